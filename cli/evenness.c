// Whether a cloud is uniform, and if not, which way: by the vote and by neighbours' distances.
#include "evenness.h"

#include "command.h"
#include "json.h"
#include "quantity.h"

#include <stdio.h>
#include <stdlib.h>

/// One cloud in 10,000 uniform ones is called non-uniform by its spacing alone.
static const double level = 1e-4;

static clast_status measure_spacing(const clast_comm *comm, const clast_domain *domain,
                                    const clast_cloud *cloud, cli_evenness *evenness)
{
    const int32_t d = cloud->dimension;
    int64_t n = 0;
    double *u = malloc(((size_t)(cloud->n * d) + 1) * sizeof *u);
    clast_status status = CLAST_OK;
    if (u == NULL) {
        status = cli_fail(CLAST_E_MEMORY, "not enough memory for %lld points", (long long)cloud->n);
    }
    CLI_TRY(clast_comm_agree(comm, status, NULL));
    for (int64_t i = 0; i < cloud->n; ++i) {
        n += clast_domain_map(domain, cloud->x + i * d, u + n * d) ? 1 : 0;
    }
    CLI_TRY(clast_spacing_ranks(comm, u, n, d, &evenness->spacing));
    evenness->has_spacing = status == CLAST_OK;
done:
    free(u);
    return status;
}

clast_status cli_decompose_evenness(const clast_comm *comm, const clast_domain *domain,
                                    const clast_cloud *cloud, const clast_decomposition *result,
                                    cli_evenness *evenness)
{
    clast_status status = CLAST_OK;
    *evenness = (cli_evenness){.is_tested = result->before.n_test > 0};
    if (evenness->is_tested && result->n >= 5 && domain->kind != CLAST_DOMAIN_MESH) {
        status = measure_spacing(comm, domain, cloud, evenness);
    }
    const bool is_far = evenness->has_spacing && evenness->spacing.p < level;
    if (result->before.reject || (is_far && evenness->spacing.ratio < 1.0)) {
        evenness->kind = CLI_LESS_EVEN;
    } else if (is_far) {
        evenness->kind = CLI_MORE_EVEN;
    }
    return status;
}

const char *cli_evenness_text(const cli_evenness *evenness)
{
    static const char *const text[3] = {"uniform", "not uniform: clustered or of varying density",
                                        "not uniform: regular (more evenly spaced than uniform)"};
    return evenness->is_tested ? text[evenness->kind] : "too few points to test";
}

void cli_evenness_print(const cli_evenness *evenness)
{
    if (evenness->has_spacing) {
        (void)printf("%-16s %12.6g %12s%s\n", "spacing", evenness->spacing.ratio,
                     cli_p_value(evenness->spacing.p),
                     evenness->spacing.p >= level    ? ""
                     : evenness->spacing.ratio > 1.0 ? "  regular"
                                                     : "  clustered");
    }
}

void cli_evenness_json(json_t *out, const cli_evenness *evenness)
{
    static const char *const word[3] = {"uniform", "less even", "more even"};
    json_t *spacing = evenness->has_spacing ? json_object() : json_null();
    cli_json_text(out, "evenness", evenness->is_tested ? word[evenness->kind] : NULL);
    if (evenness->has_spacing) {
        cli_json_number(spacing, "ratio", evenness->spacing.ratio);
        cli_json_number(spacing, "z_score", evenness->spacing.z);
        cli_json_number(spacing, "p", evenness->spacing.p);
    }
    (void)json_object_set_new(out, "spacing", spacing);
}
