// Option wall as text: "drum drum.stl mm axis 0,1,0 rotate 30rpm", "lid press 0,0,-1".
#include "pack/walls.h"

#include "base/number.h"
#include "math/vec3.h"
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

const char *clx_next_word(const char *text, char *word, size_t size)
{
    size_t n = 0;
    while (isspace((unsigned char)*text)) {
        ++text;
    }
    while (text[n] != '\0' && !isspace((unsigned char)text[n])) {
        ++n;
    }
    if (n == 0) {
        return NULL;
    }
    const size_t kept = n < size ? n : size - 1;
    memcpy(word, text, kept);
    word[kept] = '\0';
    if (kept < n) {
        word[kept - 1] = '~'; // cut: no name and no word of a wall ends so
    }
    return text + n;
}

int32_t clx_wall_of_domain(const clast_dem_config *c, const char *name, double inward[3])
{
    static const char *const box[4] = {"left", "right", "front", "back"};
    int32_t n = 0;
    v3_set(inward, 0.0, 0.0, 0.0);
    if (c->floor && n++ >= 0 && strcmp(name, "floor") == 0) {
        inward[2] = 1.0;
        return n - 1;
    }
    if (c->lid && n++ >= 0 && strcmp(name, "lid") == 0) {
        inward[2] = -1.0;
        return n - 1;
    }
    for (int k = 0; k < 4 && c->domain == CLAST_DEM_BOX; ++k) {
        if (strcmp(name, box[k]) == 0) {
            inward[k / 2] = k % 2 == 0 ? 1.0 : -1.0;
            return n + k;
        }
    }
    return c->domain == CLAST_DEM_CYLINDER && strcmp(name, "sides") == 0 ? n : -1;
}

static clast_status fail(const clast_pack_config *c, int32_t i, const char *what, const char *word)
{
    return clx_fail(CLAST_E_CONFIG, "wall %d, '%s': %s%s%s%s", i + 1, c->wall.item[i], what,
                    word[0] != '\0' ? " '" : "", word, word[0] != '\0' ? "'" : "");
}

/// Three numbers and a unit: 0,0,-5mm/s.
static bool read_vector(const char *text, const char *unit, double out[3])
{
    const char *at = text;
    double factor = 1.0;
    for (int k = 0; k < 3; ++k) {
        at = clx_number_parse(at, at + strlen(at), &out[k]);
        if (at == NULL || !isfinite(out[k]) || (k < 2 && *at++ != ',')) {
            return false;
        }
    }
    if (strcmp(unit, "-") == 0 ? *at != '\0' : clast_unit_factor(at, unit, &factor) != CLAST_OK) {
        return false;
    }
    v3_scale(out, factor, out);
    return true;
}

/// A number and its unit, which may end in a digit (m^2); above 0 where it has to be.
static bool read_number(const char *text, const char *unit, bool is_above_0, double *out)
{
    const char *end = clx_number_parse(text, text + strlen(text), out);
    return end != NULL && *end != '\0' && clast_unit_parse(text, unit, out) == CLAST_OK &&
           (!is_above_0 || *out > 0.0);
}

/// Words that three numbers follow, in the order of read_vector_word's places.
static const struct {
    const char *name, *unit, *wrong; ///< unit "-": a direction, taken to length 1
} vectors[] = {{"move", "m/s", "expected a velocity (0,0,-5mm/s), not"},
               {"about", "m", "expected a point (0,0,50mm), not"},
               {"axis", "-", "expected the direction of an axis (0,1,0), not"},
               {"press", "-", "expected the direction in which it presses (0,0,-1), not"}};
enum { N_VECTOR = sizeof vectors / sizeof *vectors };

/// What is wrong with such a word, or NULL; *is_one: it is one.
static const char *read_vector_word(const char *name, const char *next, clx_wall_words *w,
                                    bool *is_one)
{
    clast_dem_wall_motion *m = &w->wall.motion;
    double *const place[N_VECTOR] = {m->velocity, m->pivot, m->axis, w->wall.press};
    *is_one = true;
    for (int k = 0; k < N_VECTOR; ++k) {
        if (strcmp(name, vectors[k].name) == 0) {
            const bool is_fine = read_vector(next, vectors[k].unit, place[k]) &&
                                 (k < 2 || v3_unit(place[k], place[k]));
            return is_fine ? NULL : vectors[k].wrong;
        }
    }
    *is_one = false;
    return NULL;
}

