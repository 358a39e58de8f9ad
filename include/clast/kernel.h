#pragma once
#include <clast/status.h>

CLAST_BEGIN

// Collision kernels: the volume swept per time by a pair of particles, beta(1, 2) [m^3/s].
// [docs/theory/agglomeration.md section 1]

/// A particle or an aggregate as kernels see it.
typedef struct clast_collider {
    double monomers;    ///< i
    double radius;      ///< collision radius a [m]
    double mass;        ///< [kg]
    double velocity[3]; ///< [m/s]
    double speed_rms;   ///< turbulent velocity of one component [m/s]; 0: from the medium's
} clast_collider;

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
    double efficiency;       ///< E of settling [-]
    double constant;         ///< K [m^d/s]
    double additive;         ///< b [m^d/s]
    double product;          ///< c [m^d/s]
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
    CLAST_NEEDS_DENSITY = 256
} clast_kernel_need;

/// One row of the table that feeds --help, the documents and the checks.
typedef struct clast_kernel_info {
    const char *name, *formula, *source;
    uint32_t needs;
    bool is_model; ///< a function of i and j alone, in any dimension
} clast_kernel_info;

enum { CLAST_N_KERNEL = 12 };

/// The table, [CLAST_N_KERNEL]; bit k of a kernel mask stands for row k.
CLAST_API const clast_kernel_info *clast_kernel_table(void);

/// Mask of "brownian" or a sum, "brownian+settling".
///
/// @return CLAST_E_CONFIG names the unknown word and the known ones
CLAST_API clast_status clast_kernel_parse(const char *text, uint32_t *mask);

/// Everything that the kernels of a mask need.
CLAST_API uint32_t clast_kernel_needs(uint32_t mask);

/// Checks that the medium holds what the kernels need (> 0, finite).
///
/// @return CLAST_E_CONFIG names the kernel and what is missing
CLAST_API clast_status clast_kernel_check(uint32_t mask, const clast_medium *medium);

/// Sum of the kernels in the mask.
///
/// @note symmetric in a and b, >= 0, no allocation; the medium has passed clast_kernel_check
CLAST_API double clast_kernel_value(uint32_t mask, const clast_medium *medium,
                                    const clast_collider *a, const clast_collider *b);

/// Stokes settling velocity [m/s] of a particle that is lighter in the fluid by its own solid
/// volume: m (1 - rho_f / rho_p) g / (6 pi mu a).
CLAST_API double clast_settling_speed(const clast_medium *medium, const clast_collider *a);

CLAST_END
