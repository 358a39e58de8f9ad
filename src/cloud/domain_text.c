// Domains from and to their names: "cylinder:0,0,1mm,0,0,1,5mm,2cm".
#include <clast/cloud.h>

#include "base/number.h"
#include "base/status.h"
#include "cloud/contract.h"
#include <clast/field.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MAX_NUMBER = 8, WORD_SIZE = 64, NAME_SIZE = 32 };

/// The numbers of a name as lengths [m], and as they stand for a direction.
typedef struct {
    double length[MAX_NUMBER];
    bool has_unit[MAX_NUMBER];
    double plain[MAX_NUMBER];
} numbers;

/// Numbers after the colon; -1 when they are not numbers, or of no unit of length.
static int parse_numbers(const char *text, double factor, numbers *of)
{
    int n = 0;
    for (const char *at = text;; ++n) {
        char word[WORD_SIZE];
        char *end = NULL;
        const size_t length = strcspn(at, ",");
        if (n == MAX_NUMBER || length == 0 || length >= sizeof word) {
            return -1;
        }
        memcpy(word, at, length);
        word[length] = '\0';
        of->plain[n] = clx_number_read(word, &end);
        of->has_unit[n] = *end != '\0';
        if (end == word || clast_unit_parse(word, "m", &of->length[n]) != CLAST_OK) {
            return -1;
        }
        of->length[n] *= of->has_unit[n] ? 1.0 : factor;
        if (!isfinite(of->length[n])) {
            return -1;
        }
        at += length;
        if (*at == '\0') {
            return n + 1;
        }
        ++at;
    }
}

static clast_status bad(const char *text)
{
    return clx_fail(CLAST_E_CONFIG,
                    "domain '%s': expected box:LOW...,HIGH... (2, 4 or 6 numbers), cylinder:R,L, "
                    "cylinder:X,Y,Z,NX,NY,NZ,R,L (base centre, axis), half-pipe:R,L, sphere:R or "
                    "sphere:X,Y,Z,R with positive sizes, as 0.01 or 10mm, or mesh:FILE",
                    text);
}

static bool set_box(const numbers *of, int n, clast_domain *domain)
{
    domain->dimension = n / 2;
    for (int j = 0; j < n / 2 && j < 3; ++j) {
        domain->low[j] = of->length[j];
        domain->high[j] = of->length[n / 2 + j];
        if (!(domain->high[j] > domain->low[j])) {
            return false;
        }
    }
    return n == 2 || n == 4 || n == 6;
}

static bool set_sizes(double radius, double length, clast_domain *domain)
{
    domain->radius = radius;
    domain->length = length;
    return radius > 0.0 && length > 0.0;
}

static void cross(const double a[3], const double b[3], double c[3])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static bool normalise(double v[3])
{
    const double size = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int k = 0; k < 3; ++k) {
        v[k] /= size;
    }
    return size > 0.0 && isfinite(size);
}

/// Local z along the direction, x beside the axis of the world that it leans to least.
static bool place(const double centre[3], const double direction[3], clast_domain *domain)
{
    double beside[3] = {0};
    int least = 0;
    for (int k = 1; k < 3; ++k) {
        least = fabs(direction[k]) < fabs(direction[least]) ? k : least;
    }
    beside[least] = 1.0;
    memcpy(domain->centre, centre, sizeof domain->centre);
    memcpy(domain->axes[2], direction, sizeof domain->axes[2]);
    domain->is_placed = true;
    if (!normalise(domain->axes[2])) {
        return false;
    }
    cross(domain->axes[2], beside, domain->axes[1]);
    const bool is_made = normalise(domain->axes[1]);
    cross(domain->axes[1], domain->axes[2], domain->axes[0]);
    return is_made;
}

static bool set_cylinder(const numbers *of, int n, clast_domain *domain)
{
    if (n == 2) {
        return set_sizes(of->length[0], of->length[1], domain);
    }
    return n == 8 && !of->has_unit[3] && !of->has_unit[4] && !of->has_unit[5] &&
           set_sizes(of->length[6], of->length[7], domain) &&
           place(of->length, of->plain + 3, domain);
}

