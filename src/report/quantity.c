// Labels, units and digits of the report's numbers.
#include "report/quantity.h"

#include "report/page.h"
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const clx_quantity known[] = {
    {"n_repeat", "Repeats", "", false},
    {"n_grain", "Grains", "", true},
    {"n_particle", "Particles placed", "", false},
    {"n_contact", "Contacts", "", false},
    {"n_cluster", "Clusters", "", false},
    {"porosity", "Porosity", "", true},
    {"porosity_bulk", "Bulk porosity", "", true},
    {"bulk", "Bulk porosity", "", true},
    {"d_agg", "Aggregate diameter", "m", true},
    {"density", "Bulk density", "kg/m^3", true},
    {"mass", "Mass", "kg", false},
    {"solid_sum", "Solid volume, sum of the grains", "m^3", false},
    {"solid_union", "Solid volume, union of the grains", "m^3", false},
    {"envelope", "Envelope volume", "m^3", false},
    {"envelope_error", "Bound on the envelope's error", "m^3", false},
    {"radius_of_gyration", "Radius of gyration", "m", true},
    {"settling_velocity", "Settling velocity in air", "m/s", false},
    {"max_overlap", "Greatest overlap", "m", false},
    {"max_overlap_relative", "Greatest overlap by grain size", "", false},
    {"n_lost", "Particles left at a step limit", "", false},
    {"fractal_dimension", "Fractal dimension", "", false},
    {"coordination", "Coordination number", "", true},
    {"time", "Simulated time", "s", false},
    {"n_step", "Steps", "", false},
    {"n_sphere", "Spheres", "", true},
    {"filled_fraction", "Filled fraction", "", true},
    {"wall_s", "Wall time", "s", false},
    {"contact_s", "Wall time of contact search", "s", false},
    {"envelope_s", "Wall time of envelopes", "s", false},
};

static const struct {
    const char *ending, *unit;
} endings[] = {{"_kg/m^3", "kg/m^3"}, {"_m3", "m^3"},  {"_m2", "m^2"},      {"_kg", "kg"},
               {"_m", "m"},           {"_m/s", "m/s"}, {"_s", "s"},         {"_rad", "rad"},
               {"_um", "\302\265m"},  {"_mm", "mm"},   {"_deg", "\302\260"}};

static size_t ending_of(const char *key, const char **unit)
{
    const size_t n = strlen(key);
    for (size_t k = 0; k < sizeof endings / sizeof *endings; ++k) {
        const size_t length = strlen(endings[k].ending);
        if (n > length && strcmp(key + n - length, endings[k].ending) == 0) {
            *unit = endings[k].unit;
            return length;
        }
    }
    *unit = "";
    return 0;
}

clx_quantity clx_quantity_of(const char *key, char label[CLX_QUANTITY_SIZE])
{
    for (size_t k = 0; k < sizeof known / sizeof *known; ++k) {
        if (strcmp(known[k].key, key) == 0) {
            return known[k];
        }
    }
    const char *unit = "";
    const size_t cut = ending_of(key, &unit);
    (void)snprintf(label, CLX_QUANTITY_SIZE, "%.*s", (int)(strlen(key) - cut), key);
    label[0] = (char)toupper((unsigned char)label[0]);
    for (char *c = label; *c != '\0'; ++c) {
        *c = *c == '_' ? ' ' : *c;
    }
    return (clx_quantity){.key = key, .label = label, .unit = unit};
}

typedef struct {
    double factor; ///< from SI
    const char *name;
} scale;

/// The largest unit of which the value has at least one; the smallest for less, the last for 0.
static scale pick(double value, const scale *scales, int n)
{
    for (int i = 0; i < n; ++i) {
        if (fabs(value) * scales[i].factor >= 0.9995) {
            return scales[i];
        }
    }
    return scales[value != 0.0 ? n - 1 : 0];
}

