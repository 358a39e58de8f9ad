#pragma once
// What a packing reads: sizes and shapes named in its configuration.
#include <clast/pack.h>

CLAST_BEGIN

/// What a configuration names, loaded. Owns what `input` points to.
typedef struct clast_pack_source {
    clast_curve curve;
    clast_grading *grading;
    int32_t n_shape;
    clast_shape *shape; ///< [n_shape]
    int32_t n_hull;
    clast_pack_hull *hull; ///< [n_hull] shapes that are hulls of surfaces, in their order
    clast_mesh container, container_closed;
    clast_pack_input input;
} clast_pack_source;

/// @return the reader's status, with the option and the file's name before its message
CLAST_API clast_status clast_pack_load(const clast_pack_config *config, clast_pack_source *source);
CLAST_API void clast_pack_unload(clast_pack_source *source); ///< may be called twice

/// Files that a configuration names: how many, and the i-th with its role ("shapes", "curve").
CLAST_API int32_t clast_pack_n_file(const clast_pack_config *config);
CLAST_API const char *clast_pack_file(const clast_pack_config *config, int32_t i,
                                      const char **role);

CLAST_END
