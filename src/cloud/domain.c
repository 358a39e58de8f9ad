// Domains and their measure-preserving maps to the unit cube.
#include <clast/domain.h>

#include "base/number.h"
#include "cloud/surface.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_NUMBER = 6 };

/// Numbers after the colon; -1 when they are not numbers.
static int parse_numbers(const char *text, double *number)
{
    int n = 0;
    const char *at = text;
    while (*at != '\0') {
        char *end = NULL;
        if (n == MAX_NUMBER) {
            return -1;
        }
        number[n] = clx_number_read(at, &end);
        if (end == at || !isfinite(number[n]) || (*end != ',' && *end != '\0')) {
            return -1;
        }
        ++n;
        at = *end == ',' ? end + 1 : end;
    }
    return n;
}

static clast_status bad(const char *text)
{
    return clx_fail(CLAST_E_CONFIG,
                    "domain '%s': expected box:LOW...,HIGH... (2, 4 or 6 numbers), cylinder:R,L, "
                    "half-pipe:R,L, sphere:R with positive sizes, or mesh:FILE",
                    text);
}

static bool set_box(const double *number, int n, clast_domain *domain)
{
    domain->dimension = n / 2;
    for (int j = 0; j < n / 2; ++j) {
        domain->low[j] = number[j];
        domain->high[j] = number[n / 2 + j];
        if (!(domain->high[j] > domain->low[j])) {
            return false;
        }
    }
    return n == 2 || n == 4 || n == 6;
}

clast_status clast_domain_parse(const char *text, clast_domain *domain)
{
    CLX_ARGUMENTS(text, domain);
    static const struct {
        const char *name;
        clast_domain_kind kind;
        int n;
    } kinds[] = {{"box:", CLAST_DOMAIN_BOX, 0},
                 {"cylinder:", CLAST_DOMAIN_CYLINDER, 2},
                 {"half-pipe:", CLAST_DOMAIN_HALF_PIPE, 2},
                 {"sphere:", CLAST_DOMAIN_SPHERE, 1}};
    if (text == NULL || domain == NULL) {
        return clx_fail(CLAST_E_ARGUMENT, "clast_domain_parse: %s is NULL",
                        text == NULL ? "text" : "domain");
    }
    for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; ++k) {
        const size_t length = strlen(kinds[k].name);
        if (strncmp(text, kinds[k].name, length) != 0) {
            continue;
        }
        clast_domain made = {.kind = kinds[k].kind, .dimension = 3};
        double number[MAX_NUMBER] = {0};
        const int n = parse_numbers(text + length, number);
        made.radius = number[0];
        made.length = kinds[k].n == 2 ? number[1] : 1.0;
        const bool fits = made.kind == CLAST_DOMAIN_BOX
                              ? set_box(number, n, &made)
                              : n == kinds[k].n && made.radius > 0.0 && made.length > 0.0;
        if (!fits) {
            return bad(text);
        }
        *domain = made;
        return CLAST_OK;
    }
    return bad(text);
}

bool clx_domain_is_boxed(const clast_domain *d)
{
    return d->kind == CLAST_DOMAIN_BOX || d->kind == CLAST_DOMAIN_MESH;
}

/// A domain that can be mapped at all: clx_domain_check without its messages.
static bool is_usable(const clast_domain *d)
{
    return d != NULL && (unsigned)d->kind <= CLAST_DOMAIN_MESH && d->dimension >= 1 &&
           d->dimension <= 3 &&
           (d->kind != CLAST_DOMAIN_MAP || (d->user.map != NULL && d->user.unmap != NULL)) &&
           (d->kind != CLAST_DOMAIN_MESH || d->surface != NULL);
}

