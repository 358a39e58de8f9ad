#pragma once
// The two routines of LAPACKE that clast calls, for machines without a Fortran compiler.
// Column-major only; the same arguments, layout and info as LAPACK's; the last digits differ, as
// they do between any two LAPACKs.

typedef int lapack_int;

enum { LAPACK_COL_MAJOR = 102, LAPACK_WORK_MEMORY_ERROR = -1010 };

/// Eigenvalues w [n] ascending and vectors, the columns of a [n][n], of a symmetric matrix. jobz
/// 'V' only.
lapack_int LAPACKE_dsyev(int layout, char jobz, char uplo, lapack_int n, double *a, lapack_int lda,
                         double *w);

/// a [m][n], m >= n, becomes U of a = U diag(s) V'; s descending; vt [n][n]. jobz 'O' only.
lapack_int LAPACKE_dgesdd(int layout, char jobz, lapack_int m, lapack_int n, double *a,
                          lapack_int lda, double *s, double *u, lapack_int ldu, double *vt,
                          lapack_int ldvt);
