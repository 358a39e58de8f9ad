// Which spheres of a filling are outer ones: SCARLET-1.0's option O_ext.
//
// The released code calls MATLAB's `boundary` on the centres with its default shrink factor of 0.5
// and keeps the spheres whose centres are corners of the facets it returns. The rule behind it:
// take the Delaunay tetrahedra of the points; the alpha shape of radius a is the union of those
// with a circumradius of at most a. Sort the distinct circumradii from the greatest down to the
// critical one, the least for which the shape is one region that touches every point; take the one
// that lies the shrink factor of the way along this list; fill the voids; return the facets towards
// the outside.                                                     [docs/theory/fill.md sec. 5]
#include "shape/fill.h"

#include "base/alloc.h"
#include "geom/hull.h"
#include <libqhull_r/qhull_ra.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    int32_t corner[4]; ///< rising
    double radius;     ///< of the circumscribed sphere
} tetrahedron;

typedef struct {
    int32_t corner[3]; ///< rising
    int32_t tet;       ///< four times the tetrahedron, plus which corner is opposite
} face;

typedef struct {
    int32_t n_tet;
    tetrahedron *tet;        ///< [n_tet] by rising radius
    face *faces;             ///< [4 n_tet] scratch
    int32_t (*neighbour)[4]; ///< [n_tet] tetrahedron behind the face opposite to each corner, or -1
    int32_t *root;           ///< [n_tet] union-find
} complex;

static void free_complex(complex *c)
{
    clx_free(c->tet);
    clx_free(c->faces);
    clx_free(c->neighbour);
    clx_free(c->root);
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
    const int32_t x = *(const int32_t *)a;
    const int32_t y = *(const int32_t *)b;
    return (x > y) - (x < y);
}

static int compare_tets(const void *a, const void *b)
{
    const tetrahedron *p = a;
    const tetrahedron *q = b;
    return p->radius != q->radius ? (p->radius > q->radius) - (p->radius < q->radius)
                                  : memcmp(p->corner, q->corner, sizeof p->corner);
}

static int compare_faces(const void *a, const void *b)
{
    const face *p = a;
    const face *q = b;
    for (int k = 0; k < 3; ++k) {
        if (p->corner[k] != q->corner[k]) {
            return p->corner[k] < q->corner[k] ? -1 : 1;
        }
    }
    return (p->tet > q->tet) - (p->tet < q->tet);
}

/// Copies qhull's lower facets: the Delaunay tetrahedra.
static clast_status collect(qhT *qh, const clast_spheres *s, complex *c)
{
    clast_status status = CLAST_OK;
    facetT *facet;
    vertexT *vertex;
    vertexT **vertexp;
    CLX_TRY(clx_alloc(&c->tet, qh->num_facets, sizeof *c->tet));
    FORALLfacets
    {
        if (facet->upperdelaunay) {
            continue;
        }
        tetrahedron *t = &c->tet[c->n_tet++];
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
            v3_copy(p[k], s->centre[t->corner[k]]);
        }
        t->radius = circumradius(p);
    }
    qsort(c->tet, (size_t)c->n_tet, sizeof *c->tet, compare_tets);
done:
    return status;
}

static clast_status delaunay(const clast_spheres *s, complex *c)
{
    clast_status status = CLAST_OK;
    qhT *qh = NULL;
    char *text = NULL;
    size_t text_size = 0;
    FILE *report = NULL;
    double *point = NULL;
    CLX_TRY(clx_alloc(&point, 3 * (int64_t)s->n, sizeof *point));
    for (int32_t i = 0; i < s->n; ++i) {
        v3_sub(point + 3 * (ptrdiff_t)i, s->centre[i], s->centre[0]);
    }
    CLX_TRY(clx_alloc(&qh, 1, sizeof *qh));
    report = open_memstream(&text, &text_size); // memory, not a file: what qhull would print
    CLX_CHECK(report != NULL, CLAST_E_MEMORY, "no memory for qhull's messages");
    char options[] = "qhull d Qbb Qt Qz Pp";
    const int code = qh_new_qhull(qh, 3, s->n, point, False, options, NULL, report);
    (void)fflush(report);
    if (code == 0) {
        status = collect(qh, s, c);
    } else {
        status = clx_fail(code == qh_ERRmem ? CLAST_E_MEMORY : CLAST_E_GEOMETRY,
                          "Delaunay tetrahedra of %d centres: qhull says %.*s", s->n,
                          (int)strcspn(text != NULL ? text : "", "\n"), text != NULL ? text : "");
    }
done:
    if (report != NULL) {
        int long_blocks = 0;
        int long_bytes = 0;
        qh_freeqhull(qh, !qh_ALL);
        qh_memfreeshort(qh, &long_blocks, &long_bytes);
        (void)fclose(report);
    }
    free(text); // by open_memstream, not ours
    clx_free(qh);
    clx_free(point);
    return status;
}