double clast_domain_volume(const clast_domain *d)
{
    if (!is_usable(d)) {
        return (double)NAN;
    }
    double volume = 1.0;
    switch (d->kind) {
    case CLAST_DOMAIN_MAP:
        return d->user.volume;
    case CLAST_DOMAIN_MESH:
        return d->surface->volume;
    case CLAST_DOMAIN_BOX:
        for (int32_t j = 0; j < d->dimension; ++j) {
            volume *= d->high[j] - d->low[j];
        }
        return volume;
    case CLAST_DOMAIN_CYLINDER:
        return CLAST_PI * d->radius * d->radius * d->length;
    case CLAST_DOMAIN_HALF_PIPE:
        return 0.5 * CLAST_PI * d->radius * d->radius * d->length;
    case CLAST_DOMAIN_SPHERE:
        break;
    }
    return 4.0 / 3.0 * CLAST_PI * d->radius * d->radius * d->radius;
}

void clast_domain_sides(const clast_domain *d, double side[3])
{
    if (!is_usable(d) || side == NULL) {
        return;
    }
    for (int32_t j = 0; j < 3; ++j) {
        side[j] = clx_domain_is_boxed(d) && j < d->dimension ? d->high[j] - d->low[j] : 1.0;
    }
}

static bool map_pipe(const clast_domain *d, const double *x, double *u)
{
    const double rho2 = x[0] * x[0] + x[1] * x[1];
    const double angle = atan2(x[1], x[0]);
    u[0] = rho2 / (d->radius * d->radius);
    u[1] = d->kind == CLAST_DOMAIN_HALF_PIPE ? angle / CLAST_PI : 0.5 + 0.5 * angle / CLAST_PI;
    u[2] = x[2] / d->length;
    return u[0] <= 1.0 && u[1] >= 0.0 && u[1] <= 1.0 && u[2] >= 0.0 && u[2] <= 1.0;
}

static bool map_sphere(const clast_domain *d, const double *x, double *u)
{
    const double r = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]) / d->radius;
    u[0] = r * r * r;
    u[1] = r > 0.0 ? fmin(fmax(0.5 + 0.5 * x[2] / (r * d->radius), 0.0), 1.0) : 0.5;
    u[2] = 0.5 + 0.5 * atan2(x[1], x[0]) / CLAST_PI;
    return r <= 1.0;
}

bool clast_domain_map(const clast_domain *d, const double *x, double *u)
{
    if (!is_usable(d) || x == NULL || u == NULL) {
        return false;
    }
    if (d->kind == CLAST_DOMAIN_SPHERE) {
        return map_sphere(d, x, u);
    }
    if (d->kind == CLAST_DOMAIN_MAP) {
        return d->user.map(d->user.context, x, u);
    }
    if (!clx_domain_is_boxed(d)) {
        return map_pipe(d, x, u);
    }
    bool inside = true;
    for (int32_t j = 0; j < d->dimension; ++j) {
        u[j] = (x[j] - d->low[j]) / (d->high[j] - d->low[j]);
        inside = inside && u[j] >= 0.0 && u[j] <= 1.0;
    }
    if (inside && d->kind == CLAST_DOMAIN_MESH) {
        return clast_bvh_inside(d->surface->bvh, x);
    }
    return inside;
}

void clast_domain_unmap(const clast_domain *d, const double *u, double *x)
{
    if (!is_usable(d) || u == NULL || x == NULL) {
        return;
    }
    if (d->kind == CLAST_DOMAIN_MAP) {
        d->user.unmap(d->user.context, u, x);
    } else if (clx_domain_is_boxed(d)) {
        for (int32_t j = 0; j < d->dimension; ++j) {
            x[j] = d->low[j] + u[j] * (d->high[j] - d->low[j]);
        }
    } else if (d->kind == CLAST_DOMAIN_SPHERE) {
        const double r = d->radius * cbrt(u[0]);
        const double z = 2.0 * u[1] - 1.0;
        const double rho = r * sqrt(fmax(0.0, 1.0 - z * z));
        const double angle = (2.0 * u[2] - 1.0) * CLAST_PI;
        x[0] = rho * cos(angle);
        x[1] = rho * sin(angle);
        x[2] = r * z;
    } else {
        const double rho = d->radius * sqrt(u[0]);
        const double angle =
            d->kind == CLAST_DOMAIN_HALF_PIPE ? u[1] * CLAST_PI : (2.0 * u[1] - 1.0) * CLAST_PI;
        x[0] = rho * cos(angle);
        x[1] = rho * sin(angle);
        x[2] = u[2] * d->length;
    }
}
