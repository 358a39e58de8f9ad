// Where grains begin: fill after fill, clear of each other, none shrunk or left out.
#include "base/alloc.h"
#include "dem/body.h"
#include "math/vec3.h"
#include "pack/pack.h"
#include <math.h>

double clx_pack_fill_low(const clast_pack *p)
{
    const clast_pack_config *c = &p->config;
    if (c->dem.domain == CLAST_DEM_CELL) {
        return p->base;
    }
    return p->base +
           p->height * (p->n_fill == 0 && c->first_low >= 0.0 ? c->first_low : c->fill_low);
}

static double fill_high(const clast_pack *p)
{
    const clast_pack_config *c = &p->config;
    if (c->dem.domain == CLAST_DEM_CELL) {
        return p->base + p->height;
    }
    return p->base +
           p->height * (p->n_fill == 0 && c->first_high >= 0.0 ? c->first_high : c->fill_high);
}

enum { LATTICE_LIMIT = 1 << 26 };

/// What a point of the lattice is to the grains that follow.
enum { FREE, BARRED, HELD }; // no grain fits there; one has its centre there

/// Where the next grain of a fill may go.
typedef struct {
    double low, high; ///< heights of the region
    uint8_t *taken;   ///< [n_point] of the lattice: FREE, BARRED or HELD
    int64_t first;    ///< all before it are taken
    double x, y, z;   ///< shelf: where the next sphere may begin
    double row, layer;
    int32_t n;
    int32_t *wide; ///< [n_wide] of `grain`, wider than the spacing
    int64_t n_wide, wide_capacity;
    double least;   ///< radius that no grain falls below
    int32_t n_old;  ///< the first of `grain`: of earlier fills, still reaching into the region
    double refused; ///< least radius that found no place: no greater one will
    clast_dem_grain *grain; ///< [n] of this fill
    double *radius;         ///< [n]
    int64_t capacity, radius_capacity;
} filling;

/// Steps of the lattice [m], and its points along x and y.
static void measure_lattice(const clast_pack *p, double step[3], double n[2])
{
    const clast_dem_config *d = &p->config.dem;
    const bool is_hcp = p->config.generator == CLAST_PACK_HCP;
    const double depth = d->depth > 0.0 ? d->depth : d->width;
    step[0] = p->spacing;
    step[1] = p->spacing * (is_hcp ? sqrt(0.75) : 1.0);
    step[2] = p->spacing * (is_hcp ? sqrt(2.0 / 3.0) : 1.0);
    n[0] = fmax(1.0, floor(d->width / step[0] + 1e-9));
    n[1] = fmax(1.0, floor(depth / step[1] + 1e-9));
}

/// Refuses a lattice that is much finer than the grains: it takes time and memory and no grain
/// more.
static clast_status check_lattice(const clast_pack *p, filling *f)
{
    clast_status status = CLAST_OK;
    double step[3];
    double n[2];
    double low = 0.0;
    double high = 0.0;
    measure_lattice(p, step, n);
    clast_grading_range(p->input.grading, &low, &high);
    f->least = 0.4999 * low;
    const double narrowest = low * p->widest;
    CLX_CHECK(p->spacing >= 0.1 * narrowest, CLAST_E_CONFIG,
              "spacing %s is less than a tenth of the smallest grain, %s",
              clx_unit_text(p->spacing, "m"), clx_unit_text(narrowest, "m"));
    const double n_point = n[0] * n[1] * fmax(1.0, (f->high - f->low) / step[2]);
    CLX_CHECK(n_point <= LATTICE_LIMIT, CLAST_E_CONFIG,
              "spacing %s: %.3g places for grains in this domain, at most %.3g are possible; take "
              "a larger spacing or the generator shelf",
              clx_unit_text(p->spacing, "m"), n_point, (double)LATTICE_LIMIT);
done:
    return status;
}

