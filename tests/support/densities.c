// Points are drawn in the unit cube p, which the place turns or cuts; integrals are closed forms,
// of the plume a sum over slices, of the flow a sum over all pairs of its pool.
#include "densities.h"

#include "base/alloc.h"
#include <clast/mesh.h>
#include <math.h>
#include <string.h>

const density densities[N_DENSITY] = {
    {"uniform", LAW_UNIFORM, 1.0, 0.0},     {"blob_half_05", LAW_BLOB, 0.5, 0.05},
    {"blob_tenth_03", LAW_BLOB, 0.1, 0.03}, {"blob_third_12", LAW_BLOB, 1.0 / 3.0, 0.12},
    {"blob_all_08", LAW_BLOB, 1.0, 0.08},   {"blob_all_25", LAW_BLOB, 1.0, 0.25},
    {"sheet_02", LAW_SHEET, 1.0, 0.02},     {"sheet_half_05", LAW_SHEET, 0.5, 0.05},
    {"sheet_20", LAW_SHEET, 1.0, 0.2},      {"line_02", LAW_LINE, 1.0, 0.02},
    {"line_half_05", LAW_LINE, 0.5, 0.05},  {"line_20", LAW_LINE, 1.0, 0.2},
    {"frame_20", LAW_FRAME, 1.0, 0.2},      {"frame_half_07", LAW_FRAME, 0.5, 0.07},
    {"plume_02", LAW_PLUME, 1.0, 0.02},     {"plume_08", LAW_PLUME, 1.0, 0.08},
    {"power_10", LAW_POWER, 1.0, 0.1},      {"power_25", LAW_POWER, 1.0, 0.25},
    {"power_40", LAW_POWER, 1.0, 0.4},      {"cascade_3", LAW_CASCADE, 1.0, 3.0},
    {"cascade_6", LAW_CASCADE, 1.0, 6.0},   {"inertia_01", LAW_INERTIA, 1.0, 0.015}};

enum { N_MODE = 16, N_STEP = 60, N_POOL = 40000, N_SLICE = 20000 };

static const double middle[3] = {0.47, 0.55, 0.43}; ///< of blobs, lines and sheets
static const double offset[3] = {0.37, 0.21, 0.63}; ///< of a cascade: its boxes are nobody's cells
static const double radius = 0.5;

/// Rows are the axes of the turned cube.
static const double turn[3][3] = {{2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0},
                                  {2.0 / 3.0, 2.0 / 3.0, -1.0 / 3.0},
                                  {-1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0}};

static double centre(density_place place, int32_t d, int32_t j)
{
    return place == PLACE_CYLINDER && j < 2 ? 0.5 : middle[d == 2 && j == 1 ? 2 : j];
}

static bool is_inside(density_place place, const double p[3])
{
    const double x = p[0] - 0.5;
    const double y = p[1] - 0.5;
    return place != PLACE_CYLINDER || x * x + y * y <= radius * radius;
}

bool density_fits(const density *law, density_place place, int32_t dimension)
{
    return dimension == 3 || (place == PLACE_BOX && law->law != LAW_SHEET);
}

/// A normal number within [0, 1].
static double cut_normal(clx_rng *rng, double mean, double sd)
{
    for (;;) {
        const double x = mean + sd * clx_rng_normal(rng);
        if (x >= 0.0 && x <= 1.0) {
            return x;
        }
    }
}

static void draw_uniform(clx_rng *rng, density_place place, int32_t d, double p[3])
{
    do {
        for (int32_t j = 0; j < d; ++j) {
            p[j] = clx_rng_uniform(rng);
        }
    } while (!is_inside(place, p));
}

/// Normal along the axes of the bits of `across`, uniform along the others.
static void draw_normal(clx_rng *rng, const density_scene *s, unsigned across, double sd,
                        double p[3])
{
    do {
        for (int32_t j = 0; j < s->dimension; ++j) {
            p[j] = (across >> j & 1u) != 0 ? cut_normal(rng, centre(s->place, s->dimension, j), sd)
                                           : clx_rng_uniform(rng);
        }
    } while (!is_inside(s->place, p));
}

