// Stages of a bed between walls: "drum until time 2s", "lid=10kPa until rest", "open gate until
// mass 1g".
#include "pack/walls.h"

#include "base/number.h"
#include "math/vec3.h"
#include <string.h>

enum { WORD = 64 };

static clast_status fail(const clast_pack_config *c, int32_t number, const char *what,
                         const char *word)
{
    return clx_fail(CLAST_E_CONFIG, "stage %d, '%s': %s%s%s%s", number + 1, c->stages.item[number],
                    what, word[0] != '\0' ? " '" : "", word, word[0] != '\0' ? "'" : "");
}

static int32_t find(const clast_pack_input *input, const char *name, size_t n)
{
    for (int32_t i = 0; i < input->n_wall; ++i) {
        if (strlen(input->wall[i].name) == n && memcmp(input->wall[i].name, name, n) == 0) {
            return i;
        }
    }
    return -1;
}

static bool moves(const clast_dem_wall_motion *m)
{
    return v3_norm2(m->velocity) > 0.0 || v3_norm2(m->amplitude) > 0.0 || m->rate != 0.0 ||
           m->swing != 0.0 || m->n > 0;
}

/// A number's unit: what follows its digits.
static bool ends_in(const char *text, const char *unit)
{
    double value = 0.0;
    const char *end = clx_number_parse(text, text + strlen(text), &value);
    double factor = 0.0;
    return end != NULL && clast_unit_factor(end, unit, &factor) == CLAST_OK;
}

/// Number of the stage before this one that opens a wall, or -1.
static int32_t find_opening(const clast_pack_config *c, int32_t number, const char *name)
{
    char word[WORD] = "";
    for (int32_t i = 0; i < number; ++i) {
        const char *at = c->stages.item[i];
        bool opens = false;
        while ((at = clx_next_word(at, word, sizeof word)) != NULL && strcmp(word, "until") != 0) {
            if (opens && strcmp(word, name) == 0) {
                return i;
            }
            opens = !opens && strcmp(word, "open") == 0;
        }
    }
    return -1;
}

static clast_status read_drive(const clast_pack_config *c, int32_t number,
                               const clast_pack_input *input, const char *word, bool opens,
                               clx_wall_stage *s)
{
    const char *equals = strchr(word, '=');
    const size_t n = equals != NULL ? (size_t)(equals - word) : strlen(word);
    clx_wall_drive d = {.wall = find(input, word, n), .kind = CLX_WALL_RUNS};
    if (d.wall < 0) {
        return fail(c, number,
                    "expected a wall of option wall, open NAME, hold, or until; there is no wall",
                    word);
    }
    const clast_pack_wall *wall = &input->wall[d.wall];
    const int32_t opening = opens ? -1 : find_opening(c, number, wall->name);
    if (opening >= 0) {
        return clx_fail(CLAST_E_CONFIG, "stage %d, '%s': stage %d opened wall %s, which is gone",
                        number + 1, c->stages.item[number], opening + 1, wall->name);
    }
    if (s->n == CLX_MOST_DRIVES) {
        return fail(c, number, "it drives too many walls", "");
    }
    for (int32_t k = 0; k < s->n; ++k) {
        if (s->drive[k].wall == d.wall &&
            (opens || s->drive[k].kind == CLX_WALL_OPENS ||
             (equals == NULL) == (s->drive[k].kind == CLX_WALL_RUNS))) {
            return fail(c, number, "it drives this wall twice:", word);
        }
    }
    if (opens) {
        d.kind = CLX_WALL_OPENS;
    } else if (equals == NULL && !moves(&wall->motion)) {
        return fail(c, number, "this wall has no motion of its own (move, rotate, ...):", word);
    } else if (equals != NULL) {
        const char *unit = ends_in(equals + 1, "Pa")  ? "Pa"
                           : ends_in(equals + 1, "N") ? "N"
                                                      : "m/s";
        d.kind = strcmp(unit, "m/s") == 0 ? CLX_WALL_SPEED : CLX_WALL_PRESSED;
        d.is_force = strcmp(unit, "N") == 0;
        if (clast_unit_parse(equals + 1, unit, &d.aim) != CLAST_OK || !ends_in(equals + 1, unit)) {
            return fail(c, number,
                        "this is no pressure (10kPa), no force (5N) and no speed (1mm/s):", word);
        }
        if (d.kind == CLX_WALL_PRESSED && d.aim <= 0.0) {
            return fail(c, number, "a wall only pushes, with a pressure or force above 0:", word);
        }
        if (v3_norm2(wall->press) == 0.0) {
            return fail(c, number,
                        "its wall does not say in which direction (press 0,0,-1):", wall->name);
        }
    }
    s->drive[s->n++] = d;
    return CLAST_OK;
}

