#pragma once
#include <clast/status.h>
#include <math.h>

CLAST_BEGIN

// The form of a grain: ratios of its three dimensions L >= I >= S. Which L, I and S is another
// question (clast/grain.h): tools disagree about "elongation" mostly because they measure these
// three differently, and sometimes because they print the inverse.

/// The 13 form factors of Table 1 of Rettinger et al. 2022, in its order:
/// X(identifier, name, symbol, label, formula as text, expression in L, I, S, least value, greatest
/// value, who introduced it). This list feeds values, --help, JSON keys, CSV headers and the docs'
/// check; nothing is listed twice. The range is that of L >= I >= S > 0, its ends reached or
/// approached.
#define CLAST_FORM_FACTOR_LIST(X)                                                                  \
    X(FLATNESS, "flatness", "FL", "flatness", "S/I", S / I, 0, 1, "Zingg1935")                     \
    X(ELONGATION, "elongation", "EL", "elongation", "I/L", I / L, 0, 1, "Zingg1935")               \
    X(EQUANCY, "equancy", "EQ", "equancy", "S/L", S / L, 0, 1, "Blott2008")                        \
    X(ASCHENBRENNER, "aschenbrenner_shape_factor", "ASF", "Aschenbrenner shape factor", "L S/I^2", \
      L *S / (I * I), 0, INFINITY, "Aschenbrenner1956")                                            \
    X(COREY, "corey_shape_factor", "CSF", "Corey shape factor", "S/sqrt(L I)", S / sqrt(L * I), 0, \
      1, "Corey1949")                                                                              \
    X(DISC_ROD, "disc_rod_index", "DRI", "disc-rod index", "(L-I)/(L-S)", (L - I) / (L - S), 0, 1, \
      "Illenberger1991")                                                                           \
    X(ILLENBERGER_FORM, "illenberger_form_index", "IFI", "Illenberger form index", "(L+S)/I",      \
      (L + S) / I, 1, INFINITY, "Illenberger1991")                                                 \
    X(ILLENBERGER_ROD, "illenberger_rod_index", "IRI", "Illenberger rod index", "(S+I)/L",         \
      (S + I) / L, 0, 2, "Illenberger1991")                                                        \
    X(JANKE, "janke_form_factor", "JFF", "Janke form factor", "S/sqrt((L^2+I^2+S^2)/3)",           \
      S / sqrt((L * L + I * I + S * S) / 3.0), 0, 1, "Janke1966")                                  \
    X(KRUMBEIN, "krumbein_intercept_sphericity", "KIS", "Krumbein intercept sphericity",           \
      "cbrt(I S/L^2)", cbrt(I *S / (L * L)), 0, 1, "Krumbein1941")                                 \
    X(MAX_PROJECTION, "maximum_projection_sphericity", "MPS", "maximum projection sphericity",     \
      "cbrt(S^2/(L I))", cbrt(S *S / (L * I)), 0, 1, "Sneed1958")                                  \
    X(OBLATE_PROLATE, "oblate_prolate_index", "OPI", "oblate-prolate index",                       \
      "10 ((L-I)/(L-S) - 1/2)/(S/L)", 10.0 * ((L - I) / (L - S) - 0.5) / (S / L), -INFINITY,       \
      INFINITY, "Dobkins1970")                                                                     \
    X(WENTWORTH, "wentworth_flatness_index", "WFI", "Wentworth flatness index", "(L+I)/(2 S)",     \
      (L + I) / (2.0 * S), 1, INFINITY, "Wentworth1922")

#define CLAST_FORM_FACTOR_ENUM(id, name, symbol, label, formula, value, low, high, source)         \
    CLAST_FORM_##id,
typedef enum {
    CLAST_FORM_FACTOR_LIST(CLAST_FORM_FACTOR_ENUM) CLAST_N_FORM_FACTOR
} clast_form_factor;
#undef CLAST_FORM_FACTOR_ENUM