/// Share of part b of a box at this node: the k-th of a list, in an order of the node's own.
static double part_share(uint64_t node, int n_part, int b)
{
    static const double four[4] = {0.4, 0.3, 0.2, 0.1};
    static const double eight[8] = {0.25, 0.2, 0.15, 0.12, 0.1, 0.08, 0.06, 0.04};
    clx_rng rng = clx_rng_at(77, CLX_STREAM_TEST, node);
    int order[8] = {0, 1, 2, 3, 4, 5, 6, 7};
    for (int k = n_part - 1; k > 0; --k) {
        const int other = (int)clx_rng_below(&rng, k + 1);
        const int held = order[k];
        order[k] = order[other];
        order[other] = held;
    }
    return n_part == 4 ? four[order[b]] : eight[order[b]];
}

static void draw_cascade(clx_rng *rng, const density_scene *s, double p[3])
{
    const int n_part = 1 << s->dimension;
    uint64_t node = 1;
    double width = 1.0;
    double low[3] = {0};
    for (int level = 0; level < (int)s->density->size; ++level) {
        double left = clx_rng_uniform(rng);
        int b = 0;
        while (b < n_part - 1 && (left -= part_share(node, n_part, b)) > 0.0) {
            ++b;
        }
        width *= 0.5;
        for (int32_t j = 0; j < s->dimension; ++j) {
            low[j] += (b >> j & 1) != 0 ? width : 0.0;
        }
        node = node * (uint64_t)n_part + (uint64_t)b;
    }
    for (int32_t j = 0; j < s->dimension; ++j) {
        const double u = low[j] + width * clx_rng_uniform(rng) + offset[j];
        p[j] = u - floor(u);
    }
}

static void draw_power(clx_rng *rng, const density_scene *s, double p[3])
{
    for (int32_t j = 0; j < s->dimension; ++j) {
        p[j] = pow(clx_rng_uniform(rng), 1.0 / (1.0 - s->density->size));
    }
}

static void draw_frame(clx_rng *rng, const density_scene *s, double p[3])
{
    const double w = s->density->size;
    bool is_in = false;
    while (!is_in) {
        draw_uniform(rng, s->place, s->dimension, p);
        if (s->place == PLACE_CYLINDER) {
            is_in = hypot(p[0] - 0.5, p[1] - 0.5) >= radius - w;
        } else {
            for (int32_t j = 0; j < s->dimension; ++j) {
                is_in = is_in || fmin(p[j], 1.0 - p[j]) <= w;
            }
        }
    }
}

static double plume_sd(double size, double z)
{
    return sqrt(size * size + 0.01 * z);
}

static void draw_plume(clx_rng *rng, const density_scene *s, double p[3])
{
    const int32_t last = s->dimension - 1;
    const double z = clx_rng_uniform(rng);
    const double sd = plume_sd(s->density->size, z);
    do {
        for (int32_t j = 0; j < last; ++j) {
            p[j] = cut_normal(rng, centre(s->place, s->dimension, j), sd);
        }
    } while (!is_inside(s->place, p));
    p[last] = z;
}

static void draw_inertia(clx_rng *rng, const density_scene *s, double p[3])
{
    do {
        const double *from = s->pool + clx_rng_below(rng, s->n_pool) * s->dimension;
        for (int32_t j = 0; j < s->dimension; ++j) {
            const double x = from[j] + s->density->size * clx_rng_normal(rng);
            p[j] = x - floor(x);
        }
    } while (!is_inside(s->place, p));
}

/// From the unit cube of a map to the cylinder's p.
static void round_off(double p[3])
{
    const double rho = radius * sqrt(p[0]);
    const double angle = 2.0 * CLAST_PI * p[1];
    p[0] = 0.5 + rho * cos(angle);
    p[1] = 0.5 + rho * sin(angle);
}

