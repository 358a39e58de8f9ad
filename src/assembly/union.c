// Volume of the union of placed grains, and by how much they overlap.
//
// Pairs come from the contact search; grains of no overlapping pair add their own volume. The
// others are summed in closed form when all are spheres or clumps, else sampled: a point x drawn
// uniformly in grain i counts 1/k(x), k the number of grains that hold it, so that every point of
// the union counts 1 in all. Points are a lattice of irrational steps [the generalised golden
// ratio], shifted at random eight times; the shifts' spread is the error. Where no point of a grain
// is in another its term is exact, so the noise is that of the overlaps alone.
#include <clast/assembly.h>

#include "assembly/grain_points.h"
#include "assembly/touch_set.h"
#include "assembly/union.h"
#include "assembly/whole.h"
#include "base/alloc.h"
#include "base/parallel.h"
#include "base/status.h"
#include "math/rng.h"
#include "math/vec3.h"
#include "shape/shape.h"
#include "touch/gap.h"
#include <clast/mesh.h>
#include <clast/shape.h>

enum { N_SHIFT = 8, FIRST_POINTS = 256, BISECTIONS = 24, PAIR_BLOCK = 64 };
static const double touching = 1e-9; // depth by radius that counts as a touch, not an overlap

/// A grain of an overlapping pair.
typedef struct member {
    int32_t grain;
    int32_t first, n;   ///< its partners in `partner`
    double mean, error; ///< of 1 / k
} member;

typedef struct group {
    const clast_assembly *assembly;
    const clx_touch_set *set;
    int32_t n;
    member *member;   ///< [n] in rising order of grains
    int32_t *partner; ///< grains
    int32_t n_point;  ///< per shift
    uint64_t seed;
} group;

clast_union_options clast_union_options_default(void)
{
    return (clast_union_options){
        .tolerance = 1e-4, .n_sample = 1 << 24, .seed = 1, .find_depth = true};
}

/// Radius of the sphere of equal volume.
static double grain_radius(const clast_assembly *a, int32_t i)
{
    return cbrt(0.75 / CLAST_PI * clx_grain_volume(a, i));
}

/// Mean of 1 / k over one shifted lattice of points in a grain.
static double shifted_mean(const group *g, const member *m, int shift)
{
    CLAST_ASSERT(shift >= 0 && shift < N_SHIFT && g->n_point > 0);
    const clx_touch_body *body = clx_touch_scene_body(g->set->scene, m->grain);
    clx_rng rng =
        clx_rng_at(g->seed, CLX_STREAM_UNION, (uint64_t)m->grain * N_SHIFT + (unsigned)shift);
    double c[3] = {clx_rng_uniform(&rng), clx_rng_uniform(&rng), clx_rng_uniform(&rng)};
    double sum = 0.0;
    int32_t n = 0;
    for (int32_t i = 0; i < g->n_point; ++i) {
        double x[3];
        clx_lattice_step(c);
        if (!clx_body_draw(body, c, x)) {
            continue;
        }
        int32_t held = 1;
        for (int32_t k = 0; k < m->n; ++k) {
            held +=
                clx_body_holds(clx_touch_scene_body(g->set->scene, g->partner[m->first + k]), x);
        }
        sum += 1.0 / held;
        ++n;
    }
    return n > 0 ? sum / n : 1.0;
}

static void sample_members(int64_t begin, int64_t end, int32_t worker, void *context)
{
    group *g = context;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        member *m = &g->member[i];
        double sum = 0.0;
        double squares = 0.0;
        for (int shift = 0; shift < N_SHIFT; ++shift) {
            const double mean = shifted_mean(g, m, shift);
            sum += mean;
            squares += mean * mean;
        }
        m->mean = sum / N_SHIFT;
        m->error = sqrt(fmax(0.0, squares / N_SHIFT - m->mean * m->mean) / (N_SHIFT - 1));
    }
}