/// Features of a grain for fits: the 13 factors, then their 13 inverses.
enum { CLAST_N_FORM_FEATURE = 2 * CLAST_N_FORM_FACTOR };

/// What is known about one form factor; static texts.
typedef struct clast_form_factor_entry {
    const char *name;    ///< key in JSON and CSV, "corey_shape_factor"
    const char *inverse; ///< key of 1/X, "inverse_corey_shape_factor"
    const char *symbol;  ///< of the paper, "CSF"
    const char *label;   ///< for people, "Corey shape factor"
    const char *formula; ///< "S/sqrt(L I)"
    double low, high;    ///< range over all grains
    const char *source;  ///< who introduced it, a key of docs/theory/form.md
} clast_form_factor_entry;

/// The entry of a factor, or NULL when there is no such number.
CLAST_API const clast_form_factor_entry *clast_form_factor_about(int32_t factor);

/// The factor of this name or symbol ("flatness", "FL"; case and '-' or '_' alike), or -1.
CLAST_API int32_t clast_form_factor_find(const char *text);

/// All 13 factors of L >= I >= S > 0 (any unit), in the order of the list.
///
/// NaN where the formula has no value: the disc-rod and oblate-prolate index of a grain with L = S
/// (within 1e-6, which is the rounding of surface files), and every factor of lengths that are not
/// finite, not positive or not in this order.
CLAST_API void clast_form_factors(double l, double i, double s, double value[CLAST_N_FORM_FACTOR]);

/// One of them.
CLAST_API double clast_form_factor_value(clast_form_factor factor, double l, double i, double s);

/// The 13 factors and then their inverses 1/X; NaN where X has no value, is 0, or, of
/// those two indices, within 1e-6 of it.
CLAST_API void clast_form_features(double l, double i, double s,
                                   double value[CLAST_N_FORM_FEATURE]);

/// Name of feature 0 .. 25 (a factor's name or that of its inverse), or NULL.
CLAST_API const char *clast_form_feature_name(int32_t feature);

/// Sieve size D = sqrt((S^2 + I^2)/2): the edge of the square hole that an ellipse of height S and
/// width I just passes.                                         [Rettinger2022 eq. 1; Oakey2005]
CLAST_API double clast_form_sieve_size(double i, double s);

/// Lengths of a grain with this flatness S/I, elongation I/L and sieve size D.
///                                                               [Rettinger2022 eqs 20-22]
CLAST_API void clast_form_lengths(double flatness, double elongation, double sieve_size,
                                  double lis[3]);

/// The four classes of the Zingg diagram; a ratio of exactly 2/3 belongs to the rounder side.
typedef enum {
    CLAST_ZINGG_SPHERE, ///< S/I >= 2/3, I/L >= 2/3
    CLAST_ZINGG_DISC,   ///< S/I < 2/3, I/L >= 2/3
    CLAST_ZINGG_ROD,    ///< S/I >= 2/3, I/L < 2/3
    CLAST_ZINGG_BLADE,  ///< both below 2/3
    CLAST_N_ZINGG
} clast_zingg;

/// The class; CLAST_N_ZINGG where a ratio is not a number.
CLAST_API clast_zingg clast_form_zingg(double flatness, double elongation);

/// "sphere", "disc", "rod", "blade"; "-" for no class.
CLAST_API const char *clast_zingg_name(clast_zingg zingg);

// How form varies from grain to grain: flatness and elongation as independent normal variables cut
// to a range.                                [docs/theory/grading.md; Rettinger2022 section 7.1]

typedef struct clast_form_law {
    double flatness_mean, flatness_deviation;     ///< of the normal law before it is cut
    double elongation_mean, elongation_deviation; ///< a deviation of 0: all grains alike
    double low, high;                             ///< both in (0, 1]; 0.1 and 1 in the paper
} clast_form_law;

