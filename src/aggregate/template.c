// Shapes and groups made ready to be thrown.
#include "aggregate/template.h"

#include "aggregate/form.h"
#include "assembly/pieces.h"
#include "base/alloc.h"
#include "base/parallel.h"
#include "geom/bvh.h"
#include "math/vec3.h"
#include "touch/inside.h"
#include "touch/tree.h"
#include <clast/shape.h>
#include <string.h>

void clx_templates_free(clx_templates *templates)
{
    for (int32_t i = 0; i < templates->n_shape; ++i) {
        clx_touch_tree_destroy(templates->shape[i].tree);
    }
    for (int32_t g = 0; g < templates->n_group; ++g) {
        CLX_FREE(templates->group[g].part, templates->group[g].contact,
                 templates->group[g].contact_point);
    }
    CLX_FREE(templates->shape, templates->group);
    *templates = (clx_templates){0};
}

static clast_status composite(const clast_shape *shape, clx_template_shape *made)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(shape->spheres.n > 0, CLAST_E_GEOMETRY,
              "shape %s has no sphere composite; give coat_spheres or fill it", shape->name);
    CLX_TRY(clx_touch_tree_spheres(shape->spheres.n, shape->spheres.centre, shape->spheres.radius,
                                   &made->tree));
    made->body = clx_touch_body_tree(made->tree);
done:
    return status;
}

static clast_status true_surface(const clast_shape *shape, clx_template_shape *made)
{
    clast_status status = CLAST_OK;
    if (shape->kind == CLAST_SHAPE_SPHERE) {
        made->body = clx_touch_body_sphere(shape->semi_axes[0]);
    } else if (shape->kind == CLAST_SHAPE_ELLIPSOID) {
        made->body = clx_touch_body_ellipsoid(shape->semi_axes);
    } else if (shape->kind == CLAST_SHAPE_CLUMP) {
        CLX_TRY(composite(shape, made));
    } else {
        CLX_TRY(clx_touch_tree_mesh(&shape->mesh, &made->tree));
        made->body = clx_touch_body_tree(made->tree);
    }
done:
    return status;
}

static clast_status make_shape(int32_t contact, clx_template_shape *made)
{
    const clast_shape *shape = made->shape;
    double trace = 0.0;
    for (int k = 0; k < 3; ++k) {
        trace += 0.5 * shape->inertia[k][k];
    }
    made->inertia_trace = trace;
    const bool round = shape->kind == CLAST_SHAPE_SPHERE && shape->spheres.n == 0;
    return contact == CLAST_CONTACT_EXACT || round ? true_surface(shape, made)
                                                   : composite(shape, made);
}

static clast_status make_parts(const clx_templates *templates, const clast_assembly *assembly,
                               int32_t first_shape, clx_template *group)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_alloc(&group->part, assembly->n_grain, sizeof *group->part));
    group->n_part = assembly->n_grain;
    clast_assembly_centre(assembly, group->centre);
    for (int32_t i = 0; i < group->n_part; ++i) {
        clx_template_part *part = &group->part[i];
        const double s = assembly->scale[i];
        part->shape = first_shape + assembly->shape_id[i];
        v3_sub(part->position, assembly->position[i], group->centre);
        for (int k = 0; k < 4; ++k) {
            part->orientation[k] = assembly->orientation[i][k];
        }
        part->scale = s;
        part->density = assembly->density[i];
        const clast_shape *shape = templates->shape[part->shape].shape;
        const double volume = shape->volume * s * s * s;
        group->volume += volume;
        group->mass += volume * part->density;
        group->radius = fmax(group->radius, v3_norm(part->position) + s * shape->bounding_radius);
    }
done:
    return status;
}

/// Distance of a point in a closed surface to its triangles; 0 when it is outside.
static double depth_in_mesh(const clx_template_shape *shape, const double p[3])
{
    double least = INFINITY;
    if (!clx_bvh_is_closed(&shape->shape->mesh) || !clx_touch_tree_inside(shape->tree, p)) {
        return 0.0;
    }
    for (int32_t i = 0; i < shape->tree->n_item; ++i) {
        double closest[3];
        double corner[3][3];
        memcpy(corner, shape->tree->corner[i], sizeof corner);
        least = fmin(least, clx_triangle_closest(corner, p, closest));
    }
    return sqrt(least);
}

