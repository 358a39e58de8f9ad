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
    double settling_speed; ///< as clast_kernel_settling_speed gives it, to save calls; 0: not known
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
    double efficiency;       ///< E of settling [-]; 0: by clast_kernel_collision_efficiency's law
    double constant;         ///< K [m^d/s]
    int32_t constant_d;      ///< d of the unit that it was given in; 0: of a bare number, any
    double additive;         ///< b [m^d/s]
    int32_t additive_d;      ///< as constant_d
    double product;          ///< c [m^d/s]
    int32_t product_d;       ///< as constant_d
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
CLAST_API double clast_kernel_settling_speed(const clast_medium *medium, const clast_collider *a);

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
CLAST_API double clast_kernel_collision_efficiency(const clast_medium *medium,
                                                   const clast_collider *a,
                                                   const clast_collider *b);

/// Speed [m/s] at which a pair meets by the kernels of a mask: the sum over them of kernel over
/// pi (a1 + a2)^2, without collision efficiency and clustering (the mean relative speed of straight
/// paths).                                                                          [Costa2010]
///
/// @return 0 of the model kernels, which have no speed
CLAST_API double clast_impact_speed(uint32_t mask, const clast_medium *medium,
                                    const clast_collider *a, const clast_collider *b);

// Where kernels and laws of sticking hold, in one table for the Monte Carlo of clouds, that of a
// box and the sectional balance. [docs/theory/agglomeration.md section 7]

/// One condition: `quantity` of a pair lies in [low, high].
typedef struct clast_kernel_range {
    const char *owner;    ///< "kernel brownian", "sticking contact"
    const char *quantity; ///< "mean free path over radius"
    double low, high;     ///< high may be INFINITY
    const char *source;
    const char *instead; ///< what to do outside
} clast_kernel_range;

enum { CLAST_N_KERNEL_RANGE = 26 };

/// Row k of the table; NULL where there is none.
CLAST_API const clast_kernel_range *clast_kernel_range_row(int32_t k);

/// What was held against the table: particles, collisions or rates.
typedef struct clast_range_use {
    double n;       ///< seen
    double outside; ///< of them out of a range
    int32_t row;    ///< of the table: where the farthest one lies; there `value` is
    double value;
    double excess; ///< value / high or low / value, > 1
} clast_range_use;

/// A run against the table.
typedef struct clast_range_report {
    clast_range_use start;      ///< particles at the start, each against its like
    clast_range_use collisions; ///< sectional: of them by the trapezoid rule over the output times
    double time;                ///< when they had first left it [s]; NaN: never
} clast_range_report;

/// One line: the owner, the quantity, the farthest value, its range and the source.
///
/// @return text; empty where nothing was outside
CLAST_API const char *clast_range_use_words(const clast_range_use *use, size_t size, char *text);

/// Of a run the use that tells more: collisions where some were outside, else particles at the
/// start where some were; NULL of NULL.
CLAST_API const clast_range_use *clast_range_report_use(const clast_range_report *report);

/// What to say of particles that fill over a tenth of the volume, where kernels are of dilute
/// suspensions; "" of fewer and of NaN.
///
/// @param volume_fraction  [-]    @param text  [size], 128 suffice
/// @return text
CLAST_API const char *clast_kernel_dense_words(double volume_fraction, size_t size, char *text);

// Whether two particles that meet stick. [docs/theory/agglomeration.md section 8]

typedef enum {
    CLAST_STICKING_CONSTANT, ///< the share alpha of all
    CLAST_STICKING_VISCOUS,  ///< a viscous film stops the pair [Ennis1991]
    CLAST_STICKING_LIQUID,   ///< wet ash, a fit to measured shares [Costa2010]
    CLAST_STICKING_CONTACT   ///< the adhesion of elastic spheres holds it [Thornton1998]
} clast_sticking_law;

/// A law and what it needs; the other members may be 0. SI.
typedef struct clast_sticking {
    int32_t law;           ///< clast_sticking_law
    double film_viscosity; ///< of the liquid on the particles: viscous, liquid [Pa s]
    double film_thickness; ///< h: viscous [m]
    double asperity;       ///< h_a, where the solids touch through the film: viscous [m]
    double restitution;    ///< e of the solids: viscous
    double critical_stokes, stokes_exponent; ///< St_cr, q: liquid
    double adhesion;                         ///< work of adhesion of the surfaces: contact [J/m^2]
    double young, poisson;                   ///< modulus [Pa] and ratio of both particles: contact
} clast_sticking;

/// Two particles that meet. SI.
typedef struct clast_impact {
    double speed;     ///< relative, clast_impact_speed
    double radius[2]; ///< of the particles
    double mass[2];
    double curvature[2]; ///< radii of what touches: of the particles, or of monomers of a fractal
} clast_impact;

/// Whether a law has what it needs.
///
/// @return CLAST_E_CONFIG names the law and what is missing
CLAST_API clast_status clast_sticking_check(const clast_sticking *sticking);

/// Impact Stokes number of the law: m~ u / (6 pi mu a~^2) of reduced mass and radius of curvature
/// for a viscous film [Ennis1991 for two equal spheres, u = 2 u_0: 8 rho u_0 a / (9 mu)],
/// 8 rho u / (9 mu) d1 d2 / (d1 + d2) with the mean density of both for wet ash [Costa2010]; NaN
/// for the other laws.
CLAST_API double clast_sticking_stokes(const clast_sticking *sticking, const clast_impact *impact);

/// Speed [m/s] up to which elastic spheres stick: the work that a JKR contact takes to part,
/// 7.09 (Gamma^5 a~^4 / E*^2)^(1/3), against m~ v^2 / 2.                          [Thornton1998]
CLAST_API double clast_sticking_speed(const clast_sticking *sticking, const clast_impact *impact);

/// Share of such impacts that stick.
///
///     viscous  1 where St < (1 + 1/e) ln(h / h_a), else 0                           [Ennis1991]
///     liquid   1 / (1 + (St / St_cr)^q)                                             [Costa2010]
///     contact  1 below clast_sticking_speed, else 0                              [Thornton1998]
///
/// @return 1 for a constant law; the medium has passed clast_sticking_check
CLAST_API double clast_sticking_share(const clast_sticking *sticking, const clast_impact *impact);

CLAST_END
