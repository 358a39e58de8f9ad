// Names of columns that count grains or hold masses.
#include "shape/size_column.h"

#include <clast/field.h>
#include <ctype.h>
#include <stdio.h>
#include <string.h>

enum { NAME_SIZE = 128 };

static const struct {
    const char *name;
    clx_size_column is;
} names[] = {
    {"count", CLX_SIZE_COLUMN_NUMBER},
    {"counts", CLX_SIZE_COLUMN_NUMBER},
    {"n", CLX_SIZE_COLUMN_NUMBER},
    {"number", CLX_SIZE_COLUMN_NUMBER},
    {"numbers", CLX_SIZE_COLUMN_NUMBER},
    {"n grain", CLX_SIZE_COLUMN_NUMBER},
    {"n grains", CLX_SIZE_COLUMN_NUMBER},
    {"n particle", CLX_SIZE_COLUMN_NUMBER},
    {"n particles", CLX_SIZE_COLUMN_NUMBER},
    {"grains", CLX_SIZE_COLUMN_NUMBER},
    {"particles", CLX_SIZE_COLUMN_NUMBER},
    {"grain count", CLX_SIZE_COLUMN_NUMBER},
    {"particle count", CLX_SIZE_COLUMN_NUMBER},
    {"number of grains", CLX_SIZE_COLUMN_NUMBER},
    {"number of particles", CLX_SIZE_COLUMN_NUMBER},
    {"number fraction", CLX_SIZE_COLUMN_NUMBER},
    {"number share", CLX_SIZE_COLUMN_NUMBER},
    {"weight", CLX_SIZE_COLUMN_EITHER},
    {"weights", CLX_SIZE_COLUMN_EITHER},
    {"frequency", CLX_SIZE_COLUMN_EITHER},
    {"fraction", CLX_SIZE_COLUMN_EITHER},
    {"share", CLX_SIZE_COLUMN_EITHER},
    {"percent", CLX_SIZE_COLUMN_EITHER},
    {"mass", CLX_SIZE_COLUMN_MASS},
    {"masses", CLX_SIZE_COLUMN_MASS},
    {"mass fraction", CLX_SIZE_COLUMN_MASS},
    {"mass share", CLX_SIZE_COLUMN_MASS},
    {"mass retained", CLX_SIZE_COLUMN_MASS},
    {"retained", CLX_SIZE_COLUMN_MASS},
    {"retained mass", CLX_SIZE_COLUMN_MASS},
    {"wt", CLX_SIZE_COLUMN_MASS},
};

static bool is_mass_unit(const char *unit)
{
    double factor = 0.0;
    return clast_unit_factor(unit, "kg", &factor) == CLAST_OK;
}

static bool is_share_unit(const char *unit)
{
    return strcmp(unit, "%") == 0 || strcmp(unit, "-") == 0 || strcmp(unit, "percent") == 0;
}

/// Cuts the unit off the name: "Mass (g)", "mass [g]", "mass_g", "wt%". "" for none.
static void split_unit(char name[NAME_SIZE], char unit[NAME_SIZE])
{
    char *const open = strpbrk(name, "([");
    char *const bar = strrchr(name, '_');
    const size_t length = strlen(name);
    unit[0] = '\0';
    if (open != NULL) {
        const char *at = open + 1 + strspn(open + 1, " ");
        (void)snprintf(unit, NAME_SIZE, "%.*s", (int)strcspn(at, " )]"), at);
        *open = '\0';
    } else if (bar != NULL && (is_mass_unit(bar + 1) || is_share_unit(bar + 1))) {
        (void)snprintf(unit, NAME_SIZE, "%s", bar + 1);
        *bar = '\0';
    } else if (length > 1 && name[length - 1] == '%') {
        (void)snprintf(unit, NAME_SIZE, "%%");
        name[length - 1] = '\0';
    }
}

/// Lower case, "_" as a blank, none at the end.
static void simplify(char *name)
{
    size_t length = strlen(name);
    for (size_t i = 0; i < length; ++i) {
        name[i] = name[i] == '_' ? ' ' : (char)tolower((unsigned char)name[i]);
    }
    while (length > 0 && name[length - 1] == ' ') {
        name[--length] = '\0';
    }
}

clx_size_column clx_size_column_of(const char *name)
{
    char text[NAME_SIZE];
    char unit[NAME_SIZE];
    clx_size_column is = CLX_SIZE_COLUMN_OTHER;
    (void)snprintf(text, sizeof text, "%s", name);
    split_unit(text, unit);
    simplify(text);
    for (size_t k = 0; k < sizeof names / sizeof names[0]; ++k) {
        is = strcmp(text, names[k].name) == 0 ? names[k].is : is;
    }
    if (unit[0] == '\0' || is_share_unit(unit)) { // "weight" is any measure, "weight %" a mass
        const bool is_percent = unit[0] == '%' || unit[0] == 'p';
        return is_percent && strncmp(text, "weight", 6) == 0 ? CLX_SIZE_COLUMN_MASS : is;
    }
    const bool is_weighed = is == CLX_SIZE_COLUMN_MASS || is == CLX_SIZE_COLUMN_EITHER;
    return is_weighed && is_mass_unit(unit) ? CLX_SIZE_COLUMN_MASS : CLX_SIZE_COLUMN_OTHER;
}
