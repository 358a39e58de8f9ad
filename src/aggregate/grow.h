#pragma once
// The inside of a growing aggregate, for the files of this folder.
#include "aggregate/history.h"
#include "aggregate/kit.h"
#include "contact/touch_scene.h"

struct clast_aggregate {
    const clast_aggregate_config *config; ///< borrowed
    const clast_aggregate_input *input;   ///< borrowed
    int32_t repeat;
    uint64_t seed; ///< of this repeat
    bool random_axis;
    double axis[3];
    int32_t origin; ///< AUTO already resolved

    clx_kit kit;
    int32_t *shape_id; ///< [kit.n_shape] number of a kit's shape in the assembly
    double *size;      ///< [n_particle] m, in order of placement
    int32_t n_particle;
    int32_t n_core; ///< grains of the core

    clast_assembly assembly;
    clx_touch_scene *scene;
    int64_t *sphere_end; ///< [n_grain] running count of composite spheres
    int64_t sphere_room;
    int32_t n_placed;
    clx_history history;

    double mass, volume;
    double moment[3]; ///< sum of mass times position
    double second;    ///< sum of mass times (position squared + own mean square radius)
    double max_overlap, max_overlap_relative;
    clast_aggregate_stop stop;
    double contact_s, envelope_s, wall_s;
};

/// Coating shape and scale of a particle.
int32_t clx_aggregate_shape(const clast_aggregate *a, int32_t particle);
double clx_aggregate_scale(const clast_aggregate *a, int32_t particle, int32_t shape);