static clast_status read_end(const clast_pack_config *c, int32_t number, const char *at,
                             clx_wall_stage *s)
{
    static const char *const name[] = {"rest", "time", "stress", "way", "mass"};
    static const char *const unit[] = {"-", "s", "Pa", "m", "kg"};
    char word[WORD] = "";
    char value[WORD] = "";
    at = clx_next_word(at, word, sizeof word);
    const char *rest = at != NULL ? clx_next_word(at, value, sizeof value) : NULL;
    if (at != NULL && rest == NULL) {
        value[0] = '\0';
    }
    for (int k = 0; k < 5; ++k) {
        if (strcmp(word, name[k]) != 0) {
            continue;
        }
        s->end = (clx_wall_end)k;
        const bool is_bare = k == CLX_UNTIL_REST || (k == CLX_UNTIL_STRESS && value[0] == '\0');
        if (!is_bare &&
            !(ends_in(value, unit[k]) && clast_unit_parse(value, unit[k], &s->until) == CLAST_OK &&
              (k == CLX_UNTIL_MASS ? s->until >= 0.0 : s->until > 0.0))) {
            return fail(c, number, "expected a number above 0 with its unit after", word);
        }
        at = clx_next_word(is_bare ? at : rest, value, sizeof value);
        return at == NULL ? CLAST_OK
                          : fail(c, number, "a stage has one end, and nothing after it:", value);
    }
    return fail(c, number,
                "expected until rest, until time 1s, until stress 10kPa, until way 5mm or until "
                "mass 1g",
                "");
}

static clast_status check(const clast_pack_config *c, int32_t number, const clast_pack_input *input,
                          const clx_wall_stage *s)
{
    bool is_pressed = false;
    bool is_moved = false;
    for (int32_t k = 0; k < s->n; ++k) {
        is_pressed = is_pressed || s->drive[k].kind == CLX_WALL_PRESSED;
        is_moved = is_moved || s->drive[k].kind == CLX_WALL_RUNS ||
                   (s->drive[k].kind == CLX_WALL_SPEED && s->drive[k].aim != 0.0);
    }
    if (s->end == CLX_UNTIL_REST && is_moved) {
        return fail(c, number, "what moves never rests; give until time, stress, way or mass", "");
    }
    if (s->end == CLX_UNTIL_STRESS && !is_pressed && !(is_moved && s->until > 0.0)) {
        return fail(c, number,
                    "no wall has a stress to reach; press one, or move one until stress 10kPa", "");
    }
    for (int32_t k = 0; k < s->n && number == 0 && input->start == NULL && !is_moved; ++k) {
        const clx_wall_drive *d = &s->drive[k];
        const char *name = input->wall[d->wall].name;
        if (s->end == CLX_UNTIL_STRESS && d->kind == CLX_WALL_PRESSED && !d->is_force &&
            d->aim < s->until && strcmp(name, "floor") != 0) {
            return fail(c, number,
                        "its pressure is below the stress that ends it, and no stage before it "
                        "presses with more:",
                        name);
        }
    }
    if (s->end == CLX_UNTIL_WAY && !is_moved && !is_pressed) {
        return fail(c, number, "no wall moves", "");
    }
    if (s->end == CLX_UNTIL_MASS && c->outlet.n == 0) {
        return fail(c, number, "no grain leaves: there is no outlet", "");
    }
    if (s->end == CLX_UNTIL_MASS && input->start == NULL && s->until > c->mass) {
        return fail(c, number, "the mass still inside, which ends it, is less from the start", "");
    }
    return CLAST_OK;
}

