#pragma once
#include <clast/status.h>

// Sizes of grains: sieve curves by mass, what they mean by number, and draws from them.
//                                     [docs/theory/grading.md; Rettinger et al. 2022, section 3.2]

CLAST_BEGIN

/// Sizes as they came: sizes or bins with counts. [m]
typedef struct clast_sizes {
    int64_t n;
    double *low, *high; ///< [n] m; equal for a plain size
    double *count;      ///< [n] > 0
    double *density;    ///< [n] > 0 [kg/m^3], or NULL: none is given
} clast_sizes;

/// Allocates n rows, zeroed; `sizes` must be empty. CLAST_E_MEMORY; CLAST_E_ARGUMENT for n < 0.
CLAST_API clast_status clast_sizes_alloc(int64_t n, clast_sizes *sizes);
/// Frees the arrays; may be called twice.
CLAST_API void clast_sizes_free(clast_sizes *sizes);

/// Sieve curve: the mass between neighbouring sieves. Between two sieves the curve of mass passing
/// is a straight line over log size, as sieve curves are drawn.
typedef struct clast_curve {
    int32_t n_class;
    double *sieve; ///< [n_class + 1] m, ascending
    double *mass;  ///< [n_class] shares of the mass, sum 1
} clast_curve;

/// Curve from sieves [n_class + 1] m in ascending order and masses [n_class] of any unit.
///
/// @return CLAST_E_CONFIG with the class's number if a sieve is not finite, not above 0 or not
/// above
///         the one before, if a mass is negative or not finite, or if the masses sum to 0
CLAST_API clast_status clast_curve_make(int32_t n_class, const double *sieve, const double *mass,
                                        clast_curve *curve);
CLAST_API void clast_curve_free(clast_curve *curve); ///< may be called twice

/// A published laboratory mixture of Rhine gravel.            [Rettinger et al. 2022, table 3]
typedef struct clast_curve_case {
    const char *name; ///< "U1" ... "B70"
    double mass[7];   ///< shares between the sieves of clast_curve_case_sieve
    double porosity;  ///< measured in a cylinder of 0.104 m, mean of two
    double deviation; ///< of that porosity
    double spacing;   ///< of generated grains h_g [m]
} clast_curve_case;

/// 2.8, 4, 5.6, 8, 11.2, 16, 22.4, 31.5 mm. [m]
extern CLAST_API const double clast_curve_case_sieve[8];

/// The i-th of the seven published curves U1, U3, U5, U7, B30, B50, B70; NULL after the last.
CLAST_API const clast_curve_case *clast_curve_case_at(int32_t i);

/// Curve of a published case.
/// @return CLAST_E_CONFIG with the known names
CLAST_API clast_status clast_curve_named(const char *name, clast_curve *curve);

/// Share of the mass that passes a sieve of this size; NaN for a curve of no class. [m]
CLAST_API double clast_curve_passing(const clast_curve *curve, double size);

/// Size that this share of the mass passes, 0 .. 1: D50 for 0.5; exact on the straight lines of the
/// curve, the smallest such size where the curve is level; NaN for a curve without mass or a share
/// outside of 0 to 1. [m]
CLAST_API double clast_curve_size(const clast_curve *curve, double share);

/// Geometric mean size of a class, sqrt(s_i s_i+1) [m].                                   [eq. 8]
CLAST_API double clast_curve_class_size(const clast_curve *curve, int32_t i);

/// Grains of a class in a mass [kg], n_i = m_i m_tot / (rho V d_i^3).                     [eq. 9]
///
/// @param grain_volume  volume of a grain of size 1: pi/6 in the paper; its program takes the mean
///                      volume of the shapes at D = 1
CLAST_API double clast_curve_count(const clast_curve *curve, int32_t i, double mass, double density,
                                   double grain_volume);

/// Sieve size in phi units, -log2(D / 1 mm), and back [m].                      [Krumbein 1934]
CLAST_API double clast_phi_of_size(double size);
CLAST_API double clast_phi_size(double phi);

/// How sizes lie within the classes of a curve.
typedef enum {
    CLAST_SPREAD_STEP,   ///< density constant over log size in each class: what the paper's program
                         ///< does, and the only one with the class counts of eq. 9
    CLAST_SPREAD_LINEAR, ///< density linear over log size between the class means, down to 0 at the
                         ///< outer sieves: the paper's words
    CLAST_SPREAD_MEANS   ///< class means only
} clast_grading_spread;

/// Which numbers of grains stand for the masses of the classes.
typedef enum {
    CLAST_COUNT_MEAN, ///< each grain has its class's mean size                           [eq. 9]
    CLAST_COUNT_EXACT ///< the mean grain volume of the class under its spread: masses come out as
                      ///< wanted also for classes of unequal width; not with `linear`
} clast_grading_count;

