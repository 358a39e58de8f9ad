// Units in the names of columns: "d_mm", "u (cm/s)", "G [1/min] mean".
#include "base/column_unit.h"

#include "base/field.h"
#include <clast/field.h>
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

static bool is_one_of(const char *word, const char *const list[])
{
    for (; *list != NULL && strcmp(word, *list) != 0; ++list) {
    }
    return *list != NULL;
}

/// What no number is given in by itself, such as moments of inertia by density [m^5], is a unit of
/// columns alone.
static bool is_known(const char *text)
{
    static const char *const alone[] = {"phi", "1/m^2", "1/m2", "m^5", "m5", NULL};
    return is_one_of(text, alone) || clx_unit_is_known(text);
}

/// A unit that is written out, or of other systems, or in capitals: nobody means metres by it.
static bool is_foreign(const char *text, bool in_brackets)
{
    static const char *const names[] = {
        "ft",    "foot",   "feet",       "inch",       "inches",     "yd",         "mile",
        "miles", "micron", "microns",    "meter",      "metre",      "meters",     "metres",
        "fps",   "mph",    "millimeter", "millimetre", "centimeter", "centimetre", "lb",
        "lbs",   "oz",     "kn",         "micrometer", "micrometre", "nanometer",  "nanometre",
        "gram",  "grams",  "kilogram",   NULL};
    char low[CLX_COLUMN_UNIT];
    size_t n = 0;
    for (; text[n] != '\0'; ++n) {
        low[n] = (char)tolower((unsigned char)text[n]);
    }
    low[n] = '\0';
    return is_one_of(low, names) || (in_brackets && n > 1 && clx_unit_is_known(low));
}

/// Written as units are: with "/" or a power, "per min", "ft s-1".
static bool is_formula(const char *text, bool in_brackets)
{
    const size_t n = strlen(text);
    return strchr(text, '/') != NULL ||
           (in_brackets && (strchr(text, '^') != NULL || strncasecmp(text, "per ", 4) == 0 ||
                            (n > 2 && text[n - 2] == '-' && isdigit((unsigned char)text[n - 1]) &&
                             isalpha((unsigned char)text[n - 3]))));
}

static clx_unit_said judge(const char *text, bool in_brackets)
{
    static const char *const words[] = {"min", "in", "rad", "t", "phi", NULL}; // d (min), x(t)
    if (text[0] == '\0' || strcmp(text, "-") == 0 || (!in_brackets && strcmp(text, "in") == 0)) {
        return CLX_UNIT_NONE; // "flow_in" flows in
    }
    if (is_known(text)) {
        const bool is_word = in_brackets ? is_one_of(text, words) : strpbrk(text, "/^") == NULL;
        return is_word ? CLX_UNIT_WORD : CLX_UNIT_TOLD;
    }
    return is_formula(text, in_brackets) || is_foreign(text, in_brackets) ? CLX_UNIT_TOLD
                                                                          : CLX_UNIT_NONE;
}

/// n bytes without blanks around; "" where they are too many for a unit.
static void copy_trimmed(const char *at, size_t n, char unit[CLX_COLUMN_UNIT])
{
    while (n > 0 && isspace((unsigned char)*at)) {
        ++at;
        --n;
    }
    while (n > 0 && isspace((unsigned char)at[n - 1])) {
        --n;
    }
    (void)snprintf(unit, CLX_COLUMN_UNIT, "%.*s", n < CLX_COLUMN_UNIT ? (int)n : 0, at);
}

static clx_unit_said in_brackets(const char *name, char unit[CLX_COLUMN_UNIT])
{
    clx_unit_said said = CLX_UNIT_NONE;
    const char *open = strpbrk(name, "([");
    while (open != NULL && said == CLX_UNIT_NONE) {
        const char *close = strchr(open, *open == '(' ? ')' : ']');
        if (close != NULL) {
            copy_trimmed(open + 1, (size_t)(close - open) - 1, unit);
            said = judge(unit, true);
        }
        open = strpbrk(open + 1, "([");
    }
    return said;
}

