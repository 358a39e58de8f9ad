#pragma once
// A packing under way.
#include "base/status.h"
#include <clast/mesh.h>
#include <clast/pack.h>

/// A grain before it is made.
typedef struct clx_pack_number {
    int64_t index; ///< of the seed's grains
    int32_t form;  ///< shape of the simulation that was made for it, or -1
} clx_pack_number;

/// Where the stages of a load are.
typedef struct clx_pack_loading {
    clast_table table; ///< load.csv
    int32_t stage;
    int64_t begun;             ///< step at which the stage began
    double strain[3], sheared; ///< of the cell then
    double steady[4];          ///< strain rates that the servo has come to; of shear [1/s]
    bool is_over;
    bool has_rested; ///< the last stage ended at rest
} clx_pack_loading;

/// A wall of the simulation, as its stages and table see it.
typedef struct clx_pack_wall {
    const char *name;  ///< borrowed
    int32_t option;    ///< number of its option `wall`, or -1
    double steady;     ///< speed that the servo has come to [m/s]
    double impulse[3]; ///< at the last look
    double begun[3];   ///< offset when the stage began
    double row[6];     ///< impulse and moment at the last row
} clx_pack_wall;

/// A half-space whose grains leave: sign (x - at) < 0; how many have.
typedef struct clx_pack_outlet {
    int axis;
    double sign, at;
    int64_t n;
    double mass;
} clx_pack_outlet;

struct clast_pack {
    clast_pack_config config; ///< borrowed texts and lists
    clast_pack_input input;   ///< borrowed
    clast_dem *dem;
    double (*unit_size)[2]; ///< [n_shape] size and volume at scale 1
    double *weight;         ///< [n_shape] running sums, last 1
    double spacing;
    clast_bvh *inside;   ///< of the container, or NULL
    bool is_held;        ///< the container is closed
    double base, height; ///< lowest height, and H above it
    double middle[2];    ///< of the domain
    double widest;       ///< greatest diameter of a grain's sphere over its size
    // what a checkpoint keeps beside the dem
    clast_pack_phase phase;
    int64_t n_made;
    double mass;
    int64_t n_drawn;   ///< grains made, and those that wait
    double drawn_mass; ///< of these
    int32_t n_waiting, n_outlet;
    clx_pack_number *waiting; ///< [n_waiting] found no place in the fills so far
    int64_t waiting_capacity;
    int64_t n_waited; ///< grains that had to wait
    int32_t n_fill, n_wall;
    int64_t fill_step;  ///< of the last fill
    int64_t phase_step; ///< when the phase began
    double last_height; ///< at the last look
    bool converged;
    double grain_steps, clocked_steps;
    clast_table series;
    clx_pack_loading load;
    clx_pack_wall *wall;             ///< [n_wall] of the simulation
    clast_table walls;               ///< walls.csv
    int64_t walls_looked, walls_row; ///< steps of the last look, of the last row
    clx_pack_outlet *outlet;         ///< [n_outlet]
    int64_t n_left;                  ///< grains that have left
    double mass_left;
    int64_t n_overlap;     ///< of a start
    double deepest;        ///< of those, over the smaller one's radius
    double step_s, wall_s; ///< clocks, which no result depends on
};

/// Sieve size of eq. 1 (meaning 0), or the volume-equivalent diameter.
double clx_pack_size_of(const clast_shape *shape, int32_t meaning);

/// Density of grain `index` of an input's shape and this size: a function of the seed.
double clx_pack_density(const clast_pack *pack, int64_t index, int32_t shape, double size);

/// Least and greatest density of the grains.
void clx_pack_densities(const clast_pack *pack, double *low, double *high);

/// Refuses options that contradict one another.
clast_status clx_pack_check(const clast_pack_config *config);

/// Refuses options that a run of these grains would not look at.
clast_status clx_pack_check_idle(const clast_pack_config *config, const clast_pack_input *input);

/// Refuses options of files where there is no folder for them.
CLX_SHARED clast_status clx_pack_check_lone(const clast_pack_config *config);

/// As clast_pack_create, of a run that goes on: options that it began with are taken as they are.
CLX_SHARED clast_status clx_pack_create_again(const clast_pack_config *config,
                                              const clast_pack_input *input, clast_pack **pack);

/// Refuses densities that do not match shapes, classes or list.
clast_status clx_pack_check_densities(const clast_pack *pack);

/// What is drawn for a grain, ready but for its place: size, shape, turn, velocities. Makes the
/// form that it needs, unless it has one.
clast_status clx_pack_draw(clast_pack *pack, clx_pack_number *number, clast_dem_grain *grain);

/// Refuses a seed that draws a grain too large for the domain, before hours are spent on others.
/// Forms of a law are measured without being made.
clast_status clx_pack_check_draws(clast_pack *pack);

/// All grains of a new cell at once; then its stages begin. Does nothing elsewhere.
CLX_SHARED clast_status clx_pack_fill_cell(clast_pack *pack);

/// Makes one fill of grains; mass and n_made follow.
clast_status clx_pack_fill(clast_pack *pack);

/// Height under which the fill lies.
double clx_pack_fill_low(const clast_pack *pack);

/// Sizes, weights and lattice from configuration and input.
clast_status clx_pack_prepare(clast_pack *pack);

/// Walls and room of the container, where there is one; else of the domain.
clast_status clx_pack_contain(clast_pack *pack);

/// Refuses to move the container, or to give it contacts of its own, where its bottom lies in the
/// floor and would stay behind.
clast_status clx_pack_check_bottom(const clast_pack_config *config, const clast_pack_input *input);

/// Whether a sphere lies in the container; true without one.
bool clx_pack_holds(const clast_pack *pack, const double x[3], double radius);

/// Grains whose centre is outside; *first is one of them, or -1.
int32_t clx_pack_n_outside(const clast_pack *pack, int32_t *first);

/// Sets what acts in the phase.
void clx_pack_drive(clast_pack *pack);

/// The usual density where none is given.
CLX_SHARED void clx_pack_set_density(clast_pack_config *config);

/// Of the first aggregate that is packed at another density than its own that one, and the other;
/// zeros where there is none.
void clx_pack_own_density(const clast_pack *p, double *own, double *given);

/// Contacts by materials, where walls are; nothing without option contacts.
clast_status clx_pack_materials_begin(clast_pack *pack);

clast_status clx_pack_series_begin(clast_pack *pack);
clast_status clx_pack_series_row(clast_pack *pack);

/// A row of each table over time for the step at hand, where there is none.
CLX_SHARED clast_status clx_pack_rows(clast_pack *pack);

/// Spreads its grains over ranks from the next step on; called by all, as all of its functions then
/// are. Before the state is read or written, clx_pack_gather brings it to rank 0.
CLX_SHARED clast_status clx_pack_share(clast_pack *pack, const clast_comm *comm);
CLX_SHARED clast_status clx_pack_gather(clast_pack *pack);

/// What went between ranks so far.
CLX_SHARED void clx_pack_count_ranks(const clast_pack *pack, clast_pack_ranks *ranks);
