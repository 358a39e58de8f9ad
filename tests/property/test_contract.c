/* Property: a call with an argument that cannot be (NULL where data is needed, a configuration of
 * zeros, a stride of 0, a number out of its field's range, NaN, an unknown enumerator) ends with
 * CLAST_E_CONFIG or CLAST_E_ARGUMENT and a message, in release builds too, and its outputs stay as
 * they were. Before, x NULL crashed, stride 0 counted as data and mesh 77 was taken. */
#include "support.h"

#include "base/status.h"
#include <string.h>

enum { N = 40, UNTOUCHED = 0x5a };

static double points[3 * N], ones[N];
static int64_t monomers[N], owner[N];
static int32_t cell[N];

static void check_refused(clast_status status, const char *call, int line)
{
    if ((status != CLAST_E_CONFIG && status != CLAST_E_ARGUMENT) ||
        strcmp(clast_error_detail(), "untold") == 0 || clast_error_detail()[0] == '\0') {
        fail_msg("line %d: %s ends with '%s' and says '%s'", line, call, clast_status_text(status),
                 clast_error_detail());
    }
}

/// The call is refused with a message.
#define REFUSED(call)                                                                              \
    do {                                                                                           \
        (void)clx_fail(CLAST_OK, "untold");                                                        \
        check_refused((call), #call, __LINE__);                                                    \
    } while (0)

/// The same, and `out` keeps its bytes.
#define REFUSED_INTO(out, call)                                                                    \
    do {                                                                                           \
        memset(&(out), UNTOUCHED, sizeof(out));                                                    \
        REFUSED(call);                                                                             \
        check_untouched(&(out), sizeof(out), #call, __LINE__);                                     \
    } while (0)

static void check_untouched(const void *out, size_t n, const char *call, int line)
{
    for (size_t i = 0; i < n; ++i) {
        if (((const unsigned char *)out)[i] != UNTOUCHED) {
            fail_msg("line %d: %s has changed byte %d of its output", line, call, (int)i);
        }
    }
}

static int make_points(void **state)
{
    (void)state;
    for (int i = 0; i < N; ++i) {
        for (int j = 0; j < 3; ++j) {
            points[3 * i + j] = fmod(0.5 + (0.7548776662466927 - 0.1 * j) * (i + 1), 1.0);
        }
        ones[i] = 1.0;
        monomers[i] = 1;
        owner[i] = i;
        cell[i] = i % 2;
    }
    return 0;
}

/* --- every field of a table, set to what it cannot be --- */

typedef void try_function(const void *config, void *context);

/// Writes the k-th impossible value of a field; false when there are no more.
static bool spoil(const clast_field *f, void *slot, int k)
{
    static char *no_text[1];
    const double number[] = {(double)NAN, (double)INFINITY, -(double)INFINITY,
                             f->low - 1.0 - fabs(f->low), 2.0 * f->high + 1.0};
    switch (f->type) {
    case CLAST_FIELD_F64:
        *(double *)slot = number[k % 5];
        return k < 5;
    case CLAST_FIELD_I32:
        *(int32_t *)slot = k == 0 || f->high >= INT32_MAX ? INT32_MIN : (int32_t)f->high + 1;
        return k < 2;
    case CLAST_FIELD_I64:
        *(int64_t *)slot = INT64_MIN;
        return k < 1;
    case CLAST_FIELD_CHOICE:
        *(int32_t *)slot = k == 0 ? -1 : 77;
        return k < 2;
    case CLAST_FIELD_BOOL:
        memset(slot, 77, 1);
        return k < 1;
    case CLAST_FIELD_TEXT:
        *(char **)slot = NULL;
        return k < 1;
    case CLAST_FIELD_TEXT_LIST:
        *(clast_text_list *)slot = (clast_text_list){k == 0 ? -1 : 1, k == 2 ? no_text : NULL};
        return k < 3;
    case CLAST_FIELD_F64_LIST:
        *(clast_f64_list *)slot = (clast_f64_list){k == 0 ? -1 : 1, NULL};
        return k < 2;
    case CLAST_FIELD_U64:
        break;
    }
    return false;
}

/// Calls `attempt` once for each impossible value of each field, the others being as they are.
static int spoil_fields(const clast_field *fields, void *config, size_t size, try_function *attempt,
                        void *context)
{
    static unsigned char spoilt[4096];
    int n = 0;
    assert_true(size <= sizeof spoilt);
    for (const clast_field *f = fields; f->name != NULL; ++f) {
        for (int k = 0;; ++k, ++n) {
            memcpy(spoilt, config, size);
            if (!spoil(f, spoilt + f->offset, k)) {
                break;
            }
            attempt(spoilt, context);
            if (strstr(clast_error_detail(), f->name) == NULL) {
                fail_msg("the message for %s does not name it: %s", f->name, clast_error_detail());
            }
        }
    }
    memset(spoilt, 0, sizeof spoilt);
    attempt(spoilt, context); // a configuration of zeros
    return n;
}

/* --- the calls of a flow solver --- */

static clast_decompose_config decompose_config(void)
{
    clast_decompose_config c;
    CHECK_OK(clast_fields_default(clast_decompose_fields, &c));
    CHECK_OK(clast_field_set(clast_fields_find(clast_decompose_fields, "domain"), &c,
                             "box:0,0,0,1,1,1", false));
    return c;
}

static const clast_points good_points = {
    .n = N, .dimension = 3, .x = points, .stride = 3, .axis_stride = 1};

typedef struct {
    clast_workspace *workspace;
    clast_domain domain;
    clast_cloud cloud;
} cloud_scene;

static void try_decompose(const void *config, void *context)
{
    cloud_scene *s = context;
    const clast_decomposition *made;
    clast_uniformity test;
    clast_decomposition whole;
    REFUSED_INTO(whole, clast_decompose(&s->cloud, config, &whole));
    REFUSED_INTO(test, clast_workspace_test(s->workspace, &good_points, config, &test));
    REFUSED_INTO(made, clast_workspace_decompose(s->workspace, &good_points, config, &made));
    if (((const clast_decompose_config *)config)->domain != NULL) { // where it may be missing
        REFUSED_INTO(whole, clast_decompose_in(&s->domain, &s->cloud, config, &whole));
    }
}

static void bad_decompositions_are_refused(void **state)
{
    (void)state;
    clast_decompose_config c = decompose_config();
    cloud_scene s = {.cloud = {.n = N, .dimension = 3, .x = points}};
    clast_decomposition whole;
    CHECK_OK(clast_workspace_create(&s.workspace));
    CHECK_OK(clast_domain_parse(c.domain, &s.domain));
    assert_true(spoil_fields(clast_decompose_fields, &c, sizeof c, try_decompose, &s) > 40);
    REFUSED_INTO(whole, clast_decompose(NULL, &c, &whole));
    REFUSED_INTO(whole, clast_decompose(&s.cloud, NULL, &whole));
    REFUSED(clast_decompose(&s.cloud, &c, NULL));
    const clast_cloud bad[] = {{.n = N, .dimension = 3},
                               {.n = -1, .dimension = 3, .x = points},
                               {.n = N, .dimension = 0, .x = points},
                               {.n = N, .dimension = 4, .x = points},
                               {0}};
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; ++k) {
        REFUSED_INTO(whole, clast_decompose(&bad[k], &c, &whole));
    }
    const clast_domain wrong[] = {{0},
                                  {.kind = 77, .dimension = 3},
                                  {.kind = CLAST_DOMAIN_BOX, .dimension = 3},
                                  {.kind = CLAST_DOMAIN_SPHERE, .dimension = 3},
                                  {.kind = CLAST_DOMAIN_MAP, .dimension = 3},
                                  {.kind = CLAST_DOMAIN_MESH, .dimension = 3}};
    for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; ++k) {
        REFUSED_INTO(whole, clast_decompose_in(&wrong[k], &s.cloud, &c, &whole));
    }
    REFUSED_INTO(whole, clast_decompose_in(NULL, &s.cloud, &c, &whole));
    clast_workspace_destroy(s.workspace);
    clast_fields_free(clast_decompose_fields, &c);
}

