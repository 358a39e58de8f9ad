// Colour sets: Okabe and Ito for categories, viridis for sequences.
#include "math/colour.h"

#include <math.h>
#include <string.h>

void clx_colour_category(int index, double rgb[3])
{
    // Okabe and Ito 2008, "Color universal design"; black last, so that the first lines of a chart
    // carry colour.
    static const double set[CLX_N_COLOUR][3] = {
        {0.000, 0.447, 0.698}, {0.835, 0.369, 0.000}, {0.000, 0.620, 0.451}, {0.800, 0.475, 0.655},
        {0.902, 0.624, 0.000}, {0.337, 0.706, 0.914}, {0.000, 0.000, 0.000}, {0.941, 0.894, 0.259}};
    static const double grey[3] = {0.45, 0.45, 0.45};
    memcpy(rgb, index < 0 ? grey : set[index % CLX_N_COLOUR], 3 * sizeof *rgb);
}

void clx_colour_sequence(double t, double rgb[3])
{
    // viridis (van der Walt and Smith 2015, CC0) at t = i / 15
    static const double map[16][3] = {
        {0.267, 0.005, 0.329}, {0.283, 0.100, 0.422}, {0.277, 0.185, 0.490}, {0.254, 0.265, 0.530},
        {0.221, 0.338, 0.549}, {0.191, 0.407, 0.556}, {0.164, 0.471, 0.558}, {0.138, 0.537, 0.555},
        {0.120, 0.603, 0.542}, {0.134, 0.669, 0.512}, {0.208, 0.731, 0.459}, {0.328, 0.788, 0.382},
        {0.478, 0.835, 0.291}, {0.647, 0.872, 0.191}, {0.824, 0.896, 0.107}, {0.993, 0.906, 0.144}};
    const double s = fmin(fmax(t, 0.0), 1.0) * 15.0;
    const int i = s >= 15.0 ? 14 : (int)s;
    for (int k = 0; k < 3; ++k) {
        rgb[k] = map[i][k] + (s - i) * (map[i + 1][k] - map[i][k]);
    }
}

void clx_colour_diverging(double t, double rgb[3])
{
    static const double end[2][3] = {{0.000, 0.300, 0.600}, {0.780, 0.250, 0.000}};
    const double s = fmin(fmax(t, 0.0), 1.0);
    const double amount = fabs(2.0 * s - 1.0);
    for (int k = 0; k < 3; ++k) {
        rgb[k] = 1.0 + amount * (end[s > 0.5 ? 1 : 0][k] - 1.0);
    }
}
