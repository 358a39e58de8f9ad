#pragma once
// Colours that colour-blind readers can tell apart, shared by charts and pictures.
#include "base/status.h"

enum { CLX_N_COLOUR = 8 };

/// Categorical set of Okabe and Ito (2008), sRGB 0..1; index modulo 8, -1 gives grey.
CLX_SHARED void clx_colour_category(int index, double rgb[3]);

/// Sequential map, dark blue through green to yellow, perceptually even (viridis sampled at 16
/// points); t in [0, 1].
CLX_SHARED void clx_colour_sequence(double t, double rgb[3]);

/// Diverging map, blue through white to red (Okabe and Ito's blue and vermilion); t in [0, 1],
/// white at 1/2.
CLX_SHARED void clx_colour_diverging(double t, double rgb[3]);
