#pragma once
// What the keys and columns of a run mean, and numbers as people read them.
#include <stdbool.h>

typedef struct clx_file clx_file;

enum { CLX_QUANTITY_SIZE = 128, CLX_UNIT_SIZE = 64 };

#define CLX_MODEL_UNITS "model units:"

typedef struct clx_quantity {
    char label[CLX_QUANTITY_SIZE]; ///< "" for an unknown key
    const char *unit;              ///< SI unit; "" for none
    const char *words;             ///< of the numbers 0, 1, ... as "no|yes"; "" for none
    bool is_headline;              ///< one of the few large figures at the top
} clx_quantity;

/// The quantity of a key of summary.json or of a column ("size_m", "porosity_surface_hull",
/// "interval.d_agg.low"); its unit is the one that the name ends in, if any.
///
/// @param place  table, list or command that holds the key, where keys mean something else there;
///               the key of a quantity, whose unit its mean, deviation, low and high have; NULL; or
///               any of these after CLX_MODEL_UNITS, where lengths are in the unit of a file that
///               does not tell it
clx_quantity clx_quantity_of(const char *key, const char *place);

/// The unit of a run whose lengths are in the unit of a file that does not tell it: "m^3" ->
/// "model units^3"; others as they are.
const char *clx_quantity_model_unit(const char *si_unit);

/// Unit as a page shows it: "kg/m^3" -> "kg/m³", "um" -> "µm", "-" -> "".
void clx_quantity_show_unit(const char *si_unit, char out[CLX_UNIT_SIZE]);

/// A unit to show, and how many of them are one SI unit.
typedef struct clx_quantity_scale {
    double factor;
    char name[CLX_UNIT_SIZE];
    bool has_floor; ///< values below a thousandth are rounding errors, not quantities
} clx_quantity_scale;

/// The unit in which `value` of this SI unit reads best: 0.000675 "m" -> 1e6, "µm".
clx_quantity_scale clx_quantity_scale_for(double value, const char *si_unit);

/// Value in that unit with four digits: "675.0", "1.200 × 10⁻⁵", "< 0.001".
void clx_quantity_format(double value, const clx_quantity_scale *scale,
                         char text[CLX_QUANTITY_SIZE]);

/// The label, or the key itself as code when it is not known.
void clx_quantity_write_label(clx_file *file, const char *key, const char *place);

/// The label of a key that names a row, with the unit that it ends in: "Sieve size (m)".
void clx_quantity_write_name(clx_file *file, const char *key);

/// Writes value and unit with the full value as a tooltip; nothing but a dash for nan and inf.
void clx_quantity_write(clx_file *file, double value, const char *si_unit);

/// The same in the unit in which `like` reads best: a row's numbers share one.
void clx_quantity_write_like(clx_file *file, double value, const char *si_unit, double like);

/// Writes the word of the number, "2" of "no|yes" as the number itself.
void clx_quantity_write_word(clx_file *file, double value, const char *words);
