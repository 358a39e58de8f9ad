// Domains from a caller's map and from a closed surface.
#include "cloud/surface.h"

#include "base/alloc.h"
#include "base/status.h"
#include "geom/whole.h"
#include "math/rng.h"
#include <clast/mesh_repair.h>
#include <math.h>

enum { N_PROBE = 64 };

static double determinant(double m[3][3], int32_t d)
{
    if (d == 1) {
        return m[0][0];
    }
    if (d == 2) {
        return m[0][0] * m[1][1] - m[0][1] * m[1][0];
    }
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/// |det dx/du| by central differences.
static double jacobian(const clast_domain_map_functions *f, const double u[3])
{
    const double step = 1e-5; // rounding 1e-11, curvature 1e-10
    double m[3][3] = {{0}};
    for (int32_t j = 0; j < f->dimension; ++j) {
        double at[3] = {u[0], u[1], u[2]};
        double low[3] = {0};
        double high[3] = {0};
        at[j] = u[j] - step;
        f->unmap(f->context, at, low);
        at[j] = u[j] + step;
        f->unmap(f->context, at, high);
        for (int32_t k = 0; k < f->dimension; ++k) {
            m[j][k] = (high[k] - low[k]) / (2.0 * step);
        }
    }
    return fabs(determinant(m, f->dimension));
}

static clast_status probe(const clast_domain_map_functions *f, const double u[3])
{
    clast_status status = CLAST_OK;
    double x[3] = {0};
    double back[3] = {0};
    f->unmap(f->context, u, x);
    CLX_CHECK(f->map(f->context, x, back), CLAST_E_CONFIG,
              "the map says that the image (%g, %g, %g) of (%g, %g, %g) is outside the domain",
              x[0], x[1], x[2], u[0], u[1], u[2]);
    for (int32_t j = 0; j < f->dimension; ++j) {
        CLX_CHECK(
            fabs(back[j] - u[j]) <= 1e-8, CLAST_E_CONFIG,
            "map and unmap do not undo each other: coordinate %d of (%g, %g, %g) comes back as %g",
            j, u[0], u[1], u[2], back[j]);
    }
    const double volume = jacobian(f, u);
    CLX_CHECK(fabs(volume - f->volume) <= 1e-3 * f->volume, CLAST_E_CONFIG,
              "the map does not keep uniform points uniform: |det dx/du| is %g at (%g, %g, %g), "
              "the volume is %g",
              volume, u[0], u[1], u[2], f->volume);
done:
    return status;
}

clast_status clast_domain_of_map(const clast_domain_map_functions *functions, clast_domain *domain)
{
    CLX_FLOAT_ENVIRONMENT;
    clast_status status = CLAST_OK;
    CLX_NEED(functions);
    CLX_NEED(domain);
    CLX_NEED(functions->map);
    CLX_NEED(functions->unmap);
    CLX_CHECK(functions->dimension >= 1 && functions->dimension <= 3, CLAST_E_ARGUMENT,
              "a domain has 1, 2 or 3 dimensions, not %d", functions->dimension);
    CLX_CHECK(functions->volume > 0.0 && isfinite(functions->volume), CLAST_E_CONFIG,
              "the volume of a domain is a number > 0, not %g", functions->volume);
    for (uint64_t i = 0; i < N_PROBE; ++i) {
        clx_rng rng = clx_rng_at(0, CLX_STREAM_EXTERIOR, i);
        double u[3] = {0};
        for (int32_t j = 0; j < functions->dimension; ++j) {
            u[j] = 0.01 + 0.98 * clx_rng_uniform(&rng); // maps may be singular on the faces
        }
        CLX_TRY(probe(functions, u));
    }
    *domain = (clast_domain){.kind = CLAST_DOMAIN_MAP,
                             .dimension = functions->dimension,
                             .radius = 1.0,
                             .length = 1.0,
                             .user = *functions};
done:
    return status;
}

/// One clear line when the surface bounds no volume that cells could share.
static clast_status check_surface(const clast_mesh_check_result *found)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(found->closed, CLAST_E_GEOMETRY,
              "the surface of the domain is open: %d open edges in %d loops; close it (clast mesh "
              "repair)",
              found->n_open_edge, found->n_open_loop);
    CLX_CHECK(found->oriented && found->volume > 0.0, CLAST_E_GEOMETRY,
              "the surface of the domain is not oriented outward: %d edges run the wrong way, %d "
              "parts are inside out; orient them (clast mesh repair)",
              found->n_misoriented_edge, found->n_inside_out);
    CLX_CHECK(found->n_intersection == 0, CLAST_E_GEOMETRY,
              "the surface of the domain cuts itself at %lld pairs of triangles, first %d and %d; "
              "see clast mesh check",
              (long long)found->n_intersection, found->intersection[0], found->intersection[1]);
    for (int32_t k = 0; k < found->n_part; ++k) {
        const clast_mesh_part *part = &found->part[k];
        CLX_CHECK((part->depth % 2 == 0) == (part->volume > 0.0), CLAST_E_GEOMETRY,
                  "part %d of the domain's surface lies in %d others and is oriented %sward: what "
                  "is inside is not defined",
                  k, part->depth, part->volume > 0.0 ? "out" : "in");
    }
done:
    return status;
}

static clast_status check(const clast_mesh *mesh)
{
    clast_mesh_check_result found = {0};
    clast_status status = clast_mesh_check(mesh, &found);
    if (status == CLAST_OK) {
        status = check_surface(&found);
    }
    clast_mesh_check_free(&found);
    return status;
}

static void free_surface(clast_domain_surface *surface)
{
    if (surface != NULL) {
        clast_bvh_destroy(surface->bvh);
        clast_mesh_free(&surface->mesh);
        clx_free(surface);
    }
}

clast_status clast_domain_of_mesh(const clast_mesh *mesh, double scale, clast_domain *domain)
{
    CLX_FLOAT_ENVIRONMENT;
    CLX_WHOLE(mesh, mesh);
    clast_status status = CLAST_OK;
    clast_domain made = {.kind = CLAST_DOMAIN_MESH, .dimension = 3};
    clast_domain_surface *s = NULL;
    clast_mass mass = {0};
    CLX_NEED(mesh);
    CLX_NEED(domain);
    CLX_CHECK(scale > 0.0 && isfinite(scale), CLAST_E_ARGUMENT, "the scale of a domain is %g",
              scale);
    CLX_TRY(clx_alloc(&s, 1, sizeof *s));
    CLX_TRY(clast_mesh_copy(mesh, &s->mesh));
    for (int32_t v = 0; v < s->mesh.n_vert; ++v) {
        for (int k = 0; k < 3; ++k) {
            s->mesh.vert[v][k] *= scale;
        }
    }
    CLX_TRY(check(&s->mesh));
    CLX_TRY(clast_mesh_mass(&s->mesh, &mass));
    CLX_TRY(clast_bvh_create(&s->mesh, &s->bvh));
    clast_mesh_bounds(&s->mesh, made.low, made.high);
    s->volume = mass.volume;
    made.surface = s;
    s = NULL;
    *domain = made;
done:
    free_surface(s);
    return status;
}

void clast_domain_free(clast_domain *domain)
{
    if (domain == NULL) {
        return;
    }
    free_surface(domain->surface);
    *domain = (clast_domain){0};
}
