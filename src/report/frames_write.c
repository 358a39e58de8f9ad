// Frames into the page: places in 16 bits of the box that all of them fill, turns in 8.
#include "report/frames.h"

#include "base/alloc.h"
#include "report/page.h"
#include <math.h>
#include <string.h>

/// What all frames share: the box of their grains, and what need not be told grain by grain.
typedef struct {
    const clast_assembly *assembly;
    int32_t n_shown;
    double low[3], step[3];
    bool has_turns;
} common;

static common look(const clx_frames *frames, const clast_assembly *a, int32_t n_shown)
{
    common c = {.assembly = a,
                .n_shown = n_shown,
                .has_turns = frames->has_turns,
                .low = {INFINITY, INFINITY, INFINITY}};
    double high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (int32_t k = 0; k < frames->n; ++k) {
        const clx_frame *f = &frames->frame[k];
        for (int32_t i = 0; i < f->n; ++i) {
            for (int j = 0; j < 3; ++j) {
                c.low[j] = fmin(c.low[j], f->position[i][j]);
                high[j] = fmax(high[j], f->position[i][j]);
            }
        }
    }
    for (int j = 0; j < 3; ++j) {
        c.low[j] = isfinite(c.low[j]) ? c.low[j] : 0.0;
        c.step[j] = high[j] > c.low[j] ? (high[j] - c.low[j]) / 65535.0 : 0.0;
    }
    return c;
}

static void store(unsigned char *at, uint32_t bits, int n)
{
    for (int k = 0; k < n; ++k) {
        at[k] = (unsigned char)(bits >> 8 * k);
    }
}

static void store_place(const common *c, const double x[3], unsigned char *at)
{
    for (int j = 0; j < 3; ++j) {
        const double steps = c->step[j] > 0.0 ? (x[j] - c->low[j]) / c->step[j] : 0.0;
        store(at + 2 * j, (uint32_t)lround(fmin(fmax(steps, 0.0), 65535.0)), 2);
    }
}

static void store_turn(const double q[4], unsigned char *at)
{
    for (int k = 0; k < 4; ++k) {
        at[k] = (unsigned char)(int8_t)lround(127.0 * fmin(fmax(q[k], -1.0), 1.0));
    }
}

/// Arrays of a frame.
typedef enum { PLACE, TURN, GRAIN, SHAPE, SCALE } part;

static void store_part(const common *c, const clx_frame *f, part what, int32_t i, unsigned char *at)
{
    const float scale = (float)f->scale[i];
    uint32_t word = 0;
    switch (what) {
    case PLACE:
        store_place(c, f->position[i], at);
        break;
    case TURN:
        store_turn(f->orientation[i], at);
        break;
    case GRAIN:
        store(at, (uint32_t)f->grain[i], 4); // -1: 0xffffffff
        break;
    case SHAPE:
        store(at, (uint32_t)f->shape[i], 4);
        break;
    default:
        memcpy(&word, &scale, sizeof word);
        store(at, word, 4);
    }
}

/// An array of the frame's grains that the view shows, as base64.
static clast_status write_part(clx_file *file, const common *c, const clx_frame *f, part what)
{
    static const char *const name[] = {"place", "turn", "grain", "shape", "scale"};
    static const size_t size[] = {6, 4, 4, 4, 4};
    clast_status status = CLAST_OK;
    unsigned char *bytes = NULL;
    size_t n = 0;
    CLX_TRY(clx_alloc(&bytes, f->n, size[what]));
    for (int32_t i = 0; i < f->n; ++i) {
        if (f->grain[i] < c->n_shown) {
            store_part(c, f, what, i, bytes + n);
            n += size[what];
        }
    }
    (void)clx_file_print(file, ", \"%s\": \"", name[what]);
    clx_page_base64(file, bytes, n);
    (void)clx_file_print(file, "\"");
done:
    clx_free(bytes);
    return status;
}

/// Are the frame's grains the first of the assembly, in its order?
static bool is_in_order(const clx_frame *f)
{
    for (int32_t i = 0; i < f->n; ++i) {
        if (f->grain[i] != i) {
            return false;
        }
    }
    return true;
}

/// Has each grain the shape and the scale that it has in the assembly?
static bool is_as_in(const clx_frame *f, const clast_assembly *a)
{
    for (int32_t i = 0; i < f->n; ++i) {
        const int32_t g = f->grain[i];
        if (g < 0 || f->shape[i] != a->shape_id[g] ||
            fabs(f->scale[i] - a->scale[g]) > 1e-9 * a->scale[g]) {
            return false;
        }
    }
    return true;
}

static clast_status write_frame(clx_file *file, const common *c, const clx_frame *f)
{
    clast_status status = CLAST_OK;
    (void)clx_file_print(file, "{\"time\": %.9g", f->time);
    CLX_TRY(write_part(file, c, f, PLACE));
    if (c->has_turns) {
        CLX_TRY(write_part(file, c, f, TURN));
    }
    if (!is_in_order(f)) {
        CLX_TRY(write_part(file, c, f, GRAIN));
    }
    if (!is_as_in(f, c->assembly)) {
        CLX_TRY(write_part(file, c, f, SHAPE));
        CLX_TRY(write_part(file, c, f, SCALE));
    }
    (void)clx_file_print(file, "}");
done:
    return status;
}

clast_status clx_frames_write(clx_file *file, const clx_frames *frames,
                              const clast_assembly *assembly, int32_t n_shown,
                              const double centre[3], double length)
{
    CLAST_ASSERT(length > 0.0);
    clast_status status = CLAST_OK;
    if (frames == NULL || frames->n == 0) {
        return CLAST_OK;
    }
    const common c = look(frames, assembly, n_shown);
    (void)clx_file_print(file, ", \"frames\": {\"n_file\": %d, \"low\": [", (int)frames->n_file);
    for (int j = 0; j < 3; ++j) {
        (void)clx_file_print(file, "%s%.9g", j > 0 ? ", " : "", (c.low[j] - centre[j]) / length);
    }
    (void)clx_file_print(file, "], \"step\": [");
    for (int j = 0; j < 3; ++j) {
        (void)clx_file_print(file, "%s%.9g", j > 0 ? ", " : "", c.step[j] / length);
    }
    (void)clx_file_print(file, "]");
    if (isfinite(frames->end)) {
        (void)clx_file_print(file, ", \"end\": %.9g", frames->end);
    }
    (void)clx_file_print(file, ", \"frame\": [");
    for (int32_t k = 0; k < frames->n; ++k) {
        (void)clx_file_print(file, "%s\n", k > 0 ? "," : "");
        CLX_TRY(write_frame(file, &c, &frames->frame[k]));
    }
    (void)clx_file_print(file, "]}");
done:
    return status;
}
