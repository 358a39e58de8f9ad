// Options material and contacts: how grains of several materials touch each other and the walls.
//
// Materials are numbered: those of the grains, then a material for each wall of the simulation.
// [docs/theory/dem.md "Materials"]
#include "base/alloc.h"
#include "dem/dem.h"
#include "pack/pack.h"
#include "pack/walls.h"
#include <ctype.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

enum { WORD = 64, VALUE = 96 };

/// Materials first to last - 1.
typedef struct {
    int32_t first, last;
} range;

/// The materials of a packing.
typedef struct {
    const clast_pack *p;
    const char **name;        ///< [n_grain] of the grains' materials
    int32_t n_grain, n;       ///< of the grains, with walls
    clast_dem_contact *table; ///< [n][n]
} materials;

static clast_status fail(const materials *m, int32_t i, const char *what, const char *word)
{
    return clx_fail(CLAST_E_CONFIG, "contacts %d, '%s': %s%s%s%s", i + 1,
                    m->p->config.contacts.item[i], what, word[0] != '\0' ? " '" : "", word,
                    word[0] != '\0' ? "'" : "");
}

static int32_t wall_of(const clast_pack *p, const char *name)
{
    double inward[3];
    for (int32_t i = 0; i < p->n_wall; ++i) {
        if (strcmp(p->wall[i].name, name) == 0) {
            return i;
        }
    }
    if (p->n_wall == 0 && p->inside != NULL && strcmp(name, "container") == 0) {
        return p->dem->n_wall;
    }
    return p->n_wall == 0 ? clx_wall_of_domain(&p->config.dem, name, inward) : -1;
}

static bool find(const materials *m, const char *name, range *out)
{
    const int32_t wall = wall_of(m->p, name);
    if (strcmp(name, "grains") == 0) {
        *out = (range){0, m->n_grain};
        return true;
    }
    if (strcmp(name, "walls") == 0) {
        *out = (range){m->n_grain, m->n};
        return m->n > m->n_grain;
    }
    for (int32_t k = 0; k < m->n_grain; ++k) {
        if (strcmp(m->name[k], name) == 0) {
            *out = (range){k, k + 1};
            return true;
        }
    }
    *out = (range){m->n_grain + wall, m->n_grain + wall + 1};
    return wall >= 0;
}

/// A number, or one for either side: 5e6,2e11Pa.
static bool read_two(const char *text, const char *unit, double out[2], bool *are_two)
{
    char first[VALUE];
    const char *comma = strchr(text, ',');
    *are_two = comma != NULL;
    if (comma == NULL) {
        const bool is_fine = clast_unit_parse(text, unit, out) == CLAST_OK;
        out[1] = out[0];
        return is_fine;
    }
    memcpy(first, text, (size_t)(comma - text));
    first[comma - text] = '\0';
    return clast_unit_parse(first, unit, out) == CLAST_OK &&
           clast_unit_parse(comma + 1, unit, out + 1) == CLAST_OK;
}

/// Words of a pair, as options of the same name; `law`: with which they act, or -1.
static const struct {
    const char *name, *unit;
    size_t at;
    double low, high;
    bool has_two;
    int law;
} words[] = {
    {"friction", "-", offsetof(clast_dem_contact, friction), 0.0, 100.0, false, -1},
    {"rolling_friction", "-", offsetof(clast_dem_contact, rolling_friction), 0.0, 100.0, false, -1},
    {"restitution", "-", offsetof(clast_dem_contact, restitution), 1e-3, 1.0, false, -1},
    {"collision_time", "s", offsetof(clast_dem_contact, collision_time), 1e-12, 1e3, false,
     CLAST_DEM_LINEAR},
    {"young", "Pa", offsetof(clast_dem_contact, young), 1.0, 1e13, true, CLAST_DEM_HERTZ},
    {"poisson", "-", offsetof(clast_dem_contact, poisson), 0.0, 0.5, true, -1}};
enum { N_WORD = sizeof words / sizeof *words };