/// Radius of a ball about p within a shape at scale 1, not always the largest; may be negative.
static double depth_in_shape(const clx_template_shape *shape, const double p[3])
{
    const clx_touch_body *body = &shape->body;
    double most = 0.0;
    if (body->kind == CLX_TOUCH_MESH) {
        return depth_in_mesh(shape, p);
    }
    if (body->kind == CLX_TOUCH_SPHERES) {
        for (int32_t i = 0; i < body->tree->n_item; ++i) {
            const double *ball = body->tree->ball[i];
            most = fmax(most, ball[3] - v3_distance(ball, p));
        }
        return most;
    }
    const double *a = body->semi_axes;
    const double least = body->kind == CLX_TOUCH_SPHERE ? a[0] : fmin(a[0], fmin(a[1], a[2]));
    return least - v3_norm(p);
}

/// A ball about the centre of mass that lies within a part lies within the group.
static void measure_inner(const clx_templates *templates, clx_template *group)
{
    for (int32_t i = 0; i < group->n_part; ++i) {
        const clx_template_part *part = &group->part[i];
        const double *q = part->orientation;
        const double back[4] = {q[0], -q[1], -q[2], -q[3]};
        double arm[3];
        v3_scale(arm, -1.0 / part->scale, part->position);
        q_rotate(arm, back, arm);
        const double depth = part->scale * depth_in_shape(&templates->shape[part->shape], arm);
        group->inner = fmax(group->inner, depth * (1.0 - 1e-9));
    }
}

static clast_status copy_contacts(const clast_assembly *assembly, clx_template *group)
{
    clast_status status = CLAST_OK;
    const int32_t n = assembly->n_contact;
    CLX_TRY(clx_alloc(&group->contact, n, sizeof *group->contact));
    CLX_TRY(clx_alloc(&group->contact_point, n, sizeof *group->contact_point));
    group->n_contact = n;
    for (int32_t i = 0; i < n; ++i) {
        group->contact[i][0] = assembly->contact[i][0];
        group->contact[i][1] = assembly->contact[i][1];
        v3_sub(group->contact_point[i], assembly->contact_point[i], group->centre);
    }
done:
    return status;
}

/// The length of a single shape is known; width and thickness take a search, made only if needed.
static clast_status measure_form(const clx_templates *templates, bool need_mean,
                                 clx_template *group)
{
    clast_status status = CLAST_OK;
    double form[3];
    const clx_template_part *part = &group->part[0];
    group->length = part->scale * templates->shape[part->shape].shape->length;
    if (group->n_part > 1 || need_mean) {
        CLX_TRY(clx_form_dimensions(templates, group, form));
        group->length = form[0];
        group->mean_diameter = cbrt(form[0] * form[1] * form[2]);
    }
done:
    return status;
}

/// A core or a coating "shape" is one rigid body: clusters that a run left side by side are not.
/// Where no contact is known it is the caller's word.
static clast_status check_one_piece(const clast_assembly *assembly, int32_t g)
{
    clast_status status = CLAST_OK;
    int32_t *piece = NULL;
    int32_t n_piece = 1;
    CLX_CHECK(assembly->n_grain > 0, CLAST_E_GEOMETRY,
              "an aggregate of no grains cannot be released");
    CLX_TRY(clx_alloc(&piece, assembly->n_grain, sizeof *piece));
    if (assembly->n_contact > 0) {
        CLX_TRY(clx_assembly_pieces(assembly, piece, &n_piece));
    }
    CLX_CHECK(n_piece == 1, CLAST_E_GEOMETRY,
              "%s: its %d grains are %d pieces that do not touch, no one rigid body; of clusters, "
              "let the run that made them end in one (n_final 1)",
              g == 0 ? "core" : "coat", assembly->n_grain, n_piece);
done:
    clx_free(piece);
    return status;
}

static clast_status make_group(const clx_templates *templates, const clast_assembly *assembly,
                               int32_t first_shape, clx_template *group)
{
    clast_status status = CLAST_OK;
    CLX_TRY(make_parts(templates, assembly, first_shape, group));
    CLX_TRY(copy_contacts(assembly, group));
done:
    return status;
}

/// What takes long is made ready side by side: a tree for each shape, then the form of each group.
typedef struct {
    const clast_aggregate_params *params;
    clx_templates *templates;
} template_job;

static clast_status make_group_form(const template_job *job, int32_t g)
{
    CLAST_ASSERT(g >= 0 && g < job->templates->n_group);
    clx_template *group = &job->templates->group[g];
    const int32_t meaning = g == 0 ? job->params->core_meaning : job->params->size_meaning;
    return group->n_part > 0 ? measure_form(job->templates, meaning == CLAST_SIZE_MEAN, group)
                             : CLAST_OK;
}

