// A picture of 1600 x 1200 pixels of 1.3 million triangles with the default settings, all cores,
// tree and normals included; reference: ten seconds.
#include "support.h"

#include <clast/render.h>
#include <stdio.h>
#include <time.h>

enum { N_REPEAT = 3 };

static double now(clockid_t clock)
{
    struct timespec t;
    (void)clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/// An ellipsoid with waves and ripples, all of it concave somewhere.
static clast_status rough_grain(clast_shape *shape)
{
    const double axes[3] = {3.0, 2.0, 1.0};
    clast_mesh mesh = {0};
    clast_status status = clast_mesh_ellipsoid(axes, 8, &mesh);
    for (int32_t i = 0; i < mesh.n_vert; ++i) {
        double *p = mesh.vert[i];
        const double f = 1.0 + 0.06 * sin(7.0 * p[0]) * cos(9.0 * p[1] + 2.0 * p[2]) +
                         0.02 * sin(31.0 * p[0] + 17.0 * p[1]) * cos(29.0 * p[2]) +
                         0.004 * sin(131.0 * p[0]) * cos(117.0 * p[1]) * cos(129.0 * p[2]);
        for (int k = 0; k < 3; ++k) {
            p[k] *= f;
        }
    }
    if (status == CLAST_OK) {
        status = clast_shape_mesh("rough", &mesh, shape);
    }
    clast_mesh_free(&mesh);
    return status;
}

int main(void)
{
    static const double origin[3] = {0.0, 0.0, 0.0};
    static const double upright[4] = {1.0, 0.0, 0.0, 0.0};
    clast_assembly assembly = {0};
    clast_shape shape = {0};
    clast_render_config config;
    int32_t id = 0;
    double wall = 1e30;
    double cpu = 1e30;
    if (clast_fields_default(clast_render_fields, &config) != CLAST_OK ||
        rough_grain(&shape) != CLAST_OK ||
        clast_assembly_add_shape(&assembly, &shape, &id) != CLAST_OK ||
        clast_assembly_add_grain(&assembly, id, origin, upright, 1.0, 1.0) != CLAST_OK) {
        (void)fprintf(stderr, "%s\n", clast_error_detail());
        return 1;
    }
    for (int i = 0; i < N_REPEAT; ++i) {
        clast_image image = {0};
        const double wall_begin = now(CLOCK_MONOTONIC);
        const double cpu_begin = now(CLOCK_PROCESS_CPUTIME_ID);
        if (clast_render_assembly(&assembly, &config, NULL, &image) != CLAST_OK) {
            (void)fprintf(stderr, "%s\n", clast_error_detail());
            return 1;
        }
        wall = fmin(wall, now(CLOCK_MONOTONIC) - wall_begin);
        cpu = fmin(cpu, now(CLOCK_PROCESS_CPUTIME_ID) - cpu_begin);
        clast_image_free(&image);
    }
    (void)printf("scene,value,unit,reference,ratio\n");
    (void)printf("render_1.3M_wall,%.2f,s,10,%.2f\n", wall, 10.0 / wall);
    (void)printf("render_1.3M_cpu,%.2f,s,20,%.2f\n", cpu, 20.0 / cpu);
    clast_fields_free(clast_render_fields, &config);
    clast_shape_free(&shape);
    clast_assembly_free(&assembly);
    return 0;
}
