#pragma once
// Many bodies that lie still, found fast: what does a body that comes along a line touch first?
//
// A binary tree of boxes that grows body by body: each new body goes where it makes the boxes grow
// least, and at every doubling of the count (or when a path grows too long) the tree is built
// afresh, so that a query costs O(log n) at any size for O(log n) per insertion.
// [docs/theory/first-touch.md]
#include "touch/first_touch.h"

/// Opaque. Inserting is for one thread; queries may run in many threads between insertions.
typedef struct clx_touch_scene clx_touch_scene;

clast_status clx_touch_scene_create(clx_touch_scene **scene);
/// About how many walks go by to each body that joins; 1 until it is told. No result depends on it.
void clx_touch_scene_expect(clx_touch_scene *scene, int64_t n_walk);
void clx_touch_scene_destroy(clx_touch_scene *scene); ///< NULL is allowed

/// Adds a copy of a body; its number is the count before. The scene is untouched on failure.
clast_status clx_touch_scene_insert(clx_touch_scene *scene, const clx_touch_body *body);

int32_t clx_touch_scene_count(const clx_touch_scene *scene);

/// Body number i; valid until the next insertion.
const clx_touch_body *clx_touch_scene_body(const clx_touch_scene *scene, int32_t i);

/// First body that the moving body touches, with touch->body its number; of equal t the lowest
/// number. Answers and limits as clx_first_touch. @note no allocation, thread-safe
bool clx_touch_scene_first(const clx_touch_scene *scene, const clx_touch_body *moving,
                           const clx_touch_path *path, clx_touch *touch);

/// The same as if only bodies 0 .. n - 1 were there.
bool clx_touch_scene_first_among(const clx_touch_scene *scene, int32_t n,
                                 const clx_touch_body *moving, const clx_touch_path *path,
                                 clx_touch *touch);

/// How far a ball about x may grow before it can touch a body: never more than the distance to the
/// nearest surface, and that distance where the nearest bodies are spheres. `limit` where nothing
/// is that near.
double clx_touch_scene_clearance(const clx_touch_scene *scene, const double x[3], double limit);

/// Called for each body; false ends the visit.
typedef bool (*clx_touch_visit)(int32_t body, void *context);

/// Visits every body whose box comes within `distance` of the body's box, in no stated but
/// repeatable order; false if the visitor ended it.
bool clx_touch_scene_near(const clx_touch_scene *scene, const clx_touch_body *body, double distance,
                          clx_touch_visit visit, void *context);