static void bad_points_change_nothing_in_a_workspace(void **state)
{
    (void)state;
    clast_decompose_config c = decompose_config();
    clast_workspace *w = NULL;
    const clast_decomposition *made = NULL;
    int32_t of[2 * N];
    double events[N];
    const clast_points bad[] = {
        {0},
        {.n = N, .dimension = 3, .stride = 3, .axis_stride = 1},
        {.n = -1, .dimension = 3, .x = points, .stride = 3, .axis_stride = 1},
        {.n = N, .dimension = 0, .x = points, .stride = 3, .axis_stride = 1},
        {.n = N, .dimension = 4, .x = points, .stride = 3, .axis_stride = 1},
        {.n = N, .dimension = 3, .x = points, .axis_stride = 1},
        {.n = N, .dimension = 3, .x = points, .stride = 3},
        {.n = N, .dimension = 3, .x = points, .stride = -3, .axis_stride = 1},
        {.n = N, .dimension = 3, .x = points, .stride = 3, .axis_stride = -1},
        {.n = N, .dimension = 3, .x = points, .stride = 1, .axis_stride = 1},
        {.n = N, .dimension = 3, .x = points, .stride = 3, .axis_stride = 6},
        {.n = N, .dimension = 3, .x = points, .stride = INT64_MAX, .axis_stride = 1},
        {.n = N, .dimension = 3, .x = points, .stride = 3, .axis_stride = 1, .weight = ones},
    };
    CHECK_OK(clast_workspace_create(&w));
    CHECK_OK(clast_workspace_decompose(w, &good_points, &c, &made));
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; ++k) {
        REFUSED_INTO(made, clast_workspace_decompose(w, &bad[k], &c, &made));
    }
    REFUSED_INTO(made, clast_workspace_decompose(w, NULL, &c, &made));
    REFUSED_INTO(made, clast_workspace_decompose(w, &good_points, NULL, &made));
    REFUSED_INTO(made, clast_workspace_decompose(NULL, &good_points, &c, &made));
    REFUSED(clast_workspace_decompose(w, &good_points, &c, NULL));
    REFUSED(clast_workspace_create(NULL));
    REFUSED_INTO(of, clast_workspace_cells(w, 0, of));
    REFUSED_INTO(of, clast_workspace_cells(w, -1, of));
    REFUSED_INTO(of, clast_workspace_cells(NULL, 1, of));
    REFUSED(clast_workspace_cells(w, 1, NULL));
    REFUSED_INTO(events, clast_workspace_events(w, 0, events));
    REFUSED_INTO(events, clast_workspace_events(NULL, 1, events));
    REFUSED(clast_workspace_events(w, 1, NULL));
    CHECK_OK(clast_workspace_cells(w, 2, of)); // the decomposition still stands
    clast_workspace_destroy(w);
    clast_fields_free(clast_decompose_fields, &c);
}