static unsigned axes_across(const density_scene *s)
{
    const unsigned last = 1u << (s->dimension - 1);
    return s->density->law == LAW_BLOB    ? 2u * last - 1u
           : s->density->law == LAW_SHEET ? last
                                          : last - 1u;
}

static void draw_point(clx_rng *rng, const density_scene *s, double x[3])
{
    const density_law law = s->density->law;
    double p[3] = {0};
    if (law == LAW_UNIFORM || clx_rng_uniform(rng) >= s->density->share) {
        draw_uniform(rng, s->place, s->dimension, p);
    } else if (law == LAW_FRAME) {
        draw_frame(rng, s, p);
    } else if (law == LAW_PLUME) {
        draw_plume(rng, s, p);
    } else if (law == LAW_INERTIA) {
        draw_inertia(rng, s, p);
    } else if (law == LAW_POWER || law == LAW_CASCADE) {
        (law == LAW_POWER ? draw_power : draw_cascade)(rng, s, p);
        if (s->place == PLACE_CYLINDER) {
            round_off(p);
        }
    } else {
        draw_normal(rng, s, axes_across(s), s->density->size, p);
    }
    for (int32_t j = 0; j < s->dimension; ++j) {
        x[j] = s->place == PLACE_SURFACE             ? 0.0
               : s->place == PLACE_CYLINDER && j < 2 ? p[j] - 0.5
                                                     : p[j];
        for (int32_t k = 0; k < 3 && s->place == PLACE_SURFACE; ++k) {
            x[j] += turn[k][j] * (p[k] - 0.5) * (1.0 - 1e-12);
        }
    }
}

/// Integral over [0, 1] of the squared density of a normal law cut to it.
static double squared_normal(double mean, double sd)
{
    const double mass = 0.5 * (erf(mean / sd / sqrt(2.0)) + erf((1.0 - mean) / sd / sqrt(2.0)));
    return 0.5 * (erf(mean / sd) + erf((1.0 - mean) / sd)) / (2.0 * sd * sqrt(CLAST_PI)) /
           (mass * mass);
}

/// The same over a disc about the mean.
static double squared_disc(double sd)
{
    const double r2 = radius * radius / (sd * sd);
    const double mass = 1.0 - exp(-0.5 * r2);
    return (1.0 - exp(-r2)) / (4.0 * CLAST_PI * sd * sd) / (mass * mass);
}

/// Integral of the squared density of a law that is normal across these axes.
static double normal_integral(const density_scene *s, unsigned across, double sd)
{
    double product = 1.0;
    int32_t j = 0;
    if (s->place == PLACE_CYLINDER) {
        product = (across & 1u) != 0 ? squared_disc(sd) : 1.0 / (CLAST_PI * radius * radius);
        j = 2;
    }
    for (; j < s->dimension; ++j) {
        product *=
            (across >> j & 1u) != 0 ? squared_normal(centre(s->place, s->dimension, j), sd) : 1.0;
    }
    return product;
}

static double plume_integral(const density_scene *s)
{
    const unsigned across = (1u << (s->dimension - 1)) - 1u;
    double sum = 0.0;
    for (int i = 0; i < N_SLICE; ++i) {
        sum +=
            normal_integral(s, across, plume_sd(s->density->size, (i + 0.5) / N_SLICE)) / N_SLICE;
    }
    return sum;
}

