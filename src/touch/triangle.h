#pragma once
// First touch of two triangles, and of a ball and a triangle: the closed forms at the leaves.
#include <stdbool.h>

/// When two things that pass on a line begin and end to touch, and which features begin.
typedef struct clx_pass {
    double first;
    double last;
    int kind; ///< private: the pair of features
    int i, j; ///< private: their numbers
} clx_pass;

/// Triangle b moves along +z past triangle a. False if they miss by more than `slack`.
///
/// Both are seen along z: where their shadows overlap, the gap is linear, so its extremes lie at
/// the corners of the overlap: corners of one inside the other and crossings of edges. Sideways
/// errors up to `slack` are allowed, so that a corner on an edge within rounding is never
/// lost between two triangles. [docs/theory/first-touch.md eq. 10-13]
bool clx_triangles_pass(double a[3][3], double b[3][3], double slack, clx_pass *pass);

/// Where they begin to touch: the point on a, the normal (not unit, either sense; 0 where the
/// features have none).
void clx_triangles_contact(double a[3][3], double b[3][3], const clx_pass *pass, double point[3],
                           double normal[3]);

/// A ball with centre c + t w passes triangle a that lies still; w need not be unit. False if it
/// misses. [eq. 14-16]
bool clx_ball_triangle_pass(double a[3][3], const double c[3], const double w[3], double radius,
                            clx_pass *pass);

/// Point of triangle a closest to the ball's centre at pass->first, by the feature that touches.
void clx_ball_triangle_contact(double a[3][3], const double c[3], const double w[3],
                               const clx_pass *pass, double point[3]);
