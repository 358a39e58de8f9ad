// Labels and units of keys and columns: a table of names, and how names are put together.
#include "report/quantity.h"

#include "base/file.h"
#include "report/page.h"
#include <clast/assembly.h>
#include <clast/report.h>
#include <stdio.h>
#include <string.h>

static const struct {
    const char *key, *label, *unit, *words;
    bool is_headline;
} known[] = {
#define Q(key, label, unit)        {key, label, unit, "", false},
#define H(key, label, unit)        {key, label, unit, "", true},
#define W(key, label, unit, words) {key, label, unit, words, false},
#include "report/quantities.def"
#undef Q
#undef H
#undef W
};

static const struct {
    const char *ending, *unit;
} endings[] = {{"_kg/m^3", "kg/m^3"}, {"_kg/m3", "kg/m^3"}, {"_kg_m3", "kg/m^3"}, {"_1/m", "1/m"},
               {"_m/s", "m/s"},       {"_m3", "m^3"},       {"_m2", "m^2"},       {"_kg", "kg"},
               {"_rad", "rad"},       {"_deg", "deg"},      {"_Pa", "Pa"},        {"_J", "J"},
               {"_N", "N"},           {"_Nm", "N m"},       {"_N/m^3", "N/m^3"},  {"_um", "um"},
               {"_mm", "mm"},         {"_m", "m"},          {"_s", "s"}};

/// What a name may begin with; the rest is a known name: "mean_d_agg" is "Aggregate diameter,
/// mean".
static const struct {
    const char *begin, *label;
} beginnings[] = {{"mean_", "mean"},
                  {"low_", "lower bound"},
                  {"high_", "upper bound"},
                  {"inverse_", "inverse"},
                  {"loading_", "loading"}};

typedef struct {
    const char *text;
    size_t n;
} name;

static bool is_same(name a, const char *b)
{
    return strlen(b) == a.n && strncmp(a.text, b, a.n) == 0;
}

static bool begins(name a, const char *with)
{
    const size_t n = strlen(with);
    return a.n > n && strncmp(a.text, with, n) == 0;
}

static bool ends(name a, const char *with)
{
    const size_t n = strlen(with);
    return a.n > n && strncmp(a.text + a.n - n, with, n) == 0;
}

static bool find(name key, const char *place, clx_quantity *q)
{
    const size_t n = place != NULL ? strlen(place) : 0;
    for (size_t k = 0; k < sizeof known / sizeof *known; ++k) {
        const char *own = known[k].key;
        if (n > 0) {
            own = strncmp(own, place, n) == 0 && own[n] == '/' ? own + n + 1 : "";
        }
        if (is_same(key, own)) {
            (void)snprintf(q->label, sizeof q->label, "%s", known[k].label);
            q->unit = known[k].unit;
            q->words = known[k].words;
            q->is_headline = known[k].is_headline;
            return true;
        }
    }
    return n > 0 && find(key, NULL, q);
}

static bool find_envelope(name key, char words[CLX_QUANTITY_SIZE])
{
    for (int k = 0; k < CLAST_N_ENVELOPE; ++k) {
        if (is_same(key, clast_envelope_name((clast_envelope_kind)k))) {
            (void)snprintf(words, CLX_QUANTITY_SIZE, "%.*s", (int)key.n, key.text);
            for (char *c = words; *c != '\0'; ++c) {
                *c = *c == '_' ? ' ' : *c;
            }
            return true;
        }
    }
    return false;
}

/// "porosity_surface_hull" and "envelope.surface_hull": a quantity of one envelope.
static bool find_of_envelope(name key, const char *place, clx_quantity *q)
{
    char words[CLX_QUANTITY_SIZE];
    for (size_t at = 1; at + 1 < key.n; ++at) {
        const name rest = {key.text + at + 1, key.n - at - 1};
        if ((key.text[at] == '_' || key.text[at] == '.') && find_envelope(rest, words) &&
            find((name){key.text, at}, place, q)) {
            const size_t used = strlen(q->label);
            (void)snprintf(q->label + used, sizeof q->label - used, ", %.60s", words);
            return true;
        }
    }
    return false;
}

/// Columns of walls.csv, each after the name of its wall or outlet: "piston_force_z".
static bool find_of_wall(name key, const char *place, clx_quantity *q)
{
    enum { N_OF_WALL = 11 }; // then those of an outlet
    static const char *const of[][3] = {{"_force_x", "force along x", "N"},
                                        {"_force_y", "force along y", "N"},
                                        {"_force_z", "force along z", "N"},
                                        {"_torque_x", "torque about x", "N m"},
                                        {"_torque_y", "torque about y", "N m"},
                                        {"_torque_z", "torque about z", "N m"},
                                        {"_work", "work on the grains", "J"},
                                        {"_angle", "angle", "rad"},
                                        {"_x", "x", "m"},
                                        {"_y", "y", "m"},
                                        {"_z", "z", "m"},
                                        {"_n", "grains that left", ""},
                                        {"_kg", "mass that left", "kg"}};
    for (size_t k = 0; place != NULL && strcmp(place, "walls") == 0 && k < sizeof of / sizeof *of;
         ++k) {
        const bool is_outlet = begins(key, "outlet_");
        if (ends(key, of[k][0]) && (k < N_OF_WALL || is_outlet)) {
            const int n = (int)(key.n - strlen(of[k][0]));
            (void)snprintf(q->label, sizeof q->label, "%.*s, %s", n, key.text, of[k][1]);
            q->unit = of[k][2];
            return true;
        }
    }
    return false;
}

