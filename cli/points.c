// Options that say how a file of points is read and which columns hold what.
#include "points.h"

#include "command.h"
#include "json.h"
#include "packing.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define TEXT(name, ...)                                                                            \
    {                                                                                              \
#name, .offset = offsetof(clast_cloud_columns, name), CLAST_FIELD_TEXT, 0, 0, 0, "-",      \
               .text = "", .help = __VA_ARGS__                                                     \
    }
static const clast_field rows[] = {
    {"columns", .offset = offsetof(clast_cloud_columns, columns), CLAST_FIELD_TEXT_LIST, 0, 0, 0,
     "-",
     "columns of the coordinates, as many as dimensions; x,y,z are found as x_m, x_mm, ... too; "
     "without a header they are column_1, column_2, ...",
     "x,y,z", .common = true, .group = "columns of the file"},
    TEXT(unit, "unit of coordinates and --domain (mm, um); none: that of columns as x_mm, else m",
         .common = true),
    TEXT(radius_column, "column of radii [m]"),
    TEXT(diameter_column, "column of diameters [m], instead of radii"),
    TEXT(mass_column, "column of masses [kg]"),
    {"velocity_columns", .offset = offsetof(clast_cloud_columns, velocity_columns),
     CLAST_FIELD_TEXT_LIST, 0, 0, 0, "-", "columns of velocities [m/s], as many as dimensions", ""},
    TEXT(weight_column, "column of weights: real particles that a parcel stands for",
         .common = true),
    TEXT(variable_column, "column of a variable (temperature) in which tree cells are uniform too"),
    {"dataset", .offset = offsetof(cli_points, dataset), CLAST_FIELD_TEXT, 0, 0, 0, "-",
     "array or folder of an HDF5 file", ""},
    {"frame", .offset = offsetof(cli_points, frame), CLAST_FIELD_I64, 0, -1e12, 1e12, "-",
     "snapshot of a LAMMPS dump or .xyz, from 0; -1: the last", NULL},
    {"domain_unit", .offset = offsetof(cli_points, domain_unit), CLAST_FIELD_TEXT, 0, 0, 0, "-",
     "unit of bare numbers in --domain and of mesh:FILE; none: --unit, else what the file says",
     ""},
    {0}};
#undef TEXT

void cli_point_fields(cli_joined *joined, size_t offset)
{
    cli_joined_append_all(joined, rows, offset);
}

clast_status cli_points_read(const cli_common *common, const char *path, const cli_points *points,
                             clast_table *table, clast_packing_report *read)
{
    clast_points_snapshot snapshot;
    const clast_points_options options = {points->dataset, points->frame, &snapshot};
    CLI_GUARD(clast_cloud_read(path, &options, table));
    if (table->n_row == 0) {
        clast_table_free(table);
        return cli_fail(CLAST_E_FORMAT, "%s holds no points", path);
    }
    *read = (clast_packing_report){
        .snapshot = snapshot.number, .n_snapshot = snapshot.n, .frame.step = snapshot.step};
    cli_packing_note(common, path, read);
    return CLAST_OK;
}

clast_status cli_domain_read(const char *text, const cli_points *points, clast_domain *domain)
{
    if (text[0] == '\0') {
        return cli_fail(
            CLAST_E_USAGE,
            "give the domain, --domain box:0,0,0,1,1,1; it is never guessed from the points");
    }
    const bool is_own = points->domain_unit[0] != '\0';
    const clast_status status =
        clast_domain_read(text, is_own ? points->domain_unit : points->columns.unit, domain);
    return status == CLAST_E_CONFIG && !is_own && cli_domain_file(text) != NULL
               ? cli_fail(status, "%s (--domain-unit: of the domain alone)", clast_error_detail())
               : status;
}

void cli_domain_name(const char *text, const clast_domain *domain, char name[CLI_DOMAIN_NAME])
{
    if (cli_domain_file(text) != NULL) {
        (void)snprintf(name, CLI_DOMAIN_NAME, "%s", text);
    } else {
        clast_domain_format(domain, name);
    }
}

const char *cli_domain_file(const char *text)
{
    static const char prefix[] = "mesh:";
    const size_t n = sizeof prefix - 1;
    return strncmp(text, prefix, n) == 0 ? text + n : NULL;
}

void cli_domain_json(json_t *out, const char *text, const clast_domain *domain)
{
    char name[CLI_DOMAIN_NAME];
    char unit[16];
    cli_domain_name(text, domain, name);
    (void)snprintf(unit, sizeof unit, "m^%d", domain->dimension);
    cli_json_text(out, "domain", name);
    cli_json_text(out, "length_unit", "m");
    cli_json_number(out, "domain_volume", clast_domain_volume(domain));
    cli_json_text(out, "domain_volume_unit", unit);
}

/// The unit in which points that lie outside the domain would fill it, "mm" or "um"; NULL: none.
static const char *unit_that_fits(const clast_domain *domain, const clast_cloud *cloud)
{
    static const struct {
        const char *name;
        double metre;
    } unit[2] = {{"mm", 1e-3}, {"um", 1e-6}};
    const int32_t d = cloud->dimension;
    const double width = pow(clast_domain_volume(domain), 1.0 / d);
    for (int k = 0; k < 2; ++k) {
        bool fits = cloud->n > 1;
        double widest = 0.0;
        for (int64_t i = 0; i < cloud->n && fits; ++i) {
            double x[3] = {0.0};
            double u[3];
            for (int32_t j = 0; j < d; ++j) {
                x[j] = unit[k].metre * cloud->x[i * d + j];
                widest = fmax(widest, fabs(x[j] - unit[k].metre * cloud->x[j]));
            }
            fits = clast_domain_map(domain, x, u);
        }
        if (fits && widest > 0.1 * width) { // near the origin anything fits
            return unit[k].name;
        }
    }
    return NULL;
}

clast_status cli_points_status(clast_status status, const cli_points *points,
                               const clast_domain *domain, const clast_cloud *cloud)
{
    char said[CLI_WORDS_SIZE];
    if (status != CLAST_E_FORMAT || points->columns.unit[0] != '\0' ||
        strstr(clast_error_detail(), "outside the domain") == NULL) {
        return status;
    }
    const char *const unit = unit_that_fits(domain, cloud);
    if (unit == NULL) {
        return status;
    }
    (void)snprintf(said, sizeof said, "%s", clast_error_detail());
    return cli_fail(status, "%s; in %s they would fit: --unit %s?", said, unit, unit);
}

void cli_warn(const cli_common *common, const char *line)
{
    if (line[0] != '\0') {
        (void)fprintf(stderr, "clast %s: warning: %s\n", common->command, cli_name(line));
    }
}

void cli_warn_of_units(const cli_common *common, const clast_domain *domain,
                       const clast_cloud *cloud)
{
    char words[CLI_WORDS_SIZE];
    char line[CLI_WORDS_SIZE + 100];
    (void)clast_cloud_corner_words(cloud, common->comm, domain, sizeof words, words);
    if (common->comm->rank == 0 && words[0] != '\0') {
        (void)snprintf(line, sizeof line,
                       "%s (bare numbers of --domain are metres unless --unit says otherwise)",
                       words);
        cli_warn(common, line);
    }
}

void cli_warn_of_weight(const cli_common *common, const clast_cloud *cloud, const char *path)
{
    char words[CLI_LINE_SIZE];
    if (common->comm->rank == 0) {
        cli_warn(common, clast_cloud_weight_words(cloud, path, sizeof words, words));
    }
}