/// Of the law alone, without the uniform rest.
static double law_integral(const density_scene *s, double volume)
{
    const double size = s->density->size;
    const double per_axis = (1.0 - size) * (1.0 - size) / (1.0 - 2.0 * size);
    // the product of the map's three axes; along the angle and the radius it is a power too
    switch (s->density->law) {
    case LAW_FRAME:
        return s->place == PLACE_CYLINDER
                   ? 1.0 / volume / (1.0 - (radius - size) * (radius - size) / (radius * radius))
                   : 1.0 / (1.0 - pow(1.0 - 2.0 * size, s->dimension));
    case LAW_PLUME:
        return plume_integral(s);
    case LAW_POWER:
        return pow(per_axis, s->dimension) / volume;
    case LAW_CASCADE:
        return pow(s->dimension == 2 ? 1.2 : 8.0 * 0.161, size) / volume;
    case LAW_UNIFORM:
    case LAW_INERTIA:
        return 1.0 / volume;
    default:
        return normal_integral(s, axes_across(s), size);
    }
}

typedef struct {
    double wave[3], amplitude[3], phase;
} flow_mode;

/// Modes of a flow without divergence: amplitudes by |k|^(-5/6).
static void make_flow(int32_t d, flow_mode mode[N_MODE])
{
    for (int m = 0; m < N_MODE; ++m) {
        clx_rng rng = clx_rng_at(5, CLX_STREAM_TEST, (uint64_t)m);
        double k2 = 0.0;
        double along = 0.0;
        while (k2 == 0.0) {
            for (int32_t j = 0; j < d; ++j) {
                mode[m].wave[j] = (double)clx_rng_below(&rng, 7) - 3.0;
                k2 += mode[m].wave[j] * mode[m].wave[j];
            }
        }
        for (int32_t j = 0; j < d; ++j) {
            mode[m].amplitude[j] = clx_rng_normal(&rng);
            along += mode[m].amplitude[j] * mode[m].wave[j] / k2;
        }
        for (int32_t j = 0; j < d; ++j) {
            mode[m].amplitude[j] =
                0.3 * pow(k2, -5.0 / 12.0) * (mode[m].amplitude[j] - along * mode[m].wave[j]);
        }
        mode[m].phase = 2.0 * CLAST_PI * clx_rng_uniform(&rng);
    }
}

/// Particles of Stokes number about 0.3 of the flow, from rest in it.
static void advect(const flow_mode mode[N_MODE], int32_t d, double *x)
{
    const double dt = 0.02;
    const double kept = exp(-dt / 0.06); // of the velocity's difference, in a step
    double v[3] = {0};
    for (int step = 0; step < N_STEP; ++step) {
        double u[3] = {0};
        for (int m = 0; m < N_MODE; ++m) {
            double phase = mode[m].phase;
            for (int32_t j = 0; j < d; ++j) {
                phase += 2.0 * CLAST_PI * mode[m].wave[j] * x[j];
            }
            const double wave = cos(phase);
            for (int32_t j = 0; j < d; ++j) {
                u[j] += mode[m].amplitude[j] * wave;
            }
        }
        for (int32_t j = 0; j < d; ++j) {
            v[j] = step == 0 ? u[j] : u[j] + (v[j] - u[j]) * kept;
            x[j] += v[j] * dt;
            x[j] -= floor(x[j]);
        }
    }
}

/// Of points at p and q, number i and j of the pool, met after smoothing: exp(-r^2 / (4 size^2))
/// times the chance that they meet inside the place (one draw; with no edge it is certain).
static double met(const density_scene *s, const double *p, const double *q, int64_t i, int64_t j)
{
    const double var = 2.0 * s->density->size * s->density->size;
    double r2 = 0.0;
    double at[3];
    for (int32_t k = 0; k < s->dimension; ++k) {
        const double off = p[k] - q[k];
        const double near = off > 0.5 ? off - 1.0 : off < -0.5 ? off + 1.0 : off;
        r2 += near * near;
        at[k] = q[k] + 0.5 * near;
    }
    if (r2 > 25.0 * var) {
        return 0.0;
    }
    clx_rng rng = clx_rng_at((uint64_t)i, CLX_STREAM_TEST, (uint64_t)j);
    for (int32_t k = 0; k < s->dimension && s->place == PLACE_CYLINDER; ++k) {
        at[k] += 0.5 * sqrt(var) * clx_rng_normal(&rng);
        at[k] -= floor(at[k]);
    }
    return is_inside(s->place, at) ? exp(-0.5 * r2 / var) : 0.0;
}