static void bad_tests_of_uniformity_are_refused(void **state)
{
    (void)state;
    const double side[3] = {1, 1, 1};
    const double bad_side[3] = {1, 0, 1};
    const clast_uniformity_config good = {.level = 0.05, .votes = 2};
    const clast_uniformity_config bad[] = {{0},
                                           {.level = (double)NAN, .votes = 2},
                                           {.level = 7.0, .votes = 2},
                                           {.level = 0.05, .votes = 9},
                                           {.level = 0.05, .votes = 2, .left_out = 31},
                                           {.level = 0.05, .votes = 2, .left_out = 1U << 30}};
    double outside[15] = {0};
    clast_uniformity r;
    clast_discrepancy d[CLAST_N_DISCREPANCY];
    clast_henze_zirkler hz;
    clast_pearson pearson;
    clast_boundary_score score;
    uint32_t left_out;
    double p;
    CHECK_OK(clast_uniformity_test(points, N, 3, side, &good, &r));
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; ++k) {
        REFUSED_INTO(r, clast_uniformity_test(points, N, 3, side, &bad[k], &r));
    }
    outside[7] = (double)NAN;
    const double *const u[] = {NULL, outside};
    for (int k = 0; k < 2; ++k) {
        REFUSED_INTO(r, clast_uniformity_test(u[k], 5, 3, side, &good, &r));
        REFUSED_INTO(d, clast_discrepancy_test(u[k], 5, 3, CLAST_SUMS_AUTO, d));
        REFUSED_INTO(hz, clast_henze_zirkler_test(u[k], 5, 3, CLAST_SUMS_AUTO, &hz));
        REFUSED_INTO(pearson, clast_pearson_test(u[k], 5, 3, &pearson));
        REFUSED_INTO(score, clast_boundary_score_test(u[k], 5, 3, side, &score));
        REFUSED_INTO(p, clast_agglomeration_change_test(u[k], points, 5, 3, &p));
        REFUSED_INTO(p, clast_agglomeration_change_test(points, u[k], 5, 3, &p));
    }
    REFUSED_INTO(r, clast_uniformity_test(points, -1, 3, side, &good, &r));
    REFUSED_INTO(r, clast_uniformity_test(points, N, 0, side, &good, &r));
    REFUSED_INTO(r, clast_uniformity_test(points, N, 3, bad_side, &good, &r));
    REFUSED_INTO(r, clast_uniformity_test(points, N, 3, NULL, &good, &r));
    REFUSED_INTO(r, clast_uniformity_test(points, N, 3, side, NULL, &r));
    REFUSED(clast_uniformity_test(points, N, 3, side, &good, NULL));
    REFUSED_INTO(d, clast_discrepancy_test(points, N, 3, 9, d));
    REFUSED_INTO(hz, clast_henze_zirkler_test(points, N, 3, 9, &hz));
    REFUSED_INTO(score, clast_boundary_score_test(points, N, 3, bad_side, &score));
    REFUSED_INTO(score, clast_boundary_score_test(points, N, 3, NULL, &score));
    REFUSED_INTO(p, clast_agglomeration_change_test(points, points, N, 0, &p));
    REFUSED_INTO(left_out, clast_uniformity_choose(NULL, &left_out));
    REFUSED_INTO(left_out, clast_uniformity_choose("", &left_out));
    REFUSED(clast_uniformity_choose("star", NULL));
}

