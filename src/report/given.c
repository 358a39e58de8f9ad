// Which names on a page are the user's: a column `mass` of a fit's table may be of anything.
#include "report/given.h"

#include "report/run.h"
#include <clast/porosity_model.h>
#include <clast/table.h>
#include <string.h>

static bool is_command(const clx_run *run, const char *command)
{
    const char *own = json_string_value(json_object_get(run->manifest, "command"));
    return own != NULL && strcmp(own, command) == 0;
}

bool clx_given_name(const clx_run *run, const char *name)
{
    return is_command(run, "fit") && strcmp(name, "intercept") != 0 &&
           clast_form_feature_find(name) < 0 && clast_mixture_feature_find(name) < 0;
}

bool clx_given_units(const clx_run *run)
{
    return is_command(run, "fit");
}

/// A column of a study's plan, but the number and the realisation of a run.
static bool is_varied(const clx_run *run, const char *column)
{
    const clast_table *plan = clx_run_table(run, "plan");
    return is_command(run, "study") && plan != NULL && clast_table_find(plan, column) >= 0 &&
           strcmp(column, "run") != 0 && strcmp(column, "seed") != 0;
}

bool clx_given_column(const clx_run *run, const char *table, const char *column)
{
    if (is_varied(run, column)) {
        return true;
    }
    return strcmp(table, "features") == 0 && strcmp(column, "row") != 0 &&
           strcmp(column, "porosity") != 0 && clx_given_name(run, column);
}
