// Command line of one run of a study.
#include "base/number.h"
#include "study/study.h"

#include "base/alloc.h"
#include "base/path.h"
#include <clast/table.h>
#include <stdio.h>
#include <string.h>

void clx_study_words_free(clast_text_list *words)
{
    for (int32_t i = 0; i < words->n; ++i) {
        clx_free(words->item[i]);
    }
    clx_free(words->item);
    *words = (clast_text_list){0};
}

typedef struct {
    clast_text_list *words;
    clast_status status;
} sink;

static void append_text(sink *to, const char *text)
{
    if (to->status == CLAST_OK) {
        to->status = clx_alloc_text(&to->words->item[to->words->n], text);
        to->words->n += to->status == CLAST_OK;
    }
}

static void add_set(sink *to, const char *key, const char *value)
{
    char pair[1024];
    const int n = snprintf(pair, sizeof pair, "%s=%s", key, value);
    if (to->status == CLAST_OK && (n < 0 || n >= (int)sizeof pair)) {
        to->status = clx_fail(CLAST_E_CONFIG, "%s: the value is too long", key);
    }
    append_text(to, "--set");
    append_text(to, pair);
}

static void add_command(sink *to, const char *command)
{
    char word[64];
    while (*command != '\0') {
        const size_t n = strcspn(command, " ");
        (void)snprintf(word, sizeof word, "%.*s", (int)n, command);
        if (n > 0) {
            append_text(to, word);
        }
        command += n + (command[n] == ' ');
    }
}

static void add_settings(sink *to, const clast_study_config *config,
                         const clast_study_worker *worker, const clast_table *plan, int64_t row)
{
    char seed[32];
    for (int32_t i = 0; i < config->set.n; ++i) {
        append_text(to, "--set");
        append_text(to, config->set.item[i]);
    }
    for (int32_t c = 0; c < plan->n_column; ++c) {
        if (plan->column[c].text != NULL) {
            add_set(to, plan->column[c].name, plan->column[c].text[row]);
        }
    }
    const double *number = clast_table_numbers(plan, "seed");
    if (worker->has_seed && number != NULL) {
        (void)clx_number_print(seed, sizeof seed, "%.0f", number[row]);
        add_set(to, "seed", seed);
    }
}

clast_status clx_study_words(const clx_study_words_of *of, int64_t row, const char *folder,
                             bool resume, clast_text_list *words)
{
    clast_status status = CLAST_OK;
    clast_text_list made = {0};
    sink to = {&made, CLAST_OK};
    char out[CLX_PATH_LIMIT];
    const clast_study_config *config = of->config;
    const clast_study_worker *worker = of->worker;
    const clast_table *plan = of->plan;
    const int32_t most = 24 + config->argument.n + 2 * config->set.n + 2 * plan->n_column +
                         (int32_t)strlen(config->run);
    CLX_TRY(clx_alloc(&made.item, most, sizeof *made.item));
    CLX_TRY(clx_path_join(out, folder, "out"));
    add_command(&to, config->run);
    if (resume) {
        append_text(&to, "--resume");
        append_text(&to, out);
    } else {
        if (config->config[0] != '\0') {
            append_text(&to, config->config);
        }
        for (int32_t i = 0; i < config->argument.n; ++i) {
            append_text(&to, config->argument.item[i]);
        }
        add_settings(&to, config, worker, plan, row);
        if (worker->has_folder) {
            append_text(&to, "-o");
            append_text(&to, out);
        }
    }
    append_text(&to, "-j");
    append_text(&to, "1");
    append_text(&to, "--quiet");
    append_text(&to, "--json");
    CLX_TRY(to.status);
    *words = made;
    made = (clast_text_list){0};
done:
    clx_study_words_free(&made);
    return status;
}
