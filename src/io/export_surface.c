// Assemblies as surfaces: STL, OBJ with a group a grain, PLY with grain and colour a face.
#include "io/bytes.h"
#include "io/export.h"
#include "io/mesh_io.h"
#include "math/colour.h"
#include <clast/state.h>
#include <inttypes.h>
#include <math.h>
#include <string.h>

clast_status clx_export_stl(clx_export *e)
{
    clast_status status = CLAST_OK;
    const clast_mesh_write_options options = {.unit = e->unit, .name = "grains"};
    int64_t n = 0;
    for (int32_t i = 0; i < e->assembly->n_grain; ++i) {
        const clast_mesh placed = clx_parts_place(&e->parts, i);
        n += clx_stl_count(&placed);
    }
    CLX_CHECK(n <= UINT32_MAX, CLAST_E_LIMIT,
              "%" PRId64 " triangles are beyond the 2^32 - 1 of STL", n);
    CLX_TRY(clx_stl_begin(&options, (uint32_t)n, &e->file));
    e->parts.n_tri = n;
    for (int32_t i = 0; i < e->assembly->n_grain; ++i) {
        const clast_mesh placed = clx_parts_place(&e->parts, i);
        CLX_TRY(clx_stl_append(&placed, &e->file));
    }
done:
    return status;
}

/// A shape's name as one word: what is not plain becomes '_'.
static void plain_name(const char *name, char out[64])
{
    size_t n = 0;
    for (; name[n] != '\0' && n < 63; ++n) {
        const bool plain = (name[n] >= '0' && name[n] <= '9') ||
                           (name[n] >= 'a' && name[n] <= 'z') ||
                           (name[n] >= 'A' && name[n] <= 'Z') || strchr("-.", name[n]) != NULL;
        out[n] = plain ? name[n] : '_';
    }
    out[n] = '\0';
}

clast_status clx_export_obj(clx_export *e)
{
    clast_status status = CLAST_OK;
    const clast_assembly *a = e->assembly;
    int64_t first = 1;
    (void)clx_file_print(&e->file, "# clast %s, unit %s\n", clast_version(), e->unit);
    for (int32_t i = 0; i < a->n_grain; ++i) {
        char name[64];
        const clast_mesh placed = clx_parts_place(&e->parts, i);
        plain_name(a->shape[a->shape_id[i]].name, name);
        (void)clx_file_print(&e->file, "g grain_%" PRId64 " shape_%s\n", a->id[i], name);
        for (int32_t v = 0; v < placed.n_vert; ++v) {
            CLX_TRY(clx_mesh_write_point(&e->file, "v ", placed.vert[v]));
        }
        for (int32_t t = 0; t < placed.n_tri; ++t) {
            const int32_t *tri = placed.tri[t];
            CLX_TRY(clx_file_print(&e->file, "f %" PRId64 " %" PRId64 " %" PRId64 "\n",
                                   first + tri[0], first + tri[1], first + tri[2]));
        }
        first += placed.n_vert;
    }
done:
    return status;
}

static double size_of(const clast_assembly *a, int32_t i)
{
    return a->scale[i] * a->shape[a->shape_id[i]].length;
}

static void find_sizes(clx_export *e)
{
    e->smallest = INFINITY;
    e->largest = 0.0;
    for (int32_t i = 0; i < e->assembly->n_grain; ++i) {
        e->smallest = fmin(e->smallest, size_of(e->assembly, i));
        e->largest = fmax(e->largest, size_of(e->assembly, i));
    }
}

/// Sizes differ by decades: the colour follows the logarithm.
static double size_share(const clx_export *e, int32_t i)
{
    CLAST_ASSERT(i >= 0 && i < e->assembly->n_grain);
    const double span = log(e->largest / e->smallest);
    return span > 0.0 ? log(size_of(e->assembly, i) / e->smallest) / span : 0.5;
}

static void colour_of(const clx_export *e, int32_t i, uint8_t out[3])
{
    const clast_assembly *a = e->assembly;
    double rgb[3] = {0};
    switch (e->options->colour) {
    case CLAST_COLOUR_GRAIN:
        clx_colour_category((int)(a->id[i] % CLX_N_COLOUR), rgb);
        break;
    case CLAST_COLOUR_ORDER:
        clx_colour_sequence(a->n_grain > 1 ? (double)i / (a->n_grain - 1) : 0.5, rgb);
        break;
    case CLAST_COLOUR_SIZE:
        clx_colour_sequence(size_share(e, i), rgb);
        break;
    case CLAST_COLOUR_SHAPE:
        clx_colour_category(a->shape_id[i] % CLX_N_COLOUR, rgb);
        break;
    }
    for (int k = 0; k < 3; ++k) {
        out[k] = (uint8_t)lround(255.0 * fmin(fmax(rgb[k], 0.0), 1.0));
    }
}

static clast_status write_ply_faces(clx_export *e)
{
    enum { FACE = 1 + 12 + 4 + 3 };
    clast_status status = CLAST_OK;
    const clast_assembly *a = e->assembly;
    int64_t first = 0;
    find_sizes(e);
    for (int32_t i = 0; i < a->n_grain; ++i) {
        const clast_mesh *surface = &e->parts.surface[a->shape_id[i]];
        uint8_t face[FACE] = {3};
        clx_store_u32(face + 13, (uint32_t)i);
        colour_of(e, i, face + 17);
        for (int32_t t = 0; t < surface->n_tri; ++t) {
            for (int k = 0; k < 3; ++k) {
                clx_store_u32(face + 1 + 4 * (ptrdiff_t)k, (uint32_t)(first + surface->tri[t][k]));
            }
            CLX_TRY(clx_file_write(&e->file, face, sizeof face));
        }
        first += surface->n_vert;
    }
done:
    return status;
}

clast_status clx_export_ply(clx_export *e)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(e->parts.n_vert <= INT32_MAX, CLAST_E_LIMIT,
              "%" PRId64 " vertices are beyond the 2^31 of PLY", e->parts.n_vert);
    CLX_TRY(clx_file_print(
        &e->file,
        "ply\nformat binary_little_endian 1.0\ncomment clast %s, unit %s\n"
        "element vertex %" PRId64 "\nproperty double x\nproperty double y\nproperty double z\n"
        "element face %" PRId64 "\nproperty list uchar int vertex_indices\nproperty int grain\n"
        "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n",
        clast_version(), e->unit, e->parts.n_vert, e->parts.n_tri));
    for (int32_t i = 0; i < e->assembly->n_grain; ++i) {
        const clast_mesh placed = clx_parts_place(&e->parts, i);
        for (int32_t v = 0; v < placed.n_vert; ++v) {
            uint8_t bytes[24];
            for (int k = 0; k < 3; ++k) {
                clx_store_f64(bytes + 8 * (ptrdiff_t)k, placed.vert[v][k]);
            }
            CLX_TRY(clx_file_write(&e->file, bytes, sizeof bytes));
        }
    }
    CLX_TRY(write_ply_faces(e));
done:
    return status;
}
