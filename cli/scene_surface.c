// Scenes of surfaces: filling, reading, drawing.
#include "scene.h"

#include <clast/fill.h>
#include <clast/mesh.h>
#include <clast/render.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

clast_status cli_scene_fill_scan(cli_lap *b);
clast_status cli_scene_fill_ellipse(cli_lap *b);
clast_status cli_scene_fill_t_rex(cli_lap *b);
clast_status cli_scene_fill_snowflake(cli_lap *b);
clast_status cli_scene_read_stl(cli_lap *b);
clast_status cli_scene_read_stl_ascii(cli_lap *b);
clast_status cli_scene_read_ply(cli_lap *b);
clast_status cli_scene_read_obj(cli_lap *b);
clast_status cli_scene_render(cli_lap *b);

static clast_status fill(cli_lap *b, const char *name)
{
    clast_fill_config config;
    clast_mesh mesh = {0};
    char path[1024];
    clast_status status = CLAST_OK;
    CLI_TRY(clast_fields_default(clast_fill_fields, &config));
    (void)snprintf(path, sizeof path, "%s/stl/%s.stl", b->data, name);
    CLI_TRY(clast_mesh_read(path, &mesh, NULL));
    while (cli_lap_again(b)) {
        clast_spheres spheres = {0};
        clast_fill_report report;
        cli_lap_start(b);
        CLI_TRY(clast_fill(&mesh, &config, NULL, &spheres, &report));
        cli_lap_stop(b);
        CLI_CHECK(report.max_protrusion <= 1e-6, CLAST_E_CONVERGE,
                  "a sphere pokes out by %g of its radius", report.max_protrusion);
        clast_spheres_free(&spheres);
    }
done:
    b->value = b->wall;
    clast_mesh_free(&mesh);
    clast_fields_free(clast_fill_fields, &config);
    return status;
}

clast_status cli_scene_fill_scan(cli_lap *b)
{
    return fill(b, "particle");
}

clast_status cli_scene_fill_ellipse(cli_lap *b)
{
    return fill(b, "ellipse");
}

clast_status cli_scene_fill_t_rex(cli_lap *b)
{
    return fill(b, "t_rex");
}

clast_status cli_scene_fill_snowflake(cli_lap *b)
{
    return fill(b, "snowflake");
}

/// A growing text or file image.
typedef struct {
    char *bytes;
    size_t n, capacity;
} buffer;

static void append(buffer *to, const void *bytes, size_t n)
{
    if (to->bytes != NULL && to->n + n <= to->capacity) {
        memcpy(to->bytes + to->n, bytes, n);
    }
    to->n += n; // beyond room: the caller sees it
}

static void append_line(buffer *to, const char *word, const double p[3])
{
    char line[160];
    const int n = snprintf(line, sizeof line, "%s %.9e %.9e %.9e\n", word, p[0], p[1], p[2]);
    append(to, line, (size_t)n);
}

static const char *const facet_line = "facet normal 0 0 1\nouter loop\n";

static void make_stl(const clast_mesh *mesh, buffer *to)
{
    const uint32_t count = (uint32_t)mesh->n_tri;
    char head[80] = "bench";
    append(to, head, sizeof head);
    append(to, &count, sizeof count);
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        float facet[12] = {0.0F, 0.0F, 1.0F};
        const char attribute[2] = {0, 0};
        for (int k = 0; k < 9; ++k) {
            const int corner = k / 3;
            facet[3 + k] = (float)mesh->vert[mesh->tri[t][corner]][k % 3];
        }
        append(to, facet, sizeof facet);
        append(to, attribute, sizeof attribute);
    }
}

static void make_stl_ascii(const clast_mesh *mesh, buffer *to)
{
    append(to, "solid bench\n", 12);
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        append(to, facet_line, strlen(facet_line));
        for (int k = 0; k < 3; ++k) {
            append_line(to, "vertex", mesh->vert[mesh->tri[t][k]]);
        }
        append(to, "endloop\nendfacet\n", 17);
    }
    append(to, "endsolid bench\n", 15);
}

static void make_ply(const clast_mesh *mesh, buffer *to)
{
    char head[256];
    const int n =
        snprintf(head, sizeof head,
                 "ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty double "
                 "x\nproperty double y\nproperty double z\nelement face %d\nproperty list "
                 "uchar int vertex_indices\nend_header\n",
                 mesh->n_vert, mesh->n_tri);
    append(to, head, (size_t)n);
    append(to, mesh->vert, (size_t)mesh->n_vert * sizeof *mesh->vert);
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        append(to, "\3", 1);
        append(to, mesh->tri[t], sizeof mesh->tri[t]);
    }
}

static void make_obj(const clast_mesh *mesh, buffer *to)
{
    for (int32_t i = 0; i < mesh->n_vert; ++i) {
        append_line(to, "v", mesh->vert[i]);
    }
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        const int32_t *v = mesh->tri[t];
        char line[64];
        const int n = snprintf(line, sizeof line, "f %d %d %d\n", v[0] + 1, v[1] + 1, v[2] + 1);
        append(to, line, (size_t)n);
    }
}

/// Reads every number of a text by strtod: what an ASCII reader cannot do without.
static double sum_numbers(const char *text)
{
    double sum = 0.0;
    for (const char *at = text; at != NULL && *at != '\0';) {
        char *end = NULL;
        const double x = strtod(at, &end);
        sum += x;
        at = end > at ? end : at + 1;
    }
    return sum;
}

