#pragma once
// The alpha envelope: what a ball that passes between surface points cannot reach.
#include <clast/status.h>

typedef struct clast_envelope clast_envelope;
typedef struct clast_envelope_options clast_envelope_options;

/// `alpha` of clast_assembly_envelope.
clast_status clx_envelope_alpha(const clast_assembly *assembly,
                                const clast_envelope_options *options, clast_envelope *envelope);
