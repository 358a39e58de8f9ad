// Bodies and events as tables, and aggregates as assemblies.
#include "evolve/state.h"

#include "base/alloc.h"
#include "math/sort.h"
#include "math/vec3.h"
#include <clast/shape.h>
#include <clast/status.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const event_column[][2] = {{"event", "-"},
                                              {"time_s", "s"},
                                              {"node_a", "-"},
                                              {"node_b", "-"},
                                              {"node", "-"},
                                              {"grains", "-"},
                                              {"touched", "-"},
                                              {"arriving", "-"},
                                              {"x_m", "m"},
                                              {"y_m", "m"},
                                              {"z_m", "m"},
                                              {"mass_kg", "kg"},
                                              {"radius_of_gyration_m", "m"},
                                              {"envelope_m", "m"},
                                              {"speed_m/s", "m/s"}};

static const char *const body_column[][2] = {{"node", "-"},
                                             {"time_s", "s"},
                                             {"x_m", "m"},
                                             {"y_m", "m"},
                                             {"z_m", "m"},
                                             {"grains", "-"},
                                             {"mass_kg", "kg"},
                                             {"solid_m3", "m^3"},
                                             {"radius_of_gyration_m", "m"},
                                             {"enclosing_radius_m", "m"},
                                             {"envelope_m", "m"},
                                             {"porosity", "-"},
                                             {"density_kg/m^3", "kg/m^3"},
                                             {"collision_radius_m", "m"},
                                             {"speed_m/s", "m/s"}};

static double size_of(double envelope)
{
    return cbrt(6.0 * envelope / CLAST_PI);
}

static clast_status events_table(const clast_evolve *e, clast_table *table)
{
    clast_status status = CLAST_OK;
    clx_rows rows = {.n_column = sizeof event_column / sizeof *event_column,
                     .column = event_column};
    for (int64_t k = 0; k < e->n_event; ++k) {
        const clx_evolve_event *event = &e->event[k];
        double *row = NULL;
        CLX_TRY(clx_rows_add(&rows, &row));
        const double value[] = {(double)k,
                                event->time,
                                (double)event->node[0],
                                (double)event->node[1],
                                (double)(e->n_start + k),
                                event->n,
                                event->contact[0],
                                event->contact[1],
                                event->x[0],
                                event->x[1],
                                event->x[2],
                                event->mass,
                                event->gyration,
                                size_of(event->envelope),
                                event->speed};
        memcpy(row, value, sizeof value);
    }
    CLX_TRY(clx_rows_table(&rows, "events", table));
done:
    clx_rows_free(&rows);
    return status;
}

static void body_row(const clx_evolve_body *b, double *row)
{
    const double value[] = {(double)b->node,
                            b->time,
                            b->x[0],
                            b->x[1],
                            b->x[2],
                            b->n,
                            b->mass,
                            b->volume,
                            b->gyration,
                            b->bounding_radius,
                            size_of(b->envelope),
                            1.0 - b->volume / b->envelope,
                            b->mass / b->envelope,
                            b->radius,
                            b->speed};
    memcpy(row, value, sizeof value);
}

typedef struct {
    double time;
    int32_t body;
} arrival;

CLX_RISING_BY_TWO(by_time, arrival, time, body)

/// Bodies of one state, by the time when they came to it.
static clast_status bodies_table(const clast_evolve *e, int32_t state, const char *name,
                                 clast_table *table)
{
    clast_status status = CLAST_OK;
    clx_rows rows = {.n_column = sizeof body_column / sizeof *body_column, .column = body_column};
    arrival *list = NULL;
    int32_t n = 0;
    CLX_TRY(clx_alloc(&list, e->n_start, sizeof *list));
    for (int32_t i = 0; i < e->n_start; ++i) {
        if ((int32_t)e->body[i].state == state) {
            list[n++] = (arrival){.time = e->body[i].time, .body = i};
        }
    }
    qsort(list, (size_t)n, sizeof *list, by_time);
    for (int32_t k = 0; k < n; ++k) {
        double *row = NULL;
        CLX_TRY(clx_rows_add(&rows, &row));
        body_row(&e->body[list[k].body], row);
    }
    CLX_TRY(clx_rows_table(&rows, name, table));
done:
    clx_rows_free(&rows);
    clx_free(list);
    return status;
}