/// A distribution of grain sizes by number, ready to draw from. Opaque; read-only once made, so any
/// number of threads may share it.
typedef struct clast_grading clast_grading;

CLAST_API void clast_grading_destroy(clast_grading *grading); ///< NULL is allowed

/// Distribution of a sieve curve. Empty classes below the first and above the last filled one do
/// not count.
/// @return CLAST_E_CONFIG for `exact` counts of a `linear` spread, and for what clast_curve_make
/// refuses
CLAST_API clast_status clast_grading_of_curve(const clast_curve *curve, clast_grading_spread spread,
                                              clast_grading_count count, clast_grading **grading);

/// Distribution of a list: rows of one size or of a bin (constant over log size) with counts, or
/// with masses. Rows may have densities (clast_grading_draw_density), which masses are divided by.
/// @return CLAST_E_CONFIG for an empty list, sizes not above 0, counts that sum to 0
CLAST_API clast_status clast_grading_of_sizes(const clast_sizes *sizes, bool by_mass,
                                              clast_grading **grading);

/// Uniform over size, by number; low = high is one size.
CLAST_API clast_status clast_grading_uniform(double low, double high, clast_grading **grading);

/// Log-normal by number with this mean and standard deviation of the size itself, cut off outside
/// [low, high]; low = 0 and high = INFINITY cut nothing.
CLAST_API clast_status clast_grading_lognormal(double mean, double deviation, double low,
                                               double high, clast_grading **grading);

/// Size of grain `index` [m]: a function of (seed, index) alone.
CLAST_API double clast_grading_draw(const clast_grading *grading, uint64_t seed, uint64_t index);

/// Smallest and largest size that can be drawn; the largest is INFINITY for an uncut log-normal.
CLAST_API void clast_grading_range(const clast_grading *grading, double *low, double *high);

/// Share of the grains, and of their volume at equal shape, that is not larger than this size; NaN
/// for NaN.
CLAST_API double clast_grading_share(const clast_grading *grading, double size);
CLAST_API double clast_grading_mass_share(const clast_grading *grading, double size);

/// Size that this share of the grains, or of their volume, does not exceed [m]; the inverses of the
/// two above, in closed form but for masses under `linear` (bisection to the last bits). NaN for a
/// share outside 0 to 1.
CLAST_API double clast_grading_size(const clast_grading *grading, double share);
CLAST_API double clast_grading_mass_size(const clast_grading *grading, double share);

/// Mean of D^3 [m^3]: a mass M of grains of density rho holds M / (rho V mean_cube) grains on
/// average, V the volume at size 1.
CLAST_API double clast_grading_mean_cube(const clast_grading *grading);

/// Grains that were made; borrowed.
typedef struct clast_grading_sample {
    int64_t n;
    const double *size;   ///< [n] m
    const double *volume; ///< [n] m^3, or NULL: size^3
} clast_grading_sample;

/// Wanted against achieved, in a few numbers.
typedef struct clast_grading_match {
    int64_t n;
    double distance_mass;   ///< greatest difference of the shares by mass from the grading's,
                            ///< anywhere; NAN without one
    double distance_number; ///< the same by number: Kolmogorov and Smirnov's statistic
    double distance_curve;  ///< by mass from the curve, which is not the law of the draws: grains
                            ///< of a class have not its mean mass, or cross its sieves
    double achieved_d10, achieved_d50, achieved_d90; ///< by mass, smallest size that reaches it [m]
    double wanted_d10, wanted_d50, wanted_d90;       ///< by mass, of the curve [m]
} clast_grading_match;

/// Grains against the curve that they were to follow: one row a class, below and above it.
///
/// @param grading  what they were drawn from, for distance_mass and _number, or NULL
/// @param table    empty; low_m, high_m, wanted_mass, achieved_mass (shares), wanted_number,
///                 achieved_number (shares), count
/// @return CLAST_E_CONFIG for no grains, or sizes and volumes that are not finite and above 0
CLAST_API clast_status clast_grading_compare(const clast_grading *grading, const clast_curve *curve,
                                             const clast_grading_sample *sample, clast_table *table,
                                             clast_grading_match *match);

