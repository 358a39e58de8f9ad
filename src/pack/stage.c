// Stages as text: "isotropic 10kPa until rest", "z=-0.1/s x=10kPa y=10kPa until strain 0.2".
#include "pack/load.h"

#include <ctype.h>
#include <math.h>
#include <string.h>

enum { WORD = 48, MOST_WORDS = 16 };

typedef struct {
    int n;
    char word[MOST_WORDS][WORD];
} words;

static clast_status fail(const clast_pack_config *c, int32_t number, const char *what,
                         const char *word)
{
    return clx_fail(CLAST_E_CONFIG, "stage %d, '%s': %s%s%s%s", number + 1, c->stages.item[number],
                    what, word[0] != '\0' ? " '" : "", word, word[0] != '\0' ? "'" : "");
}

static clast_status split(const clast_pack_config *c, int32_t number, words *out)
{
    const char *at = c->stages.item[number];
    out->n = 0;
    while (*at != '\0') {
        size_t length = 0;
        while (isspace((unsigned char)*at)) {
            ++at;
        }
        while (at[length] != '\0' && !isspace((unsigned char)at[length])) {
            ++length;
        }
        if (length == 0) {
            break;
        }
        if (out->n == MOST_WORDS || length >= WORD) {
            return fail(c, number, "it has too many words, or too long ones", "");
        }
        memcpy(out->word[out->n], at, length);
        out->word[out->n++][length] = '\0';
        at += length;
    }
    return out->n > 0 ? CLAST_OK : fail(c, number, "it says nothing", "");
}

/// A strain rate (1/s) or a pressure (Pa).
static clast_status read_drive(const clast_pack_config *c, int32_t number, const char *text,
                               clx_drive_kind *kind, double *aim)
{
    const size_t n = strlen(text);
    if (n > 2 && strcmp(text + n - 2, "/s") == 0) {
        *kind = CLX_DRIVE_RATE;
        return clast_unit_parse(text, "1/s", aim) == CLAST_OK
                   ? CLAST_OK
                   : fail(c, number, "this is no strain rate (0.1/s):", text);
    }
    *kind = CLX_DRIVE_STRESS;
    if (n < 2 || strcmp(text + n - 2, "Pa") != 0 || clast_unit_parse(text, "Pa", aim) != CLAST_OK) {
        return fail(c, number, "this is no pressure (10kPa) and no strain rate (0.1/s):", text);
    }
    if (*aim == 0.0) {
        return fail(c, number,
                    "a stress of 0 is never reached; give a small one, or a rate:", text);
    }
    return *aim > 0.0 || c->dem.cohesion != CLAST_DEM_DRY
               ? CLAST_OK
               : fail(c, number, "dry grains bear no pull:", text);
}

/// A rate of shear strain (1/s), or a stress (Pa) of either sign.
static clast_status read_shear(const clast_pack_config *c, int32_t number, const char *text,
                               clx_stage *s)
{
    const size_t n = strlen(text);
    const bool is_stress = n > 2 && strcmp(text + n - 2, "Pa") == 0;
    const clast_status status = read_drive(c, number, is_stress && text[0] == '-' ? text + 1 : text,
                                           &s->shear_kind, &s->shear);
    s->shear = is_stress && text[0] == '-' ? -s->shear : s->shear;
    return status;
}

static clast_status read_axis(const clast_pack_config *c, int32_t number, const char *word,
                              clx_stage *s)
{
    if (strncmp(word, "xz=", 3) == 0) {
        return read_shear(c, number, word + 3, s);
    }
    if (word[0] >= 'x' && word[0] <= 'z' && word[1] == '=') {
        const int axis = word[0] - 'x';
        return read_drive(c, number, word + 2, &s->kind[axis], &s->aim[axis]);
    }
    return fail(c, number,
                "expected isotropic, oedometer, triaxial, shear, hold, or x=, y=, z=, xz=; this is "
                "none:",
                word);
}

