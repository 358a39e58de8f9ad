#pragma once
// Templates of the core and of what is thrown at it, made ready once: shapes with their trees,
// groups with their sizes.
#include "touch/body.h"
#include <clast/aggregate.h>

/// A distinct shape of the run.
typedef struct clx_template_shape {
    const clast_shape *shape; ///< borrowed
    clx_touch_tree *tree;     ///< of surfaces and composites, or NULL
    clx_touch_body body;      ///< as contact sees it: at the origin, scale 1
    int32_t group;            ///< that it belongs to
    double inertia_trace;     ///< half the trace of the inertia: integral of r2 about the centroid
} clx_template_shape;

/// One placed shape of a rigid group, relative to the group's centre of mass.
typedef struct clx_template_part {
    int32_t shape; ///< in the templates
    double position[3];
    double orientation[4];
    double scale;
    double density;
} clx_template_part;

/// A core or a coating "shape": one grain, or an aggregate that is thrown as one.
typedef struct clx_template {
    int32_t n_part;
    clx_template_part *part; ///< [n_part] owned
    int32_t n_contact;
    int32_t (*contact)[2];      ///< [n_contact] parts that touch, owned
    double (*contact_point)[3]; ///< [n_contact] relative to the centre of mass
    double centre[3];           ///< centre of mass in the coordinates of its assembly
    double volume;              ///< sum of its parts'
    double mass;
    double length;        ///< greatest distance of two of its points
    double mean_diameter; ///< (L I S)^(1/3); 0 where no size means it
    double radius;        ///< everything lies within this distance of the centre of mass
    double inner;         ///< everything within this distance of the centre of mass is solid, or 0
    bool is_round;        ///< one sphere: turning it changes nothing
} clx_template;

typedef struct clx_templates {
    int32_t n_shape;
    clx_template_shape *shape; ///< [n_shape]
    int32_t n_group;
    clx_template *group; ///< [n_group] 0 the core (in cluster mode empty), 1 + k coating shape k
} clx_templates;

/// Shapes and groups of this input for this kind of contact.
///
/// @return CLAST_E_GEOMETRY for a shape without the composite that the contact needs
clast_status clx_templates_make(const clast_aggregate_params *params,
                                const clast_aggregate_input *input, clx_templates *templates);
void clx_templates_free(clx_templates *templates);

/// Size of a group at scale 1 by one of the meanings.
double clx_template_size(const clx_template *group, int32_t meaning);

/// Part `part` of a group whose centre of mass is at `centre`, turned and scaled.
void clx_template_pose(const clx_template *group, int32_t part, const double centre[3],
                       const double orientation[4], double scale, clx_template_part *placed);