/// The paper's Rhine gravel: flatness 0.647 and 0.175, elongation 0.682 and 0.139, cut to 0.1 .. 1.
///                                                                        [Rettinger2022 table 2]
CLAST_API clast_form_law clast_form_law_rhine(void);

/// @return CLAST_E_CONFIG for numbers that are not finite, deviations below 0, a range that is not
///         0 < low <= high <= 1, a mean outside of it with deviation 0, or a range that holds less
///         than 1e-6 of a law
CLAST_API clast_status clast_form_law_check(const clast_form_law *law);

/// Flatness S/I and elongation I/L of grain `index`: a function of (law, seed, index) alone.
///
/// Values outside the range are redrawn in the paper; here the cut law's inverse distribution is
/// taken, which is the same law by one number each.    @param law  passes clast_form_law_check
CLAST_API void clast_form_law_draw(const clast_form_law *law, uint64_t seed, uint64_t index,
                                   double *flatness, double *elongation);

/// Means and deviations after the cut, in closed form: what a packing really holds.
typedef struct clast_form_law_moments {
    double flatness_mean, flatness_deviation;
    double elongation_mean, elongation_deviation;
} clast_form_law_moments;

/// Moments of the law as it is drawn from, cut to its range.
CLAST_API clast_form_law_moments clast_form_law_cut(const clast_form_law *law);

// The forms of a set of grains, from a table of flatness and elongation or of L, I and S.

/// Why a row was left out.
typedef enum {
    CLAST_ROW_MISSING,    ///< an empty cell, NA or nan
    CLAST_ROW_NOT_NUMBER, ///< a word where a number belongs
    CLAST_ROW_INFINITE,
    CLAST_ROW_NOT_POSITIVE, ///< zero or negative
    CLAST_ROW_ABOVE_ONE,    ///< a ratio above 1
    CLAST_ROW_NOT_ORDERED,  ///< not L >= I >= S
    CLAST_N_ROW_FAULT
} clast_row_fault;

/// "missing", "not a number", ...
CLAST_API const char *clast_row_fault_text(clast_row_fault fault);

typedef struct clast_left_out {
    int64_t row; ///< of the table, from 0
    clast_row_fault fault;
} clast_left_out;

typedef struct clast_form_set {
    int64_t n;                     ///< grains kept
    int64_t *row;                  ///< [n] their rows in the table, from 0
    double *flatness, *elongation; ///< [n] S/I and I/L in (0, 1]
    double *size;                  ///< [n] in the unit of its column (mm for phi), or that of L, I
                                   ///< and S (metres where they say several); NAN for none above 0;
                                   ///< NULL if the table has no size
    char size_name[64];            ///< "sieve size", "diameter"
    char size_unit[16];            ///< of length: "mm", "m"; "": none is known
    bool is_sieve_size;            ///< of eq. 1: L, I and S follow from it and the ratios
    char unread_count[64];         ///< column of numbers of grains or masses (count, n, weight,
                                   ///< mass_g), some of which are not 1: each row is one grain;
                                   ///< else ""
    int64_t n_left_out;
    clast_left_out *left_out; ///< [n_left_out] by row
} clast_form_set;

/// Whether the names of a list "a,b" (flatness, elongation) or "a,b,c" (L, I, S) are a form's by
/// their words, each that of its place: "flatness_mean,elongation_mean", "mean L,mean I,mean S" or
/// "L_mm,I_mm,S_mm", not "sand,mu" or "length,width,time_s"; a letter counts at the beginning of a
/// name, and as a capital at its end. True of NULL and "", which name none.
CLAST_API bool clast_form_columns_named(const char *columns);

/// Whether the columns of a table are named as those of forms, whatever is in them; false of NULL.
CLAST_API bool clast_form_set_named(const clast_table *table);