/// Finds the tetrahedra behind each face.
static clast_status join(complex *c)
{
    clast_status status = CLAST_OK;
    const int64_t n = 4 * (int64_t)c->n_tet;
    CLX_TRY(clx_alloc(&c->faces, n, sizeof *c->faces));
    CLX_TRY(clx_alloc(&c->neighbour, c->n_tet, sizeof *c->neighbour));
    CLX_TRY(clx_alloc(&c->root, c->n_tet, sizeof *c->root));
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
        const face *f = &c->faces[i];
        if (memcmp(f[0].corner, f[1].corner, sizeof f->corner) == 0) {
            c->neighbour[f[0].tet / 4][f[0].tet % 4] = f[1].tet / 4;
            c->neighbour[f[1].tet / 4][f[1].tet % 4] = f[0].tet / 4;
        }
    }
done:
    return status;
}

static int32_t root_of(complex *c, int32_t i)
{
    while (c->root[i] != i) {
        c->root[i] = c->root[c->root[i]];
        i = c->root[i];
    }
    return i;
}

/// Number of tetrahedra, by rising radius, that the critical alpha shape holds: one region, all
/// points. `is_met` [n] is scratch, zeroed.
static int32_t critical(complex *c, int32_t n, bool *is_met)
{
    int32_t regions = 0;
    int32_t left = n;
    for (int32_t i = 0; i < c->n_tet; ++i) {
        c->root[i] = i;
        ++regions;
        for (int k = 0; k < 4; ++k) {
            const int32_t other = c->neighbour[i][k];
            if (other >= 0 && other < i && root_of(c, other) != root_of(c, i)) {
                c->root[root_of(c, other)] = root_of(c, i);
                --regions;
            }
            left -= !is_met[c->tet[i].corner[k]];
            is_met[c->tet[i].corner[k]] = true;
        }
        const bool last = i + 1 == c->n_tet || c->tet[i + 1].radius > c->tet[i].radius;
        if (last && left == 0 && regions == 1) {
            return i + 1;
        }
    }
    return c->n_tet;
}

/// Number of tetrahedra in the alpha shape of the chosen radius.
static int32_t choose(const complex *c, int32_t n_critical, double shrink)
{
    // ranks of the distinct radii from the greatest (1) to the critical one (n_rank)
    int32_t n_rank = 1;
    for (int32_t i = c->n_tet - 1; i >= n_critical; --i) {
        n_rank += c->tet[i - 1].radius < c->tet[i].radius;
    }
    const int32_t wanted = (int32_t)fmax(1.0, ceil(shrink * n_rank));
    int32_t rank = 1;
    int32_t n = c->n_tet;
    while (n > n_critical && rank < wanted) {
        rank += c->tet[n - 2].radius < c->tet[n - 1].radius;
        --n;
    }
    return n;
}

/// Marks the corners of facets between the first n tetrahedra (voids filled) and the outside.
static clast_status mark_boundary(const complex *c, int32_t n, bool *keep)
{
    clast_status status = CLAST_OK;
    bool *outside = NULL; // reached from infinity without crossing the shape
    int32_t *stack = NULL;
    int32_t n_stack = 0;
    CLX_TRY(clx_alloc(&outside, c->n_tet, sizeof *outside));
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
    for (int32_t i = 0; i < c->n_tet; ++i) {
        for (int k = 0; k < 4 && !outside[i]; ++k) {
            const int32_t other = c->neighbour[i][k];
            for (int j = 0; j < 4 && (other < 0 || outside[other]); ++j) {
                if (j != k) {
                    keep[c->tet[i].corner[j]] = true;
                }
            }
        }
    }
done:
    clx_free(stack);
    clx_free(outside);
    return status;
}

clast_status clx_fill_outer(const clast_spheres *spheres, double shrink, bool *keep)
{
    clast_status status = CLAST_OK;
    complex c = {0};
    bool *is_met = NULL;
    if (clx_points_rank((const double(*)[3])spheres->centre, spheres->n, 1e-9) < 3) {
        for (int32_t i = 0; i < spheres->n; ++i) {
            keep[i] = true; // centres in a plane: none is inside
        }
        return CLAST_OK;
    }
    CLX_TRY(delaunay(spheres, &c));
    CLX_TRY(join(&c));
    CLX_TRY(clx_alloc(&is_met, spheres->n, sizeof *is_met));
    CLX_TRY(mark_boundary(&c, choose(&c, critical(&c, spheres->n, is_met), shrink), keep));
done:
    clx_free(is_met);
    free_complex(&c);
    return status;
}