/// Writes one word's numbers into the contacts of both sides.
static void write(const materials *m, const range side[2], int k, const double value[2])
{
    for (int32_t a = side[0].first; a < side[0].last; ++a) {
        for (int32_t b = side[1].first; b < side[1].last; ++b) {
            clast_dem_contact *c = &m->table[a < b ? a * m->n + b : b * m->n + a];
            double *to = (double *)(void *)((char *)c + words[k].at);
            to[0] = value[a <= b ? 0 : 1];
            if (words[k].has_two) {
                to[1] = value[a <= b ? 1 : 0];
            }
        }
    }
}

/// One word with its value; what is wrong, or NULL.
static const char *read_word(const materials *m, const range side[2], const char *word,
                             const char *value, uint32_t *given)
{
    const bool is_one_side = side[0].first < side[1].last && side[1].first < side[0].last;
    double number[2] = {0.0, 0.0};
    bool are_two = false;
    int k = 0;
    while (k < N_WORD && strcmp(word, words[k].name) != 0) {
        ++k;
    }
    if (k == N_WORD) {
        return "expected friction, rolling_friction, restitution, collision_time, young or "
               "poisson, not";
    }
    if ((*given >> k & 1U) != 0) {
        return "it is given twice:";
    }
    *given |= 1U << k;
    if (words[k].law >= 0 && m->p->config.dem.law != words[k].law) {
        return words[k].law == CLAST_DEM_HERTZ ? "with law hertz alone acts"
                                               : "with law linear alone acts";
    }
    if (!read_two(value, words[k].unit, number, &are_two) ||
        (are_two && (!words[k].has_two || is_one_side))) {
        return are_two ? "one number is expected after" : "a number is expected after";
    }
    for (int i = 0; i < 2; ++i) {
        if (!(number[i] >= words[k].low && number[i] <= words[k].high)) {
            return "out of the range of its option is";
        }
    }
    write(m, side, k, number);
    return NULL;
}

/// Every contact of both sides as the law can have it.
static clast_status check(const materials *m, int32_t i, const range side[2])
{
    for (int32_t a = side[0].first; a < side[0].last; ++a) {
        for (int32_t b = side[1].first; b < side[1].last; ++b) {
            const clast_dem_contact *c = &m->table[a < b ? a * m->n + b : b * m->n + a];
            const clast_status status = clx_dem_check_contact(&m->p->config.dem, c);
            if (status != CLAST_OK) {
                clx_fail_prefix("contacts %d, '%s'", i + 1, m->p->config.contacts.item[i]);
                return status;
            }
        }
    }
    return CLAST_OK;
}

/// "glass lid friction 0.2 restitution 0.5"
static clast_status read_contact(const materials *m, int32_t i)
{
    const char *at = m->p->config.contacts.item[i];
    char name[2][WORD];
    char word[WORD];
    char value[VALUE];
    range side[2];
    uint32_t given = 0;
    for (int k = 0; k < 2; ++k) {
        at = at != NULL ? clx_next_word(at, name[k], sizeof name[k]) : NULL;
        if (at == NULL) {
            return fail(m, i, "it begins with the names of two sides (glass steel, grains lid)",
                        "");
        }
        if (!find(m, name[k], &side[k])) {
            return fail(m, i,
                        "a side is grains, walls, a name of option material, or a wall's (floor, "
                        "lid, sides, left, right, front, back, container, those of option wall) "
                        "that is there, not",
                        name[k]);
        }
    }
    if (side[0].first >= m->n_grain && side[1].first >= m->n_grain) {
        return fail(m, i, "walls do not touch each other", "");
    }
    for (int32_t e = 0; e < i; ++e) {
        char other[2][WORD] = {"", ""};
        const char *rest = clx_next_word(m->p->config.contacts.item[e], other[0], WORD);
        (void)clx_next_word(rest, other[1], WORD);
        const int swapped = strcmp(other[0], name[0]) == 0 ? 0 : 1;
        if (strcmp(other[swapped], name[0]) == 0 && strcmp(other[1 - swapped], name[1]) == 0) {
            return fail(m, i, "an earlier one is of the same two sides", "");
        }
    }
    while ((at = clx_next_word(at, word, sizeof word)) != NULL) {
        const char *after = clx_next_word(at, value, sizeof value);
        const char *wrong = read_word(m, side, word, after != NULL ? value : "", &given);
        if (wrong != NULL) {
            return fail(m, i, wrong, word);
        }
        at = after;
    }
    return given == 0 ? fail(m, i, "what is theirs follows (friction 0.2 restitution 0.5)", "")
                      : check(m, i, side);
}

