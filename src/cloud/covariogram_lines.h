#pragma once
// Quasi-random uniform lines through a closed surface or a half pipe.
#include "base/status.h"
#include <clast/cloud.h>

enum { CLX_MOST_CROSSING = 64, CLX_MOST_SEQUENCE = 7 };

/// Numbers of the generalised golden ratio: the sequence frac(shift + k g^-j). [Roberts2018]
typedef struct clx_sequence {
    int n;
    double shift[CLX_MOST_SEQUENCE], step[CLX_MOST_SEQUENCE];
} clx_sequence;

/// @param number  of its random shift    @param n  numbers a point: 3, 4, 5 or 7
clx_sequence clx_sequence_at(int64_t number, int n);

/// The k-th point of the unit cube.
void clx_sequence_point(const clx_sequence *q, int64_t k, double *u);

/// What lines enter by. {0} is empty.
typedef struct clx_lines {
    const clast_domain *domain; ///< borrowed
    double area;
    double *area_to; ///< [n_tri] of a mesh: summed areas
} clx_lines;

/// A line from its entry on.
typedef struct clx_line {
    double x[3], direction[3];
    int n; ///< of t: 0 where it only grazes
    double t[CLX_MOST_CROSSING];
} clx_line;

/// A domain without a surface to enter by, such as a map, has the area 0.
clast_status clx_lines_init(const clast_domain *domain, clx_lines *lines);
void clx_lines_free(clx_lines *lines);

/// A line by a point u of the unit cube; t are its crossings behind the entry, out, in, out ..: as
/// far as pairs within `distance` need.
void clx_line_at(const clx_lines *lines, const double u[4], double distance, clx_line *line);
