// Size classes of whole monomers: 1 .. 8 each, then two classes an octave. [docs/theory/
// agglomeration.md section 6]
#include "cloud/size_classes.h"

#include "base/alloc.h"
#include <clast/agglomerate.h>
#include <math.h>
#include <stdio.h>

clast_status clx_size_classes_begin(int64_t n_row, clx_size_classes *c)
{
    clast_status status = CLAST_OK;
    enum { MOST_SPECTRA = 1000 };
    c->n_row = n_row;
    c->stride = 1 + (n_row - 1) / MOST_SPECTRA;
    c->n_snapshot = 1 + (n_row - 2 + c->stride) / c->stride;
    CLX_TRY(clx_alloc(&c->single, n_row * CLX_N_SINGLE, sizeof *c->single));
    CLX_TRY(clx_alloc(&c->single2, n_row * CLX_N_SINGLE, sizeof *c->single2));
    CLX_TRY(clx_alloc(&c->number, c->n_snapshot * CLX_N_CLASS, sizeof *c->number));
    CLX_TRY(clx_alloc(&c->number2, c->n_snapshot * CLX_N_CLASS, sizeof *c->number2));
done:
    return status;
}

void clx_size_classes_free(clx_size_classes *c)
{
    CLX_FREE(c->single, c->single2, c->number, c->number2);
    *c = (clx_size_classes){0};
}

/// Smallest number of monomers of class k.
static double low_of(int32_t k)
{
    return k < CLX_N_SINGLE ? k + 1.0 : ceil(9.0 * exp2(0.5 * (k - CLX_N_SINGLE)));
}

static int32_t class_of(int64_t monomers)
{
    CLAST_ASSERT(monomers >= 1);
    const double size = (double)monomers;
    if (monomers <= CLX_N_SINGLE) {
        return (int32_t)monomers - 1;
    }
    // the class by its logarithm, or the one above where its first number was rounded up
    int32_t k = CLX_N_SINGLE + (int32_t)fmax(0.0, 2.0 * log2(size / 9.0) - 1.0);
    while (k + 1 < CLX_N_CLASS && size >= low_of(k + 1)) {
        ++k;
    }
    return k;
}

void clx_size_classes_count(clx_size_classes *c, const clast_population *p, int64_t row)
{
    CLAST_ASSERT(row >= 0 && row < c->n_row);
    double number[CLX_N_CLASS] = {0};
    for (int64_t i = 0; i < p->n; ++i) {
        if (p->monomers[i] > 0) {
            number[class_of(p->monomers[i])] += p->weight != NULL ? p->weight[i] : 1.0;
        }
    }
    for (int32_t k = 0; k < CLX_N_SINGLE; ++k) {
        c->single[row * CLX_N_SINGLE + k] += number[k];
        c->single2[row * CLX_N_SINGLE + k] += number[k] * number[k];
    }
    if (row % c->stride != 0 && row != c->n_row - 1) {
        return;
    }
    const int64_t snapshot = (row + c->stride - 1) / c->stride;
    for (int32_t k = 0; k < CLX_N_CLASS; ++k) {
        c->number[snapshot * CLX_N_CLASS + k] += number[k];
        c->number2[snapshot * CLX_N_CLASS + k] += number[k] * number[k];
    }
}

static double deviation(double sum, double squares, int32_t n_run)
{
    const double mean = sum / n_run;
    return sqrt(fmax(0.0, squares / n_run - mean * mean) * n_run / (n_run - 1.0));
}

clast_status clx_size_classes_columns(const clx_size_classes *c, int32_t n_run,
                                      clast_table *history)
{
    clast_status status = CLAST_OK;
    for (int32_t k = 0; k < CLX_N_SINGLE; ++k) {
        char name[24];
        double *column = NULL;
        (void)snprintf(name, sizeof name, "n_%d", k + 1);
        CLX_TRY(clast_table_add_number(history, name, "-", &column));
        for (int64_t row = 0; row < c->n_row; ++row) {
            column[row] = c->single[row * CLX_N_SINGLE + k] / n_run;
        }
        if (n_run > 1) {
            (void)snprintf(name, sizeof name, "n_%d_sd", k + 1);
            CLX_TRY(clast_table_add_number(history, name, "-", &column));
            for (int64_t row = 0; row < c->n_row; ++row) {
                const int64_t at = row * CLX_N_SINGLE + k;
                column[row] = deviation(c->single[at], c->single2[at], n_run);
            }
        }
    }
done:
    return status;
}

clast_status clx_size_classes_table(const clx_size_classes *c, int32_t n_run, const double *time,
                                    clast_table *spectrum)
{
    enum { N_COLUMN = 7 };
    static const char *const name[N_COLUMN] = {"time_s", "size",    "size_low", "size_high",
                                               "n",      "density", "n_sd"};
    static const char *const unit[N_COLUMN] = {"s", "-", "-", "-", "-", "-", "-"};
    clast_status status = CLAST_OK;
    const int n_column = n_run > 1 ? N_COLUMN : N_COLUMN - 1;
    int32_t n_class = 1;
    double *column = NULL;
    for (int64_t at = 0; at < c->n_snapshot * CLX_N_CLASS; ++at) {
        const int32_t k = (int32_t)(at % CLX_N_CLASS);
        n_class = c->number[at] > 0.0 && k >= n_class ? k + 1 : n_class;
    }
    CLX_TRY(clast_table_init(spectrum, "spectrum", c->n_snapshot * n_class));
    for (int k = 0; k < n_column; ++k) {
        CLX_TRY(clast_table_add_number(spectrum, name[k], unit[k], &column));
    }
    for (int64_t i = 0; i < spectrum->n_row; ++i) {
        const int32_t k = (int32_t)(i % n_class);
        const int64_t at = i / n_class * CLX_N_CLASS + k;
        const double low = low_of(k);
        const double high = low_of(k + 1) - 1.0;
        const double n = c->number[at] / n_run;
        const double value[N_COLUMN] = {
            time[i / n_class * c->stride < c->n_row ? i / n_class * c->stride : c->n_row - 1],
            0.5 * (low + high),
            low,
            high,
            n,
            n / (high - low + 1.0),
            n_run > 1 ? deviation(c->number[at], c->number2[at], n_run) : 0.0};
        for (int j = 0; j < n_column; ++j) {
            spectrum->column[j].number[i] = value[j];
        }
    }
done:
    return status;
}
