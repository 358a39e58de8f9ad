// Porosity of a bed of one's own: spheres on a cubic lattice in a box, against 1 - pi/6.
//
//     cc bed_porosity.c $(pkg-config --cflags --libs clast) && ./a.out
#include <clast/assembly.h>
#include <clast/porosity.h>
#include <clast/shape.h>
#include <stdio.h>

enum { N = 10 }; // spheres along an edge, 1 mm in radius

static clast_status place(clast_assembly *assembly)
{
    static const double unturned[4] = {1.0, 0.0, 0.0, 0.0};
    const double radius = 1e-3;
    clast_shape sphere = {0};
    clast_status status = clast_shape_sphere("sphere", radius, &sphere);
    status = status == CLAST_OK ? clast_assembly_add_shape(assembly, &sphere, NULL) : status;
    for (int i = 0; i < N * N * N && status == CLAST_OK; ++i) {
        const double at[3] = {radius * (2 * (i % N) + 1), radius * (2 * (i / N % N) + 1),
                              radius * (2 * (i / (N * N)) + 1)};
        status = clast_assembly_add_grain(assembly, 0, at, unturned, 1.0, 2650.0);
    }
    clast_shape_free(&sphere);
    return status;
}

int main(void)
{
    clast_assembly assembly = {.unit = "m"};
    clast_table profile = {0};
    clast_porosity_bulk bulk = {0};
    clast_bed bed;
    clast_porosity_options options = clast_porosity_options_default(); // true shapes, 1 mm slices
    options.trim = 2e-3;                                               // left out at both ends
    options.at_slice = true; // the bed ends with a slice, as this one does
    clast_status status = place(&assembly);
    if (status == CLAST_OK) { // edges in m
        status = clast_bed_parse("box:0,0,0.02,0.02", &bed);
    }
    if (status == CLAST_OK) {
        status = clast_porosity_profile(&assembly, &bed, &options, &profile);
    }
    if (status == CLAST_OK) {
        status = clast_porosity_measure(&assembly, &bed, &profile, &options, &bulk);
    }
    if (status == CLAST_OK) {
        const double *porosity = clast_table_numbers(&profile, "porosity");
        (void)printf("slices %lld, the first has porosity %.4f\n", (long long)profile.n_row,
                     porosity[0]);
        (void)printf("bulk porosity %.6f from %.1f to %.1f mm; 1 - pi/6 is %.6f\n", bulk.porosity,
                     1e3 * bulk.z_low, 1e3 * bulk.z_high, 1.0 - CLAST_PI / 6.0);
    } else {
        (void)fprintf(stderr, "%s\n", clast_error_detail());
    }
    clast_table_free(&profile);
    clast_assembly_free(&assembly);
    return status == CLAST_OK ? 0 : 1;
}
