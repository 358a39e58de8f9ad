// What calls.h hands to functions beside structs of any bytes: objects that are made anew for each
// call (a simulation, a tree, an aggregate), and structs that hold together.
#pragma once
#include <clast/clast.h>

#include <string.h>

/// Arrays of ITEMS structs are asked for: the first, over and over.
#define REPEAT(item)                                                                               \
    for (int k_ = 1; k_ < ITEMS; ++k_) {                                                           \
        (item)[k_] = (item)[0];                                                                    \
    }

static const double upright[4] = {1.0, 0.0, 0.0, 0.0};

static clast_mesh *good_clast_mesh(void)
{
    static clast_mesh box[ITEMS];
    if (box[0].n_tri == 0) {
        (void)clast_mesh_box(1.0, 2.0, 3.0, &box[0]);
    }
    REPEAT(box);
    return box;
}

static clast_shape *good_clast_shape(void)
{
    static clast_shape ball[ITEMS];
    if (ball[0].name == NULL) {
        (void)clast_shape_sphere("ball", 0.5, &ball[0]);
    }
    REPEAT(ball);
    return ball;
}

/// Two spheres and a box that overlap.
static clast_assembly *good_clast_assembly(void)
{
    static clast_assembly a[ITEMS];
    if (a[0].n_grain == 0) {
        clast_shape box = {0};
        strcpy(a[0].unit, "m");
        (void)clast_shape_mesh("box", good_clast_mesh(), &box);
        (void)clast_assembly_add_shape(&a[0], good_clast_shape(), NULL);
        (void)clast_assembly_add_shape(&a[0], &box, NULL);
        for (int i = 0; i < 3; ++i) {
            (void)clast_assembly_add_grain(&a[0], i / 2, (double[3]){0.4 * i, 0.1, 0.7}, upright,
                                           1.0, 2650.0);
        }
        (void)clast_assembly_find_contacts(&a[0], 0.0);
        clast_shape_free(&box);
    }
    REPEAT(a);
    return a;
}

/// Which of two good objects, where a function looks at one or the other.
static int good_variant;

static clast_bed *good_clast_bed(void)
{
    static clast_bed bed[ITEMS];
    (void)clast_bed_parse(good_variant == 0 ? "box:-1,-1,1,1" : "cylinder:1", &bed[0]);
    REPEAT(bed);
    return bed;
}

/// Columns of a porosity profile, a history and points.
static clast_table *good_clast_table(void)
{
    static const char *const name[] = {"n",          "z_low_m", "z_high_m", "porosity",
                                       "porosity_x", "size_m",  "d_agg_m"};
    static clast_table table[ITEMS];
    if (table[0].n_column == 0) {
        (void)clast_table_init(&table[0], "good", 5);
        for (size_t k = 0; k < sizeof name / sizeof name[0]; ++k) {
            double *number = NULL;
            (void)clast_table_add_number(&table[0], name[k], "m", &number);
            for (int i = 0; number != NULL && i < 5; ++i) {
                number[i] = k == 3 ? 0.2 * (i + 1) : k == 0 ? i / 2 : i + (k == 2 ? 1.0 : 0.0);
            }
        }
    }
    REPEAT(table);
    return table;
}

static clast_spheres *good_clast_spheres(void)
{
    static double centre[2][3] = {{0.0, 0.0, 0.0}, {0.5, 0.1, 0.2}};
    static double radius[2] = {0.5, 0.3};
    static clast_spheres spheres[ITEMS] = {{2, centre, radius}};
    REPEAT(spheres);
    return spheres;
}

static clast_domain *good_clast_domain(void)
{
    static clast_domain domain[ITEMS];
    (void)clast_domain_parse("box:0,0,0,1,1,1", &domain[0]);
    REPEAT(domain);
    return domain;
}

enum { N_GOOD = 40 };
static double good_x[3 * N_GOOD];

static double *good_places(void)
{
    for (int i = 0; i < 3 * N_GOOD; ++i) {
        good_x[i] = 0.1 + 0.02 * (37 * i % N_GOOD);
    }
    return good_x;
}

static clast_cloud *good_clast_cloud(void)
{
    static clast_cloud cloud[ITEMS];
    cloud[0] = (clast_cloud){.n = N_GOOD, .dimension = 3, .x = good_places()};
    REPEAT(cloud);
    return cloud;
}

