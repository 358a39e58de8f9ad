// Units of measure: texts such as "675 um" become SI numbers.
#include <clast/field.h>

#include "base/field.h"
#include "base/number.h"
#include "base/status.h"
#include <ctype.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

typedef struct {
    const char *name;
    const char *si;
    double factor;
} unit;

static const unit units[] = {
    {"m", "m", 1.0},
    {"cm", "m", 1e-2},
    {"mm", "m", 1e-3},
    {"um", "m", 1e-6},
    {"nm", "m", 1e-9},
    {"km", "m", 1e3},
    {"in", "m", 0.0254},
    {"m^2", "m^2", 1.0},
    {"cm^2", "m^2", 1e-4},
    {"mm^2", "m^2", 1e-6},
    {"um^2", "m^2", 1e-12},
    {"nm^2", "m^2", 1e-18},
    {"m^3", "m^3", 1.0},
    {"cm^3", "m^3", 1e-6},
    {"mm^3", "m^3", 1e-9},
    {"um^3", "m^3", 1e-18},
    {"nm^3", "m^3", 1e-27},
    {"1/m", "1/m", 1.0},
    {"1/mm", "1/m", 1e3},
    {"rad", "rad", 1.0},
    {"deg", "rad", CLAST_PI / 180.0},
    {"rad/s", "rad/s", 1.0},
    {"deg/s", "rad/s", CLAST_PI / 180.0},
    {"rpm", "rad/s", CLAST_PI / 30.0},
    {"kg", "kg", 1.0},
    {"g", "kg", 1e-3},
    {"mg", "kg", 1e-6},
    {"ug", "kg", 1e-9},
    {"ng", "kg", 1e-12},
    {"pg", "kg", 1e-15},
    {"fg", "kg", 1e-18},
    {"t", "kg", 1e3},
    {"s", "s", 1.0},
    {"ms", "s", 1e-3},
    {"us", "s", 1e-6},
    {"ns", "s", 1e-9},
    {"min", "s", 60.0},
    {"h", "s", 3600.0},
    {"kg/m^3", "kg/m^3", 1.0},
    {"g/cm^3", "kg/m^3", 1e3},
    {"m/s", "m/s", 1.0},
    {"cm/s", "m/s", 1e-2},
    {"mm/s", "m/s", 1e-3},
    {"um/s", "m/s", 1e-6},
    {"nm/s", "m/s", 1e-9},
    {"km/h", "m/s", 1.0 / 3.6},
    {"m/s^2", "m/s^2", 1.0},
    {"Pa", "Pa", 1.0},
    {"kPa", "Pa", 1e3},
    {"MPa", "Pa", 1e6},
    {"GPa", "Pa", 1e9},
    {"Pa s", "Pa s", 1.0},
    {"Pa*s", "Pa s", 1.0},
    {"Pas", "Pa s", 1.0},
    {"mPa s", "Pa s", 1e-3},
    {"mPa*s", "Pa s", 1e-3},
    {"uPa s", "Pa s", 1e-6},
    {"uPa*s", "Pa s", 1e-6},
    {"m^2/s", "m^2/s", 1.0},
    {"cm^2/s", "m^2/s", 1e-4},
    {"mm^2/s", "m^2/s", 1e-6},
    {"m^2/s^3", "m^2/s^3", 1.0},
    {"cm^2/s^3", "m^2/s^3", 1e-4},
    {"mm^2/s^3", "m^2/s^3", 1e-6},
    {"W/kg", "m^2/s^3", 1.0},
    {"m^3/s", "m^3/s", 1.0},
    {"cm^3/s", "m^3/s", 1e-6},
    {"mm^3/s", "m^3/s", 1e-9},
    {"1/s", "1/s", 1.0},
    {"1/min", "1/s", 1.0 / 60.0},
    {"1/h", "1/s", 1.0 / 3600.0},
    {"K", "K", 1.0},
    {"J", "J", 1.0},
    {"mJ", "J", 1e-3},
    {"uJ", "J", 1e-6},
    {"nJ", "J", 1e-9},
    {"pJ", "J", 1e-12},
    {"fJ", "J", 1e-15},
    {"J/m^3", "J/m^3", 1.0},
    {"J/m^2", "J/m^2", 1.0},
    {"mJ/m^2", "J/m^2", 1e-3},
    {"N", "N", 1.0},
    {"mN", "N", 1e-3},
    {"uN", "N", 1e-6},
    {"nN", "N", 1e-9},
    {"pN", "N", 1e-12},
    {"N/m", "N/m", 1.0},
    {"1/m^3", "1/m^3", 1.0},
    {"1/cm^3", "1/m^3", 1e6},
    {"1/mm^3", "1/m^3", 1e9},
    {"B", "B", 1.0},
    {"kB", "B", 1e3},
    {"MB", "B", 1e6},
    {"GB", "B", 1e9},
    {"TB", "B", 1e12},
    {"KiB", "B", 0x1p10},
    {"MiB", "B", 0x1p20},
    {"GiB", "B", 0x1p30},
    {"TiB", "B", 0x1p40},
    {"-", "-", 1.0},
    {"%", "-", 0.01},
};

