// What a reader of surfaces has to say.
#include "io/mesh_io.h"

#include "base/number.h"
#include <stdarg.h>

void clx_report_warn(clast_mesh_read_report *report, const char *format, ...)
{
    if (report->n_warning < CLAST_MESH_N_WARNING) {
        va_list args;
        va_start(args, format);
        (void)clx_number_print_list(report->warning[report->n_warning++], CLAST_MESH_WARNING_SIZE,
                                    format, args);
        va_end(args);
    }
}
