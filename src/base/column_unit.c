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

/// A unit that is written out, or of other systems or alphabets (Latin-1's micro sign), or in
/// capitals: nobody means metres by it.
static bool is_foreign(const char *text, bool in_brackets)
{
    static const char *const names[] = {
        "ft",    "foot",   "feet",       "inch",       "inches",     "yd",         "mile",
        "miles", "micron", "microns",    "meter",      "metre",      "meters",     "metres",
        "fps",   "mph",    "millimeter", "millimetre", "centimeter", "centimetre", "lb",
        "lbs",   "oz",     "kn",         "micrometer", "micrometre", "nanometer",  "nanometre",
        "gram",  "grams",  "kilogram",   "\xb5m",      "\xb5g",      NULL};
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

bool clx_unit_is_celsius(const char *unit)
{
    static const char *const names[] = {"C", "degC", "celsius", "Celsius", "\u00b0C", NULL};
    return is_one_of(unit, names);
}

/// What is a unit where a column is known to hold this dimension: L_in, d_phi, T_C.
static clx_unit_said judge_known(const char *text, const char *si_unit)
{
    static const char *const other[] = {"F", "degF", "Fahrenheit", "\u00b0F", "R", "mK", NULL};
    const bool is_length = strcmp(si_unit, "m") == 0;
    const bool is_kelvin = strcmp(si_unit, "K") == 0;
    const bool is_told = (is_length && strcmp(text, "phi") == 0) ||
                         (is_kelvin && (clx_unit_is_celsius(text) || is_one_of(text, other)));
    return is_told                                ? CLX_UNIT_TOLD
           : is_length && strcmp(text, "in") == 0 ? CLX_UNIT_WORD
                                                  : CLX_UNIT_NONE;
}

/// @param si_unit  of the dimension that the column is known to hold, or ""
static clx_unit_said judge(const char *text, const char *si_unit, bool in_brackets)
{
    static const char *const words[] = {"min", "in", "rad", "t", "phi", NULL}; // d (min), x(t)
    const clx_unit_said known = judge_known(text, si_unit);
    if (known != CLX_UNIT_NONE) {
        return known;
    }
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

static clx_unit_said in_brackets(const char *name, const char *si_unit, char unit[CLX_COLUMN_UNIT])
{
    clx_unit_said said = CLX_UNIT_NONE;
    const char *open = strpbrk(name, "([");
    while (open != NULL && said == CLX_UNIT_NONE) {
        const char *close = strchr(open, *open == '(' ? ')' : ']');
        if (close != NULL) {
            copy_trimmed(open + 1, (size_t)(close - open) - 1, unit);
            said = judge(unit, si_unit, true);
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
static clx_unit_said behind_bars(const char *name, const char *si_unit, char unit[CLX_COLUMN_UNIT])
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
            said = judge(unit, si_unit, false);
        }
        is_last = is_last && is_component(name + at, end - at);
        end = at - 1;
    }
    return said;
}

/// "density g/cm3": the last word, where nothing but a unit is written so.
static clx_unit_said behind_blank(const char *name, const char *si_unit, char unit[CLX_COLUMN_UNIT])
{
    const char *blank = strrchr(name, ' ');
    if (blank == NULL) {
        return CLX_UNIT_NONE;
    }
    copy_trimmed(blank, strlen(blank), unit);
    return judge(unit, si_unit, false) == CLX_UNIT_TOLD ? CLX_UNIT_TOLD : CLX_UNIT_NONE;
}

static clx_unit_said find_unit(const char *name, const char *si_unit, char unit[CLX_COLUMN_UNIT])
{
    clx_unit_said said = in_brackets(name, si_unit, unit);
    if (said == CLX_UNIT_NONE) {
        said = behind_bars(name, si_unit, unit);
    }
    if (said == CLX_UNIT_NONE) {
        said = behind_blank(name, si_unit, unit);
    }
    if (said == CLX_UNIT_NONE) {
        (void)snprintf(unit, CLX_COLUMN_UNIT, "-");
    }
    return said;
}

clx_unit_said clx_column_unit(const char *name, char unit[CLX_COLUMN_UNIT])
{
    return find_unit(name, "", unit);
}

/// The unit that a column says, known or not, else that of its name.
static clx_unit_said own_unit(const clast_column *column, const char *si_unit,
                              char unit[CLX_COLUMN_UNIT])
{
    static const char *const none[] = {"", "-", "1", "none", "dimensionless", NULL};
    const clx_unit_said said = find_unit(column->name, si_unit, unit);
    if (column->unit == NULL || is_one_of(column->unit, none) || strcmp(column->unit, unit) == 0 ||
        strlen(column->unit) >= CLX_COLUMN_UNIT) {
        return said;
    }
    const clx_unit_said own = judge(column->unit, si_unit, true);
    (void)snprintf(unit, CLX_COLUMN_UNIT, "%s", column->unit);
    return own == CLX_UNIT_NONE ? CLX_UNIT_TOLD : own;
}

bool clx_column_says_length(const char *name, char unit[CLX_COLUMN_UNIT])
{
    double metre = 0.0;
    const clx_unit_said said = find_unit(name, "m", unit);
    return clast_unit_factor(unit, "m", &metre) == CLAST_OK || strcmp(unit, "phi") == 0 ||
           (said == CLX_UNIT_TOLD && strchr(unit, '/') == NULL && !is_known(unit));
}

clast_status clx_column_factor(const clast_column *column, const char *si_unit,
                               char unit[CLX_COLUMN_UNIT], double *factor)
{
    const clx_unit_said said = own_unit(column, si_unit, unit);
    clast_status status = CLAST_OK;
    *factor = 0.0;
    if (strcmp(si_unit, "K") == 0 && clx_unit_is_celsius(unit)) {
        *factor = 1.0;
    } else if (said != CLX_UNIT_NONE) {
        status = clast_unit_factor(unit, si_unit, factor);
    }
    if (status != CLAST_OK && said == CLX_UNIT_WORD) { // "x_t" is no time
        return CLAST_OK;
    }
    if (status != CLAST_OK) {
        clx_fail_prefix("column '%s' (convert or rename it%s)", column->name,
                        strcmp(si_unit, "K") == 0 ? "; T_C is in degrees Celsius" : "");
    }
    return status;
}

/// "phi", "Phi (mean)"
static bool is_called_phi(const char *name)
{
    return strncasecmp(name, "phi", 3) == 0 && !isalnum((unsigned char)name[3]);
}

clast_status clx_column_length(const clast_column *column, bool takes_phi, clx_length_unit *length)
{
    clast_status status = CLAST_OK;
    clx_length_unit found = {.metre = 0.0};
    const clx_unit_said said = own_unit(column, "m", found.unit);
    found.is_phi = takes_phi && (strcmp(found.unit, "phi") == 0 ||
                                 (said == CLX_UNIT_NONE && is_called_phi(column->name)));
    if (found.is_phi) {
        (void)snprintf(found.unit, sizeof found.unit, "mm");
    }
    if (clast_unit_factor(found.unit, "m", &found.metre) != CLAST_OK) {
        CLX_CHECK(said != CLX_UNIT_TOLD, CLAST_E_FORMAT,
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

clast_status clx_table_add_numbers(clast_table *table, size_t n, const char *const column[][2])
{
    clast_status status = CLAST_OK;
    for (size_t k = 0; k < n && status == CLAST_OK; ++k) {
        status = clast_table_add_number(table, column[k][0], column[k][1], NULL);
    }
    return status;
}