/// The k-th point of the lattice, layer by layer; false above the region.
static bool lattice_point(const clast_pack *p, const filling *f, int64_t k, double x[3])
{
    CLAST_ASSERT(k >= 0);
    const double h = p->spacing;
    const bool is_hcp = p->config.generator == CLAST_PACK_HCP;
    double step[3];
    double n[2];
    measure_lattice(p, step, n);
    const int64_t nx = (int64_t)n[0];
    const int64_t ny = (int64_t)n[1];
    const int64_t i = k % nx;
    const int64_t j = k / nx % ny;
    const int64_t l = k / (nx * ny);
    x[0] = p->middle[0] + ((double)i - 0.5 * (double)(nx - 1)) * step[0];
    x[1] = p->middle[1] + ((double)j - 0.5 * (double)(ny - 1)) * step[1];
    x[2] = f->low + 0.5 * h + (double)l * step[2];
    if (is_hcp) {
        x[0] += (j + l) % 2 != 0 ? 0.25 * h : -0.25 * h;
        x[1] += l % 2 != 0 ? h / sqrt(48.0) : -h / sqrt(48.0);
    }
    return x[2] <= f->high - 0.5 * h + 1e-9 * h;
}

/// Whether a sphere lies within the side walls, by half a spacing or its own radius.
static bool is_inside(const clast_pack *p, const double x[3], double radius)
{
    const clast_dem_config *d = &p->config.dem;
    const double depth = d->depth > 0.0 ? d->depth : d->width;
    if (p->inside != NULL) {
        return clx_pack_holds(p, x, radius);
    }
    if (d->domain == CLAST_DEM_CYLINDER) {
        return sqrt(x[0] * x[0] + x[1] * x[1]) + radius <= 0.5 * d->width;
    }
    return d->domain != CLAST_DEM_BOX ||
           (fabs(x[0]) + radius <= 0.5 * d->width && fabs(x[1]) + radius <= 0.5 * depth);
}

/// Whether a sphere is clear of grain i, of its periodic images too.
static bool is_clear_of(const clast_pack *p, const filling *f, int32_t i, const double x[3],
                        double radius)
{
    CLAST_ASSERT(i >= 0 && i < f->n && radius > 0.0);
    const clast_dem_config *d = &p->config.dem;
    const double period[3] = {d->width, d->depth > 0.0 ? d->depth : d->width, d->height};
    const int n_period = d->domain == CLAST_DEM_CELL ? 3 : d->domain == CLAST_DEM_PERIODIC ? 2 : 0;
    const double contact_distance = radius + f->radius[i];
    double r[3];
    v3_sub(r, x, f->grain[i].position);
    for (int k = 0; k < n_period; ++k) {
        r[k] -= period[k] * floor(r[k] / period[k] + 0.5);
    }
    return v3_norm2(r) >= contact_distance * contact_distance;
}

/// Whether a sphere is clear of all others in the region.
static bool is_clear(const clast_pack *p, const filling *f, const double x[3], double radius)
{
    for (int32_t i = f->n - 1; i >= 0; --i) {
        if (!is_clear_of(p, f, i, x, radius)) {
            return false;
        }
    }
    return true;
}

/// Whether a wide grain is so near that not even the smallest fits there. A grain's circumscribed
/// sphere is no smaller than its sieve or volume-equivalent size.
static bool is_barred(const clast_pack *p, const filling *f, const double x[3])
{
    for (int64_t i = 0; i < f->n_wide; ++i) {
        if (!is_clear_of(p, f, f->wide[i], x, f->least)) {
            return true;
        }
    }
    return false;
}

/// Whether a grain stands on the lattice straight below point k, nearer than this radius: every
/// second layer of either lattice has its points above each other.
static bool stands_above(const clast_pack *p, const filling *f, int64_t k, double radius)
{
    double step[3];
    double n[2];
    measure_lattice(p, step, n);
    const int64_t down = 2 * (int64_t)n[0] * (int64_t)n[1];
    for (int64_t i = 1; 2.0 * (double)i * step[2] < radius && k >= i * down; ++i) {
        if (f->taken[k - i * down] == HELD) {
            return true;
        }
    }
    return false;
}

/// Whether every lattice point is taken; `first` moves up to the first that is not.
static bool is_full(const clast_pack *p, filling *f)
{
    double x[3];
    while (lattice_point(p, f, f->first, x) && f->taken[f->first] != 0) {
        ++f->first;
    }
    return p->config.generator != CLAST_PACK_SHELF && !lattice_point(p, f, f->first, x);
}