/// An amplitude and a period.
static const char *read_swing(bool vibrates, const char *const next[2], clx_wall_words *w,
                              int *taken)
{
    clast_dem_wall_motion *m = &w->wall.motion;
    double period = 0.0;
    const bool is_fine = vibrates ? read_vector(next[0], "m", m->amplitude)
                                  : read_number(next[0], "rad", false, &m->swing);
    if (!is_fine) {
        return vibrates ? "expected an amplitude (0,0,1mm) and a period (20ms), not"
                        : "expected an angle (5deg) and a period (20ms), not";
    }
    *taken = 3; // the second is at fault
    if (!read_number(next[1], "s", true, &period)) {
        return "expected a period (20ms), not";
    }
    if (m->period > 0.0 && m->period != period) {
        return "vibrate and swing have one period, not also";
    }
    *taken = 2;
    m->period = period;
    return NULL;
}

/// One word of a motion with what follows it; what is wrong, or NULL.
static const char *read_motion(const char *name, const char *const next[2], clx_wall_words *w,
                               int *taken)
{
    bool is_vector = false;
    const char *wrong = read_vector_word(name, next[0], w, &is_vector);
    *taken = 1;
    if (is_vector) {
        return wrong;
    }
    if (strcmp(name, "rotate") == 0) {
        return read_number(next[0], "rad/s", false, &w->wall.motion.rate)
                   ? NULL
                   : "expected an angular velocity (30rpm, 90deg/s, 1rad/s), not";
    }
    if (strcmp(name, "area") == 0) {
        return read_number(next[0], "m^2", true, &w->wall.area) ? NULL
                                                                : "expected an area (0.01m^2), not";
    }
    if (strcmp(name, "table") == 0) {
        memcpy(w->table, next[0], sizeof w->table); // words have this size
        return next[0][0] != '\0' ? NULL : "expected a file after table";
    }
    const bool vibrates = strcmp(name, "vibrate") == 0;
    if (vibrates || strcmp(name, "swing") == 0) {
        return read_swing(vibrates, next, w, taken);
    }
    *taken = 0;
    return "expected move, vibrate, axis, about, rotate, swing, table, press or area, not";
}

/// Words by the bits of clx_wall_words.given.
static const char *const names[] = {"press", "area",   "move",    "about", "axis",
                                    "table", "rotate", "vibrate", "swing"};

/// Why a word undoes another, or NULL; *given: the words so far.
static const char *idle_word(const char *name, uint32_t *given)
{
    for (uint32_t k = 0; k < sizeof names / sizeof *names; ++k) {
        if (strcmp(name, names[k]) != 0) {
            continue;
        }
        if ((*given >> k & 1U) != 0) {
            return "it is given twice:";
        }
        *given |= 1U << k;
        return NULL;
    }
    return NULL;
}

static clast_status check(const clast_pack_config *c, int32_t i, const clx_wall_words *w)
{
    const clast_dem_wall_motion *m = &w->wall.motion;
    const bool has_axis = v3_norm2(m->axis) > 0.0;
    if (!has_axis && (m->rate != 0.0 || m->swing != 0.0)) {
        return fail(c, i, "it rotates about no axis; give axis 0,1,0 (and about X,Y,Zmm)", "");
    }
    if (has_axis && m->rate == 0.0 && m->swing == 0.0 && w->table[0] == '\0') {
        return fail(c, i, "it has an axis and does not rotate; give rotate, swing or a table", "");
    }
    for (int32_t k = 0; k < i; ++k) {
        char name[sizeof w->wall.name];
        if (clx_next_word(c->wall.item[k], name, sizeof name) != NULL &&
            strcmp(name, w->wall.name) == 0) {
            return fail(c, i, "an earlier wall has this name:", name);
        }
    }
    return CLAST_OK;
}

