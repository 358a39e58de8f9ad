#pragma once
// Expected counts of finitely many single particles in one well-mixed cell.
#include <stdbool.h>
#include <stdint.h>

/// True where clx_exact_counts knows them: one model kernel (1 constant, 2 additive, 4 product,
/// bits of clast_kernel_table), product of at most 500 particles.
bool clx_exact_counts_known(uint32_t kernel, double n);

/// Expected number of particles and of their sum of squared monomers (M2), of n single particles
/// after a time t.
///
/// @param tau  alpha K t / V, K the kernel's factor: the share of pairs of single particles that
///             meet [-]; V of the cell
void clx_exact_counts(uint32_t kernel, double n, double tau, double *number, double *m2);
