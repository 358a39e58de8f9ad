#pragma once
#include <clast/status.h>

CLAST_BEGIN

// Collision kernels: the volume swept per time by a pair of particles, beta(1, 2) [m^3/s].
// [docs/theory/agglomeration.md section 1]

/// A particle or an aggregate as kernels see it.
typedef struct clast_collider {
    double monomers;       ///< i
    double radius;         ///< collision radius a [m]
    double mass;           ///< [kg]
    double velocity[3];    ///< [m/s]
    double speed_rms;      ///< turbulent velocity of one component [m/s]; 0: from the medium's
    double settling_speed; ///< as clast_settling_speed gives it, to save calls; 0: not known
} clast_collider;

typedef enum {
    CLAST_SETTLING_STANDARD, ///< drag of clast_drag_sphere, slip
    CLAST_SETTLING_STOKES    ///< creeping flow, slip
} clast_settling_law;

/// What the particles move in, and constants of the model kernels. SI.
typedef struct clast_medium {
    double temperature;      ///< T [K]
    double viscosity;        ///< mu [Pa s]
    double density;          ///< of the fluid [kg/m^3]
    double particle_density; ///< of the solid [kg/m^3]
    double mean_free_path;   ///< of the gas [m]; 0: no slip correction
    double shear;            ///< G [1/s]
    double dissipation;      ///< eps [m^2/s^3]
    double shear_constant;   ///< of shear_turbulent; 0: sqrt(8 pi / 15) = 1.2944
    double speed_rms;        ///< of the fluid, one component [m/s]
    double gravity;          ///< g [m/s^2]
    double efficiency;       ///< E of settling [-]; 0: by clast_collision_efficiency's law
    double constant;         ///< K [m^d/s]
    double additive;         ///< b [m^d/s]
    double product;          ///< c [m^d/s]
    int32_t settling_law;    ///< clast_settling_law
} clast_medium;

/// What a kernel needs, as bits of clast_kernel_info.needs.
typedef enum {
    CLAST_NEEDS_RADIUS = 1,
    CLAST_NEEDS_MASS = 2,
    CLAST_NEEDS_VELOCITY = 4,
    CLAST_NEEDS_TEMPERATURE = 8,
    CLAST_NEEDS_VISCOSITY = 16,
    CLAST_NEEDS_SHEAR = 32,
    CLAST_NEEDS_DISSIPATION = 64,
    CLAST_NEEDS_SPEED_RMS = 128,
    CLAST_NEEDS_DENSITY = 256,
    CLAST_NEEDS_SETTLING = 512 ///< settling speeds; it is faster to fill them in once a particle
} clast_kernel_need;

/// What brings particles together, as bits of clast_kernel_info.mechanisms: a sum of kernels may
/// count each once.
typedef enum {
    CLAST_MECHANISM_BROWNIAN = 1,
    CLAST_MECHANISM_SHEAR = 2, ///< of the mean flow
    CLAST_MECHANISM_TURBULENCE = 4,
    CLAST_MECHANISM_SETTLING = 8
} clast_mechanism;

/// One row of the table that feeds --help, the documents and the checks.
typedef struct clast_kernel_info {
    const char *name, *formula, *source;
    uint32_t needs;
    uint32_t mechanisms; ///< clast_mechanism; 0: a model kernel
    bool is_model;       ///< a function of i and j alone, in any dimension
} clast_kernel_info;

/// Numbers of the kernels; bit k of a mask is kernel k.
typedef enum {
    CLAST_KERNEL_CONSTANT,
    CLAST_KERNEL_ADDITIVE,
    CLAST_KERNEL_PRODUCT,
    CLAST_KERNEL_BROWNIAN,
    CLAST_KERNEL_BROWNIAN_FREE,
    CLAST_KERNEL_BROWNIAN_TRANSITION,
    CLAST_KERNEL_SHEAR_LAMINAR,
    CLAST_KERNEL_SHEAR_TURBULENT,
    CLAST_KERNEL_SETTLING,
    CLAST_KERNEL_INERTIAL,
    CLAST_KERNEL_BALLISTIC,
    CLAST_KERNEL_CLOUD_TURBULENCE,
    CLAST_N_KERNEL
} clast_kernel;

/// The table, [CLAST_N_KERNEL]; bit k of a kernel mask stands for row k.
CLAST_API const clast_kernel_info *clast_kernel_table(void);

/// Mask of "brownian" or a sum, "brownian+settling".
///
/// @return CLAST_E_CONFIG names the unknown word and the known ones
CLAST_API clast_status clast_kernel_parse(const char *text, uint32_t *mask);

/// Everything that the kernels of a mask need.
CLAST_API uint32_t clast_kernel_needs(uint32_t mask);

/// Checks that the medium holds what the kernels need (> 0, finite), and that no two of the kernels
/// count the same mechanism. Whether they hold for the particles: kernel_range.h.
///
/// @return CLAST_E_CONFIG names the kernel and what is missing
CLAST_API clast_status clast_kernel_check(uint32_t mask, const clast_medium *medium);

/// Sum of the kernels in the mask.
///
/// @note symmetric in a and b, >= 0, no allocation; the medium has passed clast_kernel_check
CLAST_API double clast_kernel_value(uint32_t mask, const clast_medium *medium,
                                    const clast_collider *a, const clast_collider *b);

/// Settling speed [m/s] of a particle, weight less buoyancy against the drag of a sphere of its
/// radius; < 0 where the fluid is denser.
///
/// By the standard drag curve (clast_drag_sphere), or Stokes' law; either is faster by the slip
/// correction of a medium with a mean free path. Buoyancy is that of the solid, m /
/// particle_density; of the sphere where that is 0.                [docs/theory/agglomeration.md
/// section 1]
CLAST_API double clast_settling_speed(const clast_medium *medium, const clast_collider *a);

/// Share E of the particles in the swept cylinder pi (a1 + a2)^2 that a settling pair meets: the
/// medium's constant, or where that is 0
///
///     E = 1 - (1 - E_i)(1 - E_c)    each (viscous + potential Re/60) / (1 + Re/60)
///     inertia       (1 + 3/4 ln(2 St) / (St - 1.214))^-2, (St / (St + 1/2))^2
///     interception  1 - 3/2 (1 + p)^-1 + 1/2 (1 + p)^-3, 1 - (1 + p)^-3
///
/// with the ratio of radii p <= 1, St = tau_small |w1 - w2| / a_large, Re = 2 a_large |w1 - w2| /
/// nu. The smaller one is a point with inertia in the flow about the larger: p <= 0.5.
/// [Langmuir1948; Friedlander1977]
CLAST_API double clast_collision_efficiency(const clast_medium *medium, const clast_collider *a,
                                            const clast_collider *b);

/// Speed [m/s] at which a pair meets by the kernels of a mask: the sum over them of kernel over
/// pi (a1 + a2)^2, without collision efficiency and clustering (the mean relative speed of straight
/// paths).                                                                          [Costa2010]
///
/// @return 0 of the model kernels, which have no speed
CLAST_API double clast_impact_speed(uint32_t mask, const clast_medium *medium,
                                    const clast_collider *a, const clast_collider *b);

CLAST_END