/// Sides driven by short words; how many words they took, 0: none of them.
static clast_status read_test(const clast_pack_config *c, int32_t number, const words *w,
                              clx_stage *s, int *taken)
{
    clast_status status = CLAST_OK;
    const char *name = w->word[0];
    const char *const one = w->n > 1 ? w->word[1] : "";
    *taken = 2;
    if (strcmp(name, "isotropic") == 0) {
        for (int k = 0; k < 3; ++k) {
            CLX_TRY(read_drive(c, number, one, &s->kind[k], &s->aim[k]));
        }
    } else if (strcmp(name, "oedometer") == 0) {
        CLX_TRY(read_drive(c, number, one, &s->kind[2], &s->aim[2]));
    } else if (strcmp(name, "triaxial") == 0) {
        *taken = 3;
        for (int k = 0; k < 3; ++k) {
            CLX_TRY(read_drive(c, number,
                               k < 2      ? one
                               : w->n > 2 ? w->word[2]
                                          : "",
                               &s->kind[k], &s->aim[k]));
        }
    } else if (strcmp(name, "shear") == 0) {
        CLX_TRY(read_shear(c, number, one, s));
        if (w->n > 2 && strcmp(w->word[2], "until") != 0 && strchr(w->word[2], '=') == NULL) {
            *taken = 3;
            CLX_TRY(read_drive(c, number, w->word[2], &s->kind[2], &s->aim[2]));
        }
    } else {
        *taken = strcmp(name, "hold") == 0 ? 1 : 0;
    }
done:
    return status;
}

static clast_status read_end(const clast_pack_config *c, int32_t number, const words *w, int at,
                             clx_stage *s)
{
    static const char *const name[] = {"rest", "strain", "stress", "time"};
    static const char *const unit[] = {"-", "-", "Pa", "s"};
    for (int k = 0; k < 4 && at < w->n; ++k) {
        if (strcmp(w->word[at], name[k]) != 0) {
            continue;
        }
        s->end = (clx_end_kind)k;
        const bool is_bare = k == CLX_END_REST || (k == CLX_END_STRESS && at + 1 == w->n);
        if (!is_bare &&
            (at + 1 == w->n || clast_unit_parse(w->word[at + 1], unit[k], &s->until) != CLAST_OK ||
             s->until <= 0.0)) {
            return fail(c, number, "expected a number above 0 after", name[k]);
        }
        const int after = is_bare ? at + 1 : at + 2;
        return after >= w->n
                   ? CLAST_OK
                   : fail(c, number, "a stage has one end, and nothing after it:", w->word[after]);
    }
    return fail(c, number,
                "expected until rest, until strain 0.1, until stress 10kPa or until time 1s", "");
}

static clast_status check(const clast_pack_config *c, int32_t number, const clx_stage *s)
{
    bool has_rate = s->shear_kind == CLX_DRIVE_RATE && s->shear != 0.0;
    bool has_stress = s->shear_kind == CLX_DRIVE_STRESS;
    for (int k = 0; k < 3; ++k) {
        has_rate = has_rate || (s->kind[k] == CLX_DRIVE_RATE && s->aim[k] != 0.0);
        has_stress = has_stress || s->kind[k] == CLX_DRIVE_STRESS;
    }
    if (has_rate && s->end == CLX_END_REST) {
        return fail(c, number,
                    "what moves at a rate never rests; give until strain, stress or time", "");
    }
    if (s->end == CLX_END_STRAIN && !has_rate && !has_stress) {
        return fail(c, number, "nothing strains the bed", "");
    }
    if (s->end == CLX_END_STRESS && s->until == 0.0 && !has_stress) {
        return fail(c, number, "no side has a stress to reach; give one after until stress", "");
    }
    if (s->end == CLX_END_STRESS && !has_rate && !has_stress) {
        return fail(c, number, "nothing changes the bed's stress: drive a side", "");
    }
    return CLAST_OK;
}

clast_status clx_stage_read(const clast_pack_config *c, int32_t number, clx_stage *stage)
{
    CLAST_ASSERT(number >= 0 && number < c->stages.n);
    clast_status status = CLAST_OK;
    words w;
    int at = 0;
    clx_stage s = {.end = CLX_END_REST};
    CLX_TRY(split(c, number, &w));
    CLX_TRY(read_test(c, number, &w, &s, &at));
    for (; at < w.n && strcmp(w.word[at], "until") != 0; ++at) {
        CLX_TRY(read_axis(c, number, w.word[at], &s));
    }
    if (at < w.n) {
        CLX_TRY(read_end(c, number, &w, at + 1, &s));
    }
    CLX_TRY(check(c, number, &s));
    *stage = s;
done:
    return status;
}