enum {
    SIDE = 9
}; ///< cells of the pool's pair search an axis: none is narrower than 5 sqrt(2) size

static int64_t cell_of(const double *x, int32_t d)
{
    int64_t c = 0;
    for (int32_t k = 0; k < d; ++k) {
        const int at = (int)(x[k] * SIDE);
        c = c * SIDE + (at < SIDE ? at : SIDE - 1);
    }
    return c;
}

/// Cell number of the neighbour, the box being periodic.
static int64_t beside(int64_t cell, int32_t d, int neighbour)
{
    int64_t c = 0;
    int64_t scale = 1;
    for (int32_t k = 0; k < d; ++k) {
        c += (cell % SIDE + SIDE + neighbour % 3 - 1) % SIDE * scale;
        cell /= SIDE;
        neighbour /= 3;
        scale *= SIDE;
    }
    return c;
}

/// The share of the pool's smoothed points that is inside the place, by 8 draws each, times n_pool.
static double count_inside(const density_scene *s)
{
    const int32_t d = s->dimension;
    double inside = 0.0;
    for (int64_t i = 0; i < s->n_pool && s->place == PLACE_CYLINDER; ++i) {
        clx_rng rng = clx_rng_at(9, CLX_STREAM_TEST, (uint64_t)i);
        for (int k = 0; k < 8; ++k) {
            double p[3];
            for (int32_t j = 0; j < d; ++j) {
                p[j] = s->pool[i * d + j] + s->density->size * clx_rng_normal(&rng);
                p[j] -= floor(p[j]);
            }
            inside += is_inside(s->place, p) ? 0.125 : 0.0;
        }
    }
    return s->place == PLACE_CYLINDER ? inside : (double)s->n_pool;
}

/// Integral of the squared density of the pool's smoothed points: all pairs, each with itself too.
static clast_status pool_integral(const density_scene *s, double *integral)
{
    clast_status status = CLAST_OK;
    const int32_t d = s->dimension;
    const int n_cell = d == 2 ? SIDE * SIDE : SIDE * SIDE * SIDE;
    const bool is_both = s->place == PLACE_CYLINDER; // two draws a pair
    int64_t *begin = NULL;
    int64_t *item = NULL;
    double *x = NULL; // by cells
    double sum = 0.0;
    CLX_TRY(clx_alloc(&begin, n_cell + 2, sizeof *begin));
    CLX_TRY(clx_alloc(&item, s->n_pool, sizeof *item));
    CLX_TRY(clx_alloc(&x, s->n_pool * d, sizeof *x));
    for (int64_t i = 0; i < s->n_pool; ++i) {
        ++begin[cell_of(s->pool + i * d, d) + 2];
    }
    for (int c = 1; c <= n_cell; ++c) {
        begin[c + 1] += begin[c];
    }
    for (int64_t i = 0; i < s->n_pool; ++i) {
        const int64_t m = begin[cell_of(s->pool + i * d, d) + 1]++;
        item[m] = i;
        memcpy(x + m * d, s->pool + i * d, (size_t)d * sizeof *x);
    }
    for (int64_t i = 0; i < s->n_pool; ++i) {
        const int64_t own = cell_of(x + i * d, d);
        double others = 0.0;
        for (int k = 0; k < (d == 2 ? 9 : 27); ++k) {
            const int64_t c = beside(own, d, k);
            for (int64_t m = is_both || begin[c] > i ? begin[c] : i + 1; m < begin[c + 1]; ++m) {
                others += m == i ? 0.0 : met(s, x + i * d, x + m * d, item[i], item[m]);
            }
        }
        sum += (is_both ? 1.0 : 2.0) * others + met(s, x + i * d, x + i * d, item[i], item[i]);
    }
    const double inside = count_inside(s);
    *integral = sum * pow(4.0 * CLAST_PI * s->density->size * s->density->size, -0.5 * d) /
                (inside * inside);
done:
    clx_free(begin);
    clx_free(item);
    clx_free(x);
    return status;
}

