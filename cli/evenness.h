#pragma once
// Whether a cloud is uniform, and if not, which way: by the vote and by neighbours' distances.
#include <clast/clast.h>
#include <jansson.h>

typedef enum { CLI_UNIFORM, CLI_LESS_EVEN, CLI_MORE_EVEN } cli_evenness_kind;

typedef struct cli_evenness {
    bool is_tested;   ///< 5 points or more
    bool has_spacing; ///< no closed surface
    cli_evenness_kind kind;
    clast_spacing spacing;
} cli_evenness;

/// Of the points of all ranks; called by all of them.
clast_status cli_decompose_evenness(const clast_comm *comm, const clast_domain *domain,
                                    const clast_cloud *cloud, const clast_decomposition *result,
                                    cli_evenness *evenness);

/// "not uniform: regular (more evenly spaced than uniform)".
const char *cli_evenness_text(const cli_evenness *evenness);

/// The line of the test of spacing.
void cli_evenness_print(const cli_evenness *evenness);

/// evenness, spacing{ratio, z_score, p}.
void cli_evenness_json(json_t *out, const cli_evenness *evenness);