enum { N_UNIT = sizeof units / sizeof units[0] };

enum { KNOWN_SIZE = 256 };

/// The d of "m", "m^2" and "m^3", and of these by a time, else 0.
static int32_t power_of(const char *si)
{
    static const char *const power[3][2] = {{"m", "m/s"}, {"m^2", "m^2/s"}, {"m^3", "m^3/s"}};
    int32_t d = 3;
    while (d > 0 && strcmp(si, power[d - 1][0]) != 0 && strcmp(si, power[d - 1][1]) != 0) {
        --d;
    }
    return d;
}

/// Whether a unit is one of this dimension; m^d and m^d/s are those of points.
static bool is_of(const unit *u, const char *si)
{
    return strcmp(u->si, si) == 0 || (strncmp(si, "m^d", 3) == 0 && power_of(u->si) > 0 &&
                                      (si[3] == '/') == (strchr(u->si, '/') != NULL));
}

/// Units of a dimension, "m, cm, mm".
static void list_known(const char *si, char known[KNOWN_SIZE])
{
    known[0] = '\0';
    for (int i = 0; i < N_UNIT; ++i) {
        if (is_of(&units[i], si)) {
            const size_t used = strlen(known);
            (void)snprintf(known + used, KNOWN_SIZE - used, "%s%s", used > 0 ? ", " : "",
                           units[i].name);
        }
    }
}

/// "cm s^-1" as "cm/s", "s^-1" as "1/s": the last factor is the one with a negative power.
static void to_quotient(char plain[KNOWN_SIZE])
{
    static const char between[] = " *.";
    char made[KNOWN_SIZE];
    const char *const power = strstr(plain, "^-");
    if (power == NULL) {
        return;
    }
    const bool is_one = strcmp(power, "^-1") == 0;
    int from = (int)(power - plain);
    while (from > 0 && strchr(between, plain[from - 1]) == NULL) {
        --from;
    }
    int over = from;
    while (over > 0 && strchr(between, plain[over - 1]) != NULL) {
        --over;
    }
    (void)snprintf(made, sizeof made, "%.*s/%.*s%s%s", over > 0 ? over : 1, over > 0 ? plain : "1",
                   (int)(power - plain) - from, plain + from, is_one ? "" : "^",
                   is_one ? "" : power + 2);
    memcpy(plain, made, sizeof made);
}

/// The name in ASCII, with its exponents marked: "\302\265g" (either micro sign) -> "ug",
/// "m/s\302\262" and "m/s2" -> "m/s^2", "/min" and "min-1" -> "1/min".
static void to_ascii(const char *name, char plain[KNOWN_SIZE])
{
    static const char *const signs[][2] = {
        {"\302\265", "u"},  {"\316\274", "u"},      {"\302\262", "^2"}, {"\302\263", "^3"},
        {"\302\271", "^1"}, {"\342\201\273", "^-"}, {"\302\267", " "},  {"\302\260", "deg"}};
    enum { N_SIGN = sizeof signs / sizeof signs[0] };
    size_t used = (size_t)snprintf(plain, KNOWN_SIZE, "%s", *name == '/' ? "1" : "");
    while (*name != '\0' && used + 4 < KNOWN_SIZE) {
        int k = 0;
        const char *digit = name + (*name == '-');
        if (isdigit((unsigned char)*digit) && used > 0 && isalpha((unsigned char)plain[used - 1])) {
            plain[used++] = '^';
        }
        while (k < N_SIGN && strncmp(name, signs[k][0], strlen(signs[k][0])) != 0) {
            ++k;
        }
        const char *text = k < N_SIGN ? signs[k][1] : name;
        text += *text == '^' && used > 0 && plain[used - 1] == '-'; // both in superscript
        used += (size_t)snprintf(plain + used, KNOWN_SIZE - used, "%.*s", k < N_SIGN ? 3 : 1, text);
        name += k < N_SIGN ? strlen(signs[k][0]) : 1;
    }
    plain[used] = '\0';
    to_quotient(plain);
}