static void bad_domains_are_refused(void **state)
{
    (void)state;
    const clast_domain_map_functions none = {.dimension = 3, .volume = 1.0};
    clast_mesh box = {0};
    clast_domain domain;
    clast_cloud cloud;
    CHECK_OK(clast_mesh_box(1, 1, 1, &box));
    REFUSED_INTO(domain, clast_domain_parse(NULL, &domain));
    REFUSED(clast_domain_parse("sphere:1", NULL));
    REFUSED_INTO(domain, clast_domain_of_map(NULL, &domain));
    REFUSED_INTO(domain, clast_domain_of_map(&none, &domain));
    REFUSED_INTO(domain, clast_domain_of_mesh(NULL, 1.0, &domain));
    REFUSED_INTO(domain, clast_domain_of_mesh(&box, 0.0, &domain));
    REFUSED_INTO(domain, clast_domain_of_mesh(&box, (double)NAN, &domain));
    REFUSED(clast_domain_of_mesh(&box, 1.0, NULL));
    REFUSED_INTO(cloud, clast_cloud_alloc(-1, 3, &cloud));
    REFUSED_INTO(cloud, clast_cloud_alloc(1, 0, &cloud));
    REFUSED(clast_cloud_alloc(1, 1, NULL));
    clast_mesh_free(&box);
}