/// Seconds of the plain twin.
static double twin_seconds(const cli_lap *b, const buffer *file, bool is_text, char *copy)
{
    static volatile double keep; // so that the work is not dropped
    cli_lap lap = {.left = b->repeats, .wall = HUGE_VAL, .cpu = HUGE_VAL};
    while (cli_lap_again(&lap)) {
        cli_lap_start(&lap);
        if (is_text) {
            keep = sum_numbers(file->bytes);
        } else {
            memcpy(copy, file->bytes, file->n);
            keep = (double)copy[file->n - 1];
        }
        cli_lap_stop(&lap);
    }
    (void)keep;
    return lap.wall;
}

static clast_status read_all(cli_lap *b, const buffer *file, clast_mesh_format format, bool is_text)
{
    clast_status status = CLAST_OK;
    char *copy = malloc(file->n + 1);
    if (copy == NULL) {
        return cli_fail(CLAST_E_MEMORY, "out of memory for %zu bytes", file->n);
    }
    memset(copy, 0, file->n + 1);
    while (cli_lap_again(b)) {
        clast_mesh mesh = {0};
        cli_lap_start(b);
        CLI_TRY(clast_mesh_parse(file->bytes, file->n, format, &mesh, NULL));
        cli_lap_stop(b);
        clast_mesh_free(&mesh);
    }
done:
    b->value = 1e-6 * (double)file->n / b->wall;
    b->reference = 1e-6 * (double)file->n / twin_seconds(b, file, is_text, copy);
    free(copy);
    return status;
}

typedef void (*writer)(const clast_mesh *mesh, buffer *to);

static clast_status read_scene(cli_lap *b, writer write, clast_mesh_format format, bool is_text)
{
    const double axes[3] = {1.1, 2.3, 3.7};
    clast_mesh mesh = {0};
    buffer file = {0};
    clast_status status = CLAST_OK;
    CLI_TRY(clast_mesh_ellipsoid(axes, 7, &mesh));
    write(&mesh, &file); // counts
    file.capacity = file.n;
    file.n = 0;
    file.bytes = calloc(file.capacity + 1, 1); // ends in a zero for the twin
    CLI_TRY(file.bytes == NULL ? cli_fail(CLAST_E_MEMORY, "out of memory for a file") : CLAST_OK);
    write(&mesh, &file);
    CLI_TRY(read_all(b, &file, format, is_text));
done:
    free(file.bytes);
    clast_mesh_free(&mesh);
    return status;
}

clast_status cli_scene_read_stl(cli_lap *b)
{
    return read_scene(b, make_stl, CLAST_MESH_STL, false);
}

clast_status cli_scene_read_stl_ascii(cli_lap *b)
{
    return read_scene(b, make_stl_ascii, CLAST_MESH_STL, true);
}

clast_status cli_scene_read_ply(cli_lap *b)
{
    return read_scene(b, make_ply, CLAST_MESH_PLY, false);
}

clast_status cli_scene_read_obj(cli_lap *b)
{
    return read_scene(b, make_obj, CLAST_MESH_OBJ, true);
}

/// An ellipsoid with waves and ripples, concave in many places.
static clast_status rough_grain(clast_shape *shape)
{
    const double axes[3] = {3.0, 2.0, 1.0};
    clast_mesh mesh = {0};
    clast_status status = CLAST_OK;
    CLI_TRY(clast_mesh_ellipsoid(axes, 8, &mesh));
    for (int32_t i = 0; i < mesh.n_vert; ++i) {
        double *p = mesh.vert[i];
        const double f = 1.0 + 0.06 * sin(7.0 * p[0]) * cos(9.0 * p[1] + 2.0 * p[2]) +
                         0.02 * sin(31.0 * p[0] + 17.0 * p[1]) * cos(29.0 * p[2]) +
                         0.004 * sin(131.0 * p[0]) * cos(117.0 * p[1]) * cos(129.0 * p[2]);
        for (int k = 0; k < 3; ++k) {
            p[k] *= f;
        }
    }
    CLI_TRY(clast_shape_mesh("rough", &mesh, shape));
done:
    clast_mesh_free(&mesh);
    return status;
}

clast_status cli_scene_render(cli_lap *b)
{
    static const double origin[3] = {0.0, 0.0, 0.0};
    static const double unturned[4] = {1.0, 0.0, 0.0, 0.0};
    clast_assembly assembly = {0};
    clast_shape shape = {0};
    clast_render_config config;
    clast_status status = CLAST_OK;
    CLI_TRY(clast_fields_default(clast_render_fields, &config));
    CLI_TRY(rough_grain(&shape));
    CLI_TRY(clast_assembly_add_shape(&assembly, &shape, NULL));
    CLI_TRY(clast_assembly_add_grain(&assembly, 0, origin, unturned, 1.0, 1.0));
    while (cli_lap_again(b)) {
        clast_image image = {0};
        cli_lap_start(b);
        CLI_TRY(clast_render_assembly(&assembly, &config, NULL, &image));
        cli_lap_stop(b);
        clast_image_free(&image);
    }
done:
    b->value = b->wall;
    clast_fields_free(clast_render_fields, &config);
    clast_shape_free(&shape);
    clast_assembly_free(&assembly);
    return status;
}
