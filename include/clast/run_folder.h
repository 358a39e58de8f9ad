#pragma once
#include <clast/field.h>
#include <clast/status.h>

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

/// Writes the manifest, whole or not at all; may be called at the start and again at the end.
///
/// @param outcome  "running", "done", "stopped", "failed"; wall and CPU time are those until now
CLAST_API clast_status clast_manifest_write(const clast_manifest *manifest, const char *outcome,
                                            const char *path);

/// A configuration as one JSON object of SI values in table order; free it with clast_text_free.
CLAST_API clast_status clast_fields_json(const clast_field *fields, const void *config,
                                         char **text);

/// Frees a text that the library made; NULL is allowed.
CLAST_API void clast_text_free(char *text);

/// SHA-256 of a file in 64 lower-case hexadecimal digits, or "" and 0 bytes for a pipe or a device,
/// which is read only once. CLAST_E_IO if it cannot be read.
CLAST_API clast_status clast_sha256_file(const char *path, char hex[65], int64_t *n_byte);

/// Refuses ranks that read different things, as from copies on their own disks: options, or files
/// by their SHA-256. A file that a rank has not (or a pipe) passes. Called by all ranks before they
/// begin; does nothing for one.
///
/// @param comm  NULL for one rank    @param file  paths [n_file]
/// @return CLAST_E_FORMAT on all ranks, with one line that names a rank and the option or file
CLAST_API clast_status clast_run_inputs_agree(const clast_comm *comm, const clast_field *fields,
                                              const void *config, int32_t n_file,
                                              const char *const *file);

// A run's folder, taken and closed in one way by every command:
//
//     begin    refuses a folder that holds a run, unless force is set or that run was of the same
//              command and cut off with nothing but its manifest written
//     manifest, input: what the run is and what it reads
//     open     makes the folder; from here on it holds a run that has not ended
//     path     where the files go
//     summary  the last of them
//     end      done, stopped or failed
//
// With force the new run is made in FOLDER.new and changes places with the old one when it has
// succeeded; until then the old one is whole. Files that are not the old run's own end up in the
// new folder.

/// A run's folder under way. Opaque; one thread at a time.
typedef struct clast_run_folder clast_run_folder;

enum { CLAST_RUN_PATH = 4096 };

/// Takes a folder for a run and starts its clocks; nothing is written yet.
///
/// @param command  "pack"    @param monitor  its command line goes to the manifest; NULL: none
/// @return CLAST_E_USAGE when the folder holds a run, ended or not, and force is not set, or when
///         the run in it cannot be replaced; CLAST_E_DISK when it cannot be made or written into,
///         or another process is at it (its number, host and start are in the message)
CLAST_API clast_status clast_run_folder_begin(const char *folder, bool force, const char *command,
                                              const clast_monitor *monitor, clast_run_folder **run);
CLAST_API void clast_run_folder_destroy(clast_run_folder *run); ///< NULL is allowed

/// The run's manifest, borrowed: give it configuration and seed before open.
CLAST_API clast_manifest *clast_run_folder_manifest(clast_run_folder *run);

/// As clast_manifest_input; CLAST_E_USAGE when the file is part of the run that is to be replaced.
CLAST_API clast_status clast_run_folder_input(clast_run_folder *run, const char *role,
                                              const char *path);

/// Makes the folder and its manifest.json ("running").
CLAST_API clast_status clast_run_folder_open(clast_run_folder *run);

/// The folder that the run's files go to; borrowed. After end it is the one that was asked for.
CLAST_API const char *clast_run_folder_path(const clast_run_folder *run);

/// The path of a file in it.
CLAST_API clast_status clast_run_folder_file(const clast_run_folder *run, const char *name,
                                             char path[CLAST_RUN_PATH]);

/// Writes its summary.json, whole or not at all: a text of JSON and a newline. CLAST_E_DISK.
CLAST_API clast_status clast_run_folder_summary(const clast_run_folder *run, const char *text);

/// Ends the run with the status of its work, which is returned (CLAST_OK: or why the folder could
/// not be closed). A run that was not opened leaves nothing.
///
/// @param run  NULL is allowed
CLAST_API clast_status clast_run_folder_end(clast_run_folder *run, clast_status status);

/// For readers: CLAST_OK when the folder holds a whole run, or a study, else CLAST_E_IO with one
/// line that says what it holds: "RUN: stopped at 49 %, go on with clast pack --resume RUN".
CLAST_API clast_status clast_run_folder_check(const char *folder);

/// Refuses an output that is there as part of a run: its folder, or one above it, holds the run
/// that wrote it. A page (report.html) can be made again at any time and is not.
///
/// @param option  what names the output, for the message: "-o", "output"
/// @return CLAST_E_USAGE
CLAST_API clast_status clast_run_folder_check_output(const char *option, const char *path);

/// Refuses an output that is this input, or the folder that holds it, whatever the spelling or
/// link.
///
/// @param input  a file or folder, which need not be there; "list:FILE" names one as FILE does
/// @return CLAST_E_USAGE
CLAST_API clast_status clast_run_folder_check_input(const char *option, const char *path,
                                                    const char *input);

/// Whether two paths are one place, whatever their spelling and links, where nothing need be yet.
CLAST_API bool clast_run_folder_is_same(const char *path, const char *other);

/// The state file that a command's argument means: a run folder's state.h5, else the argument
/// itself.
///
/// @return CLAST_E_IO as clast_run_folder_check, and for a run that has no grains
CLAST_API clast_status clast_run_folder_state(const char *argument, char path[CLAST_RUN_PATH]);

CLAST_END
