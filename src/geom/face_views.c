// What a convex hull looks like along the normals of its faces: shadows in single precision of all
// of them, widths and shadows to the last bit of the few that matter.
#include "geom/hull_body.h"

#include "base/alloc.h"
#include "math/sort.h"
#include "math/vec3.h"
#include <stdlib.h>

enum { MOST_FACES = 2048 };

void clx_face_shadows_free(clx_face_shadows *shadows)
{
    CLX_FREE(shadows->face, shadows->area);
    *shadows = (clx_face_shadows){0};
}

/// Sixteen of the shadows, from number i on; the last one again where there are no more.
static void measure_shadows(const clx_hull_body *body, const float (*part)[3], int32_t i,
                            clx_face_shadows *shadows)
{
    float direction[3][CLX_SINGLES];
    float sum[CLX_SINGLES];
    for (int k = 0; k < CLX_SINGLES; ++k) {
        const double *normal = body->normal[shadows->face[i + k < shadows->n ? i + k : i]];
        for (int c = 0; c < 3; ++c) {
            direction[c][k] = (float)normal[c];
        }
    }
    clx_shadow_singles(body->n_face, part, (const float(*)[CLX_SINGLES])direction, sum);
    for (int k = 0; k < CLX_SINGLES && i + k < shadows->n; ++k) {
        shadows->area[i + k] = 0.5 * body->surface * (double)sum[k];
    }
}

clast_status clx_face_shadows_make(const clx_hull_body *body, clx_face_shadows *shadows)
{
    clast_status status = CLAST_OK;
    float(*part)[3] = NULL;
    const int32_t stride = body->n_face > MOST_FACES ? body->n_face / MOST_FACES + 1 : 1;
    const int32_t most = body->n_face / stride + 1;
    CLX_TRY(clx_alloc(&shadows->face, most, sizeof *shadows->face));
    CLX_TRY(clx_alloc(&shadows->area, most, sizeof *shadows->area));
    CLX_TRY(clx_alloc(&part, body->n_face, sizeof *part));
    shadows->n = 0;
    for (int32_t f = 0; f < body->n_face; f += stride) {
        if (v3_norm2(body->normal[f]) > 0.5) { // else a sliver without a normal
            shadows->face[shadows->n++] = f;
        }
    }
    for (int32_t f = 0; f < body->n_face; ++f) {
        for (int k = 0; k < 3; ++k) {
            part[f][k] = (float)(body->area[f] / body->surface * body->normal[f][k]);
        }
    }
    // eight roundings of a term, one of each addition, of no more than half the surface
    shadows->doubt = (16.0 + body->n_face) * 0x1p-24 * body->surface;
    for (int32_t i = 0; i < shadows->n; i += CLX_SINGLES) {
        measure_shadows(body, (const float(*)[3])part, i, shadows);
    }
done:
    clx_free(part);
    return status;
}

CLX_RISING_BY_TWO(compare_views, clx_face_view, least, face)

/// Widths and shadows along the faces' normals, several at a time.
static void measure_views(const clx_hull_body *body, clx_face_views *views)
{
    for (int32_t i = 0; i < views->n; i += CLX_DIRECTIONS) {
        double normal[CLX_DIRECTIONS][3];
        double width[CLX_DIRECTIONS];
        double shadow[CLX_DIRECTIONS];
        for (int k = 0; k < CLX_DIRECTIONS; ++k) { // the last one again where there are no more
            const int32_t at = i + k < views->n ? i + k : views->n - 1;
            v3_copy(normal[k], body->normal[views->view[at].face]);
        }
        clx_hull_body_widths(body, (const double(*)[3])normal, width);
        clx_shadow_areas(body, (const double(*)[3])normal, shadow);
        for (int k = 0; k < CLX_DIRECTIONS && i + k < views->n; ++k) {
            views->view[i + k].width = width[k];
            views->view[i + k].shadow = shadow[k];
            views->view[i + k].least = width[k] * shadow[k];
        }
    }
}

clast_status clx_face_views_make(const clx_hull_body *body, int32_t n, const int32_t face[],
                                 clx_face_views *views)
{
    const clast_status status = clx_alloc(&views->view, n, sizeof *views->view);
    if (status == CLAST_OK) {
        views->n = n;
        for (int32_t i = 0; i < n; ++i) {
            views->view[i].face = face[i];
        }
        measure_views(body, views);
        qsort(views->view, (size_t)n, sizeof *views->view, compare_views);
    }
    return status;
}

void clx_face_views_free(clx_face_views *views)
{
    clx_free(views->view);
    *views = (clx_face_views){0};
}
