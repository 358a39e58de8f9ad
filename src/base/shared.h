#pragma once
// The library is built as two: libclast, the core, and libclast_view (src/plot, render, report and
// study), which needs cairo.

/// Of the core, called by the view too: exported under a version name of the exact release
/// (cmake/Exports.cmake), so that a view never meets another core. Inside the core the call stays
/// direct, as for every clx_ function.
#ifdef CLX_VIEW
#define CLX_SHARED __attribute__((visibility("default")))
#else
#define CLX_SHARED __attribute__((visibility("protected")))
#endif
