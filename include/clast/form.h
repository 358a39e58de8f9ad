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

CLAST_END