clast_status clx_wall_stage_read(const clast_pack_config *c, int32_t number,
                                 const clast_pack_input *input, clx_wall_stage *stage)
{
    CLAST_ASSERT(number >= 0 && number < c->stages.n);
    clast_status status = CLAST_OK;
    const char *at = c->stages.item[number];
    char word[WORD] = "";
    clx_wall_stage s = {.end = CLX_UNTIL_REST};
    bool opens = false;
    bool is_any = false;
    while ((at = clx_next_word(at, word, sizeof word)) != NULL && strcmp(word, "until") != 0) {
        is_any = true;
        if (opens || (strcmp(word, "open") != 0 && strcmp(word, "hold") != 0)) {
            CLX_TRY(read_drive(c, number, input, word, opens, &s));
            opens = false;
        } else {
            opens = strcmp(word, "open") == 0;
        }
    }
    if (opens || !is_any) {
        return fail(c, number, opens ? "open which wall?" : "it says nothing", "");
    }
    if (at != NULL) {
        CLX_TRY(read_end(c, number, at, &s));
    }
    CLX_TRY(check(c, number, input, &s));
    *stage = s;
done:
    return status;
}

clast_status clx_wall_stages_use(const clast_pack_config *c, const clast_pack_input *input,
                                 int32_t wall, uint32_t *used)
{
    CLAST_ASSERT(wall >= 0 && wall < c->wall.n);
    clast_status status = CLAST_OK;
    *used = c->dem.domain == CLAST_DEM_CELL || input->n_wall < c->wall.n ? 3U : 0U;
    for (int32_t i = 0; i < c->stages.n && *used != 3U; ++i) {
        clx_wall_stage s = {.n = 0};
        CLX_TRY(clx_wall_stage_read(c, i, input, &s));
        const bool has_stress =
            s.end == CLX_UNTIL_STRESS && s.until > 0.0 && v3_norm2(input->wall[wall].press) > 0.0;
        for (int32_t k = 0; k < s.n; ++k) {
            const clx_wall_drive *d = &s.drive[k];
            if (d->wall == wall && d->kind != CLX_WALL_OPENS) {
                const bool is_pressed = d->kind == CLX_WALL_PRESSED && !d->is_force;
                *used |= d->kind != CLX_WALL_RUNS || has_stress ? 1U : 0U;
                *used |= is_pressed || has_stress ? 2U : 0U;
            }
        }
    }
done:
    return status;
}

clast_status clx_wall_stages_run_all(const clast_pack_config *c, const clast_pack_input *input)
{
    clast_status status = CLAST_OK;
    for (int32_t i = 0; i < input->n_wall && c->stages.n > 0; ++i) {
        bool runs = !moves(&input->wall[i].motion);
        for (int32_t k = 0; k < c->stages.n && !runs; ++k) {
            clx_wall_stage s = {.n = 0};
            CLX_TRY(clx_wall_stage_read(c, k, input, &s));
            for (int32_t d = 0; d < s.n; ++d) {
                runs = runs || (s.drive[d].wall == i && s.drive[d].kind == CLX_WALL_RUNS);
            }
        }
        CLX_CHECK(runs, CLAST_E_CONFIG,
                  "wall %d, '%s': its motion never runs, as no stage names it (stages: %s until "
                  "time 1s)",
                  i + 1, c->wall.item[i], input->wall[i].name);
    }
done:
    return status;
}
