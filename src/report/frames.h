#pragma once
// A run's frames for ParaView as moments of the 3-D view.
#include "base/file.h"
#include <clast/assembly.h>

typedef struct clx_run clx_run;

/// Grains at a moment. `grain` is each one's number in the view's assembly, -1: not in it; `shape`
/// is a number of that assembly too.
typedef struct clx_frame {
    double time;
    int32_t n;
    int32_t *grain, *shape;   ///< [n]
    double (*position)[3];    ///< [n]
    double (*orientation)[4]; ///< [n]
    double *scale;            ///< [n]
} clx_frame;

typedef struct clx_frames {
    int32_t n;        ///< kept: at most what a page has room for, evenly spaced
    int32_t n_file;   ///< that the run wrote
    double end;       ///< time of the assembly itself; NaN: not known
    bool has_turns;   ///< a grain is no ball
    bool lacks_poses; ///< written by a version that put none into them
    clx_frame *frame; ///< [n]
} clx_frames;

/// None for a run without frames.pvd. `frames` must be {0}.
///
/// @return CLAST_E_FORMAT for a damaged file, CLAST_E_MEMORY
clast_status clx_frames_read(const clx_run *run, const clast_assembly *assembly,
                             clx_frames *frames);
void clx_frames_free(clx_frames *frames);

/// The last frame as an assembly of `from`'s shapes, for runs whose state is a part of it; without
/// grains where there is no frame. `last` must be {0}.
clast_status clx_frames_last(const clx_run *run, const clast_assembly *from, clast_assembly *last);

/// Writes , "frames": {...} of the view's data; nothing without frames (NULL too).
///
/// @param n_shown  grains of the view; those beyond are left out
clast_status clx_frames_write(clx_file *file, const clx_frames *frames,
                              const clast_assembly *assembly, int32_t n_shown,
                              const double centre[3], double length);
