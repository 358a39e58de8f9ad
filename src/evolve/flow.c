// A velocity field from points: their distinct coordinates are the grid's planes.
#include "evolve/flow.h"

#include "base/alloc.h"
#include "math/sort.h"
#include <math.h>
#include <stdlib.h>

static const double EVEN = 1e-6; ///< of a cell: planes that lie so near their place are even

void clx_flow_free(clx_flow *flow)
{
    clx_free(flow->u);
    *flow = (clx_flow){0};
}

/// First plane, distance and number of the planes of one axis.
static clast_status find_planes(const clast_cloud *cloud, int axis, clx_flow *flow)
{
    clast_status status = CLAST_OK;
    double *x = NULL;
    int64_t n = 0;
    CLX_TRY(clx_alloc(&x, cloud->n, sizeof *x));
    for (int64_t i = 0; i < cloud->n; ++i) {
        x[i] = cloud->x[3 * i + axis];
    }
    qsort(x, (size_t)cloud->n, sizeof *x, clx_by_value);
    const double slack = EVEN * (x[cloud->n - 1] - x[0]) / (double)cloud->n;
    for (int64_t i = 0; i < cloud->n; ++i) {
        if (n == 0 || x[i] > x[n - 1] + slack) {
            x[n++] = x[i];
        }
    }
    flow->low[axis] = x[0];
    flow->n[axis] = (int32_t)n;
    flow->step[axis] = n > 1 ? (x[n - 1] - x[0]) / (double)(n - 1) : 1.0;
    for (int64_t i = 0; i < n; ++i) {
        const double off = x[i] - (x[0] + flow->step[axis] * (double)i);
        CLX_CHECK(fabs(off) <= EVEN * (double)n * flow->step[axis], CLAST_E_FORMAT,
                  "its planes along %c are not evenly spaced: plane %lld of %lld is off by %s",
                  "xyz"[axis], (long long)i + 1, (long long)n, clx_unit_text(off, "m"));
    }
done:
    clx_free(x);
    return status;
}

static int64_t node_of(const clx_flow *flow, const double x[3])
{
    int64_t at = 0;
    for (int k = 2; k >= 0; --k) {
        const double place = floor((x[k] - flow->low[k]) / flow->step[k] + 0.5);
        at = at * flow->n[k] + (int64_t)fmin(fmax(place, 0.0), flow->n[k] - 1);
    }
    return at;
}

/// Velocities to their nodes, each once.
static clast_status fill(const clast_cloud *cloud, clx_flow *flow)
{
    clast_status status = CLAST_OK;
    bool *has = NULL;
    CLX_TRY(clx_alloc(&flow->u, cloud->n, sizeof *flow->u));
    CLX_TRY(clx_alloc(&has, cloud->n, sizeof *has));
    for (int64_t i = 0; i < cloud->n; ++i) {
        const int64_t node = node_of(flow, &cloud->x[3 * i]);
        CLX_CHECK(!has[node], CLAST_E_FORMAT, "row %lld is at a node that an earlier row has",
                  (long long)i + 1);
        has[node] = true;
        for (int k = 0; k < 3; ++k) {
            const double u = cloud->velocity[3 * i + k];
            CLX_CHECK(isfinite(u), CLAST_E_FORMAT, "row %lld has no finite velocity",
                      (long long)i + 1);
            flow->u[node][k] = u;
            flow->fastest[k] = fmax(flow->fastest[k], fabs(u));
        }
    }
done:
    clx_free(has);
    return status;
}

clast_status clx_flow_make(const clast_cloud *cloud, clx_flow *flow)
{
    CLAST_ASSERT(cloud != NULL && flow->u == NULL);
    clast_status status = CLAST_OK;
    clx_flow made = {0};
    CLX_CHECK(cloud->dimension == 3 && cloud->n > 0 && cloud->n <= INT32_MAX &&
                  cloud->velocity != NULL,
              CLAST_E_FORMAT, "it needs rows of x, y, z and three velocities");
    for (int k = 0; k < 3; ++k) {
        CLX_TRY(find_planes(cloud, k, &made));
    }
    CLX_CHECK((double)made.n[0] * made.n[1] * made.n[2] == (double)cloud->n, CLAST_E_FORMAT,
              "%lld rows are no grid of %d x %d x %d planes", (long long)cloud->n, made.n[0],
              made.n[1], made.n[2]);
    CLX_TRY(fill(cloud, &made));
    *flow = made;
    made = (clx_flow){0};
done:
    if (status != CLAST_OK) {
        clx_fail_prefix("field");
    }
    clx_flow_free(&made);
    return status;
}

/// The cell of a point, beyond the grid the next to it, and how far along it is from 0 to 1.
static void locate(const clx_flow *flow, const double x[3], int64_t cell[3], double part[3])
{
    for (int k = 0; k < 3; ++k) {
        const double most = flow->n[k] - 1;
        const double place = fmin(fmax((x[k] - flow->low[k]) / flow->step[k], 0.0), most);
        cell[k] = (int64_t)fmin(floor(place), fmax(most - 1.0, 0.0));
        part[k] = place - (double)cell[k];
    }
}

bool clx_flow_has(const clx_flow *flow, const double x[3])
{
    bool is_in = true;
    for (int k = 0; k < 3; ++k) {
        const double place = (x[k] - flow->low[k]) / flow->step[k];
        is_in = is_in && (flow->n[k] == 1 || (place >= 0.0 && place <= flow->n[k] - 1));
    }
    return is_in;
}

/// Velocity at a corner of a cell: bit k is the upper one along axis k.
static const double *at_corner(const clx_flow *flow, const int64_t cell[3], int corner)
{
    int64_t node = 0;
    for (int k = 2; k >= 0; --k) {
        const int64_t at = cell[k] + (corner >> k & 1);
        node = node * flow->n[k] + (at < flow->n[k] ? at : flow->n[k] - 1);
    }
    return flow->u[node];
}

/// Weight of a corner along one axis.
static double weight_of(int corner, int axis, const double part[3])
{
    return (corner >> axis & 1) != 0 ? part[axis] : 1.0 - part[axis];
}

void clx_flow_add(const clx_flow *flow, const double x[3], double velocity[3])
{
    CLAST_ASSERT(flow->u != NULL);
    int64_t cell[3];
    double part[3];
    locate(flow, x, cell, part);
    for (int corner = 0; corner < 8; ++corner) {
        const double *u = at_corner(flow, cell, corner);
        double weight = 1.0;
        for (int k = 2; k >= 0; --k) {
            weight *= weight_of(corner, k, part);
        }
        for (int k = 0; k < 3; ++k) {
            velocity[k] += weight * u[k];
        }
    }
}

double clx_flow_divergence(const clx_flow *flow, const double x[3])
{
    CLAST_ASSERT(flow->u != NULL);
    int64_t cell[3];
    double part[3];
    double change[3] = {0.0, 0.0, 0.0}; // of u_k from the cell's lower face along k to its upper
    double sum = 0.0;
    locate(flow, x, cell, part);
    for (int corner = 0; corner < 8; ++corner) {
        const double *u = at_corner(flow, cell, corner);
        for (int k = 0; k < 3; ++k) {
            change[k] += (corner >> k & 1) != 0 ? 0.25 * u[k] : -0.25 * u[k];
        }
    }
    for (int k = 0; k < 3; ++k) {
        const double place = (x[k] - flow->low[k]) / flow->step[k];
        const bool is_in_grid = flow->n[k] > 1 && place >= 0.0 && place <= flow->n[k] - 1;
        sum += is_in_grid ? change[k] / flow->step[k] : 0.0;
    }
    return sum;
}