static void bad_collisions_are_refused(void **state)
{
    (void)state;
    static double x[3 * N], radius[N], mass[N];
    memcpy(x, points, sizeof x);
    memcpy(radius, ones, sizeof radius);
    memcpy(mass, ones, sizeof mass);
    const double volume[2] = {1.0, 1.0};
    const clast_population p = {N, 3, x, monomers, radius, mass, NULL, NULL, owner, NULL};
    const clast_collide_cells cells = {2, cell, volume, NULL, NULL, NULL};
    const clast_collide_config good = {
        .kernel = 1, .alpha = 1.0, .medium.constant = 1e-3, .block = 1024};
    clast_collide_config bad[12];
    clast_population wrong[8];
    clast_collide_cells none[4];
    int64_t n;
    for (int k = 0; k < 12; ++k) {
        bad[k] = good;
        wrong[k % 8] = p;
        none[k % 4] = cells;
    }
    bad[0] = (clast_collide_config){0};
    bad[1].kernel = 0;
    bad[2].kernel = 1U << 31;
    bad[3].alpha = (double)NAN;
    bad[4].alpha = 7.0;
    bad[5].radius_law = 77;
    bad[6].collisions = 77;
    bad[7].collisions = CLAST_COLLISIONS_POISSON;       // leap is 0
    bad[8].radius_law = CLAST_RADIUS_FRACTAL_COLLISION; // so are a0, D_f, k_f
    bad[9].block = -1;
    bad[10].medium.constant = -1.0;
    bad[11].kernel = 1U << 3; // brownian without temperature
    for (int k = 0; k < 12; ++k) {
        clast_population q = p;
        REFUSED_INTO(n, clast_collide(&q, &cells, 0.1, 0, &bad[k], &n));
    }
    wrong[0] = (clast_population){0};
    wrong[1].n = -1;
    wrong[2].dimension = 4;
    wrong[3].x = NULL;
    wrong[4].monomers = NULL;
    wrong[5].radius = NULL;
    wrong[6].mass = NULL;
    wrong[7].owner = NULL;
    for (int k = 0; k < 8; ++k) {
        REFUSED_INTO(n, clast_collide(&wrong[k], &cells, 0.1, 0, &good, &n));
    }
    const int32_t far[N] = {5};
    none[0] = (clast_collide_cells){0};
    none[1].of_particle = NULL;
    none[2].volume = NULL;
    none[3].of_particle = far;
    for (int k = 0; k < 4; ++k) {
        clast_population q = p;
        REFUSED_INTO(n, clast_collide(&q, &none[k], 0.1, 0, &good, &n));
    }
    clast_population q = p;
    REFUSED_INTO(n, clast_collide(&q, &cells, (double)NAN, 0, &good, &n));
    REFUSED_INTO(n, clast_collide(&q, &cells, -1.0, 0, &good, &n));
    REFUSED_INTO(n, clast_collide(&q, NULL, 0.1, 0, &good, &n));
    REFUSED_INTO(n, clast_collide(NULL, &cells, 0.1, 0, &good, &n));
    REFUSED_INTO(n, clast_collide(&q, &cells, 0.1, 0, NULL, &n));
    mass[3] = (double)NAN;
    REFUSED_INTO(n, clast_collide(&q, &cells, 0.1, 0, &good, &n));
    REFUSED_INTO(
        n, clast_workspace_collide(NULL, &q, &cells, (clast_workspace_step){0.1, 0}, &good, &n));
    assert_memory_equal(x, points, sizeof x);
    assert_memory_equal(radius, ones, sizeof radius);
}

static void try_agglomerate(const void *config, void *context)
{
    clast_agglomeration r;
    REFUSED_INTO(r, clast_agglomerate(context, config, NULL, &r));
}

static void bad_agglomerations_are_refused(void **state)
{
    (void)state;
    clast_agglomerate_config c = {0};
    const clast_cloud cloud = {.n = N, .dimension = 3, .x = points};
    const clast_agglomerate_input bad[] = {{0},
                                           {.n_snapshot = 1},
                                           {.snapshot = &cloud},
                                           {.snapshot = &cloud, .n_snapshot = -1},
                                           {.snapshot = &(clast_cloud){0}, .n_snapshot = 1}};
    clast_agglomerate_input good = {.snapshot = &cloud, .n_snapshot = 1};
    clast_agglomeration r;
    CHECK_OK(clast_fields_default(clast_agglomerate_fields, &c));
    c.decompose = decompose_config();
    spoil_fields(clast_agglomerate_fields, &c, sizeof c, try_agglomerate, &good);
    spoil_fields(clast_decompose_fields, &c, sizeof c, try_agglomerate, &good);
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; ++k) {
        REFUSED_INTO(r, clast_agglomerate(&bad[k], &c, NULL, &r));
    }
    REFUSED_INTO(r, clast_agglomerate(NULL, &c, NULL, &r));
    REFUSED_INTO(r, clast_agglomerate(&good, NULL, NULL, &r));
    REFUSED(clast_agglomerate(&good, &c, NULL, NULL));
    clast_fields_free(clast_agglomerate_fields, &c);
    clast_fields_free(clast_decompose_fields, &c.decompose);
}

