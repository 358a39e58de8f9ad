#include "states.h"

#include "base/alloc.h"
#include <clast/assembly.h>
#include <clast/table.h>
#include <string.h>

static clast_status add_shapes(clast_assembly *a, const clast_spheres *pair)
{
    clast_status status = CLAST_OK;
    clast_mesh box = {0};
    clast_shape s[3] = {0};
    CLX_TRY(clast_mesh_box(1.0, 2.0, 3.0, &box));
    CLX_TRY(clast_shape_ellipsoid("egg, \"the\" <first>", (double[3]){3.0, 2.0, 1.0}, &s[0]));
    CLX_TRY(clast_shape_mesh("box", &box, &s[1]));
    CLX_TRY(clast_shape_clump("clump", pair, &s[2]));
    for (int i = 0; i < 3; ++i) {
        CLX_TRY(clast_assembly_add_shape(a, &s[i], NULL));
    }
done:
    for (int i = 0; i < 3; ++i) {
        clast_shape_free(&s[i]);
    }
    clast_mesh_free(&box);
    return status;
}

static clast_status add_grains(clast_assembly *a)
{
    static const int32_t shape[6] = {0, 1, 0, 2, 0, 1};
    static const double turn[4] = {0.5, -0.5, 0.5, 0.5};
    clast_status status = CLAST_OK;
    for (int i = 0; i < 6; ++i) {
        const double at[3] = {10.0 * i, 0.125, -0.25};
        CLX_TRY(clast_assembly_add_grain(a, shape[i], at, turn, 1.0 + 0.5 * i, 2000.0 + i));
        a->id[i] = 100 + i;
    }
    CLX_TRY(clast_assembly_add_contact(a, 0, 1, a->position[0]));
    CLX_TRY(clast_assembly_add_contact(a, 1, 3, a->position[1]));
    memcpy(a->unit, "mm", 3);
done:
    return status;
}

static clast_status make_history(clast_table *table)
{
    clast_status status = CLAST_OK;
    double *x = NULL;
    CLX_TRY(clast_table_init(table, "history", 3));
    CLX_TRY(clast_table_add_number(table, "porosity", "-", &x));
    x[1] = 0.25;
    x[2] = 0.5;
    CLX_TRY(clast_table_add_text(table, "shape"));
    CLX_TRY(clast_table_set_text(table, 1, 2, "box, turned"));
done:
    return status;
}

clast_status support_state(clast_state *state)
{
    clast_status status = CLAST_OK;
    clast_state made = {.unit = "mm"};
    clast_spheres pair = {0};
    CLX_TRY(clast_spheres_alloc(2, &pair));
    pair.centre[1][1] = 1.0;
    pair.radius[0] = 1.0;
    pair.radius[1] = 0.75;
    CLX_TRY(clx_alloc_text(&made.config, "{\"seed\": 1}"));
    CLX_TRY(clx_alloc(&made.assembly, 1, sizeof *made.assembly));
    CLX_TRY(add_shapes(made.assembly, &pair));
    CLX_TRY(add_grains(made.assembly));
    CLX_TRY(clx_alloc(&made.spheres, 1, sizeof *made.spheres));
    made.n_spheres = 1;
    CLX_TRY(clx_alloc_text(&made.spheres[0].name, "fill"));
    CLX_TRY(clast_spheres_copy(&pair, &made.spheres[0].spheres));
    CLX_TRY(clx_alloc(&made.table, 1, sizeof *made.table));
    made.n_table = 1;
    CLX_TRY(make_history(&made.table[0]));
    *state = made;
    made = (clast_state){0};
done:
    clast_state_free(&made);
    clast_spheres_free(&pair);
    return status;
}