/// Samples with twice the points each round until the error is small or the budget used up.
static void sample_group(group *g, const clast_union_options *options, double rest, double *volume,
                         double *error)
{
    for (g->n_point = FIRST_POINTS;; g->n_point *= 2) {
        double sum = 0.0;
        double variance = 0.0;
        clx_parallel_for(g->n, 1, sample_members, g);
        for (int32_t i = 0; i < g->n; ++i) {
            const double v = clx_grain_volume(g->assembly, g->member[i].grain);
            sum += v * g->member[i].mean;
            variance += v * g->member[i].error * v * g->member[i].error;
        }
        *volume = sum;
        *error = sqrt(variance);
        const int64_t next = (int64_t)g->n_point * 2 * N_SHIFT * g->n;
        if (*error <= options->tolerance * (rest + sum) || next > options->n_sample ||
            g->n_point > INT32_MAX / 4) {
            break;
        }
    }
}

static bool is_of_spheres(const clast_assembly *a, int32_t i)
{
    const clast_shape_kind kind = a->shape[a->shape_id[i]].kind;
    return kind == CLAST_SHAPE_SPHERE || kind == CLAST_SHAPE_CLUMP;
}

/// Union of a group of spheres and clumps in closed form.
static clast_status sum_spheres(const group *g, double *volume)
{
    clast_status status = CLAST_OK;
    clast_spheres all = {0};
    clast_mass mass;
    const clast_assembly *a = g->assembly;
    int32_t n = 0;
    for (int32_t i = 0; i < g->n; ++i) {
        const clast_shape *shape = &a->shape[a->shape_id[g->member[i].grain]];
        n += shape->kind == CLAST_SHAPE_SPHERE ? 1 : shape->spheres.n;
    }
    CLX_TRY(clast_spheres_alloc(n, &all));
    n = 0;
    for (int32_t i = 0; i < g->n; ++i) {
        const int32_t grain = g->member[i].grain;
        const clast_shape *shape = &a->shape[a->shape_id[grain]];
        const bool one = shape->kind == CLAST_SHAPE_SPHERE;
        for (int32_t k = 0; k < (one ? 1 : shape->spheres.n); ++k) {
            static const double origin[3] = {0.0, 0.0, 0.0};
            double at[3];
            q_rotate(at, a->orientation[grain], one ? origin : shape->spheres.centre[k]);
            v3_axpy(all.centre[n], a->position[grain], a->scale[grain], at);
            all.radius[n++] =
                a->scale[grain] * (one ? shape->semi_axes[0] : shape->spheres.radius[k]);
        }
    }
    CLX_TRY(clx_spheres_union_mass(&all, &mass));
    *volume = mass.volume;
done:
    clast_spheres_free(&all);
    return status;
}

/// Depth of an overlap: exact for round pairs, else the least shift found that parts them, by
/// halving to 1e-3 of it, which takes some twenty tests; any value above `least` where the depth is
/// not above `known`.
static double overlap_depth(const clx_touch_body *a, const clx_touch_body *b, double least,
                            double known)
{
    CLAST_ASSERT(least >= 0.0);
    clx_gap gap;
    if (!clx_touch_gap(a, b, 0.0, &gap)) {
        return 0.0;
    }
    if (a->tree == NULL && b->tree == NULL) {
        return -gap.distance;
    }
    if (!clx_touch_overlap(a, b, least, NULL)) {
        return 0.0;
    }
    if (isinf(known) || (known > least && !clx_touch_overlap(a, b, known, NULL))) {
        return 2.0 * least;
    }
    double low = least;
    double high = a->radius + b->radius + v3_distance(a->position, b->position);
    for (int i = 0; i < BISECTIONS && high > 1.001 * low; ++i) {
        const double middle = low > 1e-3 * high ? 0.5 * (low + high) : sqrt(low * high);
        *(clx_touch_overlap(a, b, middle, NULL) ? &low : &high) = middle;
    }
    return high;
}

/// Pairs as workers see them.
typedef struct {
    const clast_assembly *assembly;
    const clx_touch_set *set;
    const clx_pairs *pairs;
    bool wanted;   ///< the depths themselves
    double *depth; ///< [pairs->n]
} depth_job;

static double smaller_radius(const clast_assembly *a, const int32_t pair[2])
{
    CLAST_ASSERT(pair[0] >= 0 && pair[0] < pair[1] && pair[1] < a->n_grain);
    return fmin(grain_radius(a, pair[0]), grain_radius(a, pair[1]));
}

