// Delaunay tetrahedra by qhull, and who is behind each face.
#include "geom/delaunay.h"

#include "base/alloc.h"
#include "geom/hull.h"
#include "geom/qhull_call.h"
#include "math/sort.h"
#include "math/vec3.h"
#include <stdlib.h>
#include <string.h>

void clx_delaunay_free(clx_delaunay *c)
{
    CLX_FREE(c->tet, c->faces, c->neighbour);
    *c = (clx_delaunay){0};
}

/// Radius of the sphere through four points; INFINITY when they lie in a plane.
static double circumradius(double p[4][3])
{
    double u[3];
    double v[3];
    double w[3];
    double vw[3];
    double wu[3];
    double uv[3];
    double centre[3];
    v3_sub(u, p[1], p[0]);
    v3_sub(v, p[2], p[0]);
    v3_sub(w, p[3], p[0]);
    v3_cross(vw, v, w);
    v3_cross(wu, w, u);
    v3_cross(uv, u, v);
    const double det = 2.0 * v3_dot(u, vw);
    for (int k = 0; k < 3; ++k) {
        centre[k] = v3_norm2(u) * vw[k] + v3_norm2(v) * wu[k] + v3_norm2(w) * uv[k];
    }
    return det != 0.0 ? v3_norm(centre) / fabs(det) : (double)INFINITY;
}

static int compare_ints(const void *a, const void *b)
{
    return clx_compare_ints(a, b, 1);
}

static int compare_tets(const void *a, const void *b)
{
    const clx_delaunay_tet *p = a;
    const clx_delaunay_tet *q = b;
    return p->radius != q->radius ? (p->radius > q->radius) - (p->radius < q->radius)
                                  : memcmp(p->corner, q->corner, sizeof p->corner);
}

static int compare_faces(const void *a, const void *b)
{
    const clx_delaunay_face *p = a;
    const clx_delaunay_face *q = b;
    const int order = clx_compare_ints(p->corner, q->corner, 3);
    return order != 0 ? order : (p->tet > q->tet) - (p->tet < q->tet);
}

typedef struct {
    const double (*point)[3];
    clx_delaunay *made;
} job;

/// Copies qhull's lower facets: the Delaunay tetrahedra.
static clast_status collect(qhT *qh, void *context)
{
    clast_status status = CLAST_OK;
    const job *j = context;
    clx_delaunay *c = j->made;
    facetT *facet;
    vertexT *vertex;
    vertexT **vertexp;
    CLX_TRY(clx_alloc(&c->tet, qh->num_facets, sizeof *c->tet));
    FORALLfacets
    {
        if (facet->upperdelaunay) {
            continue;
        }
        clx_delaunay_tet *t = &c->tet[c->n_tet++];
        double p[4][3];
        int k = 0;
        FOREACHvertex_(facet->vertices)
        {
            if (k < 4) {
                t->corner[k++] = qh_pointid(qh, vertex->point);
            }
        }
        qsort(t->corner, 4, sizeof t->corner[0], compare_ints);
        for (k = 0; k < 4; ++k) {
            v3_copy(p[k], j->point[t->corner[k]]);
        }
        t->radius = circumradius(p);
    }
    qsort(c->tet, (size_t)c->n_tet, sizeof *c->tet, compare_tets);
done:
    return status;
}

static clast_status triangulate(int32_t n, const double (*at)[3], clx_delaunay *c)
{
    clast_status status = CLAST_OK;
    double *point = NULL;
    CLX_TRY(clx_alloc(&point, 3 * (int64_t)n, sizeof *point));
    for (int32_t i = 0; i < n; ++i) {
        v3_sub(point + 3 * (ptrdiff_t)i, at[i], at[0]);
    }
    CLX_TRY(clx_qhull("Delaunay triangulation", "d Qbb Qt Qz Pp", n, point, collect,
                      &(job){.point = at, .made = c}));
done:
    clx_free(point);
    return status;
}

/// Finds the tetrahedra behind each face.
static clast_status join(clx_delaunay *c)
{
    CLAST_ASSERT(c->n_tet > 0 && c->neighbour == NULL);
    clast_status status = CLAST_OK;
    const int64_t n = 4 * (int64_t)c->n_tet;
    CLX_TRY(clx_alloc(&c->faces, n, sizeof *c->faces));
    CLX_TRY(clx_alloc(&c->neighbour, c->n_tet, sizeof *c->neighbour));
    for (int64_t i = 0; i < n; ++i) {
        const int32_t *corner = c->tet[i / 4].corner;
        int at = 0;
        for (int k = 0; k < 4; ++k) {
            if (k != i % 4) {
                c->faces[i].corner[at++] = corner[k];
            }
        }
        c->faces[i].tet = (int32_t)i;
        c->neighbour[i / 4][i % 4] = -1;
    }
    qsort(c->faces, (size_t)n, sizeof *c->faces, compare_faces);
    for (int64_t i = 0; i + 1 < n; ++i) {
        const clx_delaunay_face *f = &c->faces[i];
        if (memcmp(f[0].corner, f[1].corner, sizeof f->corner) == 0) {
            c->neighbour[f[0].tet / 4][f[0].tet % 4] = f[1].tet / 4;
            c->neighbour[f[1].tet / 4][f[1].tet % 4] = f[0].tet / 4;
        }
    }
done:
    return status;
}

clast_status clx_delaunay_make(int32_t n, const double (*point)[3], clx_delaunay *delaunay)
{
    clast_status status = CLAST_OK;
    clx_delaunay made = {0};
    CLX_TRY(triangulate(n, point, &made));
    CLX_TRY(join(&made));
    *delaunay = made;
    made = (clx_delaunay){0};
done:
    clx_delaunay_free(&made);
    return status;
}

clast_status clx_delaunay_outside(const clx_delaunay *c, int32_t n, bool *outside)
{
    CLAST_ASSERT(n >= 0 && n <= c->n_tet);
    clast_status status = CLAST_OK;
    int32_t *stack = NULL;
    int32_t n_stack = 0;
    CLX_TRY(clx_alloc(&stack, c->n_tet, sizeof *stack));
    for (int32_t i = n; i < c->n_tet; ++i) {
        for (int k = 0; k < 4 && !outside[i]; ++k) {
            if (c->neighbour[i][k] < 0) {
                outside[i] = true;
                stack[n_stack++] = i;
            }
        }
    }
    while (n_stack > 0) {
        const int32_t i = stack[--n_stack];
        for (int k = 0; k < 4; ++k) {
            const int32_t other = c->neighbour[i][k];
            if (other >= n && !outside[other]) {
                outside[other] = true;
                stack[n_stack++] = other;
            }
        }
    }
done:
    clx_free(stack);
    return status;
}
