// What lies on the floor as a bed to begin with: every body one rigid grain above the place where
// it came down, in the order in which they came, each dropped onto those before. clast pack --start
// lets them fall and settles them.                                  [docs/theory/evolve.md sec. 6]
#include "study/evolve_folder.h"

#include "base/alloc.h"
#include "evolve/walls.h"
#include "io/rigid_grain.h"
#include <clast/assembly.h>
#include <clast/cloud.h>
#include <clast/shape.h>
#include <clast/state.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const double CLEARANCE = 1.01;     ///< bounding radius over the body's own
static const double NARROWEST = 1.05;     ///< width of a bed, by its widest body's diameter
static const double ASIDE = 0.01;         ///< a body's shift to the side, by its radius
static const double GOLDEN = 2.399963230; ///< angle between the shifts of two that follow [rad]

/// The shape of this name, or -1.
static int32_t find_shape(const clast_assembly *bed, const char *name)
{
    for (int32_t k = 0; k < bed->n_shape; ++k) {
        if (strcmp(bed->shape[k].name, name) == 0) {
            return k;
        }
    }
    return -1;
}

/// A single grain keeps its shape, at scale 1 and unturned, for others of its kind.
static void make_plain(clast_assembly *body)
{
    const double plain[4] = {1.0, 0.0, 0.0, 0.0};
    body->scale[0] = 1.0;
    memcpy(body->orientation[0], plain, sizeof plain);
    memset(body->position[0], 0, sizeof body->position[0]);
}

/// The rigid shape of a body, made once: of an aggregate under the name of its node.
static clast_status shape_of(clast_assembly *body, int64_t node, clast_assembly *bed, int32_t *id)
{
    static const clast_rigid_options hulls = {.hull = true};
    clast_status status = CLAST_OK;
    clast_shape shape = {0};
    const clast_shape *first = &body->shape[body->shape_id[0]];
    double added = 0.0;
    char name[256];
    (void)snprintf(name, sizeof name, "node-%08lld", (long long)node);
    if (body->n_grain == 1) {
        (void)snprintf(name, sizeof name, "%.200s", first->name);
        make_plain(body);
    }
    *id = body->n_grain == 1 ? find_shape(bed, name) : -1;
    if (*id >= 0) {
        return CLAST_OK;
    }
    if (body->n_grain == 1 &&
        (first->kind == CLAST_SHAPE_SPHERE || first->kind == CLAST_SHAPE_ELLIPSOID)) {
        CLX_TRY(clast_shape_copy(first, &shape));
    } else {
        CLX_TRY(clx_rigid_grain(body, name, &hulls, &shape, &added));
    }
    CLX_TRY(clast_assembly_add_shape(bed, &shape, id));
done:
    clast_shape_free(&shape);
    return status;
}

/// Adds a body where it came down.
static clast_status add_body(const clast_evolve *evolve, int64_t node, double mass,
                             const double place[3], clast_assembly *bed)
{
    clast_status status = CLAST_OK;
    clast_assembly body = {0};
    double rotation[4] = {1.0, 0.0, 0.0, 0.0};
    int32_t id = -1;
    CLX_TRY(clast_evolve_aggregate(evolve, node, &body));
    const double scale = body.n_grain == 1 ? body.scale[0] : 1.0;
    if (body.n_grain == 1) {
        memcpy(rotation, body.orientation[0], sizeof rotation);
    }
    CLX_TRY(shape_of(&body, node, bed, &id));
    CLAST_ASSERT(id >= 0 && bed->shape != NULL);
    CLX_TRY(clast_assembly_add_grain(bed, id, place, rotation, scale,
                                     mass / (bed->shape[id].volume * scale * scale * scale)));
done:
    clast_assembly_free(&body);
    return status;
}

/// Radius of a body's place.
static double bounding_radius_of(const clast_assembly *bed, int32_t i)
{
    return CLEARANCE * bed->scale[i] * bed->shape[bed->shape_id[i]].bounding_radius;
}

/// From where to where a domain reaches along x or y.
typedef struct {
    double low, high;
} span;

