// Arguments of the functions on clouds.
#include "cloud/contract.h"

#include "base/status.h"
#include <clast/cloud.h>
#include <math.h>

clast_status clx_cloud_check(const clast_cloud *cloud)
{
    clast_status status = CLAST_OK;
    CLX_NEED(cloud);
    CLX_CHECK(cloud->dimension >= 1 && cloud->dimension <= 3, CLAST_E_ARGUMENT,
              "a cloud has 1, 2 or 3 dimensions, not %d", cloud->dimension);
    CLX_CHECK(cloud->n >= 0 && (cloud->n == 0 || cloud->x != NULL), CLAST_E_ARGUMENT,
              "a cloud of %lld points%s", (long long)cloud->n,
              cloud->n < 0 ? "" : " without coordinates: x is NULL");
done:
    return status;
}

clast_status clx_cube_check(const double *u, int64_t n, int32_t d, int64_t least, const char *what)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(n >= least && d >= 1 && d <= 3, CLAST_E_ARGUMENT,
              "%s needs at least %lld points in 1 to 3 dimensions, not %lld in %d", what,
              (long long)least, (long long)n, d);
    CLX_CHECK(n == 0 || u != NULL, CLAST_E_ARGUMENT, "%s: u is NULL", what);
    int inside = 1;
    for (int64_t i = 0; i < n * d; ++i) { // no branch: a tenth of a ns each
        inside &= (u[i] >= 0.0) & (u[i] <= 1.0);
    }
    for (int64_t i = 0; i < n * d && inside == 0; ++i) {
        CLX_CHECK(u[i] >= 0.0 && u[i] <= 1.0, CLAST_E_ARGUMENT,
                  "%s: coordinate %lld of point %lld is %g, outside the unit cube", what,
                  (long long)(i % d), (long long)(i / d) + 1, u[i]);
    }
done:
    return status;
}

static bool is_box(const clast_domain *domain)
{
    bool is = true;
    for (int32_t j = 0; j < domain->dimension; ++j) {
        is = is && isfinite(domain->low[j]) && isfinite(domain->high[j]) &&
             domain->high[j] > domain->low[j];
    }
    return is;
}

/// Volumes are squared: that shall be a number.
static const double LEAST_VOLUME = 1e-150;
static const double GREATEST_VOLUME = 1e150;

clast_status clx_domain_check(const clast_domain *domain)
{
    clast_status status = CLAST_OK;
    CLX_NEED(domain);
    CLX_CHECK((unsigned)domain->kind <= CLAST_DOMAIN_MESH, CLAST_E_ARGUMENT,
              "%d is no kind of domain", (int)domain->kind);
    CLX_CHECK(domain->dimension >= 1 && domain->dimension <= 3, CLAST_E_ARGUMENT,
              "a domain has 1, 2 or 3 dimensions, not %d", domain->dimension);
    if (domain->kind == CLAST_DOMAIN_BOX) {
        CLX_CHECK(is_box(domain), CLAST_E_ARGUMENT, "the corners of the domain make no box");
    } else if (domain->kind == CLAST_DOMAIN_MESH) {
        CLX_CHECK(domain->surface != NULL && domain->dimension == 3, CLAST_E_ARGUMENT,
                  "the domain has no surface: make it with clast_domain_of_mesh");
    } else if (domain->kind == CLAST_DOMAIN_MAP) {
        CLX_CHECK(domain->user.map != NULL && domain->user.unmap != NULL, CLAST_E_ARGUMENT,
                  "the domain has no map: make it with clast_domain_of_map");
    } else {
        CLX_CHECK(domain->dimension == 3 && domain->radius > 0.0 && domain->length > 0.0 &&
                      isfinite(domain->radius) && isfinite(domain->length),
                  CLAST_E_ARGUMENT,
                  "the domain has the radius %g and the length %g in %d dimensions", domain->radius,
                  domain->length, domain->dimension);
    }
    const double volume = clast_domain_volume(domain);
    CLX_CHECK(volume >= LEAST_VOLUME && volume <= GREATEST_VOLUME, CLAST_E_ARGUMENT,
              "the volume of the domain is %g m^%d, and its square no number: it lies between %g "
              "and %g",
              volume, domain->dimension, LEAST_VOLUME, GREATEST_VOLUME);
done:
    return status;
}