static clast_status unknown(const char *name, const char *si)
{
    char known[KNOWN_SIZE];
    list_known(si, known);
    return known[0] != '\0'
               ? clx_fail(CLAST_E_CONFIG, "unknown unit '%s'; known here: %s", name, known)
               : clx_fail(CLAST_E_CONFIG, "unknown unit '%s'; give a bare number in %s", name, si);
}

clast_status clast_unit_factor(const char *name, const char *si_unit, double *factor)
{
    CLX_ARGUMENTS(name, si_unit, factor);
    char plain[KNOWN_SIZE];
    to_ascii(name, plain);
    for (int i = 0; i < N_UNIT; ++i) {
        if (strcmp(units[i].name, plain) == 0 && is_of(&units[i], si_unit)) {
            *factor = units[i].factor;
            return CLAST_OK;
        }
    }
    if (strcmp(name, si_unit) == 0) { // "m^d", whose d is the cloud's
        *factor = 1.0;
        return CLAST_OK;
    }
    return unknown(name, si_unit);
}

/// The unit of any dimension, in either spelling, or NULL.
static const unit *find_unit(const char *name)
{
    char plain[KNOWN_SIZE];
    to_ascii(name, plain);
    for (int i = 0; i < N_UNIT; ++i) {
        if (strcmp(units[i].name, plain) == 0) {
            return &units[i];
        }
    }
    return NULL;
}

bool clx_unit_is_known(const char *name)
{
    return find_unit(name) != NULL;
}

/// Units that people choose among, all of them in `units`, the largest first: a number gets the
/// first of which it has `least`, 0 that of `zero`.
static const struct {
    const char *si, *zero;
    double least;
    struct {
        const char *name;
        double factor; ///< from SI
    } unit[7];
} prefixes[] = {
    {"m", "mm", 1.0, {{"m", 1.0}, {"mm", 1e3}, {"um", 1e6}, {"nm", 1e9}}},
    {"m^2", "mm^2", 1e-3, {{"m^2", 1.0}, {"mm^2", 1e6}, {"um^2", 1e12}, {"nm^2", 1e18}}},
    {"m^3",
     "mm^3",
     1e-3,
     {{"m^3", 1.0}, {"cm^3", 1e6}, {"mm^3", 1e9}, {"um^3", 1e18}, {"nm^3", 1e27}}},
    {"kg",
     "g",
     1.0,
     {{"kg", 1.0}, {"g", 1e3}, {"mg", 1e6}, {"ug", 1e9}, {"ng", 1e12}, {"pg", 1e15}, {"fg", 1e18}}},
    {"s", "s", 1.0, {{"s", 1.0}, {"ms", 1e3}, {"us", 1e6}, {"ns", 1e9}}},
    {"m/s", "mm/s", 1.0, {{"m/s", 1.0}, {"mm/s", 1e3}, {"um/s", 1e6}, {"nm/s", 1e9}}},
    {"J",
     "J",
     1.0,
     {{"J", 1.0}, {"mJ", 1e3}, {"uJ", 1e6}, {"nJ", 1e9}, {"pJ", 1e12}, {"fJ", 1e15}}},
    {"N", "N", 1.0, {{"N", 1.0}, {"mN", 1e3}, {"uN", 1e6}, {"nN", 1e9}, {"pN", 1e12}}},
    {"Pa s", "Pa s", 1.0, {{"Pa s", 1.0}, {"mPa s", 1e3}, {"uPa s", 1e6}}},
    {"Pa", "Pa", 1.0, {{"GPa", 1e-9}, {"MPa", 1e-6}, {"kPa", 1e-3}, {"Pa", 1.0}}},
    {"rad", "deg", 0.0, {{"deg", 180.0 / CLAST_PI}}},
    {"1/m", "1/mm", 0.0, {{"1/mm", 1e-3}}},
};

