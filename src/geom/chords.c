// A table of a convex hull's chords by direction, and what it says of rectangles around shadows.
#include "geom/chords.h"

#include "base/alloc.h"
#include "math/lanes.h"
#include "math/least.h"
#include "math/vec3.h"

enum { GRID = CLX_CHORD_GRID, MANY_FACES = 128 };

/// The chord of one cell; *high and *low begin as those of a cell near by.
static void fill_cell(const clx_hull_body *body, int32_t cell, clx_chords *chords, int32_t *high,
                      int32_t *low)
{
    const int k = cell / (GRID * GRID);
    clx_chord *chord = &chords->cell[cell];
    double d[3];
    double back[3];
    d[k] = 1.0;
    d[(k + 1) % 3] = (2 * (cell / GRID % GRID) + 1.0) / GRID - 1.0;
    d[(k + 2) % 3] = (2 * (cell % GRID) + 1.0) / GRID - 1.0;
    v3_scale(back, -1.0, d);
    *high = clx_hull_body_support(body, d, *high);
    *low = clx_hull_body_support(body, back, *low);
    v3_sub(chord->d, body->vert[*high], body->vert[*low]);
    chord->high = *high;
    chord->low = *low;
    chords->longest = greater_of(v3_norm(chord->d), chords->longest);
    chords->shortest = lesser_of(v3_dot(chord->d, d) / v3_norm(d), chords->shortest);
}

static void fill_cells(const clx_hull_body *body, clx_chords *chords)
{
    int32_t high = 0;
    int32_t low = 0;
    chords->shortest = INFINITY;
    for (int32_t c = 0; c < CLX_N_CHORD; ++c) {
        const int row = c / GRID % GRID; // every other one backwards: the next cell is beside this
        const int32_t cell = row % 2 == 0 ? c : c - c % GRID + GRID - 1 - c % GRID;
        fill_cell(body, cell, chords, &high, &low);
    }
    for (int32_t v = 0; v < body->n_vert; ++v) {
        chords->radius = greater_of(v3_norm(body->vert[v]), chords->radius);
    }
}

/// Arcs of a quarter turn have equal parts of the line from (1, 0) to (0, 1), so that a division
/// tells a direction's arc; then come those of the next quarter.
static void fill_arcs(clx_chords *chords)
{
    for (int32_t a = 0; a < CLX_N_ARC; ++a) {
        for (int k = 0; k < 3; ++k) {
            const double y = (a + 0.5 * k) / CLX_N_ARC;
            const double length = hypot(1.0 - y, y);
            chords->arc[k][0][a] = (1.0 - y) / length;
            chords->arc[k][1][a] = y / length;
            chords->arc[k][0][CLX_N_ARC + a] = -y / length;
            chords->arc[k][1][CLX_N_ARC + a] = (1.0 - y) / length;
        }
    }
}

clast_status clx_chords_make(const clx_hull_body *body, clx_chords **chords)
{
    *chords = NULL;
    if (body->n_face <= MANY_FACES) {
        return CLAST_OK;
    }
    const clast_status status = clx_alloc(chords, 1, sizeof **chords);
    if (status == CLAST_OK) {
        fill_arcs(*chords);
        fill_cells(body, *chords);
    }
    return status;
}

/// Chords of four directions: clx_chord_cell() in lanes.
CLX_INLINE void find_chords(const clx_chords *chords, const clx_lanes d[3], clx_lanes chord[4])
{
    typedef int32_t numbers __attribute__((vector_size(16)));
    const clx_lanes half = lanes_all(0.5 * GRID);
    const clx_lanes most = lanes_all(GRID - 0.5);
    const clx_marks second = lanes_size(d[1]) > lanes_size(d[0]);
    const clx_marks third =
        lanes_size(d[2]) > lanes_pick(second, lanes_size(d[1]), lanes_size(d[0]));
    const clx_lanes along = lanes_pick(third, d[2], lanes_pick(second, d[1], d[0]));
    const clx_lanes row = lanes_pick(third, d[0], lanes_pick(second, d[2], d[1]));
    const clx_lanes column = lanes_pick(third, d[1], lanes_pick(second, d[0], d[2]));
    const clx_lanes face =
        lanes_pick(third, lanes_all(2.0), lanes_pick(second, lanes_all(1.0), lanes_all(0.0)));
    const clx_lanes scale = half / along;
    const numbers i = __builtin_convertvector(lanes_lesser(half + scale * row, most), numbers);
    const numbers j = __builtin_convertvector(lanes_lesser(half + scale * column, most), numbers);
    const numbers cell = (__builtin_convertvector(face, numbers) * GRID + i) * GRID + j;
    lanes_gather(chord, chords->cell[cell[0]].d, chords->cell[cell[1]].d, chords->cell[cell[2]].d,
                 chords->cell[cell[3]].d);
}

/// Within each of four arcs the width is at least that of the chord of its middle, a cosine: at
/// both ends of the arcs.
CLX_INLINE void bound_widths(const clx_chords *chords, int from, const double u[3],
                             const double v[3], clx_lanes width[2])
{
    const double(*begin)[2 * CLX_N_ARC] = chords->arc[0];
    const double(*middle)[2 * CLX_N_ARC] = chords->arc[1];
    const double(*end)[2 * CLX_N_ARC] = chords->arc[2];
    const clx_lanes along = lanes_load(middle[0] + from);
    const clx_lanes across = lanes_load(middle[1] + from);
    clx_lanes d[3];
    clx_lanes chord[4];
    for (int k = 0; k < 3; ++k) {
        d[k] = along * u[k] + across * v[k];
    }
    find_chords(chords, d, chord);
    const clx_lanes x = chord[0] * u[0] + chord[1] * u[1] + chord[2] * u[2];
    const clx_lanes y = chord[0] * v[0] + chord[1] * v[1] + chord[2] * v[2];
    width[0] = x * lanes_load(begin[0] + from) + y * lanes_load(begin[1] + from);
    width[1] = x * lanes_load(end[0] + from) + y * lanes_load(end[1] + from);
}

CLX_FOR_EACH_MACHINE
uint32_t clx_chords_arcs(const clx_chords *chords, const double u[3], const double v[3],
                         double limit)
{
    const double sure = 1.0 - 1e-8; // of a bound, in spite of rounding
    uint32_t arcs = 0;
    for (int from = 0; from < CLX_N_ARC; from += CLX_LANES) {
        clx_lanes a[2];
        clx_lanes b[2];
        bound_widths(chords, from, u, v, a);
        bound_widths(chords, CLX_N_ARC + from, u, v, b);
        // the product of two cosines without a change of sign is least at an end
        const clx_marks is_bound = (a[0] * a[1] > 0.0) & (b[0] * b[1] > 0.0);
        const clx_lanes least = lanes_lesser(lanes_size(a[0] * b[0]), lanes_size(a[1] * b[1]));
        arcs |= (uint32_t)lanes_bits(~(is_bound & (sure * least > limit))) << from;
    }
    return arcs | (arcs & 1) << CLX_N_ARC;
}