static clast_points *good_clast_points(void)
{
    static clast_points points[ITEMS];
    points[0] = (clast_points){
        .n = N_GOOD, .dimension = 3, .x = good_places(), .stride = 3, .axis_stride = 1};
    REPEAT(points);
    return points;
}

static clast_curve *good_clast_curve(void)
{
    static double sieve[] = {1.0, 2.0, 4.0};
    static double mass[] = {0.25, 0.75};
    static clast_curve curve[ITEMS] = {{2, sieve, mass}};
    REPEAT(curve);
    return curve;
}

static clast_sizes *good_clast_sizes(void)
{
    static double size[] = {1.0, 2.0};
    static clast_sizes sizes[ITEMS] = {{2, size, size, size, NULL}};
    REPEAT(sizes);
    return sizes;
}

static clast_bvh *live_clast_bvh(void)
{
    static clast_bvh *bvh;
    clast_bvh_destroy(bvh);
    bvh = NULL;
    (void)clast_bvh_create(good_clast_mesh(), &bvh);
    return bvh;
}

static clast_grading *live_clast_grading(void)
{
    static clast_grading *grading;
    clast_grading_destroy(grading);
    grading = NULL;
    (void)clast_grading_uniform(1.0, 2.0, &grading);
    return grading;
}

static clast_manifest *live_clast_manifest(void)
{
    static char word[] = "test";
    static char *const argv[] = {word};
    static clast_manifest *manifest;
    clast_manifest_destroy(manifest);
    manifest = NULL;
    (void)clast_manifest_create("test", 1, argv, &manifest);
    return manifest;
}

/// Three balls of 5 mm, one of which has been taken out, in a cell with walls that are watched.
static clast_dem *live_clast_dem(void)
{
    static clast_dem *dem;
    const uint8_t goes[] = {0, 0, 1};
    clast_dem_grain ball = {.scale = 5e-3, .density = 2650.0, .orientation = {1.0}};
    clast_dem_config config;
    int32_t id = 0;
    clast_dem_destroy(dem);
    dem = NULL;
    (void)clast_fields_default(clast_dem_fields, &config);
    config.domain = CLAST_DEM_BOX;
    config.width = config.height = 0.1;
    (void)clast_dem_create(&config, &dem);
    (void)clast_dem_watch_walls(dem);
    (void)clast_dem_add_shape(dem, good_clast_shape(), &id);
    for (int i = 0; i < 3; ++i) {
        ball.position[2] = 0.01 + 0.02 * i;
        (void)clast_dem_add_grains(dem, 1, &ball);
    }
    (void)clast_dem_remove_grains(dem, goes);
    clast_fields_free(clast_dem_fields, &config);
    return dem;
}

/// Two of four balls on a ball.
static clast_aggregate *live_clast_aggregate(void)
{
    static clast_aggregate_params params;
    static clast_assembly core;
    static clast_aggregate *aggregate;
    const clast_aggregate_input input = {.core = &core, .n_coat = 1, .coat = &core};
    static clast_aggregate_input kept;
    clast_aggregate_destroy(aggregate);
    aggregate = NULL;
    if (params.axis == NULL) {
        (void)clast_aggregate_params_default(&params);
        params.size_law = CLAST_SIZE_UNIFORM;
        params.size_low = 0.2;
        params.size_high = 0.4;
        params.n_particle = 4;
        strcpy(core.unit, "m");
        (void)clast_assembly_add_shape(&core, good_clast_shape(), NULL);
        (void)clast_assembly_add_grain(&core, 0, (double[3]){0}, upright, 1.0, 2650.0);
    }
    kept = input;
    (void)clast_aggregate_create(&params, &kept, 0, &aggregate);
    (void)clast_aggregate_grow(aggregate, 2, NULL);
    return aggregate;
}

static clast_workspace *live_clast_workspace(void)
{
    static clast_workspace *workspace;
    static clast_decompose_config config;
    const clast_decomposition *made = NULL;
    clast_workspace_destroy(workspace);
    workspace = NULL;
    if (config.domain == NULL) {
        (void)clast_fields_default(clast_decompose_fields, &config);
    }
    (void)clast_workspace_create(&workspace);
    (void)clast_workspace_decompose_in(workspace, good_clast_domain(), good_clast_points(), &config,
                                       &made);
    return workspace;
}