static void try_spectrum(const void *config, void *context)
{
    clast_spectrum r;
    REFUSED_INTO(r, clast_spectrum_evolve(NULL, config, context, NULL, &r));
}

static void spectra_are_refused(void **state)
{
    (void)state;
    clast_spectrum_config c = {0};
    clast_spectrum r;
    clast_collide_config good = {.kernel = 1, .alpha = 1.0, .medium.constant = 1e-3, .block = 1024};
    CHECK_OK(clast_fields_default(clast_spectrum_fields, &c));
    c.concentration = c.duration = 1.0;
    c.n_step = c.repeats = 1;
    spoil_fields(clast_spectrum_fields, &c, sizeof c, try_spectrum, &good);
    REFUSED_INTO(r, clast_spectrum_evolve(NULL, NULL, &good, NULL, &r));
    REFUSED_INTO(r, clast_spectrum_evolve(NULL, &c, NULL, NULL, &r));
    REFUSED(clast_spectrum_evolve(NULL, &c, &good, NULL, NULL));
    good.alpha = (double)NAN;
    REFUSED_INTO(r, clast_spectrum_evolve(NULL, &c, &good, NULL, &r));
    c.duration = (double)NAN;
    good.alpha = 1.0;
    REFUSED_INTO(r, clast_spectrum_evolve(NULL, &c, &good, NULL, &r));
}

/* --- surfaces --- */

static void try_fill(const void *config, void *context)
{
    clast_spheres spheres;
    clast_fill_report report;
    REFUSED_INTO(spheres, clast_fill(context, config, NULL, &spheres, NULL));
    REFUSED_INTO(report, clast_fill(context, config, NULL, &spheres, &report));
}

static void try_repair(const void *config, void *context)
{
    clast_mesh mesh;
    if (((const clast_mesh_repair_config *)config)->weld_tolerance != 0.0) { // zeros: no step
        REFUSED_INTO(mesh, clast_mesh_repair(context, config, &mesh, NULL));
    }
}

static void try_synthesize(const void *config, void *context)
{
    clast_mesh mesh;
    REFUSED_INTO(mesh, clast_synthesize_grain(config, 0, &mesh, context));
}

static void bad_work_on_surfaces_is_refused(void **state)
{
    (void)state;
    clast_fill_config fill;
    clast_mesh_repair_config repair;
    clast_synthesize_config synthesize;
    clast_synthesize_report report;
    clast_spheres spheres;
    clast_mesh box = {0};
    clast_mesh mesh;
    CHECK_OK(clast_mesh_box(1, 1, 1, &box));
    CHECK_OK(clast_fields_default(clast_fill_fields, &fill));
    CHECK_OK(clast_fields_default(clast_mesh_repair_fields, &repair));
    CHECK_OK(clast_fields_default(clast_synthesize_fields, &synthesize));
    spoil_fields(clast_fill_fields, &fill, sizeof fill, try_fill, &box);
    spoil_fields(clast_mesh_repair_fields, &repair, sizeof repair, try_repair, &box);
    spoil_fields(clast_synthesize_fields, &synthesize, sizeof synthesize, try_synthesize, &report);
    REFUSED_INTO(spheres, clast_fill(NULL, &fill, NULL, &spheres, NULL));
    REFUSED_INTO(spheres, clast_fill(&box, NULL, NULL, &spheres, NULL));
    REFUSED_INTO(mesh, clast_mesh_repair(NULL, &repair, &mesh, NULL));
    REFUSED_INTO(mesh, clast_synthesize_grain(NULL, 0, &mesh, &report));
    clast_fields_free(clast_fill_fields, &fill);
    clast_fields_free(clast_mesh_repair_fields, &repair);
    clast_fields_free(clast_synthesize_fields, &synthesize);
    clast_mesh_free(&box);
    const double lengths[] = {(double)NAN, 0.0, -1.0, (double)INFINITY};
    for (int k = 0; k < 4; ++k) {
        clast_mesh made;
        REFUSED_INTO(made, clast_mesh_box(1.0, lengths[k], 1.0, &made));
        REFUSED_INTO(made, clast_mesh_ellipsoid((double[3]){1.0, 1.0, lengths[k]}, 1, &made));
    }
}