enum { N_PREFIX = sizeof prefixes / sizeof prefixes[0], MAX_PREFIX = 7 };

const char *clast_unit_for(double value, const char *si_unit, double *factor)
{
    if (si_unit == NULL || factor == NULL) {
        return "";
    }
    *factor = 1.0;
    for (int i = 0; i < N_PREFIX && isfinite(value); ++i) {
        if (strcmp(prefixes[i].si, si_unit) != 0) {
            continue;
        }
        int best = 0;
        for (int k = 0; k < MAX_PREFIX && prefixes[i].unit[k].name != NULL; ++k) {
            const double f = prefixes[i].unit[k].factor;
            const bool is_it = value == 0.0
                                   ? strcmp(prefixes[i].unit[k].name, prefixes[i].zero) == 0
                                   : fabs(value) * f >= 0.9995 * prefixes[i].least;
            best = k;
            if (is_it) {
                break;
            }
        }
        *factor = prefixes[i].unit[best].factor;
        return prefixes[i].unit[best].name;
    }
    return si_unit;
}

const char *clx_unit_text(double value, const char *si_unit)
{
    static _Thread_local char shown[8][64];
    static _Thread_local unsigned next;
    char *out = shown[next++ % 8];
    double factor = 1.0;
    const bool is_plain = si_unit == NULL || strcmp(si_unit, "-") == 0;
    const char *name = is_plain ? "" : clast_unit_for(value, si_unit, &factor);
    (void)clx_number_print(out, sizeof shown[0], "%g%s%s", value * factor, is_plain ? "" : " ",
                           name);
    return out;
}

static void trim_end(char *text)
{
    size_t n = strlen(text);
    while (n > 0 && isspace((unsigned char)text[n - 1])) {
        text[--n] = '\0';
    }
}

/// The words that the C library reads as numbers.
static bool is_not_finite(const char *text)
{
    text += strspn(text, " \t");
    text += *text == '-' || *text == '+';
    return strncasecmp(text, "nan", 3) == 0 || strncasecmp(text, "inf", 3) == 0;
}

/// Times are the nearest double: 5 us is 5e-6 s, as 5e-6 is, which 5 times the double next to 1e-6
/// is not. Lengths are multiplied, as columns of files are: a domain typed in um ends where the
/// file's last point lies.
static double to_si(double number, double factor, const char *si_unit)
{
    const double inverse = nearbyint(1.0 / factor);
    const bool is_whole = factor < 1.0 && fabs(inverse * factor - 1.0) < 4.0 * DBL_EPSILON;
    return is_whole && strcmp(si_unit, "s") == 0 ? number / inverse : number * factor;
}

clast_status clast_unit_parse(const char *text, const char *si_unit, double *value)
{
    CLX_ARGUMENTS(text, si_unit, value);
    char *end = NULL;
    const double number = clx_number_read(text, &end);
    if (end == text && !is_not_finite(text)) {
        return clx_fail(CLAST_E_CONFIG, "'%s' is not a number", text);
    }
    if (end == text || !isfinite(number)) {
        return clx_fail(CLAST_E_CONFIG, "'%s' is not a finite number", text);
    }
    while (isspace((unsigned char)*end)) {
        ++end;
    }
    char name[32] = "";
    (void)snprintf(name, sizeof name, "%s", end);
    trim_end(name);
    if (name[0] == '\0') {
        *value = number;
        return CLAST_OK;
    }
    if (strcmp(name, "phi") == 0 && strcmp(si_unit, "m") == 0) {
        *value = 1e-3 * exp2(-number);
        return CLAST_OK;
    }
    double factor = 0.0;
    const clast_status status = clast_unit_factor(name, si_unit, &factor);
    if (status == CLAST_OK) {
        *value = to_si(number, factor, si_unit);
    }
    return status;
}

