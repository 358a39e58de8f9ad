#pragma once
// Geometric questions whose answer is a sign, answered exactly for any doubles.
#include <stdint.h>

/// Which side of the plane (a, b, c) is d on? Exact sign of
///
///     det [ a - d ; b - d ; c - d ]
///
/// negative when a, b, c run counter-clockwise seen from d (d is above, outside an outward
/// triangle), positive when d is below, 0 only when the four points are coplanar.
/// The value itself has no stated accuracy beyond its sign. [Shewchuk1997 sec. 4.3]
double clx_orient3d(const double a[3], const double b[3], const double c[3], const double d[3]);

/// Exact sign of the doubled area of the plane triangle (a, b, c): positive when counter-clockwise.
double clx_orient2d(const double a[2], const double b[2], const double c[2]);

/// Steps of exact arithmetic, of some nanoseconds each, that these took in this thread so far: a
/// measure of time that is the same on any machine.
int64_t clx_exact_work(void);