static void find_depths(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const depth_job *job = context;
    (void)worker;
    for (int64_t b = begin; b < end; ++b) {
        // the deepest of this block alone, so that threads change nothing
        double known = job->wanted ? 0.0 : (double)INFINITY;
        for (int64_t p = b * PAIR_BLOCK; p < (b + 1) * PAIR_BLOCK && p < job->pairs->n; ++p) {
            const int32_t *pair = job->pairs->pair[p];
            job->depth[p] = overlap_depth(clx_touch_scene_body(job->set->scene, pair[0]),
                                          clx_touch_scene_body(job->set->scene, pair[1]),
                                          touching * smaller_radius(job->assembly, pair), known);
            known = fmax(known, job->depth[p]);
        }
    }
}

clast_status clx_keep_overlaps(const clast_assembly *assembly, const clx_touch_set *set,
                               bool find_depth, clx_pairs *pairs, clast_union *out)
{
    clast_status status = CLAST_OK;
    depth_job job = {assembly, set, pairs, find_depth, NULL};
    int32_t n = 0;
    CLX_TRY(clx_alloc(&job.depth, pairs->n, sizeof *job.depth));
    clx_parallel_for((pairs->n + PAIR_BLOCK - 1) / PAIR_BLOCK, 1, find_depths, &job);
    for (int32_t p = 0; p < pairs->n; ++p) {
        const double radius = smaller_radius(assembly, pairs->pair[p]);
        if (job.depth[p] > touching * radius) {
            out->max_overlap = fmax(out->max_overlap, job.depth[p]);
            out->max_overlap_share = fmax(out->max_overlap_share, job.depth[p] / radius);
            pairs->pair[n][0] = pairs->pair[p][0];
            pairs->pair[n++][1] = pairs->pair[p][1];
        }
    }
    if (n > 0 && !find_depth) {
        out->max_overlap = (double)NAN;
        out->max_overlap_share = (double)NAN;
    }
    pairs->n = n;
    out->n_overlap = n;
done:
    clx_free(job.depth);
    return status;
}

/// Lists each overlapping grain with its partners.
static clast_status make_group(const clx_pairs *pairs, group *g)
{
    clast_status status = CLAST_OK;
    const int32_t n_grain = g->assembly->n_grain;
    int32_t *count = NULL;
    int32_t total = 0;
    CLX_TRY(clx_alloc(&count, n_grain, sizeof *count));
    for (int32_t p = 0; p < pairs->n; ++p) {
        ++count[pairs->pair[p][0]];
        ++count[pairs->pair[p][1]];
    }
    for (int32_t i = 0; i < n_grain; ++i) {
        g->n += count[i] > 0;
    }
    CLX_TRY(clx_alloc(&g->member, g->n, sizeof *g->member));
    CLX_TRY(clx_alloc(&g->partner, 2 * (int64_t)pairs->n, sizeof *g->partner));
    for (int32_t i = 0, m = 0; i < n_grain; ++i) {
        if (count[i] > 0) {
            g->member[m] = (member){.grain = i, .first = total};
            total += count[i];
            count[i] = m++;
        }
    }
    for (int32_t p = 0; p < pairs->n; ++p) {
        member *a = &g->member[count[pairs->pair[p][0]]];
        member *b = &g->member[count[pairs->pair[p][1]]];
        g->partner[a->first + a->n++] = b->grain;
        g->partner[b->first + b->n++] = a->grain;
    }
done:
    clx_free(count);
    return status;
}

static void group_free(group *g)
{
    CLX_FREE(g->member, g->partner);
    *g = (group){0};
}

/// Adds the overlapping grains to the volume of the others.
static clast_status add_group(group *g, const clast_union_options *options, clast_union *out)
{
    clast_status status = CLAST_OK;
    double volume = 0.0;
    bool all_spheres = true;
    out->volume = out->sum;
    for (int32_t i = 0; i < g->n; ++i) {
        out->volume -= clx_grain_volume(g->assembly, g->member[i].grain);
        all_spheres = all_spheres && is_of_spheres(g->assembly, g->member[i].grain);
    }
    if (all_spheres) {
        CLX_TRY(sum_spheres(g, &volume));
    } else {
        out->is_exact = false;
        sample_group(g, options, out->volume, &volume, &out->error);
    }
    out->volume += volume;
done:
    return status;
}