bool clx_unit_is_number(const char *text, double *value, const char **si_unit)
{
    char *end = NULL;
    char name[32];
    const double number = clx_number_read(text, &end);
    if (end == text || !isfinite(number)) {
        return false;
    }
    (void)snprintf(name, sizeof name, "%s", end + strspn(end, " \t"));
    trim_end(name);
    const char *plain = name[0] != '\0' ? name : "-";
    const unit *found = find_unit(strcmp(name, "phi") == 0 ? "m" : plain);
    if (found != NULL && si_unit != NULL) {
        *si_unit = found->si;
    }
    return found != NULL && clast_unit_parse(text, found->si, value) == CLAST_OK;
}

int32_t clx_unit_dimension(const char *text)
{
    double value = 0.0;
    const char *si_unit = "";
    return clx_unit_is_number(text, &value, &si_unit) ? power_of(si_unit) : 0;
}

/// The unit of length in which the number comes nearest to a typical length [m].
static const char *nearest_length(double size, double typical)
{
    static const struct {
        const char *name;
        double metre;
    } scale[] = {{"m", 1.0}, {"mm", 1e-3}, {"um", 1e-6}, {"nm", 1e-9}};
    size_t best = 0;
    for (size_t k = 1; k < sizeof scale / sizeof *scale; ++k) {
        best = fabs(log(size * scale[k].metre / typical)) <
                       fabs(log(size * scale[best].metre / typical))
                   ? k
                   : best;
    }
    return scale[best].name;
}

/// Refuses a bare number of a dimension for which people use several units, and says how to write
/// it: near its typical value where that is known, else 270 is micrometres rather than metres, 0.3
/// is metres.
static clast_status refuse_bare(const char *si_unit, double value, double typical)
{
    char known[KNOWN_SIZE];
    const char *likely = NULL;
    const double size = fabs(value);
    if (strcmp(si_unit, "m") == 0 && size > 0.0 && typical > 0.0) {
        likely = nearest_length(size, typical);
    } else if (strcmp(si_unit, "rad") == 0) {
        likely = size < 1.0 ? "rad" : "deg";
    } else if (strcmp(si_unit, "m") == 0) {
        likely = size < 0.5 ? "m" : size < 100.0 ? "mm" : "um";
    } else if (strcmp(si_unit, "B") == 0) {
        likely = "GB";
    }
    if (likely == NULL || value == 0.0) {
        return CLAST_OK;
    }
    list_known(si_unit, known);
    return clx_fail(CLAST_E_CONFIG, "%g has no unit; write %g%s, or another of %s", value, value,
                    likely, known);
}

/// No unit of a length or an angle ends like a number.
static bool is_bare(const char *text)
{
    size_t n = strlen(text);
    while (n > 0 && isspace((unsigned char)text[n - 1])) {
        --n;
    }
    return n > 0 && (isdigit((unsigned char)text[n - 1]) || text[n - 1] == '.');
}

clast_status clx_unit_parse_asked(const char *text, const char *si_unit, double typical,
                                  double *value)
{
    double parsed = 0.0;
    clast_status status = clast_unit_parse(text, si_unit, &parsed);
    if (status == CLAST_OK && is_bare(text)) {
        status = refuse_bare(si_unit, parsed, typical);
    }
    if (status == CLAST_OK) {
        *value = parsed;
    }
    return status;
}

clast_status clast_unit_parse_asked(const char *text, const char *si_unit, double *value)
{
    CLX_ARGUMENTS(text, si_unit, value);
    return clx_unit_parse_asked(text, si_unit, 0.0, value);
}

clast_status clast_unit_parse_length(const char *text, const char *own, double *value)
{
    CLX_ARGUMENTS(text, own, value);
    clast_status status = CLAST_OK;
    double factor = 1.0;
    double metres = 0.0;
    if (strcmp(own, "m") == 0) {
        return clast_unit_parse_asked(text, "m", value);
    }
    if (is_bare(text)) {
        return clast_unit_parse(text, "-", value);
    }
    CLX_CHECK(own[0] != '\0' && strcmp(own, "model") != 0, CLAST_E_CONFIG,
              "'%s': the lengths have no unit, so give a bare number in their own", text);
    CLX_TRY(clast_unit_factor(own, "m", &factor));
    CLX_TRY(clast_unit_parse(text, "m", &metres));
    *value = metres / factor;
done:
    return status;
}