static clast_status make_some(int64_t begin, int64_t end, int32_t worker, void *context)
{
    clast_status status = CLAST_OK;
    const template_job *job = context;
    const int64_t n_shape = job->templates->n_shape;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        CLX_TRY(i < n_shape ? make_shape(job->params->contact, &job->templates->shape[i])
                            : make_group_form(job, (int32_t)(i - n_shape)));
    }
done:
    return status;
}

static clast_status make_all(const clast_aggregate_params *params, clx_templates *templates)
{
    template_job job = {.params = params, .templates = templates};
    return clx_parallel_try((int64_t)templates->n_shape + templates->n_group, 1, make_some, &job);
}

/// Assembly g of the input: 0 the core (none in cluster mode), 1 + k coating shape k.
static const clast_assembly *assembly_of(const clast_aggregate_input *input, int32_t g)
{
    CLAST_ASSERT(g >= 0 && g <= input->n_coat);
    return g == 0 ? input->core : &input->coat[g - 1];
}

/// One assembly's shapes come after those before it.
static clast_status name_shapes(const clast_aggregate_input *input, clx_templates *templates)
{
    clast_status status = CLAST_OK;
    int32_t n_all = 0;
    for (int32_t g = 0; g <= input->n_coat; ++g) {
        const clast_assembly *from = assembly_of(input, g);
        n_all += from != NULL ? from->n_shape : 0;
    }
    CLX_TRY(clx_alloc(&templates->shape, n_all, sizeof *templates->shape));
    for (int32_t g = 0; g <= input->n_coat; ++g) {
        const clast_assembly *from = assembly_of(input, g);
        for (int32_t i = 0; from != NULL && i < from->n_shape; ++i) {
            templates->shape[templates->n_shape].group = g;
            templates->shape[templates->n_shape++].shape = &from->shape[i];
        }
    }
done:
    return status;
}

/// The parts of every group; an absent assembly leaves its group empty.
static clast_status name_groups(const clast_aggregate_input *input, clx_templates *templates)
{
    clast_status status = CLAST_OK;
    int32_t first = 0;
    CLX_TRY(clx_alloc(&templates->group, 1 + input->n_coat, sizeof *templates->group));
    templates->n_group = 1 + input->n_coat;
    for (int32_t g = 0; g < templates->n_group; ++g) {
        const clast_assembly *from = assembly_of(input, g);
        if (from != NULL) {
            CLX_TRY(check_one_piece(from, g));
            CLX_TRY(make_group(templates, from, first, &templates->group[g]));
            first += from->n_shape;
        }
    }
done:
    return status;
}

clast_status clx_templates_make(const clast_aggregate_params *params,
                                const clast_aggregate_input *input, clx_templates *templates)
{
    clast_status status = CLAST_OK;
    clx_templates made = {0};
    CLX_TRY(name_shapes(input, &made));
    CLX_TRY(name_groups(input, &made));
    CLX_TRY(make_all(params, &made));
    for (int32_t g = 0; g < made.n_group; ++g) {
        clx_template *group = &made.group[g];
        measure_inner(&made, group);
        group->is_round =
            group->n_part == 1 && made.shape[group->part[0].shape].body.kind == CLX_TOUCH_SPHERE;
    }
    *templates = made;
    made = (clx_templates){0};
done:
    clx_templates_free(&made);
    return status;
}

double clx_template_size(const clx_template *group, int32_t meaning)
{
    switch (meaning) {
    case CLAST_SIZE_LENGTH:
        return group->length;
    case CLAST_SIZE_VOLUME:
        return cbrt(6.0 * group->volume / CLAST_PI);
    default:
        return group->mean_diameter;
    }
}

void clx_template_pose(const clx_template *group, int32_t part, const double centre[3],
                       const double orientation[4], double scale, clx_template_part *placed)
{
    CLAST_ASSERT(part >= 0 && part < group->n_part && scale > 0.0);
    const clx_template_part *p = &group->part[part];
    double arm[3];
    q_rotate(arm, orientation, p->position);
    v3_axpy(placed->position, centre, scale, arm);
    q_mul(placed->orientation, orientation, p->orientation);
    q_unit(placed->orientation);
    placed->shape = p->shape;
    placed->scale = scale * p->scale;
    placed->density = p->density;
}