/// First lattice point that takes this sphere: points that a wide grain passed over are left to
/// those that follow.
static bool place_on_lattice(const clast_pack *p, filling *f, double radius, double x[3])
{
    CLAST_ASSERT(radius > 0.0 && p->spacing > 0.0);
    const double clearance = fmax(radius, 0.5 * p->spacing);
    const bool may_overlap = 2.0 * radius > p->spacing || f->n_wide > 0 || f->n_old > 0;
    for (int64_t k = f->first; lattice_point(p, f, k, x); ++k) {
        if (f->taken[k] != FREE) {
            continue;
        }
        if (!is_inside(p, x, clearance)) {
            f->taken[k] =
                clearance > 0.5 * p->spacing ? FREE : BARRED; // too near a side for any grain
            continue;
        }
        if (is_barred(p, f, x)) {
            f->taken[k] = BARRED;
            continue;
        }
        if (!may_overlap || (!stands_above(p, f, k, radius) && is_clear(p, f, x, radius))) {
            f->taken[k] = HELD;
            (void)is_full(p, f);
            return true;
        }
    }
    // a wide grain may fit between walls where the lattice has no point: on the axis
    v3_set(x, p->middle[0], p->middle[1], f->low + clearance);
    if (f->n == f->n_old && is_clear(p, f, x, radius) && is_inside(p, x, radius) &&
        x[2] + radius <= f->high) {
        return true;
    }
    return false;
}

/// Next place on the shelves: rows along x, rows side by side along y, layers above each other.
static bool place_on_shelf(const clast_pack *p, filling *f, double radius, double x[3])
{
    CLAST_ASSERT(radius > 0.0);
    const clast_dem_config *d = &p->config.dem;
    const double low[2] = {p->middle[0] - 0.5 * d->width,
                           p->middle[1] - 0.5 * (d->depth > 0.0 ? d->depth : d->width)};
    const double high[2] = {2.0 * p->middle[0] - low[0], 2.0 * p->middle[1] - low[1]};
    const double size = 2.02 * radius;
    for (int tries = 0; tries < 100000; ++tries) {
        if (f->z + size > f->high) {
            return false;
        }
        if (f->y + size > high[1]) { // layer is full
            f->z += f->layer;
            f->y = low[1];
            f->x = low[0];
            f->row = f->layer = 0.0;
        } else if (f->x + size > high[0]) { // row is full
            f->y += f->row > 0.0 ? f->row : 0.25 * radius;
            f->x = low[0];
            f->row = 0.0;
        } else {
            v3_set(x, f->x + 0.5 * size, f->y + 0.5 * size, f->z + 0.5 * size);
            if (is_inside(p, x, radius)) {
                f->x += size;
                f->row = fmax(f->row, size);
                f->layer = fmax(f->layer, size);
                return true;
            }
            f->x += 0.25 * radius;
        }
    }
    return false;
}

static clast_status append_grain(const clast_pack *p, filling *f, const clast_dem_grain *g,
                                 double radius)
{
    CLAST_ASSERT(radius > 0.0);
    clast_status status = CLAST_OK;
    if (2.0 * radius > p->spacing) {
        CLX_TRY(clx_grow(&f->wide, &f->wide_capacity, f->n_wide + 1, sizeof *f->wide));
        f->wide[f->n_wide++] = f->n;
    }
    CLX_TRY(clx_grow(&f->grain, &f->capacity, f->n + 1, sizeof *f->grain));
    CLX_TRY(clx_grow(&f->radius, &f->radius_capacity, f->n + 1, sizeof *f->radius));
    f->radius[f->n] = radius;
    f->grain[f->n++] = *g;
done:
    return status;
}

/// Grains of earlier fills that still reach into the region.
static clast_status keep_old(const clast_pack *p, filling *f)
{
    clast_status status = CLAST_OK;
    for (int32_t i = 0; i < clast_dem_n_grain(p->dem); ++i) {
        clast_dem_grain g;
        double measures[2];
        clast_dem_read_grain(p->dem, i, &g);
        clx_dem_shape_measures(p->dem, g.shape, measures);
        if (g.position[2] + g.scale * measures[0] > f->low) {
            CLX_TRY(append_grain(p, f, &g, g.scale * measures[0]));
        }
    }
    f->n_old = f->n;
done:
    return status;
}

/// Grains in a row that find no place before a fill ends.
enum { PATIENCE = 16 };