/// Name, and the file where it is no wall of the domain; *at is after them.
static clast_status read_head(const clast_pack_config *c, int32_t i, const char **at,
                              clx_wall_words *w)
{
    double inward[3] = {0.0, 0.0, 0.0};
    *at = clx_next_word(c->wall.item[i], w->wall.name, sizeof w->wall.name);
    if (*at == NULL) {
        return fail(c, i, "it begins with a name of at most 31 letters", "");
    }
    for (const char *s = w->wall.name; *s != '\0'; ++s) {
        if (!isalnum((unsigned char)*s) && *s != '_' && *s != '-') {
            return fail(c, i,
                        "a name has letters, digits, _ and - alone; this has not:", w->wall.name);
        }
    }
    clast_dem_config domain = c->dem;
    const bool has_container = c->container != NULL && c->container[0] != '\0';
    if (has_container) {
        domain.domain = CLAST_DEM_OPEN;
        domain.lid = false;
    }
    w->wall.number = has_container && strcmp(w->wall.name, "container") == 0
                         ? (domain.floor ? 1 : 0)
                         : clx_wall_of_domain(&domain, w->wall.name, inward);
    if (w->wall.number >= 0) {
        v3_copy(w->wall.press, inward);
        return CLAST_OK;
    }
    *at = clx_next_word(*at, w->file, sizeof w->file);
    *at = *at != NULL ? clx_next_word(*at, w->unit, sizeof w->unit) : NULL;
    double factor = 0.0;
    if (*at == NULL || clast_unit_factor(w->unit, "m", &factor) != CLAST_OK) {
        return fail(
            c, i, "expected a surface's file and its unit (stl: mm), since the domain has no wall",
            w->wall.name);
    }
    return CLAST_OK;
}

clast_status clx_wall_read(const clast_pack_config *c, int32_t i, clx_wall_words *out)
{
    CLAST_ASSERT(i >= 0 && i < c->wall.n);
    clast_status status = CLAST_OK;
    const char *at = NULL;
    char word[3][CLX_WALL_PATH] = {"", "", ""};
    clx_wall_words w = {.file = ""};
    CLX_TRY(read_head(c, i, &at, &w));
    while (at != NULL && (at = clx_next_word(at, word[0], sizeof word[0])) != NULL) {
        int taken = 0;
        const char *after = at;
        for (int k = 1; k < 3; ++k) {
            const char *next = after != NULL ? clx_next_word(after, word[k], sizeof word[k]) : NULL;
            word[k][0] = next != NULL ? word[k][0] : '\0';
            after = next;
        }
        const char *idle = idle_word(word[0], &w.given);
        if (idle != NULL && w.idle == NULL) {
            w.idle = idle;
            (void)snprintf(w.idle_word, sizeof w.idle_word, "%s", word[0]);
        }
        const char *wrong =
            read_motion(word[0], (const char *const[2]){word[1], word[2]}, &w, &taken);
        if (wrong != NULL) {
            return fail(c, i, wrong, word[taken < 3 ? taken : 2]);
        }
        for (int k = 0; k < taken && at != NULL; ++k) {
            at = clx_next_word(at, word[1], sizeof word[1]);
        }
    }
    CLX_TRY(check(c, i, &w));
    *out = w;
done:
    return status;
}

clast_status clx_walls_check_idle(const clast_pack_config *c, const clast_pack_input *input)
{
    clast_status status = CLAST_OK;
    for (int32_t i = 0; i < c->wall.n; ++i) {
        clx_wall_words w = {.idle = NULL};
        uint32_t used = 0;
        CLX_TRY(clx_wall_read(c, i, &w));
        CLX_TRY(w.idle == NULL ? CLAST_OK : fail(c, i, w.idle, w.idle_word));
        CLX_TRY(clx_wall_stages_use(c, input, i, &used));
        for (uint32_t k = 0; k < 2; ++k) {
            CLX_TRY((w.given & ~used) >> k & 1U
                        ? fail(c, i,
                               k == 0 ? "no stage presses the wall, or moves it along that "
                                        "direction (stages); leave out"
                                      : "no stage presses the wall by a pressure, or until one "
                                        "(stages); leave out",
                               names[k])
                        : CLAST_OK);
        }
    }
done:
    return status;
}
