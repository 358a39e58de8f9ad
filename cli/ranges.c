// Runs of agglomeration against the ranges of their kernels, in words and JSON.
#include "ranges.h"

#include <math.h>
#include <stdio.h>

static double share_of(const clast_range_use *use)
{
    return use->n > 0.0 ? use->outside / use->n : 0.0;
}

void cli_range_json(json_t *out, const clast_range_report *r)
{
    const clast_range_use *use = clast_range_report_use(r);
    if (!(use->outside > 0.0)) {
        (void)json_object_set_new(out, "out_of_range", json_null());
        return;
    }
    char words[512];
    const clast_kernel_range *row = clast_kernel_range_row(use->row);
    json_t *o = json_object();
    cli_json_text(o, "words", clast_range_use_words(use, sizeof words, words));
    cli_json_text(o, "owner", row->owner);
    cli_json_text(o, "quantity", row->quantity);
    cli_json_number(o, "value", use->value);
    cli_json_number(o, "low", row->low);
    cli_json_number(o, "high", row->high);
    cli_json_text(o, "source", row->source);
    cli_json_number(o, "share_of_start", share_of(&r->start));
    cli_json_number(o, "share_of_collisions", share_of(&r->collisions));
    cli_json_number(o, "from_time", r->time);
    (void)json_object_set_new(out, "out_of_range", o);
}

size_t cli_range_table(char *words, size_t size)
{
    size_t used = 0;
    for (int k = 0; k < CLAST_N_KERNEL_RANGE && used < size; ++k) {
        const clast_kernel_range *row = clast_kernel_range_row(k);
        char range[64];
        if (isinf(row->high)) {
            (void)snprintf(range, sizeof range, ">= %.3g", row->low);
        } else {
            (void)snprintf(range, sizeof range, "<= %.3g", row->high);
        }
        const int n = snprintf(words + used, size - used, "%-26s %s %s   [%s]\n", row->owner,
                               row->quantity, range, row->source);
        used += n > 0 ? (size_t)n : 0;
    }
    return used;
}
