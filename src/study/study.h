#pragma once
// Files of a study's folder.
#include "base/path.h"
#include <clast/study.h>
#include <jansson.h>

/// FOLDER/runs/NNNNNN of a row of the plan, with `suffix`: "", ".part" or what lies in it.
clast_status clx_study_run_folder(const char *folder, int64_t row, const char *suffix,
                                  char path[CLX_PATH_LIMIT]);

/// Sets a seed of -1: to that of the configuration, as its command reads it, or to 1.
clast_status clx_study_find_seed(clast_study_config *config);

/// True when the row's run is whole: its folder was renamed from .part.
bool clx_study_is_done(const char *folder, int64_t row);

/// What a study is now, and study.json as it was.
typedef struct clx_study_record {
    char *text;          ///< the study as JSON
    json_t *study;       ///< the same
    json_t *before;      ///< study.json, or NULL: a new study
    char config_hex[65]; ///< digest of its configuration; "" for none
} clx_study_record;

/// Reads study.json and compares the study and its configuration. `record` must be {0}.
///
/// @return CLAST_E_USAGE for another study or another configuration
clast_status clx_study_record_read(const clast_study_config *config, const char *folder,
                                   clx_study_record *record);
void clx_study_record_free(clx_study_record *record); ///< may be called twice

/// Writes study.json where something is new: the versions that work on it, the digests of its
/// configuration, table and arguments. That of an older clast, without them, stays as it is.
///
/// @return CLAST_E_USAGE when an argument's file is not the one that a run was made with
clast_status clx_study_record_update(const clast_study_config *config, const char *folder,
                                     const clast_table *plan, const clx_study_record *record);

/// Keeps what the study is (study.json, plan.csv), or checks that the folder holds the same.
///
/// @return CLAST_E_USAGE when it holds another
clast_status clx_study_store(const clast_study_config *config, const char *folder,
                             const clast_table *plan);

/// The file that an argument names, also as "list:FILE"; NULL for none.
const char *clx_study_file_of(const char *argument);

/// Refuses to go on (CLAST_E_USAGE) when an input file of a run that is done, by its manifest, has
/// changed since. Files that are gone pass.
clast_status clx_study_check_inputs(const char *folder, const clast_table *plan);

/// FOLDER/exit_code of a run.
clast_status clx_study_write_exit(const char *run_folder, int exit_code);

/// Adds the signal that ended the run to FOLDER/messages.txt, where the exit code is one's: such a
/// run has had no time to say why.
clast_status clx_study_note_signal(const char *run_folder, int exit_code);

/// Renames the folder of a run that is whole, also in its messages.
clast_status clx_study_make_whole(const char *part, const char *whole);

/// Refuses a name of `keep` that a run's result has not where it is a slip for one that it has.
clast_status clx_study_check_kept(const clast_study_config *config, const char *run_folder);

/// Writes FOLDER/results.csv and FOLDER/times.csv from the runs that are there; the report's
/// n_unknown, first_unknown and n_unconverged.
clast_status clx_study_collect(const clast_study_config *config, const char *folder,
                               const clast_table *plan, clast_study_report *report);

/// What all runs of a study share.
typedef struct {
    const clast_study_config *config;
    const clast_study_worker *worker;
    const clast_table *plan;
} clx_study_words_of;

/// Words of a run's command line; free with clx_study_words_free.
///
/// @param resume  go on from the checkpoint in the run's folder
clast_status clx_study_words(const clx_study_words_of *of, int64_t row, const char *folder,
                             bool resume, clast_text_list *words);
void clx_study_words_free(clast_text_list *words);
