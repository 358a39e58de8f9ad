#pragma once
#include <clast/field.h>
#include <clast/status.h>

CLAST_BEGIN

// Pictures of assemblies by a ray tracer, without a display or a graphics card. Of libclast_view.

/// Pixels in memory, row by row from the top, straight (not premultiplied) sRGB and alpha.
typedef struct clast_image {
    int32_t width, height;
    uint8_t *rgba;     ///< [height][width][4]
    double pixel_size; ///< edge of a pixel in the assembly's length unit, in the plane through the
                       ///< middle of the view; 0 when not a picture of an assembly
} clast_image;

/// Allocates the pixels, zeroed; `image` must be empty. CLAST_E_MEMORY.
CLAST_API clast_status clast_image_alloc(int32_t width, int32_t height, clast_image *image);
/// Frees the pixels; may be called twice.
CLAST_API void clast_image_free(clast_image *image);

/// Writes a PNG file, whole or not at all. Opaque images are written without alpha.
CLAST_API clast_status clast_image_write_png(const clast_image *image, const char *path);

typedef enum {
    CLAST_RENDER_COLOUR_AUTO, ///< size when grains differ in size by over 1 %, else single
    CLAST_RENDER_COLOUR_SINGLE,
    CLAST_RENDER_COLOUR_SIZE,  ///< diameter of the sphere of equal volume
    CLAST_RENDER_COLOUR_ORDER, ///< index of the grain
    CLAST_RENDER_COLOUR_SHAPE  ///< shape of the grain, with a legend
} clast_render_colour;

typedef enum {
    CLAST_RENDER_SCALE_AUTO,
    CLAST_RENDER_SCALE_LINEAR,
    CLAST_RENDER_SCALE_LOG
} clast_render_scale;
typedef enum { CLAST_RENDER_ORTHOGRAPHIC, CLAST_RENDER_PERSPECTIVE } clast_render_projection;
typedef enum {
    CLAST_RENDER_WHITE,
    CLAST_RENDER_TRANSPARENT,
    CLAST_RENDER_BLACK
} clast_render_background;
typedef enum { CLAST_RENDER_SMOOTH, CLAST_RENDER_FLAT } clast_render_shading;
typedef enum {
    CLAST_RENDER_CUT_NONE,
    CLAST_RENDER_CUT_X,
    CLAST_RENDER_CUT_Y,
    CLAST_RENDER_CUT_Z,
    CLAST_RENDER_CUT_VIEW ///< plane that faces the viewer
} clast_render_cut;

/// Axis of the coordinates that points up in the picture.
typedef enum { CLAST_RENDER_UP_X, CLAST_RENDER_UP_Y, CLAST_RENDER_UP_Z } clast_render_up;

/// What the picture shows; see clast_render_fields for ranges and defaults.
typedef struct clast_render_config {
    int32_t width, height; ///< pixels
    int32_t samples;       ///< camera rays a pixel
    int32_t ambient_rays;  ///< sky rays a camera ray
    int32_t projection;    ///< clast_render_projection
    int32_t up;            ///< clast_render_up
    double azimuth;        ///< of the viewer about the up axis, from the next axis on [rad]
    double elevation;      ///< of the viewer above the horizontal [rad]
    double field_of_view;  ///< perspective: angle of the picture's height [rad]
    double zoom;           ///< 1: everything just fits
    int32_t colour;        ///< clast_render_colour
    char *tint;            ///< "#rrggbb" for a single colour
    int32_t scale;         ///< clast_render_scale of the colour bar
    int32_t shading;       ///< clast_render_shading
    int32_t background;    ///< clast_render_background
    bool ground;           ///< shadow on a plane under the grains
    int32_t cut;           ///< clast_render_cut: removes the half nearer to the viewer
    double cut_position;   ///< of the plane: 0 first, 1 last end of the extent along its axis
    bool colour_bar;
    bool scale_bar;
    char *unit;           ///< unit of the coordinates when the assembly knows none ("" : not known)
    double sun_azimuth;   ///< of the sun, to the right of the viewer [rad]
    double sun_elevation; ///< of the sun above the line of sight [rad]
    double sun_radius;    ///< half-angle of the sun's disc: softness of shadows [rad]
    double ambient;       ///< share of the light that comes from the sky
    uint64_t seed;
} clast_render_config;

/// Table of the fields, ends with {0}.
CLAST_API extern const clast_field clast_render_fields[];

/// The fields that a picture by the others does not look at (clast_fields_idle). NULL of a NULL.
CLAST_API const clast_idle *clast_render_idle(const clast_render_config *config,
                                              clast_idle rules[CLAST_N_IDLE]);

/// Draws the assembly into `image` (which must be empty).
///
/// Spheres, ellipsoids and clumps are analytic; meshes go through one hierarchy per shape,
/// whatever the number of grains. The picture is framed so that nothing is cut off at zoom 1. The
/// same bytes for any thread count.                                      [docs/theory/render.md]
///
/// @param monitor  progress and stop, or NULL
/// @return CLAST_E_GEOMETRY for no grains, or coordinates that are not finite; CLAST_E_CONFIG for a
///         bad colour or unit; CLAST_E_STOPPED when the monitor said so (the image is then empty)
CLAST_API clast_status clast_render_assembly(const clast_assembly *assembly,
                                             const clast_render_config *config,
                                             const clast_monitor *monitor, clast_image *image);

CLAST_END
