#pragma once
// Stages that load a bed in a periodic cell, one after the other.
#include "pack/pack.h"

/// Steps between two looks of the servo, and those in which a stress comes near its aim by 1/e.
enum { CLX_SERVO_STEPS = 25, CLX_SERVO_TIME = 10 * CLX_SERVO_STEPS };

/// What a side of the cell is driven by.
typedef enum { CLX_DRIVE_NONE, CLX_DRIVE_RATE, CLX_DRIVE_STRESS } clx_drive_kind;

typedef enum { CLX_END_REST, CLX_END_STRAIN, CLX_END_STRESS, CLX_END_TIME } clx_end_kind;

typedef struct clx_stage {
    clx_drive_kind kind[3];
    double aim[3]; ///< strain rate, > 0 in compression [1/s]; or pressure [Pa]
    clx_drive_kind shear_kind;
    double shear; ///< rate of shear strain [1/s], or the stress that drives it [Pa]
    clx_end_kind end;
    double until; ///< strain, pressure [Pa], or time [s]
} clx_stage;

/// Reads the words of a stage. CLAST_E_CONFIG names it, by its number, and what is wrong.
clast_status clx_stage_read(const clast_pack_config *config, int32_t number, clx_stage *stage);

/// Refuses stages that are none, or faster than contacts allow; begins the first.
clast_status clx_pack_load_check(const clast_pack *pack);
clast_status clx_pack_load_begin(clast_pack *pack);

/// Speed at which the softest contact still stops a grain of this bounding radius within half of
/// it, without its dashpot [m/s].                        [docs/theory/dem.md "When a run explodes"]
double clx_pack_stopped_speed(const clast_pack *pack, double radius, double mass);

/// Half of that for the smallest grains [m/s].
double clx_pack_speed_limit(const clast_pack *pack);

/// Every CLX_SERVO_STEPS: sets the cell's rates; goes to the next stage, or is done.
clast_status clx_pack_load_look(clast_pack *pack);

/// The table of what the bed carries: load.csv.
bool clx_pack_has_load(const clast_pack_config *config);
clast_status clx_pack_load_table(clast_pack *pack);
clast_status clx_pack_load_row(clast_pack *pack);
