// Loads what an evolution's configuration names: shapes, sizes, space, positions.
#include <clast/evolve.h>

#include "base/alloc.h"
#include "base/column_unit.h"
#include "base/path.h"
#include "io/config_files.h"
#include "io/points.h"
#include "io/shape_word.h"
#include <clast/aggregate_run.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

void clast_evolve_unload(clast_evolve_source *source)
{
    if (source == NULL) {
        return;
    }
    for (int32_t i = 0; i < source->n_shape; ++i) {
        clast_assembly_free(&source->shape[i]);
    }
    clx_free(source->shape);
    clast_grading_destroy(source->grading);
    clast_domain_free(&source->domain);
    clast_domain_free(&source->release);
    clast_cloud_free(&source->points);
    clast_cloud_free(&source->field);
    *source = (clast_evolve_source){0};
}

static clast_status load_shapes(const clast_evolve_config *c, clast_evolve_source *made)
{
    clast_status status = CLAST_OK;
    clast_aggregate_config as = {0}; // how clast aggregate reads its shapes
    bool has_fields = false;
    CLX_CHECK(c->shapes.n > 0, CLAST_E_CONFIG, "a cloud needs a shape (shapes)");
    CLX_CHECK(c->density.n == 1 || c->density.n == c->shapes.n, CLAST_E_CONFIG,
              "density: %d of %d shapes; give one for all, or one each", c->density.n, c->shapes.n);
    CLX_TRY(clast_fields_default(clast_aggregate_fields, &as));
    has_fields = true;
    CLX_TRY(
        clast_field_set(clast_fields_find(clast_aggregate_fields, "unit"), &as, c->unit, false));
    clast_field_clear(clast_fields_find(clast_aggregate_fields, "envelope"), &as);
    as.accept_faults = c->accept_faults;
    CLX_TRY(clx_alloc(&made->shape, c->shapes.n, sizeof *made->shape));
    for (int32_t i = 0; i < c->shapes.n; ++i) {
        CLX_TRY(clx_load_named("shapes", &as, c->shapes.item[i], "",
                               c->density.item[c->density.n > 1 ? i : 0], &made->shape[i]));
        ++made->n_shape;
    }
done:
    if (has_fields) {
        clast_fields_free(clast_aggregate_fields, &as);
    }
    return status;
}

static clast_status load_domain(const char *option, const char *text, clast_domain *domain)
{
    const clast_status status = clast_domain_read(text, NULL, domain);
    if (status != CLAST_OK) {
        clx_fail_prefix("%s", option);
    }
    return status;
}

/// A column of numbers that are sizes by its name, "diameter", "diameter_um", "radius (mm)"; NULL:
/// none is.
static const char *find_sizes(const clast_table *table)
{
    static const char *const words[] = {"diameter", "volume_diameter", "radius"};
    char unit[CLX_COLUMN_UNIT];
    for (size_t w = 0; w < sizeof words / sizeof words[0]; ++w) {
        const size_t n = strlen(words[w]);
        for (int32_t k = 0; k < table->n_column; ++k) {
            const clast_column *c = &table->column[k];
            if (c->number != NULL && strncasecmp(c->name, words[w], n) == 0 &&
                (c->name[n] == '\0' || clx_column_says_length(c->name, unit))) {
                return c->name;
            }
        }
    }
    return NULL;
}

/// What nothing reads of a file of points.
static void tell_unread(const clast_evolve_config *c, const clast_table *table,
                        const clast_points_snapshot *snapshot, char words[CLAST_POINTS_WORDS])
{
    char sizes[CLAST_POINTS_WORDS / 2] = "";
    char which[CLAST_POINTS_WORDS / 4] = "";
    const char *const column = c->diameter_column[0] == '\0' ? find_sizes(table) : NULL;
    if (column != NULL) {
        (void)snprintf(sizes, sizeof sizes,
                       "column '%.40s' is not looked at: sizes are those of the curve "
                       "(--diameter-column: of diameters)",
                       column);
    }
    if (snapshot->n > 1 && c->frame == 0) {
        (void)snprintf(which, sizeof which, "the first snapshot of %lld (--frame -1: the last)",
                       (long long)snapshot->n);
    }
    if (sizes[0] != '\0' || which[0] != '\0') {
        (void)snprintf(words, CLAST_POINTS_WORDS, "points: %s%s%s", which,
                       which[0] != '\0' && sizes[0] != '\0' ? "; " : "", sizes);
    }
}

/// Rows of three coordinates with what else the columns name; `option` stands before messages.
/// Points are bodies, which no faces join; a field's may be nodes of a mesh.
static clast_status load_cloud(const clast_evolve_config *c, const char *option, const char *path,
                               const clast_cloud_columns *columns, clast_evolve_source *made)
{
    clast_status status = CLAST_OK;
    clast_table table = {0};
    bool has_faces = false;
    clast_points_snapshot snapshot;
    const clast_points_options options = {c->dataset, c->frame, &snapshot};
    const bool is_field = columns->velocity_columns.n > 0;
    clast_cloud *const cloud = is_field ? &made->field : &made->points;
    CLX_TRY(is_field ? clx_points_read(path, NULL, &table, &has_faces)
                     : clast_cloud_read(path, &options, &table));
    if (!is_field) {
        tell_unread(c, &table, &snapshot, made->points_words);
    }
    CLX_TRY(clast_cloud_from_table(&table, columns, cloud));
    CLX_CHECK(cloud->dimension == 3, CLAST_E_FORMAT,
              "%s has %d coordinates of three; name its columns (columns)", path, cloud->dimension);
done:
    if (status != CLAST_OK) {
        clx_fail_prefix("%s", option);
    }
    clast_table_free(&table);
    return status;
}

