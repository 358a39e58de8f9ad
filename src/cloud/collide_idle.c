// Which keys of a configuration change anything: a parameter that the kernels, their ranges and the
// law of sticking do not look at is a mistake of the person who gives it.
#include <clast/agglomerate.h>

#include <string.h>

#define KERNEL(name)   (1U << CLAST_KERNEL_##name)
#define STICKING(name) (1U << CLAST_STICKING_##name)

// Kernels that do not overlap, so that sums of them name each once.
#define CONTINUUM (KERNEL(BROWNIAN) | KERNEL(BROWNIAN_TRANSITION))
#define DIFFUSES  (CONTINUUM | KERNEL(BROWNIAN_FREE))
#define FALLS     (KERNEL(SETTLING) | KERNEL(CLOUD_TURBULENCE))
#define SWIRLS    (KERNEL(INERTIAL) | KERNEL(CLOUD_TURBULENCE))
#define FLOWS     (KERNEL(SHEAR_LAMINAR) | KERNEL(SHEAR_TURBULENT) | KERNEL(INERTIAL) | FALLS)
#define RESPONDS  (FLOWS | KERNEL(BALLISTIC)) // by a response time

/// By kernels, and by laws of sticking.
static const struct {
    const char *key;
    uint32_t kernels, laws;
} use[] = {
    {"constant", KERNEL(CONSTANT), 0},
    {"additive", KERNEL(ADDITIVE), 0},
    {"product", KERNEL(PRODUCT), 0},
    {"temperature", DIFFUSES | KERNEL(SETTLING), 0},
    {"viscosity", CONTINUUM | RESPONDS, 0},
    {"density", CONTINUUM | FLOWS, 0},
    {"mean_free_path", DIFFUSES | RESPONDS, 0},
    {"shear", KERNEL(SHEAR_LAMINAR), 0},
    {"shear_constant", KERNEL(SHEAR_TURBULENT), 0},
    {"dissipation", KERNEL(SHEAR_TURBULENT) | SWIRLS, 0},
    {"speed_rms", SWIRLS, 0},
    {"gravity", FALLS, 0},
    {"efficiency", KERNEL(SETTLING), 0},
    {"settling_law", FALLS, 0},
    {"film_viscosity", 0, STICKING(VISCOUS) | STICKING(LIQUID)},
    {"film_thickness", 0, STICKING(VISCOUS)},
    {"asperity", 0, STICKING(VISCOUS)},
    {"restitution", 0, STICKING(VISCOUS)},
    {"critical_stokes", 0, STICKING(LIQUID)},
    {"stokes_exponent", 0, STICKING(LIQUID)},
    {"adhesion", 0, STICKING(CONTACT)},
    {"young", 0, STICKING(CONTACT)},
    {"poisson", 0, STICKING(CONTACT)},
};

static const char *const fractal[] = {"fractal_dimension", "fractal_prefactor"};

const char *clast_collide_idle(const clast_collide_config *config, const char *key, bool settles)
{
    const int32_t law = config != NULL ? config->sticking.law : -1;
    if (key == NULL || law < 0 || law > CLAST_STICKING_CONTACT) {
        return NULL; // what is wrong with it is for others to say
    }
    const uint32_t settling = settles && strcmp(key, "efficiency") != 0 ? KERNEL(SETTLING) : 0;
    const uint32_t kernels = config->kernel | settling; // no pair of which meets by the settling
    for (size_t k = 0; k < sizeof use / sizeof use[0]; ++k) {
        const bool is_used = (use[k].kernels & kernels) != 0 || (use[k].laws >> law & 1U) != 0;
        if (strcmp(use[k].key, key) == 0) {
            return is_used ? NULL : use[k].kernels != 0 ? "kernel" : "sticking";
        }
    }
    for (size_t k = 0; k < sizeof fractal / sizeof fractal[0]; ++k) {
        if (strcmp(fractal[k], key) == 0 && config->radius_law == CLAST_RADIUS_VOLUME) {
            return "radius_law";
        }
    }
    return NULL;
}
