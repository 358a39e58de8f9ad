// Statistics of a set of grains. The tables and charts of a folder are in study/grain_statistics.c.
#include <clast/statistics.h>

#include "base/status.h"
#include <clast/table.h>

void clast_grain_statistics_free(clast_grain_statistics *statistics)
{
    if (statistics == NULL) {
        return;
    }
    clast_form_set_free(&statistics->set);
    clast_statistics_free(&statistics->statistics);
    *statistics = (clast_grain_statistics){0};
}

clast_status clast_grain_statistics_of(const clast_table *table, const char *columns,
                                       const clast_bootstrap *bootstrap,
                                       clast_grain_statistics *statistics)
{
    CLX_ARGUMENTS(table, statistics);
    CLX_WHOLE(table, table);
    clast_status status = CLAST_OK;
    clast_grain_statistics g = {0};
    clast_table factors = {0};
    CLX_TRY(clast_form_set_of(table, columns, &g.set));
    CLX_TRY(clast_form_set_factors(&g.set, &factors));
    CLX_TRY(clast_statistics_of(&factors, bootstrap, &g.statistics));
    CLX_TRY(clast_statistics_limit_pca(&g.statistics, CLAST_N_FORM_FACTOR));
    for (int64_t i = 0; i < g.set.n; ++i) {
        ++g.zingg[clast_form_zingg(g.set.flatness[i], g.set.elongation[i])];
    }
    *statistics = g;
    g = (clast_grain_statistics){0};
done:
    clast_table_free(&factors);
    clast_grain_statistics_free(&g);
    return status;
}
