#pragma once
#include <clast/field.h>

CLAST_BEGIN

// Where a result came from: manifest.json of a run folder. It alone holds times and the host, so
// that all other files of two equal runs are equal byte for byte.

/// A manifest being gathered. Opaque; its creation is the run's start.
typedef struct clast_manifest clast_manifest;

/// Starts a manifest: the clocks run from here.
///
/// @param command  "aggregate"
/// @param argv     [argc] the command line as typed, copied; argc may be 0
CLAST_API clast_status clast_manifest_create(const char *command, int argc, char *const *argv,
                                             clast_manifest **manifest);
CLAST_API void clast_manifest_destroy(clast_manifest *manifest); ///< NULL is allowed

/// Keeps the full resolved configuration, SI, as the field table has it. Copied.
CLAST_API clast_status clast_manifest_config(clast_manifest *manifest, const clast_field *fields,
                                             const void *config);

/// Keeps the seed.
CLAST_API void clast_manifest_seed(clast_manifest *manifest, uint64_t seed);

/// Keeps an input file's role ("core"), path, size and SHA-256 (both null for a pipe, which is read
/// only once). CLAST_E_IO if it cannot be read.
CLAST_API clast_status clast_manifest_input(clast_manifest *manifest, const char *role,
                                            const char *path);

/// Keeps a text under a key of the caller's ("resumed_from"). CLAST_E_USAGE if the key is taken.
CLAST_API clast_status clast_manifest_note(clast_manifest *manifest, const char *key,
                                           const char *text);

/// Keeps the name of a file or folder that the run wrote.
CLAST_API clast_status clast_manifest_output(clast_manifest *manifest, const char *name);

/// Keeps how much of the run is done, 0 to 1; written while it is not done.
CLAST_API void clast_manifest_progress(clast_manifest *manifest, double share);

/// Writes the manifest, whole or not at all; may be called at the start and again at the end.
///
/// @param outcome  "running", "done", "stopped", "failed"; wall and CPU time are those until now
CLAST_API clast_status clast_manifest_write(const clast_manifest *manifest, const char *outcome,
                                            const char *path);

/// A configuration as one JSON object of SI values in table order; free it with clast_text_free.
CLAST_API clast_status clast_config_json(const clast_field *fields, const void *config,
                                         char **text);

/// Frees a text that the library made; NULL is allowed.
CLAST_API void clast_text_free(char *text);

/// SHA-256 of a file in 64 lower-case hexadecimal digits. CLAST_E_IO if it cannot be read.
CLAST_API clast_status clast_sha256_file(const char *path, char hex[65], int64_t *n_byte);

CLAST_END
