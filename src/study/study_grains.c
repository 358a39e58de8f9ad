// The grains of a study's beds, from the folders of its runs.
#include "study/study.h"

#include "base/path.h"
#include "base/status.h"
#include <clast/table.h>
#include <string.h>

static const char *const form[2] = {"flatness", "elongation"};

/// Adds the rows of one run's grains; its number is in column 0, the form behind it.
static clast_status add_run(const char *path, double run, clast_table *grains)
{
    clast_status status = CLAST_OK;
    clast_table own = {0};
    const int64_t first = grains->n_row;
    CLX_TRY(clast_table_read_csv(path, NULL, &own, NULL));
    CLX_TRY(clast_table_resize(grains, first + own.n_row));
    for (int k = 0; k < 2; ++k) {
        const double *const from = clast_table_numbers(&own, form[k]);
        CLX_CHECK(from != NULL, CLAST_E_FORMAT, "%s: no column is called %s", path, form[k]);
        memcpy(grains->column[1 + k].number + first, from, (size_t)own.n_row * sizeof *from);
    }
    for (int64_t i = first; i < grains->n_row; ++i) {
        grains->column[0].number[i] = run;
    }
done:
    clast_table_free(&own);
    return status;
}

clast_status clast_study_grains(const char *folder, const clast_table *beds, const char *group,
                                clast_table *grains)
{
    CLX_ARGUMENTS(folder, beds, group, grains);
    CLX_WHOLE(table, beds);
    clast_status status = CLAST_OK;
    clast_table made = {0};
    const double *const run = clast_table_numbers(beds, group);
    const double *const code = clast_table_numbers(beds, "exit_code");
    CLX_CHECK(run != NULL, CLAST_E_FORMAT,
              "table %s has no column of numbers '%s' that names the run (--group run)", beds->name,
              group);
    CLX_TRY(clast_table_init(&made, folder, 0));
    CLX_TRY(clast_table_add_number(&made, group, "-", NULL));
    CLX_TRY(clast_table_add_number(&made, form[0], "-", NULL));
    CLX_TRY(clast_table_add_number(&made, form[1], "-", NULL));
    for (int64_t i = 0; i < beds->n_row; ++i) {
        char path[CLX_PATH_LIMIT];
        if (code != NULL && code[i] != 0.0) { // a failed run has no bed either
            continue;
        }
        CLX_CHECK(run[i] >= 1.0 && run[i] <= 1e15 && run[i] == (double)(int64_t)run[i],
                  CLAST_E_FORMAT, "table %s, row %lld: column '%s' has no number of a run",
                  beds->name, (long long)i + 1, group);
        CLX_TRY(clx_study_run_folder(folder, (int64_t)run[i] - 1, "/out/grains.csv", path));
        CLX_TRY(add_run(path, run[i], &made));
    }
    CLX_CHECK(made.n_row > 0, CLAST_E_FORMAT, "no run of %s ended well", folder);
    *grains = made;
    made = (clast_table){0};
done:
    clast_table_free(&made);
    return status;
}