/* --- every other function that takes a configuration with a table --- */

static void try_dem(const void *config, void *context)
{
    clast_dem *dem;
    (void)context;
    REFUSED_INTO(dem, clast_dem_create(config, &dem));
}

static void try_pack(const void *config, void *context)
{
    clast_pack *pack;
    clast_pack_source source;
    clast_pack_result result;
    REFUSED_INTO(pack, clast_pack_create(config, context, &pack));
    REFUSED_INTO(source, clast_pack_load(config, &source));
    REFUSED_INTO(result, clast_pack_run(config, NULL, NULL, NULL, &result));
}

static void try_aggregate(const void *config, void *context)
{
    clast_aggregate_source source;
    clast_aggregate_report report;
    clast_aggregate_fit fit;
    clast_table nodes;
    REFUSED(clast_aggregate_config_check(config));
    REFUSED_INTO(source, clast_aggregate_load(config, &source));
    REFUSED_INTO(report, clast_aggregate_run(config, NULL, NULL, NULL, &report));
    REFUSED_INTO(fit, clast_aggregate_fit_run(config, context, NULL, &fit, &nodes));
    REFUSED_INTO(fit, clast_aggregate_fit_study(config, NULL, NULL, &fit));
}

static void try_evolve(const void *config, void *context)
{
    clast_evolve *evolve;
    clast_evolve_source source;
    clast_evolve_result result;
    REFUSED_INTO(evolve, clast_evolve_create(config, context, &evolve));
    REFUSED_INTO(source, clast_evolve_load(config, &source));
    REFUSED_INTO(result, clast_evolve_run(config, NULL, NULL, &result));
}

static void try_fit(const void *config, void *context)
{
    const clast_table *table = context;
    const clast_fit_data beds = {.beds = *table}; // borrowed
    clast_fit_data data;
    clast_porosity_fit fit;
    clast_fit_note note;
    clast_model_kind kind = CLAST_MODEL_SINGLE;
    REFUSED_INTO(data, clast_fit_data_single(table, config, &data));
    REFUSED_INTO(data, clast_fit_data_mixture(table, table, config, &data));
    REFUSED_INTO(data, clast_fit_data_columns(table, config, &data));
    REFUSED_INTO(fit, clast_porosity_fit_data(&beds, "fit", "table", config, &fit));
    REFUSED(clast_porosity_fit_choose(table, false, config, &kind, &note));
    assert_false(clast_porosity_fit_note(NULL, table, &beds, 0, config, &note));
}

static void try_render(const void *config, void *context)
{
    clast_image image;
    REFUSED_INTO(image, clast_render_assembly(context, config, NULL, &image));
}

static void try_report(const void *config, void *context)
{
    static const char *const runs[] = {"/no/run"};
    REFUSED(clast_report_write(runs, 1, "/no/report.html", config));
    REFUSED(clast_report_write_view(context, "/no/view.html", config));
}

static void try_study(const void *config, void *context)
{
    const clast_study_worker worker = {0};
    clast_table plan;
    clast_study_report report;
    (void)context;
    REFUSED_INTO(plan, clast_study_plan(config, &plan));
    REFUSED_INTO(report, clast_study_run(config, "/no/study", &worker, NULL, NULL, &report));
}