clast_status clast_evolve_table(const clast_evolve *e, clast_evolve_table_kind kind,
                                clast_table *table)
{
    CLX_ARGUMENTS(e, table);
    switch (kind) {
    case CLAST_EVOLVE_BALANCE:
        return clx_rows_table(&e->balance, "balance", table);
    case CLAST_EVOLVE_SPECTRUM:
        return clx_rows_table(&e->spectrum, "spectrum", table);
    case CLAST_EVOLVE_EVENTS:
        return events_table(e, table);
    case CLAST_EVOLVE_DEPOSIT:
        return bodies_table(e, CLX_BODY_ON_FLOOR, "deposit", table);
    case CLAST_EVOLVE_PARTICLES:
        return bodies_table(e, CLX_BODY_IN_FLUID, "particles", table);
    default:
        return clx_fail(CLAST_E_ARGUMENT, "%s: there is no table %d", __func__, (int)kind);
    }
}

/// The body that is this node, or NULL.
static const clx_evolve_body *body_of(const clast_evolve *e, int64_t node)
{
    if (node < 0 || node >= e->n_start + e->n_event) {
        return NULL;
    }
    const int64_t i = node < e->n_start ? node : e->event[node - e->n_start].body;
    const clx_evolve_body *body = &e->body[i];
    return body->node == node && body->state != CLX_BODY_MERGED ? body : NULL;
}

/// Shapes of the templates that are in use, under names of their own; of_template [n_shape] -1: not
/// yet.
static clast_status add_shape(const clast_evolve *e, int32_t k, int32_t *of_template,
                              clast_assembly *assembly)
{
    clast_status status = CLAST_OK;
    clast_shape copy = {0};
    char name[256];
    if (of_template[k] >= 0) {
        return CLAST_OK;
    }
    CLX_TRY(clast_shape_copy(e->templates.shape[k].shape, &copy));
    (void)snprintf(name, sizeof name, "%.200s", copy.name);
    for (int32_t i = 0; i < assembly->n_shape; ++i) {
        if (strcmp(assembly->shape[i].name, name) == 0) {
            (void)snprintf(name, sizeof name, "%.200s-%d", copy.name, k + 1);
        }
    }
    clx_free(copy.name);
    copy.name = NULL;
    CLX_TRY(clx_alloc_text(&copy.name, name));
    CLX_TRY(clast_assembly_add_shape(assembly, &copy, &of_template[k]));
done:
    clast_shape_free(&copy);
    return status;
}

/// The parts of all grains of a body with its centre at x; first [n_start] is the first part of
/// each grain, or NULL.
static clast_status add_grains(const clast_evolve *e, const clx_evolve_body *body,
                               const double x[3], int32_t *of_template, int32_t *first,
                               clast_assembly *assembly)
{
    clast_status status = CLAST_OK;
    for (int32_t g = body->first; g >= 0; g = e->grain[g].next) {
        const clx_evolve_grain *grain = &e->grain[g];
        const clx_template *group = &e->templates.group[1 + grain->kind];
        double centre[3];
        v3_add(centre, x, grain->position);
        if (first != NULL) {
            first[g] = assembly->n_grain;
        }
        for (int32_t i = 0; i < group->n_part; ++i) {
            clx_template_part part;
            clx_template_pose(group, i, centre, grain->orientation, grain->scale, &part);
            CLX_TRY(add_shape(e, part.shape, of_template, assembly));
            CLX_TRY(clast_assembly_add_grain(assembly, of_template[part.shape], part.position,
                                             part.orientation, part.scale, part.density));
        }
    }
done:
    return status;
}

/// Contacts of the events that made a node, the last ones first.
static clast_status add_contacts(const clast_evolve *e, int64_t node, const int32_t *first,
                                 clast_assembly *assembly)
{
    clast_status status = CLAST_OK;
    int64_t *stack = NULL;
    int64_t capacity = 0;
    int64_t n = 0;
    CLX_TRY(clx_grow(&stack, &capacity, 1, sizeof *stack));
    stack[n++] = node;
    while (n > 0) {
        const int64_t at = stack[--n];
        if (at < e->n_start) {
            continue;
        }
        const clx_evolve_event *event = &e->event[at - e->n_start];
        const clx_evolve_grain *grain = &e->grain[event->contact[0]];
        double point[3];
        q_rotate(point, grain->orientation, event->point);
        v3_add(point, point, grain->position);
        CLX_TRY(clast_assembly_add_contact(assembly, first[event->contact[0]],
                                           first[event->contact[1]], point));
        CLX_TRY(clx_grow(&stack, &capacity, n + 2, sizeof *stack));
        stack[n++] = event->node[0];
        stack[n++] = event->node[1];
    }
done:
    clx_free(stack);
    return status;
}

static clast_status template_numbers(const clast_evolve *e, int32_t **of_template)
{
    const clast_status status = clx_alloc(of_template, e->templates.n_shape, sizeof **of_template);
    for (int32_t k = 0; status == CLAST_OK && k < e->templates.n_shape; ++k) {
        (*of_template)[k] = -1;
    }
    return status;
}

