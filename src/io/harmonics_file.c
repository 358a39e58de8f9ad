// Coefficient files of spherical-harmonic series: rows n m Re(a) Im(a).
#include <clast/harmonics.h>

#include "base/alloc.h"
#include "base/file.h"
#include "io/text.h"
#include "math/legendre.h"

static const int64_t LARGEST_FILE = 1 << 28;

/// Coefficients as they are read: the greatest degree that may come.
typedef struct {
    double (*plus)[2];  ///< [n, m >= 0]
    double (*minus)[2]; ///< [n, m > 0] of -m
    char *seen;         ///< [n, m]: 1 for m >= 0, 2 for m < 0
    int32_t degree;     ///< greatest n so far, -1 before the first row
    int64_t n_plus, n_minus;
} series_rows;

static clast_status rows_alloc(series_rows *rows)
{
    clast_status status = CLAST_OK;
    const int64_t n = clx_nm(CLAST_HARMONICS_MAX_DEGREE + 1, 0);
    rows->degree = -1;
    CLX_TRY(clx_alloc(&rows->plus, n, sizeof *rows->plus));
    CLX_TRY(clx_alloc(&rows->minus, n, sizeof *rows->minus));
    CLX_TRY(clx_alloc(&rows->seen, n, 1));
done:
    return status;
}

static void rows_free(series_rows *rows)
{
    CLX_FREE(rows->plus, rows->minus, rows->seen);
}

static clast_status add_row(clx_text *text, series_rows *rows)
{
    clast_status status = CLAST_OK;
    int64_t n = 0;
    int64_t m = 0;
    double a[2];
    clx_word rest;
    CLX_TRY(clx_text_integer(text, "degree n", 0, CLAST_HARMONICS_MAX_DEGREE, &n));
    CLX_TRY(clx_text_integer(text, "order m of -n .. n", -n, n, &m));
    CLX_TRY(clx_text_number(text, "real part", &a[0]));
    CLX_TRY(clx_text_number(text, "imaginary part", &a[1]));
    CLX_CHECK(!clx_text_word(text, &rest), CLAST_E_FORMAT,
              "line %lld: more than the four numbers n m Re Im", (long long)text->line);
    const int32_t i = clx_nm((int32_t)n, (int32_t)(m < 0 ? -m : m));
    const char mark = m < 0 ? 2 : 1;
    CLX_CHECK((rows->seen[i] & mark) == 0, CLAST_E_FORMAT,
              "line %lld: the coefficient n = %lld, m = %lld comes twice", (long long)text->line,
              (long long)n, (long long)m);
    rows->seen[i] = (char)(rows->seen[i] | mark);
    double *to = m < 0 ? rows->minus[i] : rows->plus[i];
    to[0] = a[0];
    to[1] = a[1];
    rows->n_plus += m >= 0;
    rows->n_minus += m < 0;
    rows->degree = (int32_t)n > rows->degree ? (int32_t)n : rows->degree;
done:
    return status;
}

/// Every coefficient up to the degree must be there: a file cut short is no smoother grain.
static clast_status check_complete(const series_rows *rows)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(rows->degree >= 0, CLAST_E_FORMAT, "no coefficients; rows are `n m Re(a) Im(a)`");
    for (int32_t n = 0; n <= rows->degree; ++n) {
        for (int32_t m = 0; m <= n; ++m) {
            const char seen = rows->seen[clx_nm(n, m)];
            CLX_CHECK((seen & 1) != 0, CLAST_E_FORMAT,
                      "the coefficient n = %d, m = %d is missing of a series of degree %d", n, m,
                      rows->degree);
            CLX_CHECK(m == 0 || rows->n_minus == 0 || (seen & 2) != 0, CLAST_E_FORMAT,
                      "the coefficient n = %d, m = %d is missing of a series of degree %d", n, -m,
                      rows->degree);
        }
    }
done:
    return status;
}

/// a Y_n(+m) + a' Y_n(-m) has the real part P (c cos m phi - d sin m phi) with
/// c + i d = a + (-1)^m conj(a'); without rows of -m the sum is real and c + i d = 2 a.
static void fold(const series_rows *rows, clast_harmonics *series)
{
    for (int32_t n = 0; n <= series->degree; ++n) {
        for (int32_t m = 0; m <= n; ++m) {
            const int32_t i = clx_nm(n, m);
            const double sign = m % 2 == 0 ? 1.0 : -1.0;
            const double *a = rows->plus[i];
            double c = a[0];
            double d = a[1];
            if (m > 0 && rows->n_minus > 0) {
                c += sign * rows->minus[i][0];
                d -= sign * rows->minus[i][1];
            } else if (m > 0) {
                c *= 2.0;
                d *= 2.0;
            }
            series->coefficient[i][0] = c;
            series->coefficient[i][1] = m > 0 ? -d : 0.0;
        }
    }
}

clast_status clast_harmonics_parse(const void *bytes, size_t n, clast_harmonics *series)
{
    CLX_ARGUMENTS(series);
    CLX_ARRAY(bytes, n);
    clast_status status = CLAST_OK;
    series_rows rows = {0};
    clast_harmonics made = {0};
    clx_text text = clx_text_begin(bytes, n, '#', false);
    CLX_TRY(rows_alloc(&rows));
    do {
        clx_text peek = text;
        clx_word word;
        if (clx_text_word(&peek, &word)) {
            CLX_TRY(add_row(&text, &rows));
        }
    } while (clx_text_next_line(&text));
    CLX_TRY(check_complete(&rows));
    CLX_TRY(clast_harmonics_alloc(rows.degree, &made));
    fold(&rows, &made);
    *series = made;
    made = (clast_harmonics){0};
done:
    rows_free(&rows);
    clast_harmonics_free(&made);
    return status;
}

clast_status clast_harmonics_read(const char *path, clast_harmonics *series)
{
    CLX_ARGUMENTS(path, series);
    clast_status status = CLAST_OK;
    char *bytes = NULL;
    int64_t n = 0;
    CLX_TRY(clx_file_read_all(path, LARGEST_FILE, &bytes, &n));
    status = clast_harmonics_parse(bytes, (size_t)n, series);
    if (status != CLAST_OK) {
        clx_fail_prefix("%s", path);
    }
done:
    clx_free(bytes);
    return status;
}