/// A disc of the domain, or its half (a half pipe: y of its own from 0 up), about an end of its
/// axis.
static span span_of_disc(const clast_domain *d, int axis, double along)
{
    double own[3];
    double centre = d->is_placed ? d->centre[axis] : 0.0;
    for (int k = 0; k < 3; ++k) {
        own[k] = d->is_placed ? d->axes[k][axis] : (k == axis ? 1.0 : 0.0);
    }
    const bool is_half = d->kind == CLAST_DOMAIN_HALF_PIPE;
    const double whole = d->radius * hypot(own[0], own[1]);
    const double side = d->radius * fabs(own[0]);
    centre += along * own[2];
    return (span){centre - (is_half && own[1] >= 0.0 ? side : whole),
                  centre + (is_half && own[1] <= 0.0 ? side : whole)};
}

static span span_of(const clast_domain *d, int axis)
{
    if (d->kind == CLAST_DOMAIN_CYLINDER || d->kind == CLAST_DOMAIN_HALF_PIPE) {
        const span base = span_of_disc(d, axis, 0.0);
        const span end = span_of_disc(d, axis, d->length);
        return (span){fmin(base.low, end.low), fmax(base.high, end.high)};
    }
    if (d->kind == CLAST_DOMAIN_SPHERE) {
        const double centre = d->is_placed ? d->centre[axis] : 0.0;
        return (span){centre - d->radius, centre + d->radius};
    }
    return (span){d->low[axis], d->high[axis]};
}

/// Where places of arrival go in a bed of this width: the domain is cut across into the whole
/// number of strips that comes nearest to the bed's width, which lie upon each other, stretched
/// onto what a body's centre can reach between the walls.
static double across(span domain, double width, double x, double radius)
{
    const double extent = domain.high - domain.low;
    const double strip = extent / fmax(1.0, round(extent / width));
    const double t = extent > 0.0 ? (x - domain.low) / strip : 0.5;
    const double share = x >= domain.high ? 1.0 : t - floor(t);
    return radius - 0.5 * width + share * (width - 2.0 * radius);
}

/// Moves bodies from where they came down to where they are in the column. Each goes a hundredth of
/// its radius to a side of its own, so that none stands on the top of another, whatever the places.
static void place_across(const clast_domain *domain, double width, clast_assembly *bed)
{
    for (int32_t i = 0; i < bed->n_grain; ++i) {
        const double radius = bounding_radius_of(bed, i);
        const double aside = ASIDE * radius / CLEARANCE;
        double *x = bed->position[i];
        x[0] = across(span_of(domain, 0), width, x[0], radius) + aside * cos(GOLDEN * i);
        x[1] = across(span_of(domain, 1), width, x[1], radius) + aside * sin(GOLDEN * i);
    }
}

/// Bodies that lie already, by square cells of the column no smaller than the widest of them.
typedef struct {
    double width;
    int32_t n;       ///< cells in a row
    int32_t *newest; ///< [n * n] body, or -1
    int32_t *older;  ///< [bodies] the one before it in its cell, or -1
    double *crest;   ///< [bodies] top of the highest of it and all older ones of its cell
} column;

static int32_t cell_of(const column *c, double x)
{
    const int32_t k = (int32_t)((x / c->width + 0.5) * c->n);
    return k < 0 ? 0 : (k < c->n ? k : c->n - 1);
}

/// Lowest height to which body i sinks straight down without meeting another one's place.
static double height_of(const column *c, const clast_assembly *bed, int32_t i)
{
    const double *x = bed->position[i];
    const double radius = bounding_radius_of(bed, i);
    const int32_t at[2] = {cell_of(c, x[0]), cell_of(c, x[1])};
    double best = radius;
    for (int k = 0; k < 9; ++k) {
        const int32_t a = at[0] + k % 3 - 1;
        const int32_t b = at[1] + k / 3 - 1;
        const bool is_cell = a >= 0 && b >= 0 && a < c->n && b < c->n;
        for (int32_t j = is_cell ? c->newest[a * c->n + b] : -1;
             j >= 0 && c->crest[j] + radius > best; j = c->older[j]) {
            const double *y = bed->position[j];
            const double distance = radius + bounding_radius_of(bed, j);
            const double dx = x[0] - y[0];
            const double dy = x[1] - y[1];
            const double rest = distance * distance - dx * dx - dy * dy;
            best = rest > 0.0 ? fmax(best, y[2] + sqrt(rest)) : best;
        }
    }
    return best;
}

