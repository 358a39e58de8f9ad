// Surface readers: bytes a second from memory, and the time for a scan of 33,000 triangles.
#include "support.h"

#include "base/alloc.h"
#include "base/file.h"
#include <stdio.h>
#include <time.h>

enum { N_REPEAT = 15, N_TRIANGLE = 33000 };

static double cpu_now(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/// Part of an ellipsoid with exactly 33,000 triangles.
static clast_status make_scan(clast_mesh *mesh)
{
    const double axes[3] = {1.1, 2.3, 3.7};
    const clast_status status = clast_mesh_ellipsoid(axes, 6, mesh);
    mesh->n_tri = status == CLAST_OK ? N_TRIANGLE : 0;
    return status;
}

static int write_ascii(const char *path, const clast_mesh *mesh)
{
    FILE *file = fopen(path, "w");
    if (file == NULL) {
        return 1;
    }
    (void)fputs("solid scan\n", file);
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        (void)fputs("  facet normal 0.000000e+00 0.000000e+00 1.000000e+00\n    outer loop\n",
                    file);
        for (int k = 0; k < 3; ++k) {
            const double *p = mesh->vert[mesh->tri[t][k]];
            (void)fprintf(file, "      vertex %.9e %.9e %.9e\n", p[0], p[1], p[2]);
        }
        (void)fputs("    endloop\n  endfacet\n", file);
    }
    (void)fputs("endsolid scan\n", file);
    return fclose(file);
}

static int measure(const char *name, const char *path)
{
    char *bytes = NULL;
    int64_t n = 0;
    double best = 1e30;
    if (clx_file_read_all(path, INT64_MAX, &bytes, &n) != CLAST_OK) {
        return 1;
    }
    for (int r = 0; r < N_REPEAT; ++r) {
        clast_mesh mesh = {0};
        const double begin = cpu_now();
        if (clast_mesh_parse(bytes, (size_t)n, CLAST_MESH_ANY, &mesh, NULL) != CLAST_OK) {
            (void)fprintf(stderr, "%s: %s\n", path, clast_error_detail());
            return 1;
        }
        const double time = cpu_now() - begin;
        best = time < best ? time : best;
        clast_mesh_free(&mesh);
    }
    (void)printf("read_%s_33k,%.4g,ms,,\nread_%s_rate,%.4g,MB/s,,\n", name, 1e3 * best, name,
                 1e-6 * (double)n / best);
    clx_free(bytes);
    return 0;
}

int main(void)
{
    static const char *const names[] = {"stl", "ply", "obj", "off"};
    char path[400];
    int failed = 0;
    clast_mesh mesh = {0};
    if (make_scan(&mesh) != CLAST_OK) {
        return 1;
    }
    (void)printf("scene,value,unit,reference,ratio\n");
    (void)snprintf(path, sizeof path, "%s/ascii.stl", support_scratch());
    failed += write_ascii(path, &mesh) + measure("stl_ascii", path);
    for (int i = 0; i < 4; ++i) {
        (void)snprintf(path, sizeof path, "%s/scan.%s", support_scratch(), names[i]);
        failed += clast_mesh_write(&mesh, path, NULL) != CLAST_OK || measure(names[i], path) != 0;
    }
    clast_mesh_free(&mesh);
    return failed != 0;
}
