#pragma once
// Whether a sample resolves its own structure, and the integral of its squared density.
#include "cloud/pair_levels.h"

#define CLX_NORMAL_975  1.959963984540054
#define CLX_MOST_BIAS   0.02  ///< of what is called resolved
#define CLX_MOST_FACTOR 100.0 ///< times the points: what more a sample asks for, it cannot tell

typedef struct clx_resolution {
    double value;     ///< sum over pairs per volume: n (n - 1) times the integral; where resolved
    double low, high; ///< 95 %; not resolved: low alone holds, at 97.5 %, and high is INFINITY
    bool resolved;
    double n_factor;  ///< so many times the points would resolve it: 1 where it is resolved,
                      ///< INFINITY where that cannot be told
    int32_t halvings; ///< of the cells whose pairs decide
    bool is_repeated; ///< repeated points make up so many pairs that there is no lower bound: NAN
    bool is_by_pairs; ///< by pairs of all distances instead
    bool is_apart;    ///< points keep apart: pairs in small cells tell nothing of their density
} clx_resolution;

/// Reads the levels. [docs/theory/decompose.md section 8]
clx_resolution clx_resolution_of(const clx_pair_levels *levels);

/// Whether a value that pairs of all distances gave may stand beside the levels: no level lies
/// higher, what a halving adds has begun to fall, and points do not keep apart.
///
/// @param value  as clx_resolution's
bool clx_resolution_allows(const clx_pair_levels *levels, double value);

/// How many times the pairs per volume are that they were, by the finest cells that have 500 pairs
/// in both; NAN where none have.
double clx_resolution_change(const clx_pair_levels *before, const clx_pair_levels *now);
