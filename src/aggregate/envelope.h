#pragma once
// Envelopes of an aggregate while it grows.
#include <clast/assembly.h>

/// Volumes of chosen kinds, kept up to date grain by grain. Opaque; one thread at a time.
///
/// Its state is a function of the sequence of grains added, never of when volumes were asked for,
/// so a run that is resumed by adding all grains again goes on with the same bytes.
typedef struct clx_envelope_tracker clx_envelope_tracker;

/// @param options  copied; `tolerance` is the gap between the bounds of the hulls of smooth bodies
///                 after every grain (2e-3 is cheap; polyhedra are exact anyway)
clast_status clx_envelope_tracker_create(int32_t n_kind, const clast_envelope_kind *kind,
                                         const clast_envelope_options *options,
                                         clx_envelope_tracker **tracker);
void clx_envelope_tracker_destroy(clx_envelope_tracker *tracker); ///< NULL is allowed

/// Takes in grain i of the assembly. The hulls pay O(facets) for a grain inside them, and what
/// their refinement needs for one that shows; other kinds do nothing here.
///
/// @return CLAST_E_USAGE when a sphere kind is tracked and the grain's shape has no spheres
clast_status clx_envelope_tracker_add(clx_envelope_tracker *tracker, const clast_assembly *assembly,
                                      int32_t i);

/// Volumes now, [n_kind] in the order of create, of the assembly that holds the grains added.
///
/// Hulls of polyhedra are exact; hulls of smooth bodies carry their gap's estimate (value) and its
/// uncertainty. sphere_rays, enclosing_sphere and gyration_sphere are worked out anew: O(rays +
/// spheres), O(grains), O(grains). For the last digit use clast_assembly_envelope.
clast_status clx_envelope_tracker_now(clx_envelope_tracker *tracker, const clast_assembly *assembly,
                                      clast_envelope *envelope);
