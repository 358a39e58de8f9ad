#include "aggregates.h"

#include <stdio.h>
#include <string.h>

/// Three spheres inside an ellipsoid, along its longest axis.
static void give_spheres(clast_shape *shape)
{
    const double *a = shape->semi_axes;
    const double x = 0.6 * a[0];
    CHECK_OK(clast_spheres_alloc(3, &shape->spheres));
    for (int i = 0; i < 3; ++i) {
        shape->spheres.centre[i][0] = (i - 1) * x;
        shape->spheres.radius[i] =
            i == 1 ? a[2] : a[2] * sqrt(1.0 - x * x / (a[0] * a[0] - a[2] * a[2]));
    }
}

static void one_grain(const char *name, const double *axes, clast_assembly *assembly)
{
    clast_shape shape = {0};
    const double none[3] = {0.0, 0.0, 0.0};
    const double unturned[4] = {1.0, 0.0, 0.0, 0.0};
    if (axes == NULL) {
        CHECK_OK(clast_shape_sphere(name, 0.5, &shape));
    } else {
        const double semi[3] = {0.5 * axes[0], 0.5 * axes[1], 0.5 * axes[2]};
        CHECK_OK(clast_shape_ellipsoid(name, semi, &shape));
        give_spheres(&shape);
    }
    CHECK_OK(clast_assembly_add_shape(assembly, &shape, NULL));
    CHECK_OK(clast_assembly_add_grain(assembly, 0, none, unturned, 1.0, 2500.0));
    clast_shape_free(&shape);
}

void support_aggregate_options(clast_aggregate_config *config, const char *options)
{
    char text[1024];
    const clast_field *seen[64];
    int n_seen = 0;
    (void)snprintf(text, sizeof text, "%s", options);
    for (char *at = text; *at != '\0';) {
        char *end = at + strcspn(at, ";");
        char *next = *end != '\0' ? end + 1 : end;
        *end = '\0';
        char *value = strchr(at, '=');
        assert_non_null(value);
        *value = '\0';
        const clast_field *field = clast_fields_find(clast_aggregate_fields, at);
        assert_non_null(field);
        bool again = false;
        for (int k = 0; k < n_seen; ++k) {
            again = again || seen[k] == field;
        }
        seen[n_seen++] = field;
        CHECK_OK(clast_field_set_si(field, config, value + 1, again));
        at = next;
    }
}

void support_aggregate_make(support_aggregate *s, const double (*axes)[3], int32_t n_coat,
                            const char *options)
{
    char name[16];
    *s = (support_aggregate){0};
    CHECK_OK(clast_fields_default(clast_aggregate_fields, &s->config));
    one_grain("core", axes != NULL ? axes[0] : NULL, &s->core);
    support_aggregate_options(&s->config, "core=core;core_size=1");
    char names[64] = "";
    for (int32_t i = 0; i < n_coat; ++i) {
        (void)snprintf(name, sizeof name, "coat%d", i);
        one_grain(name, axes != NULL ? axes[i] : NULL, &s->coat[i]);
        (void)snprintf(names + strlen(names), sizeof names - strlen(names), "coat=%s;", name);
    }
    support_aggregate_options(&s->config, names);
    support_aggregate_options(&s->config, options);
    s->input = (clast_aggregate_input){.core = &s->core, .n_coat = n_coat, .coat = s->coat};
}

void support_aggregate_free(support_aggregate *s)
{
    clast_fields_free(clast_aggregate_fields, &s->config);
    clast_assembly_free(&s->core);
    for (int32_t i = 0; i < 4; ++i) {
        clast_assembly_free(&s->coat[i]);
    }
}

clast_aggregate *support_aggregate_run(support_aggregate *s, int32_t repeat)
{
    clast_aggregate *a = NULL;
    CHECK_OK(clast_aggregate_create(&s->config.params, &s->input, repeat, &a));
    CHECK_OK(clast_aggregate_grow(a, INT32_MAX, NULL));
    assert_true(clast_aggregate_is_done(a));
    return a;
}
