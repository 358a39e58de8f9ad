#pragma once
// Symmetric 3x3 eigen-problems, called millions of times: no allocation, no failure.

/// Eigenvalues, greatest first, and unit eigenvectors (vector[k] belongs to value[k]; the three are
/// a right-handed frame) of the symmetric matrix whose upper part is given.
///
/// Cyclic Jacobi rotations on the matrix scaled by its greatest entry. Errors are a few 1e-16 of
/// the greatest eigenvalue, also for equal and nearly equal ones.        [GolubVanLoan2013 8.5]
void clx_sym3_eigen(double a[3][3], double value[3], double vector[3][3]);