static bool is_component(const char *part, size_t n)
{
    return (n == 1 && strchr("xyzXYZ", part[0]) != NULL) || strspn(part, "0123456789") >= n;
}

/// Parts from the last one to the second: of those before the last only what has a "/" is a unit.
static clx_unit_said behind_bars(const char *name, char unit[CLX_COLUMN_UNIT])
{
    clx_unit_said said = CLX_UNIT_NONE;
    bool is_last = true;
    const char *bar = strrchr(name, '_');
    size_t end = bar != NULL ? (size_t)(bar - name) + strcspn(bar, "([:") : 0;
    for (size_t at = end; at > 1 && said == CLX_UNIT_NONE; --at) {
        if (name[at - 1] != '_') {
            continue;
        }
        copy_trimmed(name + at, end - at, unit);
        if (is_last || strchr(unit, '/') != NULL) {
            said = judge(unit, false);
        }
        is_last = is_last && is_component(name + at, end - at);
        end = at - 1;
    }
    return said;
}

clx_unit_said clx_column_unit(const char *name, char unit[CLX_COLUMN_UNIT])
{
    clx_unit_said said = in_brackets(name, unit);
    if (said == CLX_UNIT_NONE) {
        said = behind_bars(name, unit);
    }
    if (said == CLX_UNIT_NONE) {
        (void)snprintf(unit, CLX_COLUMN_UNIT, "-");
    }
    return said;
}

/// The unit of a column that is known to hold lengths: "L_in" is in inches then.
static clx_unit_said unit_of_length(const char *name, char unit[CLX_COLUMN_UNIT])
{
    const char *bar = strrchr(name, '_');
    const clx_unit_said said = clx_column_unit(name, unit);
    if (said != CLX_UNIT_NONE || bar == NULL || strcmp(bar, "_in") != 0) {
        return said;
    }
    (void)snprintf(unit, CLX_COLUMN_UNIT, "in");
    return CLX_UNIT_WORD;
}

bool clx_column_says_length(const char *name, char unit[CLX_COLUMN_UNIT])
{
    double metre = 0.0;
    const clx_unit_said said = unit_of_length(name, unit);
    return clast_unit_factor(unit, "m", &metre) == CLAST_OK || strcmp(unit, "phi") == 0 ||
           (said == CLX_UNIT_TOLD && strchr(unit, '/') == NULL && !is_known(unit));
}

clast_status clx_column_length(const clast_column *column, bool takes_phi, clx_length_unit *length)
{
    clast_status status = CLAST_OK;
    clx_length_unit found = {.metre = 0.0};
    clx_unit_said said = unit_of_length(column->name, found.unit);
    const bool has_own = column->unit != NULL && strlen(column->unit) < sizeof found.unit;
    const clx_unit_said own = has_own ? judge(column->unit, true) : CLX_UNIT_NONE;
    if (own != CLX_UNIT_NONE && strcmp(column->unit, found.unit) != 0) {
        (void)snprintf(found.unit, sizeof found.unit, "%s", column->unit);
        said = own;
    }
    found.is_phi = takes_phi && strcmp(found.unit, "phi") == 0;
    if (found.is_phi) {
        (void)snprintf(found.unit, sizeof found.unit, "mm");
    }
    if (clast_unit_factor(found.unit, "m", &found.metre) != CLAST_OK) {
        CLX_CHECK(said != CLX_UNIT_TOLD && strcmp(found.unit, "phi") != 0, CLAST_E_FORMAT,
                  "column '%s' is in no unit of length that is read here (m, mm, um, ...%s): "
                  "convert or rename it",
                  column->name, takes_phi ? "; phi" : "");
        found = (clx_length_unit){.metre = 0.0};
    }
    *length = found;
done:
    return status;
}

double clx_length_value(const clx_length_unit *length, double number)
{
    return length->is_phi ? exp2(-number) : number;
}

clast_status clx_table_add_said(clast_table *table, const char *name, const char *said,
                                double **number)
{
    char unit[CLX_COLUMN_UNIT];
    (void)clx_column_unit(said, unit);
    return clast_table_add_number(table, name, is_known(unit) ? unit : "-", number);
}
