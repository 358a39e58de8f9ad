#pragma once
// Asking and telling the caller of long work, who may have given no monitor or a part of one.
#include "base/status.h"

static inline bool clx_monitor_stops(const clast_monitor *m)
{
    return m != NULL && m->stop != NULL && m->stop(m->context);
}

static inline void clx_monitor_report(const clast_monitor *m, const char *phase, int64_t done,
                                      int64_t total)
{
    if (m != NULL && m->report != NULL) {
        m->report(m->context, phase, done, total);
    }
}
