// Envelopes of an assembly by name: hulls, spheres, published rays.
#include <clast/assembly.h>

#include "assembly/alpha.h"
#include "assembly/hull_part.h"
#include "assembly/sphere_rays.h"
#include "assembly/whole.h"
#include "assembly/wrap.h"
#include "base/status.h"
#include <math.h>
#include <string.h>

clast_envelope_options clast_envelope_options_default(void)
{
    return (clast_envelope_options){.tolerance = 1e-3, .n_ray = 10000, .seed = 1, .n_cell = 128};
}

const char *clast_envelope_name(clast_envelope_kind kind)
{
#define NAME(kind, name, text) name,
    static const char *const names[] = {CLAST_ENVELOPE_LIST(NAME)};
#undef NAME
    return (unsigned)kind < CLAST_N_ENVELOPE ? names[kind] : "unknown";
}

const char *clast_envelope_text(clast_envelope_kind kind)
{
#define TEXT(kind, name, text) text,
    static const char *const texts[] = {CLAST_ENVELOPE_LIST(TEXT)};
#undef TEXT
    return (unsigned)kind < CLAST_N_ENVELOPE ? texts[kind] : "unknown";
}

clast_status clast_envelope_parse(const char *name, clast_envelope_kind *kind)
{
    CLX_ARGUMENTS(name, kind);
#define NAME(kind, name, text) " " name
    static const char all[] = CLAST_ENVELOPE_LIST(NAME);
#undef NAME
    for (int k = 0; k < CLAST_N_ENVELOPE; ++k) {
        if (strcmp(name, clast_envelope_name((clast_envelope_kind)k)) == 0) {
            *kind = (clast_envelope_kind)k;
            return CLAST_OK;
        }
    }
    return clx_fail(CLAST_E_CONFIG, "no envelope is called '%s'; there are:%s", name, all);
}

static double sphere_volume(double radius)
{
    CLAST_ASSERT(!(radius < 0.0));
    return 4.0 / 3.0 * CLAST_PI * radius * radius * radius;
}

/// Fills in a value with a relative error and bounds from it.
static clast_envelope measured(clast_envelope_kind kind, double volume, double relative_error)
{
    const double error = volume * relative_error;
    return (clast_envelope){kind, volume, error, volume - error, volume + error};
}

clast_envelope clx_envelope_of_hull(clast_envelope_kind kind, const clx_hull_volume *volume)
{
    return (clast_envelope){kind, volume->value, volume->error, volume->low, volume->high};
}

/// Refines until the closed form is found twice, at bounds four times apart, and agrees.
static clast_status settle_hull(clx_smooth_hull *hull, double tolerance, clx_hull_volume *volume)
{
    clast_status status = CLAST_OK;
    clx_hull_volume before = {0};
    double finer = tolerance;
    CLX_TRY(clx_smooth_hull_refine(hull, tolerance));
    CLX_TRY(clx_smooth_hull_exact(hull, volume));
    for (int pass = 0; pass < 4 && hull->gap > 0.0; ++pass) {
        before = *volume;
        finer *= 0.25;
        CLX_TRY(clx_smooth_hull_refine(hull, finer));
        CLX_TRY(clx_smooth_hull_exact(hull, volume));
        if (before.is_exact && volume->is_exact) {
            const double moved = fabs(volume->value - before.value);
            volume->error = fmax(volume->error, moved);
            if (moved <= 1e-9 * volume->value) {
                break;
            }
        }
    }
done:
    return status;
}

static clast_status hull_envelope(const clast_assembly *assembly, clast_envelope_kind kind,
                                  double tolerance, clast_envelope *envelope)
{
    clast_status status = CLAST_OK;
    clx_hull_parts parts = {.of_spheres = kind == CLAST_ENVELOPE_SPHERE_HULL};
    clx_smooth_hull hull = {0};
    clx_hull_volume volume;
    CLX_CHECK(assembly->n_grain > 0, CLAST_E_USAGE, "no grain to enclose");
    CLX_TRY(clx_hull_parts_add_all(&parts, assembly, &hull));
    CLX_TRY(settle_hull(&hull, tolerance, &volume));
    *envelope = clx_envelope_of_hull(kind, &volume);
done:
    clx_hull_parts_free(&parts);
    clx_smooth_hull_free(&hull);
    return status;
}

double clast_assembly_radius_of_gyration(const clast_assembly *assembly)
{
    if (clx_assembly_fault(assembly) != NULL) {
        return (double)NAN;
    }
    double centre[3];
    double mass = 0.0;
    double sum = 0.0;
    clast_assembly_centre(assembly, centre);
    for (int32_t i = 0; i < assembly->n_grain; ++i) {
        const clast_shape *shape = &assembly->shape[assembly->shape_id[i]];
        const double s = assembly->scale[i];
        const double m = assembly->density[i] * s * s * s * shape->volume;
        const double trace = shape->inertia[0][0] + shape->inertia[1][1] + shape->inertia[2][2];
        mass += m;
        sum += m * v3_distance2(assembly->position[i], centre) +
               assembly->density[i] * s * s * s * s * s * 0.5 * trace;
    }
    return mass > 0.0 ? sqrt(sum / mass) : 0.0;
}

clast_status clast_assembly_envelope(const clast_assembly *assembly, clast_envelope_kind kind,
                                     const clast_envelope_options *options,
                                     clast_envelope *envelope)
{
    CLX_ARGUMENTS(assembly, options, envelope);
    CLX_WHOLE(assembly, assembly);
    clast_status status = CLAST_OK;
    double centre[3];
    double radius = 0.0;
    CLX_CHECK(
        options->tolerance >= 0.0 && options->length >= 0.0 &&
            isfinite(options->tolerance + options->length),
        CLAST_E_ARGUMENT,
        "envelope: a tolerance of %g and a length of %g; both must be finite and not negative",
        options->tolerance, options->length);
    CLX_CHECK(options->tolerance > 0.0 ||
                  (kind != CLAST_ENVELOPE_SURFACE_HULL && kind != CLAST_ENVELOPE_SPHERE_HULL),
              CLAST_E_ARGUMENT, "envelope: a hull needs a tolerance above 0");
    CLX_CHECK(assembly->n_grain > 0, CLAST_E_USAGE, "no grain to enclose");
    switch (kind) {
    case CLAST_ENVELOPE_SURFACE_HULL:
    case CLAST_ENVELOPE_SPHERE_HULL:
        CLX_TRY(hull_envelope(assembly, kind, options->tolerance, envelope));
        break;
    case CLAST_ENVELOPE_SPHERE_RAYS:
        CLX_TRY(clx_envelope_sphere_rays(assembly, options, envelope));
        break;
    case CLAST_ENVELOPE_WRAP:
        CLX_TRY(clx_envelope_wrap(assembly, options, envelope));
        break;
    case CLAST_ENVELOPE_ALPHA:
        CLX_TRY(clx_envelope_alpha(assembly, options, envelope));
        break;
    case CLAST_ENVELOPE_ENCLOSING_SPHERE:
        CLX_TRY(clast_assembly_enclosing_sphere(assembly, centre, &radius));
        *envelope = measured(kind, sphere_volume(radius), 3e-12);
        break;
    case CLAST_ENVELOPE_GYRATION_SPHERE:
        radius = sqrt(5.0 / 3.0) * clast_assembly_radius_of_gyration(assembly);
        *envelope = measured(kind, sphere_volume(radius), 1e-14);
        break;
    default:
        status = clx_fail(CLAST_E_USAGE, "envelope %d does not exist", (int)kind);
    }
done:
    return status;
}