static void try_pairs(const void *config, void *context)
{
    cloud_scene *s = context;
    clast_pairs pairs;
    REFUSED_INTO(pairs, clast_pairs_count(&s->domain, &s->cloud, config, &pairs));
}

static void try_policy(const void *config, void *context)
{
    cloud_scene *s = context;
    REFUSED(clast_workspace_set_policy(s->workspace, config));
}

/* Before, clast_dem_create looked at 5 of its 33 fields: a friction of -0.5 or NAN, a law 7 and a
 * viscosity of -1 were stepped. clast_report_write looked at none. */
static void no_table_has_a_field_that_is_not_looked_at(void **state)
{
    (void)state;
    static unsigned char config[4096];
    const clast_pack_input no_input = {0};
    const clast_aggregate_input no_core = {0};
    const clast_evolve_input no_cloud = {0};
    clast_table table = {0};
    double *number;
    clast_assembly ball = {0};
    clast_shape shape = {0};
    cloud_scene s = {.cloud = {.n = N, .dimension = 3, .x = points}};
    CHECK_OK(clast_shape_sphere("ball", 1.0, &shape));
    CHECK_OK(clast_assembly_add_shape(&ball, &shape, NULL));
    CHECK_OK(clast_assembly_add_grain(&ball, 0, (double[3]){0.0, 0.0, 0.0},
                                      (double[4]){1.0, 0.0, 0.0, 0.0}, 1.0, 1.0));
    CHECK_OK(clast_table_init(&table, "beds", 0));
    CHECK_OK(clast_table_add_number(&table, "row", "-", &number));
    CHECK_OK(clast_table_add_number(&table, "porosity", "-", &number));
    CHECK_OK(clast_workspace_create(&s.workspace));
    CHECK_OK(clast_domain_parse("box:0,0,0,1,1,1", &s.domain));
    const struct {
        const clast_field *fields;
        size_t size;
        try_function *attempt;
        const void *context;
    } all[] = {
        {clast_dem_fields, sizeof(clast_dem_config), try_dem, NULL},
        {clast_pack_fields, sizeof(clast_pack_config), try_pack, &no_input},
        {clast_aggregate_fields, sizeof(clast_aggregate_config), try_aggregate, &no_core},
        {clast_evolve_fields, sizeof(clast_evolve_config), try_evolve, &no_cloud},
        {clast_porosity_fit_fields, sizeof(clast_porosity_fit_config), try_fit, &table},
        {clast_render_fields, sizeof(clast_render_config), try_render, &ball},
        {clast_report_fields, sizeof(clast_report_config), try_report, &ball},
        {clast_study_fields, sizeof(clast_study_config), try_study, NULL},
        {clast_pairs_fields, sizeof(clast_pairs_config), try_pairs, &s},
        {clast_workspace_fields, sizeof(clast_workspace_policy), try_policy, &s},
    };
    for (size_t k = 0; k < sizeof all / sizeof all[0]; ++k) {
        assert_true(all[k].size <= sizeof config);
        CHECK_OK(clast_fields_default(all[k].fields, config));
        spoil_fields(all[k].fields, config, all[k].size, all[k].attempt, (void *)all[k].context);
        clast_fields_free(all[k].fields, config);
    }
    clast_workspace_destroy(s.workspace);
    clast_table_free(&table);
    clast_assembly_free(&ball);
    clast_shape_free(&shape);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bad_decompositions_are_refused),
        cmocka_unit_test(bad_points_change_nothing_in_a_workspace),
        cmocka_unit_test(bad_tests_of_uniformity_are_refused),
        cmocka_unit_test(bad_domains_are_refused),
        cmocka_unit_test(bad_collisions_are_refused),
        cmocka_unit_test(bad_agglomerations_are_refused),
        cmocka_unit_test(spectra_are_refused),
        cmocka_unit_test(bad_work_on_surfaces_is_refused),
        cmocka_unit_test(no_table_has_a_field_that_is_not_looked_at),
    };
    return cmocka_run_group_tests(tests, make_points, NULL);
}
