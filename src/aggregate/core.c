// The core: where it lies, whether its centre is inside it, and what it may meet.
#include "aggregate/state.h"

#include "base/alloc.h"
#include "math/vec3.h"
#include <clast/mesh.h>
#include <string.h>

/// The smallest core that a particle may meet, by length.
static const double CORE_SMALLEST = 1e-6;

/// Does the point lie in the solid of this shape (its own frame)?
static clast_status shape_holds(const clast_shape *shape, const double point[3], bool *holds)
{
    clast_status status = CLAST_OK;
    clast_bvh *bvh = NULL;
    *holds = false;
    if (shape->kind == CLAST_SHAPE_MESH) {
        CLX_TRY(clast_bvh_create(&shape->mesh, &bvh));
        *holds = clast_bvh_inside(bvh, point);
    } else if (shape->kind == CLAST_SHAPE_CLUMP) {
        for (int32_t i = 0; i < shape->spheres.n && !*holds; ++i) {
            *holds = v3_distance(point, shape->spheres.centre[i]) <= shape->spheres.radius[i];
        }
    } else {
        double sum = 0.0;
        for (int k = 0; k < 3; ++k) {
            const double x = point[k] / shape->semi_axes[shape->kind == CLAST_SHAPE_SPHERE ? 0 : k];
            sum += x * x;
        }
        *holds = sum <= 1.0;
    }
done:
    clast_bvh_destroy(bvh);
    return status;
}

/// AUTO: from the core's centre, or from random grains when that lies outside the core.
static clast_status resolve_origin(clast_aggregate *a)
{
    clast_status status = CLAST_OK;
    bool holds = false;
    a->origin = a->params->origin;
    if (a->origin != CLAST_ORIGIN_AUTO) {
        return CLAST_OK;
    }
    for (int32_t i = 0; i < a->n_core && !holds; ++i) {
        double m[3][3], to[3], point[3];
        q_matrix(m, a->assembly.orientation[i]);
        v3_scale(to, -1.0 / a->assembly.scale[i], a->assembly.position[i]);
        m3_to_local(point, m, to);
        CLX_TRY(shape_holds(&a->assembly.shape[a->assembly.shape_id[i]], point, &holds));
    }
    a->origin = holds ? CLAST_ORIGIN_CORE : CLAST_ORIGIN_GRAIN;
done:
    return status;
}

static const double UNTURNED[4] = {1.0, 0.0, 0.0, 0.0};

/// The core's centre of mass at the origin.
static clast_status core_by_mass(clast_aggregate *a, double scale)
{
    const double none[3] = {0.0, 0.0, 0.0};
    return clx_aggregate_add_group(a, 0, none, UNTURNED, scale);
}

/// The centroid of the core's spheres at the origin, scaled by its sampled length.
static clast_status core_by_spheres(clast_aggregate *a)
{
    const clx_march_shape *core = &a->march.shape[0];
    const clx_template *group = &a->templates.group[0];
    double centre[3];
    const double scale = a->params->core_size > 0.0
                             ? a->params->core_size * core->ratio / core->length
                             : group->part[0].scale;
    v3_scale(centre, -scale, core->centroid);
    return clx_aggregate_add_group(a, 0, centre, UNTURNED, scale / group->part[0].scale);
}

static clast_status place_core(clast_aggregate *a)
{
    clast_status status = CLAST_OK;
    const clast_aggregate_params *c = a->params;
    double *row = NULL;
    const double own = clx_template_size(&a->templates.group[0], c->core_meaning);
    const double scale = c->core_size > 0.0 ? c->core_size / own : 1.0;
    CLX_CHECK(c->core_size > 0.0 || strcmp(a->input->core->unit, "m") == 0, CLAST_E_CONFIG,
              "core_size: %s",
              a->input->core->shape[0].kind == CLAST_SHAPE_MESH ||
                      a->input->core->shape[0].kind == CLAST_SHAPE_CLUMP
                  ? "the core's file has no unit; give core_size, or unit"
                  : "sphere and ellipsoid have no size of their own; give core_size");
    CLX_TRY(c->contact == CLAST_CONTACT_MARCH ? core_by_spheres(a) : core_by_mass(a, scale));
    a->n_core = a->assembly.n_grain;
    CLX_TRY(clx_aggregate_add_row(a, &row));
    row[CLX_HISTORY_SIZE] = own * scale;
    CLX_TRY(resolve_origin(a));
done:
    return status;
}