clast_status clast_evolve_aggregate(const clast_evolve *e, int64_t node, clast_assembly *assembly)
{
    CLX_ARGUMENTS(e, assembly);
    clast_status status = CLAST_OK;
    const double none[3] = {0.0, 0.0, 0.0};
    clast_assembly made = {.unit = "m"};
    int32_t *of_template = NULL;
    int32_t *first = NULL;
    const clx_evolve_body *body = body_of(e, node);
    CLX_CHECK(body != NULL, CLAST_E_USAGE, "node %lld is no body now", (long long)node);
    CLX_CHECK(e->config->structure || body->n == 1, CLAST_E_CONFIG,
              "structure: drops that merge have no grains");
    CLX_TRY(template_numbers(e, &of_template));
    CLX_TRY(clx_alloc(&first, e->n_start, sizeof *first));
    CLX_TRY(add_grains(e, body, none, of_template, first, &made));
    CLX_TRY(add_contacts(e, node, first, &made));
    *assembly = made;
    made = (clast_assembly){0};
done:
    CLX_FREE(of_template, first);
    clast_assembly_free(&made);
    return status;
}

static const char *const value_column[][2] = {
    {"node", "-"},     {"on_floor", "-"},    {"grains", "-"},  {"envelope_m", "m"},
    {"porosity", "-"}, {"speed_m/s", "m/s"}, {"mass_kg", "kg"}};

/// n rows of what is known of a body.
static clast_status add_values(const clx_evolve_body *b, int32_t n, clx_rows *rows)
{
    clast_status status = CLAST_OK;
    const double value[] = {(double)b->node,
                            b->state == CLX_BODY_ON_FLOOR ? 1.0 : 0.0,
                            b->n,
                            size_of(b->envelope),
                            1.0 - b->volume / b->envelope,
                            b->speed,
                            b->mass};
    for (int32_t i = 0; i < n; ++i) {
        double *row = NULL;
        CLX_TRY(clx_rows_add(rows, &row));
        memcpy(row, value, sizeof value);
    }
done:
    return status;
}

clast_status clast_evolve_assembly(const clast_evolve *e, clast_assembly *assembly,
                                   clast_table *values)
{
    CLX_ARGUMENTS(e, assembly);
    clast_status status = CLAST_OK;
    clast_assembly made = {.unit = "m"};
    clx_rows rows = {.n_column = sizeof value_column / sizeof *value_column,
                     .column = value_column};
    int32_t *of_template = NULL;
    CLX_CHECK(e->config->structure, CLAST_E_CONFIG, "structure: drops that merge have no grains");
    CLX_TRY(template_numbers(e, &of_template));
    for (int32_t i = 0; i < e->n_start; ++i) {
        const clx_evolve_body *body = &e->body[i];
        const int32_t n = made.n_grain;
        if (body->state == CLX_BODY_IN_FLUID || body->state == CLX_BODY_ON_FLOOR) {
            CLX_TRY(add_grains(e, body, body->x, of_template, NULL, &made));
            CLX_TRY(values != NULL ? add_values(body, made.n_grain - n, &rows) : CLAST_OK);
        }
    }
    CLX_TRY(values != NULL ? clx_rows_table(&rows, "grains", values) : CLAST_OK);
    *assembly = made;
    made = (clast_assembly){0};
done:
    clx_free(of_template);
    clx_rows_free(&rows);
    clast_assembly_free(&made);
    return status;
}

typedef struct {
    int32_t n;
    int64_t node;
} ranked;

static int by_grains(const void *a, const void *b)
{
    const ranked *x = a;
    const ranked *y = b;
    return x->n != y->n ? (x->n < y->n ? 1 : -1) : (x->node > y->node) - (x->node < y->node);
}

clast_status clast_evolve_largest(const clast_evolve *e, int32_t *n, int64_t *node)
{
    CLX_ARGUMENTS(e, n);
    CLX_ARRAY(node, *n);
    clast_status status = CLAST_OK;
    ranked *list = NULL;
    int32_t found = 0;
    CLX_TRY(clx_alloc(&list, e->n_start, sizeof *list));
    for (int32_t i = 0; i < e->n_start; ++i) {
        const clx_evolve_body *body = &e->body[i];
        if (body->state == CLX_BODY_IN_FLUID || body->state == CLX_BODY_ON_FLOOR) {
            list[found++] = (ranked){.n = body->n, .node = body->node};
        }
    }
    qsort(list, (size_t)found, sizeof *list, by_grains);
    *n = found < *n ? found : *n;
    for (int32_t k = 0; k < *n; ++k) {
        node[k] = list[k].node;
    }
done:
    clx_free(list);
    return status;
}