/// Sieve curve from delimited text with a header, one row a sieve in any order. The size column is
/// called sieve, size, diameter, opening, d or phi and carries its unit (sieve_mm, "size (um)",
/// phi). A second column holds either
///
/// - retained, mass, weight or fraction: what stays on this sieve and passes the next larger one,
///   in any unit; 0 on the largest sieve; in % or shares (by its name) all of it;
/// - cumulative retained: what stays on this sieve and all coarser ones, in %, as a share of 1 or
///   (unit g, kg) as a mass; 0 on the largest sieve, all on the smallest; or
/// - passing, finer or undersize: what passes this sieve, in %, as a share of 1 or (unit g, kg) as
///   a mass; 0 at the smallest sieve, all at the largest.
///
/// All of it is 100 % or 1 within 1 %, for rounded entries and grains lost in sieving. A pan may be
/// a row of size 0 if nothing is in it.
///
/// @return CLAST_E_FORMAT with the row and what to do: no such columns, a word in the column's name
///         that is not understood (mass above), cells that are not finite, sieves that repeat,
///         negative masses, passing that falls as sieves grow, mass that is finer or coarser than
///         all sieves, % or shares that miss the whole
CLAST_API clast_status clast_curve_read(const char *path, clast_curve *curve);

/// The same from memory; `name` stands for the path in messages.
CLAST_API clast_status clast_curve_parse(const char *name, const void *bytes, size_t n,
                                         clast_curve *curve);

/// Sizes by one text, as in the option `curve`: a published case (U1 ... B70), "uniform:LOW,HIGH",
/// "lognormal:MEAN,DEVIATION" or "lognormal:MEAN,DEVIATION,LOW,HIGH", one size ("11 mm"),
/// "list:FILE" or "masses:FILE" (clast_sizes_read; with counts, or with masses), or the file
/// of a sieve curve. Each size has its unit: a bare one is refused.
///
/// @param curve    {0}; stays empty unless the text names a curve
/// @param grading  made in any case
CLAST_API clast_status clast_grading_load(const char *text, clast_grading_spread spread,
                                          clast_grading_count count, clast_curve *curve,
                                          clast_grading **grading);

/// What a grading's list held: how its rows are counted or weighed.
typedef struct clast_grading_list {
    int64_t n_row;       ///< 0: it was loaded from no list
    double total;        ///< sum of the column, n_row without one
    const char *column;  ///< that counts or weighs the rows, borrowed; "": one grain a row
    const char *ignored; ///< columns that were not looked at, ", " between them, borrowed
    const char *size;    ///< column of the sizes, or of their lower ends, borrowed
} clast_grading_list;

/// The list that clast_grading_load read, by "list:FILE" or "masses:FILE"; its texts live as long
/// as the grading.
CLAST_API clast_grading_list clast_grading_list_of(const clast_grading *grading);

/// The same in words, in `size` bytes: "40 rows, counted by column 'number': 820 in all; not looked
/// at: id"; "" for no list.
///
/// @param by_mass  the column weighs the rows ("masses:FILE")
/// @return text
CLAST_API const char *clast_grading_list_text(const clast_grading_list *list, bool by_mass,
                                              size_t size, char *text);

/// Which of the options `spread` and `count` such sizes do not look at (clast_fields_idle). NULL of
/// NULL rules.
///
/// @param curve  of clast_grading_load; NULL: not known yet
CLAST_API const clast_idle *clast_grading_idle(const clast_curve *curve,
                                               clast_grading_spread spread, clast_idle *rules);

/// Sizes, sizes with counts, or bins with counts, from delimited text (clast_table_parse_csv; a
/// comment may stand behind a row's cells too, a separator behind the last of them is none, and a
/// first row that begins with a number names no columns).
///
/// A column `count`, `n`, `number` or `n_grains` counts the row's particles, else `weight`,
/// `frequency` or `fraction`, else `mass` or `retained` (mass_g) weighs them; columns that begin
/// with `low` and `high` are the ends of a bin, each in its own unit; `density` (kg/m^3 unless its
/// name gives another unit, density_g/cm3) is that of the row's particles. In phi units a size is
/// 2^-phi mm.
///
/// @param column  name of the size column; "": that called size, diameter or sieve, else a D in
///                its unit (D_m, as clast shape writes it), else the first
/// @param unit    um, mm, m, phi, ..., as the column's name gives if it does (d_eq_um); "": that
/// @return CLAST_E_FORMAT with the line for sizes that are not numbers, not finite or not above 0,
///         and for a column whose name gives another unit than those of length (size_ft);
///         CLAST_E_CONFIG when the unit is not known, or is not the one in the column's name
CLAST_API clast_status clast_sizes_read(const char *path, const char *column, const char *unit,
                                        clast_sizes *sizes);

/// The same from memory; `name` stands for the path in messages.
CLAST_API clast_status clast_sizes_parse(const char *name, const char *text, const char *column,
                                         const char *unit, clast_sizes *sizes);

CLAST_END