static bool set_sphere(const numbers *of, int n, clast_domain *domain)
{
    static const double up[3] = {0.0, 0.0, 1.0};
    if (n == 1) {
        return set_sizes(of->length[0], 1.0, domain);
    }
    return n == 4 && set_sizes(of->length[3], 1.0, domain) && place(of->length, up, domain);
}

static bool set_half_pipe(const numbers *of, int n, clast_domain *domain)
{
    return n == 2 && set_sizes(of->length[0], of->length[1], domain);
}

clast_status clast_domain_parse_in(const char *text, double factor, clast_domain *domain)
{
    static const struct {
        const char *name;
        clast_domain_kind kind;
        bool (*set)(const numbers *of, int n, clast_domain *domain);
    } kinds[] = {{"box:", CLAST_DOMAIN_BOX, set_box},
                 {"cylinder:", CLAST_DOMAIN_CYLINDER, set_cylinder},
                 {"half-pipe:", CLAST_DOMAIN_HALF_PIPE, set_half_pipe},
                 {"sphere:", CLAST_DOMAIN_SPHERE, set_sphere}};
    CLX_ARGUMENTS(text, domain);
    if (!(factor > 0.0) || !isfinite(factor)) {
        return clx_fail(CLAST_E_ARGUMENT, "clast_domain_parse_in: the unit is %g m", factor);
    }
    for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; ++k) {
        const size_t length = strlen(kinds[k].name);
        if (strncmp(text, kinds[k].name, length) == 0) {
            clast_domain made = {.kind = kinds[k].kind, .dimension = 3};
            numbers of = {0};
            const int n = parse_numbers(text + length, factor, &of);
            if (n < 1 || !kinds[k].set(&of, n, &made)) {
                return bad(text);
            }
            if (clx_domain_check(&made) != CLAST_OK) { // its numbers make sense: its volume
                clx_fail_prefix("domain '%s'", text);
                return CLAST_E_CONFIG;
            }
            *domain = made;
            return CLAST_OK;
        }
    }
    return bad(text);
}

clast_status clast_domain_parse(const char *text, clast_domain *domain)
{
    CLX_ARGUMENTS(text, domain);
    return clast_domain_parse_in(text, 1.0, domain);
}

/// Adds a comma, but for the first, and a number.
static void add_number(double value, char text[CLAST_DOMAIN_TEXT])
{
    char number[CLX_NUMBER_SIZE];
    const size_t used = strlen(text);
    (void)clx_number_format(value, number);
    (void)snprintf(text + used, CLAST_DOMAIN_TEXT - used, "%s%s", text[used - 1] == ':' ? "" : ",",
                   number);
}

static void add_numbers(const double *value, int32_t n, char text[CLAST_DOMAIN_TEXT])
{
    for (int32_t k = 0; k < n; ++k) {
        add_number(value[k], text);
    }
}

void clast_domain_format(const clast_domain *domain, char text[CLAST_DOMAIN_TEXT])
{
    static const char *const name[] = {
        "box:", "cylinder:", "half-pipe:", "sphere:", "map:", "mesh:"};
    if (text == NULL) {
        return;
    }
    if (clx_domain_check(domain) != CLAST_OK) {
        (void)snprintf(text, CLAST_DOMAIN_TEXT, "no domain");
        return;
    }
    (void)snprintf(text, CLAST_DOMAIN_TEXT, "%s", name[domain->kind]);
    if (domain->kind == CLAST_DOMAIN_MAP) {
        (void)snprintf(text, CLAST_DOMAIN_TEXT, "map");
    } else if (domain->kind == CLAST_DOMAIN_BOX || domain->kind == CLAST_DOMAIN_MESH) {
        add_numbers(domain->low, domain->dimension, text);
        add_numbers(domain->high, domain->dimension, text);
    } else {
        if (domain->is_placed) {
            add_numbers(domain->centre, 3, text);
        }
        if (domain->is_placed && domain->kind == CLAST_DOMAIN_CYLINDER) {
            add_numbers(domain->axes[2], 3, text);
        }
        add_number(domain->radius, text);
        if (domain->kind != CLAST_DOMAIN_SPHERE) {
            add_number(domain->length, text);
        }
    }
}
