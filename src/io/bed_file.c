// Beds from state files and surfaces.
#include <clast/porosity.h>

#include "base/alloc.h"
#include "io/bed_tables.h"
#include <clast/field.h>
#include <clast/mesh.h>
#include <clast/state.h>
#include <math.h>
#include <string.h>

static const char *const vert_name[3] = {"x_m", "y_m", "z_m"};
static const char *const tri_name[3] = {"a", "b", "c"};

clast_status clx_bed_surface_tables(const clast_mesh *mesh, clast_table table[2])
{
    clast_status status = CLAST_OK;
    clast_table made[2] = {{0}, {0}};
    CLX_TRY(clast_table_init(&made[0], "container_vertices", mesh->n_vert));
    CLX_TRY(clast_table_init(&made[1], "container_triangles", mesh->n_tri));
    for (int k = 0; k < 3; ++k) {
        double *x = NULL;
        double *v = NULL;
        CLX_TRY(clast_table_add_number(&made[0], vert_name[k], "m", &x));
        CLX_TRY(clast_table_add_number(&made[1], tri_name[k], "-", &v));
        for (int32_t i = 0; i < mesh->n_vert; ++i) {
            x[i] = mesh->vert[i][k];
        }
        for (int32_t i = 0; i < mesh->n_tri; ++i) {
            v[i] = mesh->tri[i][k];
        }
    }
    table[0] = made[0];
    table[1] = made[1];
    made[0] = made[1] = (clast_table){0};
done:
    clast_table_free(&made[0]);
    clast_table_free(&made[1]);
    return status;
}

/// The surface of two such tables, which come from a file.
static clast_status read_surface(const clast_table table[2], clast_mesh *mesh)
{
    clast_status status = CLAST_OK;
    clast_mesh made = {0};
    CLX_CHECK(table[0].n_row < INT32_MAX / 4 && table[1].n_row < INT32_MAX / 4, CLAST_E_FORMAT,
              "the container has too many rows");
    CLX_TRY(clast_mesh_alloc((int32_t)table[0].n_row, (int32_t)table[1].n_row, &made));
    for (int k = 0; k < 3; ++k) {
        const double *x = clast_table_numbers(&table[0], vert_name[k]);
        const double *v = clast_table_numbers(&table[1], tri_name[k]);
        CLX_CHECK(x != NULL && v != NULL, CLAST_E_FORMAT, "the container lacks a column");
        for (int32_t i = 0; i < made.n_vert; ++i) {
            CLX_CHECK(isfinite(x[i]), CLAST_E_FORMAT, "vertex %d of the container is not finite",
                      i);
            made.vert[i][k] = x[i];
        }
        for (int32_t i = 0; i < made.n_tri; ++i) {
            CLX_CHECK(v[i] >= 0.0 && v[i] < made.n_vert, CLAST_E_FORMAT,
                      "triangle %d of the container has a corner %g of %d", i, v[i], made.n_vert);
            made.tri[i][k] = (int32_t)v[i];
        }
    }
    CLX_TRY(clast_bed_close(&made, mesh));
done:
    clast_mesh_free(&made);
    return status;
}

clast_status clast_bed_read(const char *path, clast_bed *bed, clast_mesh *surface)
{
    CLX_ARGUMENTS(path, bed, surface);
    clast_status status = CLAST_OK;
    clast_table table[3] = {{0}, {0}, {0}};
    clast_bed made = {0};
    CLX_TRY(clast_state_read_table(path, "bed", &table[0]));
    CLX_TRY(clast_bed_from_table(&table[0], &made));
    if (made.kind == CLAST_BED_MESH) {
        const double floor = made.floor;
        CLX_TRY(clast_state_read_table(path, "container_vertices", &table[1]));
        CLX_TRY(clast_state_read_table(path, "container_triangles", &table[2]));
        CLX_TRY(read_surface(&table[1], surface));
        made = clast_bed_of_surface(surface);
        made.floor = floor;
    }
    *bed = made;
done:
    for (int k = 0; k < 3; ++k) {
        clast_table_free(&table[k]);
    }
    return status;
}

clast_status clx_container_read(const char *path, const char *unit, clast_mesh *mesh)
{
    clast_status status = CLAST_OK;
    const double upright[4] = {1.0, 0.0, 0.0, 0.0};
    const double still[3] = {0.0, 0.0, 0.0};
    clast_mesh made = {0};
    clast_mesh_read_report report = {0};
    double factor = 1.0;
    CLX_TRY(clast_mesh_read(path, &made, &report));
    CLX_TRY(clast_mesh_require_unit(path, &report, unit));
    CLX_CHECK(unit[0] != '\0' || report.unit[0] != '\0', CLAST_E_USAGE,
              "%s: a container's size counts, and the file does not say its unit; give it (mm, m, "
              "...)",
              path);
    CLX_TRY(clast_unit_factor(unit[0] != '\0' ? unit : report.unit, "m", &factor));
    clast_mesh_transform(&made, factor, upright, still);
    *mesh = made;
    made = (clast_mesh){0};
done:
    clast_mesh_free(&made);
    return status;
}

clast_status clast_bed_load(const char *text, clast_bed *bed, clast_mesh *surface)
{
    CLX_ARGUMENTS(text, bed, surface);
    clast_status status = CLAST_OK;
    clast_mesh raw = {0};
    char path[4096];
    if (strncmp(text, "mesh:", 5) != 0) {
        CLX_CHECK(strcmp(text, "mesh") != 0, CLAST_E_CONFIG,
                  "bed 'mesh' names no file: write mesh:FILE,UNIT");
        return clast_bed_parse(text, bed);
    }
    const char *comma = strrchr(text, ',');
    const size_t n = comma != NULL ? (size_t)(comma - text) - 5 : strlen(text) - 5;
    CLX_CHECK(n > 0 && n < sizeof path, CLAST_E_CONFIG, "'%s': write mesh:FILE,UNIT", text);
    memcpy(path, text + 5, n);
    path[n] = '\0';
    CLX_TRY(clx_container_read(path, comma != NULL ? comma + 1 : "", &raw));
    CLX_TRY(clast_bed_close(&raw, surface));
    *bed = clast_bed_of_surface(surface);
done:
    clast_mesh_free(&raw);
    return status;
}
