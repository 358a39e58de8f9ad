#pragma once
// One subcommand: a field table, positional arguments and a function that calls the library.
#include <clast/clast.h>

/// What every command understands besides its own fields.
typedef struct cli_common {
    const char *output;     ///< -o PATH, or NULL
    int32_t threads;        ///< -j N; 0: one per core
    const char *max_memory; ///< --max-memory SIZE, or NULL
    const char *time_limit; ///< --time-limit TIME, or NULL
    bool json;              ///< one JSON object on stdout
    bool quiet;             ///< no progress on stderr
    int32_t n_argument;     ///< positional arguments
    char **argument;        ///< borrowed from argv
    const char *command;    ///< "mesh check"
    int32_t n_word;         ///< the whole command line
    char *const *word;      ///< [n_word] borrowed from argv
    const clast_comm *comm; ///< ranks that run this command together; rank 0 speaks for all
} cli_common;

typedef struct cli_command {
    const char *name;          ///< "mesh check"
    const char *arguments;     ///< "FILE [FILE...]"; "" for none
    const char *summary;       ///< one line
    const char *details;       ///< more lines for --help-all, definitions and sources, or NULL
    const char *example[3];    ///< whole command lines, from the root of a clone
    const clast_field *fields; ///< own options; NULL for none
    size_t config_size;        ///< bytes of the configuration struct
    int32_t n_min, n_max;      ///< positional arguments allowed
    bool writes_folder;        ///< -o names a run folder
    bool writes_either;        ///< -o names a file, or a folder of several
    bool shares_ranks;         ///< several ranks may run it together
    bool writes_no_file;       ///< all it has goes to stdout: -o is refused
    bool needs_file;           ///< -o names the file that it writes
    bool writes_no_data;       ///< what it prints is no data: --json is refused
    /// Changes the defaults before anything is read, or NULL.
    void (*prepare)(void *config);
    clast_status (*run)(const cli_common *common, void *config);
} cli_command;

/// Whether a study can run it: each run prints numbers, as JSON.
bool cli_runs_in_studies(const cli_command *command);

/// Finds the command that argv names and runs it on every rank: returns the exit code.
int cli_main(int argc, char **argv, const clast_comm *comm);

/// Parses what follows the command's n_skip words in argv ("clast mesh check") and runs the
/// command: returns the exit code; the error's one line goes to stderr.
int cli_run(const cli_command *command, int n_skip, int argc, char **argv, const clast_comm *comm);

/// What all ranks make of a step that ended so on this one; the line to print becomes the same too.
clast_status cli_agree(const cli_common *common, clast_status status);

/// A command's own refusal: keeps one line (printf style) for the frame to print, returns `status`.
clast_status cli_fail(clast_status status, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

// A function of the command fails as one of the library does: one status, one `done:` that frees
// what it holds, or an early end where it holds nothing.

/// Ends the function at `done:` with a refusal (printf style) unless the condition holds.
#define CLI_CHECK(condition, code, ...)                                                            \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            status = cli_fail(code, __VA_ARGS__);                                                  \
            goto done;                                                                             \
        }                                                                                          \
    } while (0)

/// Ends the function at `done:` with the status of a call that fails.
#define CLI_TRY(call)                                                                              \
    do {                                                                                           \
        status = (call);                                                                           \
        if (status != CLAST_OK) {                                                                  \
            goto done;                                                                             \
        }                                                                                          \
    } while (0)

/// Returns the status of a call that fails, where the function holds nothing that must be freed.
#define CLI_GUARD(call)                                                                            \
    do {                                                                                           \
        const clast_status cli_guarded = (call);                                                   \
        if (cli_guarded != CLAST_OK) {                                                             \
            return cli_guarded;                                                                    \
        }                                                                                          \
    } while (0)

/// A file's name, or any text from outside, as a terminal may show it; lives until the 8th call
/// after this one.
const char *cli_name(const char *text);

/// "s", or "" of one: "1 cell", "2 cells".
static inline const char *cli_plural(int64_t n)
{
    return n == 1 ? "" : "s";
}

/// Flushes stdout: `code`, or 4 and one line when something of it was lost.
int cli_flush(int code);

/// Writes the first page of a command: examples and the options that most runs need.
void cli_help(const cli_command *command);

/// Writes everything there is to say about a command, its options in groups.
void cli_help_all(const cli_command *command);

enum { CLI_NAME_SIZE = 64, CLI_WORDS_SIZE = 512 };

/// The option's name as it is typed: "cone", "[no-]hull".
void cli_field_name(const clast_field *field, char name[CLI_NAME_SIZE]);

/// Choices, unit and default of an option as they are typed: " {a|b} (default 1deg)", or "".
void cli_field_values(const clast_field *field, char words[CLI_WORDS_SIZE]);

/// The heading that begins at this field of a table, or NULL; the first field has always one.
const char *cli_field_group(const clast_field *fields, const clast_field *field);

/// The next command of the registry (cli/commands.def), or NULL after the last.
const cli_command *cli_command_at(int32_t index);

/// Progress on stderr for a monitor: at most 5 lines a second on a terminal, one a minute in a log.
/// stop() is true after SIGINT, SIGTERM or SIGHUP.
clast_monitor cli_monitor(const cli_common *common);

/// Seconds since some fixed moment; never goes back.
double cli_clock(void);

/// Seconds of processor time of the whole process, all threads added.
double cli_clock_cpu(void);

/// From now on SIGINT, SIGTERM and SIGHUP ask this command to end, and end it where it does not
/// look.
void cli_signals_begin(const char *command, const clast_comm *comm);

/// Whether a signal has asked the command to end; a loop that looks here saves its state.
bool cli_stop_asked(void);

/// The run in `folder` has a checkpoint once its loop looks: a command that a signal then ends
/// without another says how to go on from it.
void cli_signals_way_on(const char *command, const char *folder);

/// Limits the library's memory to --max-memory (8GB, 50%; 0: not at all), 80 % of the machine's
/// unless told; ranks on one machine have equal shares of it. Called by all ranks.
clast_status cli_memory_limit(const cli_common *common);

/// Ends the command as SIGTERM does once `text` (90min, 2h) has gone by; NULL: no limit.
clast_status cli_time_limit(const char *text);

/// Refuses an output that is an input, part of a run, or another output (by the file, whatever its
/// spelling), before anything is computed.
clast_status cli_check_outputs(const cli_command *command, const cli_common *common,
                               const void *config);

/// True when the path is a folder.
bool cli_is_folder(const char *path);

/// Before the work: a file can be written there; NULL and "" are none. What a link names is left to
/// the writer.
clast_status cli_check_writable(const char *path);

/// Refuses a path of `what` ("pictures") that does not end in .ENDING, in upper or lower case,
/// which is all that is written there.
clast_status cli_check_ending(const char *path, const char *what, const char *ending);

/// 130 after SIGINT, 143 after SIGTERM, 129 after SIGHUP, 0 when none came.
int cli_signal_code(void);