static scale scale_of(double value, const char *unit)
{
    static const scale length[] = {{1.0, "m"}, {1e3, "mm"}, {1e6, "\302\265m"}, {1e9, "nm"}};
    static const scale volume[] = {
        {1.0, "m\302\263"}, {1e9, "mm\302\263"}, {1e18, "\302\265m\302\263"}, {1e27, "nm\302\263"}};
    static const scale mass[] = {{1.0, "kg"},        {1e3, "g"},   {1e6, "mg"},
                                 {1e9, "\302\265g"}, {1e12, "ng"}, {1e15, "pg"}};
    static const scale time[] = {{1.0, "s"}, {1e3, "ms"}, {1e6, "\302\265s"}};
    if (strcmp(unit, "m") == 0) {
        return pick(value, length, 4);
    }
    if (strcmp(unit, "m^3") == 0) {
        return pick(value, volume, 4);
    }
    if (strcmp(unit, "kg") == 0) {
        return pick(value, mass, 6);
    }
    if (strcmp(unit, "s") == 0) {
        return pick(value, time, 3);
    }
    return (scale){1.0, clx_quantity_unit(unit)};
}

const char *clx_quantity_unit(const char *si_unit)
{
    static const struct {
        const char *plain, *shown;
    } units[] = {{"-", ""},
                 {"kg/m^3", "kg/m\302\263"},
                 {"m^3", "m\302\263"},
                 {"m^2", "m\302\262"},
                 {"m/s^2", "m/s\302\262"}};
    for (size_t k = 0; k < sizeof units / sizeof *units; ++k) {
        if (strcmp(units[k].plain, si_unit) == 0) {
            return units[k].shown;
        }
    }
    return si_unit;
}

/// -12 as superscript digits.
static void raise_digits(int power, char out[32])
{
    static const char *const digit[] = {
        "\342\201\260", "\302\271",     "\302\262",     "\302\263",     "\342\201\264",
        "\342\201\265", "\342\201\266", "\342\201\267", "\342\201\270", "\342\201\271"};
    char plain[16];
    out[0] = '\0';
    (void)snprintf(plain, sizeof plain, "%d", power);
    for (const char *c = plain; *c != '\0'; ++c) {
        const size_t used = strlen(out);
        (void)snprintf(out + used, 32 - used, "%s", *c == '-' ? "\342\201\273" : digit[*c - '0']);
    }
}

void clx_quantity_format(double value, const char *si_unit, char text[CLX_QUANTITY_SIZE],
                         const char **unit)
{
    const scale s = scale_of(value, si_unit);
    const double shown = value * s.factor;
    *unit = s.name;
    if (shown == floor(shown) && fabs(shown) < 1e9 && (s.name[0] == '\0' || shown == 0.0)) {
        (void)snprintf(text, CLX_QUANTITY_SIZE, "%.0f", shown);
    } else if (fabs(shown) >= 1e-3 && fabs(shown) < 1e5) {
        const int digits = 3 - (int)floor(log10(fabs(shown)));
        (void)snprintf(text, CLX_QUANTITY_SIZE, "%.*f", digits > 0 ? digits : 0, shown);
    } else {
        const int power = (int)floor(log10(fabs(shown)) + 1e-12);
        char superscript[32];
        raise_digits(power, superscript);
        (void)snprintf(text, CLX_QUANTITY_SIZE, "%.3f\302\240\303\227\302\24010%s",
                       shown / pow(10.0, power), superscript);
    }
}

void clx_quantity_put(clx_file *file, double value, const char *si_unit)
{
    char text[CLX_QUANTITY_SIZE];
    const char *unit = "";
    if (!isfinite(value)) {
        (void)clx_file_print(file, "<span title=\"%s\">\342\200\223</span>",
                             isnan(value) ? "not known" : "infinite");
        return;
    }
    clx_quantity_format(value, si_unit, text, &unit);
    (void)clx_file_print(file, "<span title=\"%.17g ", value);
    clx_page_text(file, clx_quantity_unit(si_unit));
    (void)clx_file_print(file, "\">%s", text);
    if (unit[0] != '\0') {
        (void)clx_file_print(file, "\302\240<span class=\"unit\">");
        clx_page_text(file, unit);
        (void)clx_file_print(file, "</span>");
    }
    (void)clx_file_print(file, "</span>");
}