static clast_status union_of(const clast_assembly *assembly, const clx_touch_set *set,
                             const clast_union_options *options, clast_union *out)
{
    clast_status status = CLAST_OK;
    clx_pairs pairs = {0};
    group g = {.assembly = assembly, .set = set, .seed = options->seed};
    clast_union made = {.is_exact = true};
    CLX_TRY(clx_touch_set_near(set, &pairs));
    made.sum = clast_assembly_volume(assembly);
    made.volume = made.sum;
    CLX_TRY(clx_keep_overlaps(assembly, set, options->find_depth, &pairs, &made));
    if (pairs.n > 0) {
        CLX_TRY(make_group(&pairs, &g));
        CLX_TRY(add_group(&g, options, &made));
    }
    *out = made;
done:
    group_free(&g);
    clx_pairs_free(&pairs);
    return status;
}

clast_status clx_union_of_scene(const clast_assembly *assembly, clx_touch_scene *scene,
                                const clast_union_options *options, clast_union *out)
{
    const clx_touch_set borrowed = {.scene = scene};
    CLAST_ASSERT(clx_touch_scene_count(scene) == assembly->n_grain);
    return union_of(assembly, &borrowed, options, out);
}

clast_status clast_assembly_union(const clast_assembly *assembly,
                                  const clast_union_options *options, clast_union *out)
{
    CLX_ARGUMENTS(assembly, options, out);
    CLX_WHOLE(assembly, assembly);
    clast_status status = CLAST_OK;
    clx_touch_set set = {0};
    CLX_CHECK(options->tolerance >= 0.0, CLAST_E_ARGUMENT,
              "union: a tolerance of %g; it must not be negative", options->tolerance);
    CLX_CHECK(assembly->n_grain > 0, CLAST_E_USAGE, "no grain to measure");
    CLX_TRY(clx_touch_set_init(assembly, &set));
    CLX_TRY(union_of(assembly, &set, options, out));
done:
    clx_touch_set_free(&set);
    return status;
}

void clx_contacts_replace(clast_assembly *assembly, clast_assembly *made)
{
    CLAST_ASSERT(assembly->n_grain == made->n_grain);
    CLX_FREE(assembly->contact, assembly->contact_point);
    assembly->contact = made->contact;
    assembly->contact_point = made->contact_point;
    assembly->n_contact = made->n_contact;
    assembly->contact_capacity = made->contact_capacity;
    made->contact = NULL;
    made->contact_point = NULL;
}

clast_status clast_assembly_find_contacts(clast_assembly *assembly, double gap)
{
    CLX_ARGUMENTS(assembly);
    CLX_WHOLE(assembly, assembly);
    clast_status status = CLAST_OK;
    clx_touch_set set = {0};
    clx_pairs pairs = {0};
    clast_assembly made = {.n_grain = assembly->n_grain}; // carries the contacts only
    CLX_CHECK(gap >= 0.0 && isfinite(gap), CLAST_E_USAGE,
              "contacts: gap %g must be finite and not negative", gap);
    CLX_TRY(clx_touch_set_init(assembly, &set));
    CLX_TRY(clx_touch_set_within(&set, gap, &pairs));
    for (int32_t p = 0; p < pairs.n; ++p) {
        CLX_TRY(
            clast_assembly_add_contact(&made, pairs.pair[p][0], pairs.pair[p][1], pairs.point[p]));
    }
    if (pairs.n == 0) { // known to be none
        CLX_TRY(clx_alloc(&made.contact, 1, sizeof *made.contact));
        CLX_TRY(clx_alloc(&made.contact_point, 1, sizeof *made.contact_point));
        made.contact_capacity = 1;
    }
    clx_contacts_replace(assembly, &made);
done:
    CLX_FREE(made.contact, made.contact_point);
    clx_pairs_free(&pairs);
    clx_touch_set_free(&set);
    return status;
}
