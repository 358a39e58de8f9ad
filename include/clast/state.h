#pragma once
#include <clast/assembly.h>
#include <clast/table.h>

CLAST_BEGIN

// A run's state in one HDF5 file: placed shapes, sphere fillings, tables, the configuration.
// The layout is in docs/theory/state-file.md; equal content gives equal bytes.

/// Spheres with the name they are kept under.
typedef struct clast_named_spheres {
    char *name; ///< not empty, without '/'
    clast_spheres spheres;
} clast_named_spheres;

/// What a state file holds; every part may be absent. Writing borrows it all.
typedef struct clast_state {
    clast_assembly *assembly; ///< or NULL
    int32_t n_spheres;
    clast_named_spheres *spheres; ///< [n_spheres]
    int32_t n_table;
    clast_table *table; ///< [n_table] names not empty, without '/'
    char *config;       ///< resolved configuration as JSON text, or NULL
    char unit[16];      ///< length unit; "" writes the assembly's, or "m"
    char version[32];   ///< reading: of the clast that wrote it
} clast_state;

/// Writes a state file: built in memory, checked by CRC-32 when read, whole or not at all.
///
/// @return CLAST_E_USAGE for a name that is empty, taken or has '/'; CLAST_E_DISK; CLAST_E_MEMORY
CLAST_API clast_status clast_state_write(const clast_state *state, const char *path);

/// Reads all of a state file into an empty state. Free it with clast_state_free.
///
/// @return CLAST_E_IO if missing; CLAST_E_FORMAT if damaged, cut short, of another schema or
/// inconsistent (indices, lengths, quaternions, signs are all checked)
CLAST_API clast_status clast_state_read(const char *path, clast_state *state);

/// The state's table of this name, or NULL. Lives as long as the state.
CLAST_API const clast_table *clast_state_table(const clast_state *state, const char *name);

/// Frees what clast_state_read made, the assembly too; may be called twice.
CLAST_API void clast_state_free(clast_state *state);

/// An assembly alone. `config` may be NULL.
CLAST_API clast_status clast_state_write_assembly(const char *path, const clast_assembly *assembly,
                                                  const char *config);

/// The assembly of a state file; CLAST_E_FORMAT if it has none.
CLAST_API clast_status clast_state_read_assembly(const char *path, clast_assembly *assembly);

/// One set of spheres alone.
CLAST_API clast_status clast_state_write_spheres(const char *path, const char *name,
                                                 const clast_spheres *spheres, const char *unit);

/// The named spheres of a state file; `name` NULL: the only ones. CLAST_E_FORMAT lists what is
/// there.
CLAST_API clast_status clast_state_read_spheres(const char *path, const char *name,
                                                clast_spheres *spheres);

/// The named table of a state file.
CLAST_API clast_status clast_state_read_table(const char *path, const char *name,
                                              clast_table *table);

CLAST_END