/// Drops all bodies in their order; the height of the column. O(bodies) where it is wide.
static clast_status drop_all(double width, clast_assembly *bed, double *height)
{
    clast_status status = CLAST_OK;
    column c = {.width = width};
    double widest = 0.0;
    for (int32_t i = 0; i < bed->n_grain; ++i) {
        widest = fmax(widest, 2.0 * bounding_radius_of(bed, i));
    }
    c.n = (int32_t)fmax(1.0, fmin(floor(width / widest), ceil(sqrt((double)bed->n_grain))));
    CLX_TRY(clx_alloc(&c.newest, c.n * c.n, sizeof *c.newest));
    CLX_TRY(clx_alloc(&c.older, bed->n_grain, sizeof *c.older));
    CLX_TRY(clx_alloc(&c.crest, bed->n_grain, sizeof *c.crest));
    memset(c.newest, -1, (size_t)c.n * (size_t)c.n * sizeof *c.newest);
    *height = 0.0;
    for (int32_t i = 0; i < bed->n_grain; ++i) {
        double *x = bed->position[i];
        int32_t *cell = &c.newest[cell_of(&c, x[0]) * c.n + cell_of(&c, x[1])];
        x[2] = height_of(&c, bed, i);
        c.older[i] = *cell;
        c.crest[i] = fmax(x[2] + bounding_radius_of(bed, i), *cell >= 0 ? c.crest[*cell] : 0.0);
        *height = fmax(*height, c.crest[i]);
        *cell = i;
    }
done:
    CLX_FREE(c.newest, c.older, c.crest);
    return status;
}

/// Radius of the sphere as large as the smallest body.
static double least_radius(const clast_assembly *bed)
{
    double least = (double)INFINITY;
    for (int32_t i = 0; i < bed->n_grain; ++i) {
        const double volume = bed->shape[bed->shape_id[i]].volume;
        least = fmin(least, bed->scale[i] * cbrt(0.75 * volume / CLAST_PI));
    }
    return least;
}

/// Puts all into a column no narrower than the widest of them; its width, height and mass.
static clast_status place_all(const clast_domain *domain, double width, clast_assembly *bed,
                              clast_evolve_result *result)
{
    clast_status status = CLAST_OK;
    double height = 0.0;
    for (int32_t i = 0; i < bed->n_grain; ++i) {
        width = fmax(width, NARROWEST / CLEARANCE * 2.0 * bounding_radius_of(bed, i));
    }
    place_across(domain, width, bed);
    CLX_TRY(drop_all(width, bed, &height));
    result->bed_width = width;
    result->bed_height = height;
    result->bed_mass = clast_assembly_mass(bed);
    result->bed_least = least_radius(bed);
done:
    return status;
}

clast_status clx_evolve_write_bed(const char *folder, double width, const clast_domain *domain,
                                  const clast_evolve *evolve, clast_evolve_result *result)
{
    clast_status status = CLAST_OK;
    clast_table deposit = {0};
    clast_assembly bed = {.unit = "m"};
    char path[CLX_PATH_LIMIT];
    CLX_TRY(clast_evolve_table(evolve, CLAST_EVOLVE_DEPOSIT, &deposit));
    for (int64_t i = 0; i < deposit.n_row; ++i) {
        const double place[3] = {clast_table_numbers(&deposit, "x_m")[i],
                                 clast_table_numbers(&deposit, "y_m")[i],
                                 clast_table_numbers(&deposit, "z_m")[i]};
        if (clx_walls_is_floor(domain, place)) {
            CLX_TRY(add_body(evolve, (int64_t)clast_table_numbers(&deposit, "node")[i],
                             clast_table_numbers(&deposit, "mass_kg")[i], place, &bed));
        }
    }
    result->is_bed_empty = bed.n_grain == 0;
    if (bed.n_grain > 0) {
        CLX_TRY(place_all(domain, width, &bed, result));
        CLX_TRY(clx_path_join(path, folder, "deposit.h5"));
        CLX_TRY(clast_state_write_assembly(&bed, path, NULL));
    }
done:
    clast_table_free(&deposit);
    clast_assembly_free(&bed);
    return status;
}
