#pragma once
// Pairs of a run against the table of ranges. [docs/theory/agglomeration.md section 7]
#include <clast/agglomerate.h>

/// Rows of the table that the kernels and the sticking of a configuration have, as bits.
uint32_t clx_ranges_of(const clast_collide_config *config);

/// Those of them that one particle alone, held against its like, may break.
uint32_t clx_ranges_of_one(uint32_t rows);

/// Those of the speeds by which particles settle out of a box; none where a kernel of settling has
/// the same.
uint32_t clx_ranges_of_settling(const clast_collide_config *config);

/// Adds a pair of some weight.
void clx_range_add(uint32_t rows, const clast_collide_config *config, const clast_medium *medium,
                   const clast_collider pair[2], double weight, clast_range_use *use);
/// The report of a run that begins.
clast_range_report clx_range_begin(void);

/// Holds what a report has of the particles at the start, or of the collisions up to a time,
/// against the ranges: an error, or the time told.
clast_status clx_range_start(const clast_collide_config *config, clast_range_report *report);
clast_status clx_range_up_to(const clast_collide_config *config, double time,
                             clast_range_report *report);

void clx_range_merge(clast_range_use *into, const clast_range_use *from);

/// The share of a pair's impacts that stick, alpha apart.
double clx_sticking_of(const clast_collide_config *config, const clast_medium *medium,
                       const clast_collider *a, const clast_collider *b);

/// Whether no more than 0.1 % were outside.
///
/// @param of  what was seen, "of the particles at the start"
/// @return CLAST_E_CONFIG with the share and clast_range_use_words
clast_status clx_range_check(const clast_range_use *use, const char *of);

/// Whether rates of model kernels are bare or in m^d/s of this d: CLAST_E_CONFIG else.
clast_status clx_medium_check_dimension(const clast_medium *medium, int32_t d);
