#pragma once
// The wrap: what a ball of a stated radius, rolling in from outside, cannot reach.
#include <clast/status.h>

typedef struct clast_envelope clast_envelope;
typedef struct clast_envelope_options clast_envelope_options;

/// `wrap` of clast_assembly_envelope.
clast_status clx_envelope_wrap(const clast_assembly *assembly,
                               const clast_envelope_options *options, clast_envelope *envelope);
