#pragma once
// Walls of a packing that move, are pressed, or open; outlets. [docs/theory/load.md "Walls"]
#include "pack/load.h"
#include "pack/pack.h"

enum { CLX_WALL_PATH = 1024, CLX_MOST_DRIVES = 8 };

/// A wall as its option says.
typedef struct clx_wall_words {
    clast_pack_wall wall;      ///< but for its surface and its table
    char file[CLX_WALL_PATH];  ///< empty: a wall of the domain
    char unit[16];             ///< of that file
    char table[CLX_WALL_PATH]; ///< empty: none
    const char *idle;          ///< what is wrong with a word that undoes another, or NULL
    char idle_word[16];
    uint32_t given; ///< bits: 0 press, 1 area, then those of the motion
} clx_wall_words;

/// Reads option `wall` number i. CLAST_E_CONFIG names it and what is wrong.
clast_status clx_wall_read(const clast_pack_config *config, int32_t i, clx_wall_words *out);

/// Refuses words of walls that do nothing: given twice, or to be pressed by no stage.
clast_status clx_walls_check_idle(const clast_pack_config *config, const clast_pack_input *input);

/// Number of a wall of the domain among the simulation's, or -1; the direction into the domain.
int32_t clx_wall_of_domain(const clast_dem_config *config, const char *name, double inward[3]);

/// The words of a text, one after the other; NULL when there is no more. One that is too long is
/// cut, and ends in ~.
const char *clx_next_word(const char *text, char *word, size_t size);

typedef enum {
    CLX_WALL_RUNS,    ///< by its own motion
    CLX_WALL_PRESSED, ///< by a pressure or force
    CLX_WALL_SPEED,   ///< along its direction
    CLX_WALL_OPENS
} clx_wall_drive_kind;

typedef struct clx_wall_drive {
    int32_t wall; ///< of the options
    clx_wall_drive_kind kind;
    bool is_force; ///< aim is a force [N], else a pressure [Pa]
    double aim;    ///< [Pa], [N] or [m/s]
} clx_wall_drive;

typedef enum {
    CLX_UNTIL_REST,
    CLX_UNTIL_TIME,
    CLX_UNTIL_STRESS,
    CLX_UNTIL_WAY,
    CLX_UNTIL_MASS
} clx_wall_end;

/// A stage of a bed between walls.
typedef struct clx_wall_stage {
    int32_t n;
    clx_wall_drive drive[CLX_MOST_DRIVES];
    clx_wall_end end;
    double until;
} clx_wall_stage;

clast_status clx_wall_stage_read(const clast_pack_config *config, int32_t number,
                                 const clast_pack_input *input, clx_wall_stage *stage);

/// Bits of clx_wall_words.given, press and area, that a stage looks at for a wall of the options.
clast_status clx_wall_stages_use(const clast_pack_config *config, const clast_pack_input *input,
                                 int32_t wall, uint32_t *used);

/// Refuses a wall whose own motion no stage runs.
clast_status clx_wall_stages_run_all(const clast_pack_config *config,
                                     const clast_pack_input *input);

/// Whether a packing has walls, outlets or stages between walls.
bool clx_pack_has_walls(const clast_pack_config *config);

/// Adds the walls to the simulation; then, with its contact laws, refuses ones that are too fast,
/// and stages that are none.
clast_status clx_pack_walls_begin(clast_pack *pack);
clast_status clx_pack_walls_check(const clast_pack *pack);

/// Every CLX_SERVO_STEPS while stages go on.
clast_status clx_pack_walls_look(clast_pack *pack);
clast_status clx_pack_walls_stage(clast_pack *pack, int32_t stage);

/// Takes out the grains beyond an outlet, where it is time to look.
clast_status clx_pack_outlets(clast_pack *pack);

/// walls.csv.
clast_status clx_pack_walls_table(clast_pack *pack);
clast_status clx_pack_walls_row(clast_pack *pack);