static bool find_plain(name key, const char *place, clx_quantity *q)
{
    char words[CLX_QUANTITY_SIZE];
    if (find(key, place, q) || find_of_envelope(key, place, q) || find_of_wall(key, place, q)) {
        return true;
    }
    if (find_envelope(key, words)) {
        const bool is_name = place != NULL && strcmp(place, "envelope") == 0;
        (void)snprintf(q->label, sizeof q->label, "%s%.60s", is_name ? "" : "Envelope volume, ",
                       words);
        q->unit = "m^3";
        return true;
    }
    return false;
}

/// The known name that is left of the key without its beginning or end, with that as a word.
static bool find_part(name key, const char *place, clx_quantity *q)
{
    static const char *const last[][2] = {{".mean", "mean"},
                                          {".deviation", "s.d."},
                                          {".low", "lower bound"},
                                          {".high", "upper bound"}};
    const char *word = NULL;
    static const char *const groups[] = {"interval.", "inputs.", "result."};
    for (size_t k = 0; k < sizeof groups / sizeof *groups; ++k) {
        const size_t n = begins(key, groups[k]) ? strlen(groups[k]) : 0;
        key = (name){key.text + n, key.n - n};
    }
    for (size_t k = 0; k < sizeof last / sizeof *last && word == NULL; ++k) {
        if (ends(key, last[k][0])) {
            key.n -= strlen(last[k][0]);
            word = last[k][1];
        }
    }
    for (size_t k = 0; k < sizeof beginnings / sizeof *beginnings && word == NULL; ++k) {
        if (begins(key, beginnings[k].begin)) {
            const size_t n = strlen(beginnings[k].begin);
            key = (name){key.text + n, key.n - n};
            word = beginnings[k].label;
        }
    }
    if (!find_plain(key, place, q)) {
        return false;
    }
    const size_t used = strlen(q->label);
    (void)snprintf(q->label + used, sizeof q->label - used, "%s%s", word != NULL ? ", " : "",
                   word != NULL ? word : "");
    return true;
}

/// Without the unit that the name ends in; that unit, or NULL.
static const char *cut_unit(name *key)
{
    for (size_t k = 0; k < sizeof endings / sizeof *endings; ++k) {
        if (ends(*key, endings[k].ending)) {
            key->n -= strlen(endings[k].ending);
            return endings[k].unit;
        }
    }
    return NULL;
}

/// True when the name of a column ends in its unit: "size_m".
static bool names_unit(const char *key)
{
    name whole = {key, strlen(key)};
    return cut_unit(&whole) != NULL;
}

/// Unit of the quantity that the key is a statistic of, "mean" of "z_high".
static const char *unit_of_parent(const char *key, const char *place)
{
    static const char *const statistics[] = {"mean", "deviation", "low", "high"};
    clx_quantity parent = {.unit = ""};
    for (size_t k = 0; place != NULL && k < sizeof statistics / sizeof *statistics; ++k) {
        if (strcmp(key, statistics[k]) == 0 && find((name){place, strlen(place)}, NULL, &parent)) {
            return parent.unit;
        }
    }
    return "";
}

clx_quantity clx_quantity_of(const char *key, const char *place)
{
    static const clx_quantity none = {.unit = "", .words = ""};
    const size_t n = sizeof CLX_MODEL_UNITS - 1;
    clx_quantity q = none;
    name whole = {key, strlen(key)};
    if (place != NULL && strncmp(place, CLX_MODEL_UNITS, n) == 0) {
        q = clx_quantity_of(key, place[n] != '\0' ? place + n : NULL);
        q.unit = names_unit(key) ? q.unit : clx_quantity_model_unit(q.unit);
        return q;
    }
    if (find_plain(whole, place, &q) || find_part(whole, place, &q)) {
        q.unit = q.unit[0] == '\0' ? unit_of_parent(key, place) : q.unit;
        return q;
    }
    const char *unit = cut_unit(&whole);
    if (unit != NULL && !find_plain(whole, place, &q)) {
        (void)find_part(whole, place, &q);
    }
    q.unit = unit != NULL ? unit : "";
    return q;
}

const char *clast_report_unit(const char *key)
{
    return key != NULL ? clx_quantity_of(key, NULL).unit : "";
}

void clx_quantity_write_label(clx_file *file, const char *key, const char *place)
{
    const clx_quantity q = clx_quantity_of(key, place);
    if (q.label[0] != '\0') {
        clx_page_text(file, q.label);
        return;
    }
    (void)clx_file_print(file, "<code>");
    clx_page_text(file, key);
    (void)clx_file_print(file, "</code>");
}

void clx_quantity_write_name(clx_file *file, const char *key)
{
    char unit[CLX_UNIT_SIZE];
    clx_quantity_write_label(file, key, NULL);
    if (names_unit(key)) {
        clx_quantity_show_unit(clx_quantity_of(key, NULL).unit, unit);
        (void)clx_file_print(file, " (");
        clx_page_text(file, unit);
        (void)clx_file_print(file, ")");
    }
}
