// Grains of the beds of a study.
#include "study_grains.h"

#include <stdio.h>
#include <sys/stat.h>

bool cli_is_folder(const char *path)
{
    struct stat about;
    return stat(path, &about) == 0 && S_ISDIR(about.st_mode);
}

/// Adds the rows of one run's grains.
static clast_status add_run(const char *path, double run, const char *group, clast_table *grains)
{
    static const char *const name[2] = {"flatness", "elongation"};
    clast_table own = {0};
    const int64_t first = grains->n_row;
    clast_status status = CLAST_OK;
    CLI_TRY(clast_table_read_csv(path, NULL, &own, NULL));
    CLI_TRY(clast_table_resize(grains, first + own.n_row));
    for (int k = 0; k < 2; ++k) {
        const double *from = clast_table_numbers(&own, name[k]);
        double *to = clast_table_numbers(grains, name[k]);
        CLI_CHECK(from != NULL, CLAST_E_FORMAT, "%s: no column is called %s", path, name[k]);
        for (int64_t i = 0; i < own.n_row; ++i) {
            to[first + i] = from[i];
        }
    }
    double *bed = clast_table_numbers(grains, group);
    for (int64_t i = first; i < grains->n_row; ++i) {
        bed[i] = run;
    }
done:
    clast_table_free(&own);
    return status;
}

clast_status cli_study_grains(const char *folder, const clast_table *beds, const char *group,
                              clast_table *grains)
{
    const double *run = clast_table_numbers(beds, group);
    const double *code = clast_table_numbers(beds, "exit_code");
    if (run == NULL) {
        return cli_fail(CLAST_E_FORMAT,
                        "table %s has no column of numbers '%s' that names the run "
                        "(--group run)",
                        beds->name, group);
    }
    CLI_GUARD(clast_table_init(grains, folder, 0));
    const char *const names[3] = {group, "flatness", "elongation"};
    for (int k = 0; k < 3; ++k) {
        CLI_GUARD(clast_table_add_number(grains, names[k], "-", NULL));
    }
    for (int64_t i = 0; i < beds->n_row; ++i) {
        char path[4096];
        (void)snprintf(path, sizeof path, "%s/runs/%06.0f/out/grains.csv", folder, run[i]);
        if (code == NULL || code[i] == 0.0) { // a failed run has no bed either
            CLI_GUARD(add_run(path, run[i], group, grains));
        }
    }
    return CLAST_OK;
}
