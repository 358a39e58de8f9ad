// Form factors, sieve size and Zingg class of a grain with dimensions L >= I >= S.
//
// Sources: Table 1 and eqs 1, 20-22 of Rettinger et al. 2022; Zingg 1935. docs/theory/form.md names
// the works that introduced each factor.
#include <clast/form.h>

#include <ctype.h>

/// Share of L below which a difference of lengths is what rounding left of it: coordinates of
/// surface files have 24 bits.
static const double ROUNDING = 1e-6;

/// The two factors that divide differences of lengths.
static bool is_difference(int factor)
{
    return factor == CLAST_FORM_DISC_ROD || factor == CLAST_FORM_OBLATE_PROLATE;
}

#define ENTRY(id, name, symbol, label, formula, value, low, high, source)                          \
    [CLAST_FORM_##id] = {name, "inverse_" name, symbol, label, formula, low, high, source},
static const clast_form_factor_entry ENTRIES[CLAST_N_FORM_FACTOR] = {CLAST_FORM_FACTOR_LIST(ENTRY)};
#undef ENTRY

const clast_form_factor_entry *clast_form_factor_about(int32_t factor)
{
    return factor >= 0 && factor < CLAST_N_FORM_FACTOR ? &ENTRIES[factor] : NULL;
}

static bool same_word(const char *a, const char *b)
{
    for (; *a != '\0' && *b != '\0'; ++a, ++b) {
        const int x = *a == '-' ? '_' : tolower((unsigned char)*a);
        const int y = *b == '-' ? '_' : tolower((unsigned char)*b);
        if (x != y) {
            return false;
        }
    }
    return *a == *b;
}

int32_t clast_form_factor_find(const char *text)
{
    if (text == NULL) {
        return -1;
    }
    for (int32_t f = 0; f < CLAST_N_FORM_FACTOR; ++f) {
        if (same_word(text, ENTRIES[f].name) || same_word(text, ENTRIES[f].symbol)) {
            return f;
        }
    }
    return -1;
}

double clast_form_factor_value(clast_form_factor factor, double l, double i, double s)
{
    // the paper's letters; I is a macro of complex.h only
    const double L = l;
    const double I = i;
    const double S = s;
    if (!(isfinite(L) && L >= I && I >= S && S > 0.0)) {
        return NAN;
    }
    if (is_difference((int)factor) && L - S <= ROUNDING * L) {
        return NAN; // 0 / 0
    }
    switch (factor) {
#define VALUE(id, name, symbol, label, formula, value, low, high, source)                          \
    case CLAST_FORM_##id:                                                                          \
        return value;
        CLAST_FORM_FACTOR_LIST(VALUE)
#undef VALUE
    default:
        return NAN;
    }
}

void clast_form_factors(double l, double i, double s, double value[CLAST_N_FORM_FACTOR])
{
    if (value == NULL) {
        return;
    }
    for (int f = 0; f < CLAST_N_FORM_FACTOR; ++f) {
        value[f] = clast_form_factor_value((clast_form_factor)f, l, i, s);
    }
}

void clast_form_features(double l, double i, double s, double value[CLAST_N_FORM_FEATURE])
{
    if (value == NULL) {
        return;
    }
    clast_form_factors(l, i, s, value);
    for (int f = 0; f < CLAST_N_FORM_FACTOR; ++f) {
        const double inverse = 1.0 / value[f];
        const bool is_known =
            isfinite(inverse) && !(is_difference(f) && fabs(value[f]) <= ROUNDING);
        value[CLAST_N_FORM_FACTOR + f] = is_known ? inverse : (double)NAN;
    }
}

const char *clast_form_feature_name(int32_t feature)
{
    if (feature < 0 || feature >= CLAST_N_FORM_FEATURE) {
        return NULL;
    }
    return feature < CLAST_N_FORM_FACTOR ? ENTRIES[feature].name
                                         : ENTRIES[feature - CLAST_N_FORM_FACTOR].inverse;
}

double clast_form_sieve_size(double i, double s)
{
    return sqrt(0.5 * (s * s + i * i));
}

void clast_form_lengths(double flatness, double elongation, double sieve_size, double lis[3])
{
    if (lis == NULL) {
        return;
    }
    const double i = sieve_size * sqrt(2.0 / (1.0 + flatness * flatness));
    lis[0] = i / elongation;
    lis[1] = i;
    lis[2] = i * flatness;
}

clast_zingg clast_form_zingg(double flatness, double elongation)
{
    if (isnan(flatness) || isnan(elongation)) {
        return CLAST_N_ZINGG;
    }
    const double border = 2.0 / 3.0 * (1.0 - ROUNDING); // a body's class is that of its copies
    const bool is_thick = flatness >= border;
    const bool is_wide = elongation >= border;
    if (is_wide) {
        return is_thick ? CLAST_ZINGG_SPHERE : CLAST_ZINGG_DISC;
    }
    return is_thick ? CLAST_ZINGG_ROD : CLAST_ZINGG_BLADE;
}

const char *clast_zingg_name(clast_zingg zingg)
{
    static const char *const names[CLAST_N_ZINGG] = {"sphere", "disc", "rod", "blade"};
    return (int)zingg >= 0 && zingg < CLAST_N_ZINGG ? names[zingg] : "-";
}
