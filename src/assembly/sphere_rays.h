#pragma once
// The published envelope: hull of the outermost hits of rays on the sphere composites.
#include <clast/status.h>

typedef struct clast_envelope clast_envelope;
typedef struct clast_envelope_options clast_envelope_options;

/// sphere_rays of clast_assembly_envelope.
clast_status clx_envelope_sphere_rays(const clast_assembly *assembly,
                                      const clast_envelope_options *options,
                                      clast_envelope *envelope);
