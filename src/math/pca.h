#pragma once
// Principal components of a symmetric matrix by LAPACK.
#include <clast/status.h>

/// Eigenvalues (falling) and unit eigenvectors of a symmetric n x n matrix; row k of `vector`
/// belongs to value k and its entry of largest size is positive, so that equal matrices give equal
/// vectors.
///
/// @return CLAST_E_CONVERGE if LAPACK's dsyev gives up; CLAST_E_MEMORY
clast_status clx_symmetric_eigen(const double *matrix, int32_t n, double *value, double *vector);
