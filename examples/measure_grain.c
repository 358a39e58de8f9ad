// Measures one grain: size, form and how fast it falls.
//
//     cc measure_grain.c $(pkg-config --cflags --libs clast) && ./a.out grain.stl
#include <clast/grain.h>
#include <clast/mesh.h>
#include <clast/mesh_repair.h>
#include <stdio.h>

int main(int argc, char **argv)
{
    const char *path = argc > 1 ? argv[1] : "data/standin63/grain10.ply";
    clast_mesh mesh = {0};
    clast_grain grain;
    // corners that a file repeats for each triangle become one; what is open or inside out is
    // refused
    if (clast_mesh_read_welded(path, &mesh, NULL) != CLAST_OK ||
        clast_grain_measure(&mesh, &grain) != CLAST_OK) {
        (void)fprintf(stderr, "%s: %s\n", path, clast_error_detail());
        clast_mesh_free(&mesh);
        return 1;
    }
    const double *lis = grain.axes[CLAST_AXES_ELLIPSOID].lis; // of the ellipsoid of equal inertia
    (void)printf("%s: %d triangles\n", path, mesh.n_tri);
    (void)printf("volume      %.6g\n", grain.volume);
    (void)printf("L, I, S     %.5g, %.5g, %.5g\n", lis[0], lis[1], lis[2]);
    (void)printf("I/L, S/I    %.4f, %.4f\n", lis[1] / lis[0], lis[2] / lis[1]);
    (void)printf("sphericity  %.4f\n", grain.sphericity);
    (void)printf("convexity   %.4f\n", grain.convexity);
    clast_mesh_free(&mesh);
    return 0;
}