static clast_status load_clouds(const clast_evolve_config *c, clast_evolve_source *made)
{
    static char axes[] = "x,y,z";
    clast_status status = CLAST_OK;
    char *velocity = c->field_columns;
    char *usual = axes;
    const clast_cloud_columns points = {.columns = c->columns,
                                        .diameter_column = c->diameter_column};
    const clast_cloud_columns field = {.columns = {.n = 1, .item = &usual},
                                       .velocity_columns = {.n = 1, .item = &velocity}};
    if (c->points[0] != '\0') {
        CLX_TRY(load_cloud(c, "points", c->points, &points, made));
    }
    if (c->field[0] != '\0') {
        CLX_TRY(load_cloud(c, "field", c->field, &field, made));
    }
done:
    return status;
}

static clast_status load_sizes(const clast_evolve_config *c, clast_evolve_source *made)
{
    clast_status status = CLAST_OK;
    clast_curve curve = {0};
    CLX_TRY(
        clast_grading_load(c->curve, CLAST_SPREAD_STEP, CLAST_COUNT_MEAN, &curve, &made->grading));
done:
    clast_curve_free(&curve);
    return status;
}

clast_status clast_evolve_load(const clast_evolve_config *config, clast_evolve_source *source)
{
    CLX_ARGUMENTS(config, source);
    CLX_GUARD(clast_fields_check(clast_evolve_fields, config));
    clast_status status = CLAST_OK;
    clast_evolve_source made = {0};
    const bool has_points = config->points[0] != '\0';
    const bool has_field = config->field[0] != '\0';
    const bool has_release = config->release[0] != '\0';
    CLX_CHECK(config->domain[0] != '\0', CLAST_E_CONFIG,
              "domain: give the space that they are in, as box:0,0,0,1cm,1cm,1cm");
    CLX_CHECK(!has_points || !has_release, CLAST_E_CONFIG,
              "release: the points say where particles start; leave it out");
    CLX_CHECK(has_points || config->diameter_column[0] == '\0', CLAST_E_CONFIG,
              "diameter_column: there is no file of points");
    CLX_TRY(load_shapes(config, &made));
    CLX_TRY(load_domain("domain", config->domain, &made.domain));
    if (has_release) {
        CLX_TRY(load_domain("release", config->release, &made.release));
        CLX_CHECK(made.release.dimension == 3, CLAST_E_CONFIG, "release: %s has %d dimensions",
                  config->release, made.release.dimension);
    }
    CLX_TRY(load_clouds(config, &made));
    CLX_TRY(load_sizes(config, &made));
    *source = made;
    made = (clast_evolve_source){0};
    source->input = (clast_evolve_input){.n_shape = source->n_shape,
                                         .shape = source->shape,
                                         .grading = source->grading,
                                         .domain = &source->domain,
                                         .release = has_release ? &source->release : NULL,
                                         .points = has_points ? &source->points : NULL,
                                         .field = has_field ? &source->field : NULL};
done:
    clast_evolve_unload(&made);
    return status;
}

static bool is_shape_file(const char *text)
{
    return strcmp(text, "sphere") != 0 && !clx_is_ellipsoid_word(text);
}

/// What stands behind a prefix, or NULL.
static const char *behind(const char *text, const char *prefix)
{
    const size_t n = strlen(prefix);
    return strncmp(text, prefix, n) == 0 ? text + n : NULL;
}

/// The file of sizes within the option curve, or NULL.
static const char *curve_file(const char *text)
{
    const char *list = behind(text, "list:");
    const char *masses = behind(text, "masses:");
    if (list != NULL || masses != NULL) {
        return list != NULL ? list : masses;
    }
    return clx_path_is(text, "csv") || clx_path_is(text, "txt") || clx_path_is(text, "tsv") ? text
                                                                                            : NULL;
}

static const char *file_of(const void *of, int32_t i, const char **role)
{
    const clast_evolve_config *config = of;
    if (clast_fields_check(clast_evolve_fields, config) != CLAST_OK) {
        return NULL;
    }
    *role = "shapes";
    for (int32_t k = 0; k < config->shapes.n; ++k) {
        if (is_shape_file(config->shapes.item[k]) && i-- == 0) {
            return config->shapes.item[k];
        }
    }
    const struct {
        const char *role, *file;
    } other[] = {{"curve", curve_file(config->curve)},
                 {"points", config->points[0] != '\0' ? config->points : NULL},
                 {"field", config->field[0] != '\0' ? config->field : NULL},
                 {"domain", behind(config->domain, "mesh:")},
                 {"release", behind(config->release, "mesh:")}};
    for (size_t k = 0; k < sizeof other / sizeof *other; ++k) {
        if (other[k].file != NULL && i-- == 0) {
            *role = other[k].role;
            return other[k].file;
        }
    }
    return NULL;
}

clx_run_inputs clx_evolve_inputs(const clast_evolve_config *config)
{
    return (clx_run_inputs){clast_evolve_fields, config, config->seed, file_of};
}