/// Refuses cores that are too small and masses that cannot be reached.
static clast_status check_sizes(const clast_aggregate *a)
{
    clast_status status = CLAST_OK;
    const double core_length =
        a->templates.group[0].length * a->assembly.scale[0] / a->templates.group[0].part[0].scale;
    double mass = a->mass;
    for (int32_t i = 0; i < a->n_particle; ++i) {
        const int32_t shape = clx_aggregate_shape(a, i);
        const clx_template *group = &a->templates.group[1 + shape];
        const double scale = clx_aggregate_scale(a, i, shape);
        const double length = scale * group->length;
        CLX_CHECK(core_length >= CORE_SMALLEST * length, CLAST_E_CONFIG,
                  "core_size: the core's length %s is below 1e-6 of particle %d, %s long; are the "
                  "units right?",
                  clx_unit_text(core_length, "m"), i + 1, clx_unit_text(length, "m"));
        mass += group->mass * scale * scale * scale;
    }
    CLX_CHECK(a->params->stop_mass <= mass, CLAST_E_CONFIG,
              "stop_mass: %s is more than core and all %d particles weigh, %s; raise replicate or "
              "lower stop_mass",
              clx_unit_text(a->params->stop_mass, "kg"), a->n_particle, clx_unit_text(mass, "kg"));
    CLX_CHECK(a->params->stop_mass == 0.0 || a->params->stop_mass > a->mass, CLAST_E_CONFIG,
              "stop_mass: the core alone weighs %s, not below %s", clx_unit_text(a->mass, "kg"),
              clx_unit_text(a->params->stop_mass, "kg"));
done:
    return status;
}

/// Refuses a size or porosity that the core, measured in its row, has: growth would stop at once.
static clast_status check_stop(const clast_aggregate *a)
{
    clast_status status = CLAST_OK;
    const double *core = &a->history.value[CLX_HISTORY_FIXED];
    const double size = a->params->stop_size;
    const double porosity = a->params->stop_porosity;
    CLX_CHECK(size == 0.0 || size > core[0], CLAST_E_CONFIG,
              "stop_size: the core alone has a d_agg of %s, not below %s",
              clx_unit_text(core[0], "m"), clx_unit_text(size, "m"));
    CLX_CHECK(porosity == 0.0 || porosity > core[2], CLAST_E_CONFIG,
              "stop_porosity: the core alone has a porosity of %.3g, not below %.3g", core[2],
              porosity);
done:
    return status;
}

clast_status clx_aggregate_begin_core(clast_aggregate *a)
{
    CLAST_ASSERT(a->assembly.n_grain == 0 && a->n_placed == 0);
    clast_status status = place_core(a);
    status = status == CLAST_OK ? check_sizes(a) : status;
    return status == CLAST_OK ? check_stop(a) : status;
}

clx_measured clx_aggregate_measured_core(const clast_aggregate *a)
{
    return (clx_measured){.n_grain = a->assembly.n_grain,
                          .n_contact = a->assembly.n_contact,
                          .n_cluster = 1,
                          .mass = a->mass,
                          .volume = a->volume,
                          .gyration = clx_aggregate_gyration(a)};
}

/// Grains that the core and the placed particles have together.
static int64_t count_grains(const clast_aggregate *a)
{
    int64_t n = a->templates.group[0].n_part;
    for (int64_t r = 1; r < a->history.n_row; ++r) {
        const double shape = a->history.value[r * a->history.n_column + CLX_HISTORY_SHAPE];
        if (!(shape >= 0.0 && shape < a->templates.n_group - 1)) {
            return -1;
        }
        n += a->templates.group[1 + (int32_t)shape].n_part;
    }
    return n;
}

clast_status clx_aggregate_restore_core(clast_aggregate *a, const clast_aggregate_saved *saved)
{
    clast_status status = CLAST_OK;
    const clast_assembly *placed = saved->placed;
    a->n_core = a->templates.group[0].n_part;
    a->n_placed = (int32_t)a->history.n_row - 1;
    CLX_CHECK(a->history.n_row >= 1 && a->n_placed <= a->n_step &&
                  count_grains(a) == placed->n_grain,
              CLAST_E_FORMAT, "%lld saved rows and %d saved grains do not belong together",
              (long long)a->history.n_row, placed->n_grain);
    CLX_TRY(clx_aggregate_copy_grains(a, placed));
    CLX_TRY(resolve_origin(a));
done:
    return status;
}
