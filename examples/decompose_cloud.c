// Splits a cloud of points into cells in which they are uniform, and counts agglomeration events
// that depend on no mesh of a flow solver. couple_flow.c does it in every step of a time loop.
//
//     cc decompose_cloud.c $(pkg-config --cflags --libs clast) && ./a.out points.csv
#include <clast/cloud.h>
#include <clast/decompose.h>
#include <stdio.h>

static clast_status read(const char *path, clast_cloud *cloud)
{
    static char *axes[] = {"x", "y", "z"};
    const clast_cloud_columns columns = {.columns = {3, axes}};
    clast_table table = {0};
    clast_status status = clast_cloud_read(path, NULL, &table);
    status = status == CLAST_OK ? clast_cloud_from_table(&table, &columns, cloud) : status;
    clast_table_free(&table);
    return status;
}

int main(int argc, char **argv)
{
    const char *path = argc > 1 ? argv[1] : "data/d2sd/points_b3_n500.csv";
    clast_cloud cloud = {0};
    clast_decompose_config config = {0};
    clast_decomposition result = {0};
    clast_status status = clast_fields_default(clast_decompose_fields, &config);
    status = status == CLAST_OK ? read(path, &cloud) : status;
    if (status == CLAST_OK) {
        const clast_field *domain = clast_fields_find(clast_decompose_fields, "domain");
        status = clast_field_set(domain, &config, "box:0,0,0,1,1,1", false);
        config.beta_dt = 1e-6; // kernel times time step [m^3]
    }
    status = status == CLAST_OK ? clast_decompose(&cloud, &config, &result) : status;
    if (status == CLAST_OK) {
        (void)printf("points   %lld in %.4g m^3: %s\n", (long long)result.n, result.volume,
                     clast_decompose_stop_text(result.stop));
        (void)printf("cells    %d\n", result.cells.n);
        (void)printf("events   %.5g, 95 %% interval %.5g to %.5g%s\n", result.events,
                     result.events_low, result.events_high,
                     result.resolved ? "" : " (the points do not show all of their structure)");
    } else {
        (void)fprintf(stderr, "%s: %s\n", path, clast_error_detail());
    }
    clast_decomposition_free(&result);
    clast_fields_free(clast_decompose_fields, &config);
    clast_cloud_free(&cloud);
    return status == CLAST_OK ? 0 : 1;
}
