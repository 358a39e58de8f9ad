#pragma once
// The inside of a growing aggregate, for the files of this folder, from the bottom up: its state
// (state.c), what a grain adds (grains.c), rows and envelopes (measure.c), the two modes of growing
// (place.c on a core, cluster.c), growth (grow.c, restore.c). Calls go down only.
#include "aggregate/aim.h"
#include "aggregate/cluster.h"
#include "aggregate/envelope.h"
#include "aggregate/history.h"
#include "aggregate/march.h"
#include "aggregate/template.h"
#include "aggregate/trial.h"
#include "touch/scene.h"

/// What follows a placement and the next search does not need, so that it is done beside that: the
/// proof that nothing overlaps, the new grains' share of the envelopes, and what its row says of
/// them.
typedef struct clx_arrival {
    bool is_due;  ///< there is one
    bool is_done; ///< but for the row
    clx_search search;
    clx_placement placement;
    int32_t first; ///< new grain
    int64_t row;
    double overlap;
    clast_status status;
    char detail[512]; ///< the worker's message
} clx_arrival;

/// What the numbers of an aggregate are of.
typedef struct clx_measured {
    const clx_cluster *cluster; ///< NULL: all grains
    int32_t n_grain, n_contact, n_cluster;
    double mass, volume, gyration;
} clx_measured;

/// A way to grow: what growth on a core and growth of clusters do not share.
typedef struct clx_aggregate_mode {
    bool is_one_body; ///< all grains are one body, followed by one scene and one tracker
    /// Sets n_step; the configuration's counts are checked.
    clast_status (*plan)(clast_aggregate *a);
    /// The grains that growth starts with.
    clast_status (*begin)(clast_aggregate *a);
    /// One more particle, or one merger.
    clast_status (*step)(clast_aggregate *a);
    /// Ends what the last step left to be done beside the next, so that its row is whole; may be
    /// NULL.
    clast_status (*settle)(clast_aggregate *a);
    /// After the last step; may be NULL.
    void (*end)(clast_aggregate *a);
    clx_measured (*measured)(const clast_aggregate *a);
    /// Grains of an earlier run; the history is restored already.
    clast_status (*restore)(clast_aggregate *a, const clast_aggregate_saved *saved);
} clx_aggregate_mode;

extern const clx_aggregate_mode clx_aggregate_on_core;
extern const clx_aggregate_mode clx_aggregate_by_cluster;

struct clast_aggregate {
    const clx_aggregate_mode *mode;
    const clast_aggregate_params *params; ///< borrowed
    const clast_aggregate_input *input;   ///< borrowed
    int32_t repeat;
    uint64_t seed; ///< of this repeat
    bool random_axis;
    double axis[3];
    int32_t origin; ///< AUTO already resolved

    clx_templates templates;
    int32_t *shape_id; ///< [templates.n_shape] number of a shape of the templates in the assembly
    int32_t *template_shape; ///< [assembly.n_shape] the reverse
    double *size;            ///< [n_particle] m, in order of placement
    int32_t n_particle;
    int32_t n_step; ///< particles to place, or mergers
    int32_t n_core; ///< grains of the core

    clast_assembly assembly;
    clx_touch_scene *scene; ///< NULL in the march
    clx_march march;        ///< empty but in the march
    int64_t *sphere_end;    ///< [n_grain] running count of composite spheres
    int64_t sphere_capacity;
    int32_t n_placed;      ///< steps done: particles placed, or mergers
    clx_arrival arrival;   ///< of the last particle
    clx_clusters clusters; ///< cluster mode
    clx_history history;

    int32_t n_kind;
    clast_envelope_kind kind[CLAST_N_ENVELOPE];
    clx_envelope_tracker *tracker; ///< NULL in cluster mode

    double mass, volume;
    double bounding_radius; ///< every grain lies within this distance of the origin (core mode)
    double moment[3];       ///< sum of mass times position
    double second;          ///< sum of mass times (position squared + own mean square radius)
    clast_aggregate_stop stop;
    bool is_torn; ///< within a step that has begun to write; for good where that failed
    double contact_s, envelope_s, wall_s;
    double alone_s; ///< how long the last search took on one thread, or would have at most
};

/// state.c: empties the aggregate.
void clx_aggregate_free(clast_aggregate *a);

/// Coating shape and scale of a particle.
int32_t clx_aggregate_shape(const clast_aggregate *a, int32_t particle);
double clx_aggregate_scale(const clast_aggregate *a, int32_t particle, int32_t shape);

/// A grain of the assembly as contact sees it.
clx_touch_body clx_aggregate_body(const clast_aggregate *a, int32_t grain);

/// The cone of rays of the next step.
clx_aim clx_aggregate_aim(const clast_aggregate *a);

double clx_aggregate_gyration(const clast_aggregate *a);

/// A row of the sums as they are, without the envelopes.
clast_status clx_aggregate_open_row(clast_aggregate *a, double **row);

/// grains.c: adds the grains of a placed group: all three of the next.
clast_status clx_aggregate_add_group(clast_aggregate *a, int32_t group, const double centre[3],
                                     const double orientation[4], double scale);

/// Grains and contacts of a placed group join the assembly.
clast_status clx_aggregate_lay_group(clast_aggregate *a, int32_t group, const double centre[3],
                                     const double orientation[4], double scale);
/// Grains of the assembly from `first` on enter the scene and the sums.
clast_status clx_aggregate_account_all(clast_aggregate *a, int32_t first);
/// Grains of the assembly from `first` on are taken into the envelopes.
clast_status clx_aggregate_track(clast_aggregate *a, int32_t first);

/// All grains and contacts of an earlier run, in their order.
clast_status clx_aggregate_copy_grains(clast_aggregate *a, const clast_assembly *placed);

/// measure.c: envelopes: kinds, tracker and columns; a row's columns; the numbers at the end.
clast_status clx_aggregate_measure_begin(clast_aggregate *a);
clast_status clx_aggregate_measure_row(clast_aggregate *a, double *row);
clast_status clx_aggregate_measure_cluster(clast_aggregate *a, const clx_cluster *cluster,
                                           double *row);
struct clast_drag;
/// Terminal velocity in air of a body of these widths, and the drag that it has.
clast_status clx_aggregate_fall_speed(const double width[3], double diameter, double density,
                                      struct clast_drag *drag, double *velocity);
/// Terminal velocities in air of a body with the first envelope's volume and these widths.
clast_status clx_aggregate_measure_settling(const clast_aggregate *a, const clast_assembly *grains,
                                            const double width[3], clast_aggregate_result *result);
clast_status clx_aggregate_measure_end(const clast_aggregate *a, clast_aggregate_result *result);

/// A row of the sums as they are, with the envelopes.
clast_status clx_aggregate_add_row(clast_aggregate *a, double **row);

/// core.c: the core's grains and their row, or those of an earlier run.
clast_status clx_aggregate_begin_core(clast_aggregate *a);
clast_status clx_aggregate_restore_core(clast_aggregate *a, const clast_aggregate_saved *saved);
clx_measured clx_aggregate_measured_core(const clast_aggregate *a);

/// grow.c: templates, sizes, scene, columns; no grain yet.
clast_status clx_aggregate_begin(const clast_aggregate_params *params,
                                 const clast_aggregate_input *input, int32_t repeat,
                                 clast_aggregate *a);

/// Whether, after this step, growing ends.
clast_aggregate_stop clx_aggregate_stop_now(const clast_aggregate *a);