/// Takes the forms out of a table.
///
/// Columns are known by name, whatever their case and unit: flatness or FL with elongation or EL;
/// L, I and S (also long, intermediate, short; major, middle, minor axis length; length, width,
/// thickness); where a table has both, L, I and S count and must agree with the ratios to 0.006. A
/// size column (sieve_size, D, size, diameter, equivalent_diameter) is kept; lengths give the sieve
/// size of eq. 1, each by the unit that its column says; in phi both are 2^-phi mm. Rows with cells
/// that are no numbers, not finite, not positive, ratios above 1 (by more than 1e-9) or lengths out
/// of order are left out and listed; a form whose size alone is so is kept.
///
/// @param columns  NULL or "": as above; "a,b": flatness and elongation by name; "a,b,c": L, I, S
/// @return CLAST_E_FORMAT if columns are missing or disagree, some of L, I and S alone say a unit,
///         lengths or sizes say one that is no length or not read (ft), or no row is left
CLAST_API clast_status clast_form_set_of(const clast_table *table, const char *columns,
                                         clast_form_set *set);
CLAST_API void clast_form_set_free(clast_form_set *set);

/// One line about the rows left out, "3 rows left out: 2 missing, 1 above 1 (first: row 7)"; empty
/// if none was. Rows count from 1 after the header.
CLAST_API void clast_form_set_complaint(const clast_form_set *set, size_t size, char *text);

/// What to say of unread_count: "column 'n' is not looked at: each row is one grain"; "" where
/// nothing is.
///
/// @param text  [size], 128 suffice
/// @return text
CLAST_API const char *clast_form_set_count_words(const clast_form_set *set, size_t size,
                                                 char *text);

/// The 13 form factors of every grain, in Table 1's order, and its size if known: what
/// clast_statistics_of takes.
CLAST_API clast_status clast_form_set_factors(const clast_form_set *set, clast_table *table);

/// Rows left out, as columns row (from 1) and reason.
CLAST_API clast_status clast_form_set_left_out(const clast_form_set *set, clast_table *table);

// Form taken off a grain and put on again: stretching along the principal axes changes L, I and S
// of the mass-equivalent ellipsoid exactly, and nothing else of the shape's character.
//                    [docs/theory/grading.md; Rettinger2022 section 3.2, fig. 5 and appendix A]
//
// A grain keeps its hand: axes are right-handed and never mirrored. Their signs follow the shape's
// skewness (third moments along L and I are positive), so that the same grain in another position
// gives the same mesh.

/// The grain with its centroid at the origin, L along x, I along y and S along z, unstretched.
///
/// @param mesh  closed and outward      @param out  empty; filled on success
/// @param lis   full axes L >= I >= S of the mass-equivalent ellipsoid, in the mesh's unit
/// @return CLAST_E_GEOMETRY if the volume is not positive or the solid has no such ellipsoid
CLAST_API clast_status clast_reform_principal(const clast_mesh *mesh, clast_mesh *out,
                                              double lis[3]);

/// The same stretched to these lengths L >= I >= S > 0; measured ones agree within 1e-13 for grains
/// of S/L > 0.03. L = I = S = 1 takes all form and size off: such a mesh, its vertices multiplied
/// by (L, I, S), has any form.
///
/// @return CLAST_E_CONFIG for lengths that are not finite, not positive, not in order, too small
///         or large for moments in doubles (1e-56 .. 1e60), or of S below 1e-6 L
CLAST_API clast_status clast_reform_mesh(const clast_mesh *mesh, const double lis[3],
                                         clast_mesh *out);

/// Convex hull of at most this many triangles: the hull, simplified at constant volume where it has
/// more, and the hull of that, for simplifying leaves faces that bend inwards by little.
///
/// @param mesh    any vertices; triangles, if there are some, must be of them but change nothing
/// @param n_face  >= 4
/// @return as clast_mesh_hull and clast_mesh_simplify
CLAST_API clast_status clast_reform_hull(const clast_mesh *mesh, int32_t n_face, clast_mesh *out);

CLAST_END