/// Names of the grains' materials, each once; the material of each shape goes to of_shape.
static clast_status name_materials(materials *m, int32_t *of_shape)
{
    clast_status status = CLAST_OK;
    const clast_pack_config *c = &m->p->config;
    const int32_t n = c->material.n;
    CLX_CHECK(n <= 1 || n == m->p->input.n_shape, CLAST_E_CONFIG,
              "%d materials for %d shapes (material): one for all, or one for each", n,
              m->p->input.n_shape);
    CLX_CHECK(n <= 1 || !c->form_law, CLAST_E_CONFIG,
              "form_law makes shapes of its own: give them one material");
    m->name[0] = "";
    m->n_grain = n == 0 ? 1 : 0;
    for (int32_t i = 0; i < n; ++i) {
        const char *name = c->material.item[i];
        range taken;
        int32_t k = 0;
        while (k < m->n_grain && strcmp(m->name[k], name) != 0) {
            ++k;
        }
        for (const char *s = name; *s != '\0'; ++s) {
            CLX_CHECK(isalnum((unsigned char)*s) || *s == '_' || *s == '-', CLAST_E_CONFIG,
                      "material %d, '%s': a name has letters, digits, _ and - alone", i + 1, name);
        }
        CLX_CHECK(name[0] != '\0' && strlen(name) < WORD, CLAST_E_CONFIG,
                  "material %d, '%s': a name has 1 to %d letters", i + 1, name, WORD - 1);
        CLX_CHECK(k < m->n_grain || !find(m, name, &taken), CLAST_E_CONFIG,
                  "material %d, '%s': this is the name of a wall, or of all grains or walls", i + 1,
                  name);
        m->name[k] = name;
        m->n_grain += k == m->n_grain ? 1 : 0;
        of_shape[i] = k;
    }
done:
    return status;
}

static clast_status apply(clast_pack *p, const materials *m, const int32_t *of_shape)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clast_dem_set_contacts(p->dem, m->n, m->table));
    for (int32_t i = 0; i < p->input.n_shape; ++i) {
        CLX_TRY(clast_dem_set_material(p->dem, i, of_shape[p->config.material.n > 1 ? i : 0]));
    }
    for (int32_t k = m->n_grain; k < m->n; ++k) {
        CLX_TRY(clast_dem_set_wall_material(p->dem, k - m->n_grain, k));
    }
done:
    return status;
}

clast_status clx_pack_materials_begin(clast_pack *p)
{
    clast_status status = CLAST_OK;
    const clast_pack_config *c = &p->config;
    const int32_t n_name = c->material.n > 0 ? c->material.n : 1;
    materials m = {.p = p};
    int32_t *of_shape = NULL;
    if (c->contacts.n == 0) {
        return CLAST_OK;
    }
    CLX_TRY(clx_walls_begin(p->dem));
    CLX_TRY(clx_alloc(&m.name, n_name, sizeof *m.name));
    CLX_TRY(clx_alloc(&of_shape, n_name, sizeof *of_shape));
    CLX_TRY(name_materials(&m, of_shape));
    m.n = m.n_grain + p->dem->walls.n;
    CLX_CHECK(m.n <= CLX_MOST_MATERIALS, CLAST_E_CONFIG,
              "%d materials, each wall its own; at most %d", m.n, CLX_MOST_MATERIALS);
    CLX_TRY(clx_alloc(&m.table, (int64_t)m.n * m.n, sizeof *m.table));
    for (int32_t k = 0; k < m.n * m.n; ++k) {
        m.table[k] = clast_dem_contact_of(&c->dem, k % m.n >= m.n_grain);
    }
    for (int32_t i = 0; i < c->contacts.n; ++i) {
        CLX_TRY(read_contact(&m, i));
    }
    CLX_TRY(apply(p, &m, of_shape));
done:
    CLX_FREE(m.name, m.table, of_shape);
    return status;
}
