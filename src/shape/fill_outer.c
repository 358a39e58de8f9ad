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
#include "geom/delaunay.h"
#include "geom/hull.h"
#include "geom/union_find.h"

/// Number of tetrahedra, by rising radius, that the critical alpha shape holds: one region, all
/// points. `is_met` [n], zeroed, and `root` [n_tet] are scratch.
static int32_t critical(const clx_delaunay *c, int32_t n, bool *is_met, int32_t *root)
{
    int32_t regions = 0;
    int32_t left = n;
    clx_sets_init(root, c->n_tet);
    for (int32_t i = 0; i < c->n_tet; ++i) {
        ++regions;
        for (int k = 0; k < 4; ++k) {
            const int32_t other = c->neighbour[i][k];
            if (other >= 0 && other < i && clx_sets_find(root, other) != clx_sets_find(root, i)) {
                clx_sets_join(root, other, i);
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
static int32_t choose(const clx_delaunay *c, int32_t n_critical, double shrink)
{
    CLAST_ASSERT(n_critical >= 0 && n_critical <= c->n_tet);
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
static clast_status mark_boundary(const clx_delaunay *c, int32_t n, bool *keep)
{
    clast_status status = CLAST_OK;
    bool *outside = NULL;
    CLX_TRY(clx_alloc(&outside, c->n_tet, sizeof *outside));
    CLX_TRY(clx_delaunay_outside(c, n, outside));
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
    clx_free(outside);
    return status;
}

clast_status clx_fill_outer(const clast_spheres *spheres, double shrink, bool *keep)
{
    CLAST_ASSERT(shrink >= 0.0 && shrink <= 1.0);
    clast_status status = CLAST_OK;
    clx_delaunay c = {0};
    bool *is_met = NULL;
    int32_t *root = NULL;
    if (clx_points_rank((const double(*)[3])spheres->centre, spheres->n, 1e-9) < 3) {
        for (int32_t i = 0; i < spheres->n; ++i) {
            keep[i] = true; // centres in a plane: none is inside
        }
        return CLAST_OK;
    }
    CLX_TRY(clx_delaunay_make(spheres->n, (const double(*)[3])spheres->centre, &c));
    CLX_TRY(clx_alloc(&root, c.n_tet, sizeof *root));
    CLX_TRY(clx_alloc(&is_met, spheres->n, sizeof *is_met));
    CLX_TRY(mark_boundary(&c, choose(&c, critical(&c, spheres->n, is_met, root), shrink), keep));
done:
    CLX_FREE(is_met, root);
    clx_delaunay_free(&c);
    return status;
}