static clast_status make_pool(density_scene *s)
{
    clast_status status = CLAST_OK;
    flow_mode mode[N_MODE] = {{{0}, {0}, 0.0}};
    const int32_t d = s->dimension;
    make_flow(d, mode);
    CLX_TRY(clx_alloc(&s->pool, (int64_t)N_POOL * d, sizeof *s->pool));
    s->n_pool = N_POOL;
    for (int64_t i = 0; i < N_POOL; ++i) {
        clx_rng rng = clx_rng_at(6, CLX_STREAM_TEST, (uint64_t)i);
        for (int32_t j = 0; j < d; ++j) {
            s->pool[i * d + j] = clx_rng_uniform(&rng);
        }
        advect(mode, d, s->pool + i * d);
    }
    CLX_TRY(pool_integral(s, &s->integral));
done:
    return status;
}

/// The turned cube as 12 triangles.
static clast_status make_surface(clast_domain *domain)
{
    static const int32_t side[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1},
                                       {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
    double vert[8][3];
    int32_t tri[12][3];
    for (int v = 0; v < 8; ++v) {
        for (int j = 0; j < 3; ++j) {
            vert[v][j] = 0.0;
            for (int k = 0; k < 3; ++k) {
                vert[v][j] += turn[k][j] * ((v >> (2 - k) & 1) - 0.5);
            }
        }
    }
    for (int f = 0; f < 12; ++f) {
        const int32_t *q = side[f / 2];
        const int32_t t[3] = {q[0], q[f % 2 == 0 ? 1 : 2], q[f % 2 == 0 ? 2 : 3]};
        memcpy(tri[f], t, sizeof t);
    }
    const clast_mesh mesh = {.n_vert = 8, .n_tri = 12, .vert = vert, .tri = tri};
    return clast_domain_of_mesh(&mesh, 1.0, domain);
}

clast_status density_scene_make(const density *law, density_place place, int32_t dimension,
                                density_scene *scene)
{
    clast_status status = CLAST_OK;
    density_scene made = {.density = law, .place = place, .dimension = dimension};
    if (place == PLACE_SURFACE) {
        CLX_TRY(make_surface(&made.domain));
    } else {
        CLX_TRY(clast_domain_parse(place == PLACE_CYLINDER ? "cylinder:0.5,1"
                                   : dimension == 2        ? "box:0,0,1,1"
                                                           : "box:0,0,0,1,1,1",
                                   &made.domain));
    }
    const double volume = clast_domain_volume(&made.domain);
    const double s = law->share;
    if (law->law == LAW_INERTIA) {
        CLX_TRY(make_pool(&made));
    } else {
        made.integral = (1.0 - s) * (1.0 + s) / volume + s * s * law_integral(&made, volume);
    }
    *scene = made;
    made = (density_scene){0};
done:
    density_scene_free(&made);
    return status;
}

void density_scene_free(density_scene *scene)
{
    clast_domain_free(&scene->domain);
    clx_free(scene->pool);
    *scene = (density_scene){0};
}

clast_status density_scene_draw(const density_scene *scene, double mean_n, uint64_t seed,
                                clast_cloud *cloud)
{
    clx_rng number = clx_rng_at(seed, CLX_STREAM_TEST, UINT64_MAX);
    const clast_status status =
        clast_cloud_alloc(clx_rng_poisson(&number, mean_n), scene->dimension, cloud);
    for (int64_t i = 0; i < cloud->n && status == CLAST_OK; ++i) {
        clx_rng rng = clx_rng_at(seed, CLX_STREAM_TEST, (uint64_t)i);
        double x[3];
        draw_point(&rng, scene, x);
        memcpy(cloud->x + i * scene->dimension, x, (size_t)scene->dimension * sizeof *x);
    }
    return status;
}
