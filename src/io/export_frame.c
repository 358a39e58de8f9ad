// What files have beside the grains, as far as it is known: step and box of a run for LAMMPS,
// densities.
#include "io/export.h"

#include "base/status.h"
#include "dem/saved.h"
#include "io/h5.h"
#include <clast/assembly.h>
#include <clast/porosity.h>
#include <clast/state.h>
#include <clast/table.h>

bool clx_has_density(const clast_assembly *a)
{
    bool is_set = !a->no_density;
    for (int32_t i = 0; i < a->n_grain && !is_set; ++i) {
        is_set = a->density[i] != 1.0;
    }
    return is_set;
}

void clx_export_box(const clx_export *e, clast_packing_frame *frame)
{
    static const clast_packing_frame none = {0};
    const clast_assembly *a = e->assembly;
    double low[3] = {0};
    double high[3] = {0};
    *frame = e->options->frame != NULL ? *e->options->frame : none;
    if (a->n_grain > 0) {
        clast_assembly_bounds(a, low, high);
    }
    for (int k = 0; k < 3; ++k) {
        if (!frame->has_box[k]) {
            frame->low[k] = low[k];
            frame->high[k] = high[k];
            frame->is_periodic[k] = false;
        }
    }
}

enum { SHIFT = 9 }; ///< of a saved cell, whose sides come first (dem/saved.c)

/// A cell that is periodic in x, y and z: its image above is shifted along x.
static clast_status read_cell(clx_h5 *h5, clast_packing_frame *frame)
{
    static const int64_t shape[1] = {CLX_SAVED_CELL};
    clast_status status = CLAST_OK;
    double x[CLX_SAVED_CELL];
    CLX_TRY(clx_h5_read(h5, "/pack/cell", CLX_H5_F64, 1, shape, x));
    for (int k = 0; k < 3; ++k) {
        frame->has_box[k] = frame->is_periodic[k] = true;
        frame->low[k] = k < 2 ? -0.5 * x[k] : 0.0;
        frame->high[k] = k < 2 ? 0.5 * x[k] : x[k];
    }
    frame->tilt[1] = x[SHIFT];
done:
    return status;
}

/// Any other bed's periodic directions; a state without a bed has none.
static void read_bed(const char *path, clast_packing_frame *frame)
{
    clast_table table = {0};
    clast_bed bed = {0};
    double period[3] = {0.0, 0.0, 0.0};
    if (clast_state_read_table(path, "bed", &table) == CLAST_OK &&
        clast_bed_from_table(&table, &bed) == CLAST_OK && clast_bed_period(&bed, period)) {
        const double low[3] = {bed.low[0], bed.low[1], bed.floor};
        const double high[3] = {bed.high[0], bed.high[1], bed.ceiling};
        for (int k = 0; k < 3; ++k) {
            frame->has_box[k] = frame->is_periodic[k] = period[k] > 0.0;
            frame->low[k] = low[k];
            frame->high[k] = high[k];
        }
    }
    clast_table_free(&table);
}

clast_status clast_state_read_frame(const char *path, clast_packing_frame *frame)
{
    CLX_ARGUMENTS(path, frame);
    clast_status status = CLAST_OK;
    clast_packing_frame made = {.step = -1};
    clx_h5 *h5 = NULL;
    CLX_TRY(clx_h5_open(path, &h5));
    if (clx_h5_has(h5, "/pack")) {
        CLX_TRY(clx_h5_read_number(h5, "/pack", "step", CLX_H5_I64, &made.step));
    }
    if (clx_h5_has(h5, "/pack/cell")) {
        CLX_TRY(read_cell(h5, &made));
    } else {
        read_bed(path, &made);
    }
    *frame = made;
done:
    clx_h5_close(h5);
    return status;
}
