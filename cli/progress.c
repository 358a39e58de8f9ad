// Progress on stderr.
#include "command.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

static bool stop(void *context)
{
    (void)context;
    return cli_stop_asked();
}

typedef struct {
    double begun, last;
    int64_t first; ///< done when the phase began
    char phase[32];
} state;

static state now_state;

/// A line five times a second on a terminal, a line a minute in a log, whatever phases go by.
static void report(void *context, const char *phase, int64_t done, int64_t total)
{
    state *s = context;
    const double t = cli_clock();
    const bool terminal = isatty(STDERR_FILENO) != 0;
    if (strcmp(s->phase, phase) != 0) {
        (void)snprintf(s->phase, sizeof s->phase, "%s", phase);
        s->begun = t;
        s->first = done;
        s->last = s->last > 0.0 ? s->last : t;
    }
    if (done > total) {
        total = 0; // it was an estimate
    }
    const bool last = total > 0 && done == total;
    if (t - s->last < (terminal ? 0.2 : 60.0) && !(last && terminal)) {
        return;
    }
    s->last = t;
    const double rate = t > s->begun ? (double)(done - s->first) / (t - s->begun) : 0.0;
    (void)fprintf(stderr, "%s%s %lld", terminal ? "\r\033[K" : "", phase, (long long)done);
    if (total > 0) {
        (void)fprintf(stderr, "/%lld (%.0f %%)", (long long)total,
                      100.0 * (double)done / (double)total);
    }
    if (rate > 0.0) {
        (void)fprintf(stderr, ", %.3g/s", rate);
    }
    if (total > 0 && rate > 0.0) {
        (void)fprintf(stderr, ", %.0f s left", (double)(total - done) / rate);
    }
    (void)fputs(terminal && !last ? "" : "\n", stderr);
    (void)fflush(stderr);
}

static void note(void *context, const char *text)
{
    (void)context;
    (void)fprintf(stderr, "%s\n", cli_name(text));
}

clast_monitor cli_monitor(const cli_common *common)
{
    return (clast_monitor){.report = common->quiet ? NULL : report,
                           .stop = stop,
                           .note = common->quiet ? NULL : note,
                           .context = &now_state,
                           .n_word = common->n_word,
                           .word = common->word};
}