/// Places a grain, if there is room for it.
static clast_status try_place(clast_pack *p, filling *f, clx_pack_number *number, bool *is_placed)
{
    clast_status status = CLAST_OK;
    clast_dem_grain g;
    double measures[2];
    CLX_TRY(clx_pack_draw(p, number, &g));
    clx_dem_shape_measures(p->dem, g.shape, measures);
    const double radius = g.scale * measures[0];
    const double mass = g.density * measures[1] * g.scale * g.scale * g.scale;
    if (number->index == p->n_drawn) {
        ++p->n_drawn;
        p->drawn_mass += mass;
    }
    *is_placed = radius < f->refused && (p->config.generator == CLAST_PACK_SHELF
                                             ? place_on_shelf(p, f, radius, g.position)
                                             : place_on_lattice(p, f, radius, g.position));
    if (*is_placed) {
        CLX_TRY(append_grain(p, f, &g, radius));
        ++p->n_made;
        p->mass += mass;
        return CLAST_OK;
    }
    f->refused = fmin(f->refused, radius);
    CLX_CHECK(f->n > 0, CLAST_E_CONFIG,
              "no grain fits between %s and %s: grain %lld does not fit into the domain (its "
              "bounding diameter is %s, spacing %s); take a taller or wider domain%s",
              clx_unit_text(f->low, "m"), clx_unit_text(f->high, "m"), (long long)number->index,
              clx_unit_text(2.0 * radius, "m"), clx_unit_text(p->spacing, "m"),
              p->config.spacing > 2.0 * radius ? ", or a smaller spacing" : "");
done:
    return status;
}

/// Grains that wait come first, in their order.
static clast_status place_waiting(clast_pack *p, filling *f)
{
    CLAST_ASSERT(p->n_waiting >= 0);
    clast_status status = CLAST_OK;
    int32_t kept = 0;
    for (int32_t i = 0; i < p->n_waiting; ++i) {
        bool is_placed = false;
        CLX_TRY(try_place(p, f, &p->waiting[i], &is_placed));
        p->waiting[kept] = p->waiting[i];
        kept += is_placed ? 0 : 1;
    }
    p->n_waiting = kept;
done:
    return status;
}

/// Draws grains and places them until the region or the mass is full; those without a place wait
/// for the next fill.
static clast_status fill_region(clast_pack *p, filling *f)
{
    clast_status status = CLAST_OK;
    int in_vain = 0;
    CLX_TRY(place_waiting(p, f));
    while (p->drawn_mass < p->config.mass && in_vain < PATIENCE && (f->n == 0 || !is_full(p, f))) {
        clx_pack_number number = {p->n_drawn, -1};
        bool is_placed = false;
        CLX_TRY(
            clx_grow(&p->waiting, &p->waiting_capacity, p->n_waiting + 1LL, sizeof *p->waiting));
        CLX_TRY(try_place(p, f, &number, &is_placed));
        in_vain = is_placed ? 0 : in_vain + 1;
        if (!is_placed) {
            p->waiting[p->n_waiting++] = number;
            ++p->n_waited;
        }
    }
done:
    return status;
}

clast_status clx_pack_fill(clast_pack *p)
{
    clast_status status = CLAST_OK;
    const clast_dem_config *d = &p->config.dem;
    filling f = {.low = clx_pack_fill_low(p), .high = fill_high(p), .refused = INFINITY};
    f.x = p->middle[0] - 0.5 * d->width;
    f.y = p->middle[1] - 0.5 * (d->depth > 0.0 ? d->depth : d->width);
    f.z = f.low;
    int64_t n_point = 0;
    double x[3];
    if (p->config.generator != CLAST_PACK_SHELF) {
        CLX_TRY(check_lattice(p, &f));
    }
    while (p->config.generator != CLAST_PACK_SHELF && lattice_point(p, &f, n_point, x)) {
        ++n_point;
    }
    CLX_TRY(clx_alloc(&f.taken, n_point + 1, sizeof *f.taken));
    CLX_TRY(keep_old(p, &f));
    CLX_TRY(fill_region(p, &f));
    CLX_TRY(clast_dem_add_grains(p->dem, f.n - f.n_old, f.grain + f.n_old));
    if (f.n > f.n_old) { // else grains of the last one are still in the way
        ++p->n_fill;
        p->fill_step = clast_dem_n_step(p->dem);
    }
done:
    CLX_FREE(f.grain, f.radius, f.wide, f.taken);
    return status;
}
