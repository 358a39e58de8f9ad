#pragma once
// Options that say how a file of points is read and which columns hold what.
#include "configs.h"
#include <clast/clast.h>
#include <jansson.h>

/// The part of a configuration that cli_point_fields fills.
typedef struct cli_points {
    clast_cloud_columns columns; // first: rows of the field table share offsets
    char *dataset;
    int64_t frame;
    char *domain_unit;
} cli_points;

/// Appends the options of a cli_points that lies `offset` bytes into a configuration struct.
void cli_point_fields(cli_joined *joined, size_t offset);

/// Reads the file as a table. Of several snapshots a line on stderr says which one.
///
/// @param read  that one
clast_status cli_points_read(const cli_common *common, const char *path, const cli_points *points,
                             clast_table *table, clast_packing_report *read);

/// Reads the domain that --domain names; a missing one is a usage error.
clast_status cli_domain_read(const char *text, const cli_points *points, clast_domain *domain);

/// File of a domain mesh:FILE, or NULL.
const char *cli_domain_file(const char *text);

enum { CLI_DOMAIN_NAME = 512 };

/// "domain", "length_unit", "domain_volume" and "domain_volume_unit" of a summary.
void cli_domain_json(json_t *out, const char *text, const clast_domain *domain);

/// The domain in m; one of a file as it was typed.
void cli_domain_name(const char *text, const clast_domain *domain, char name[CLI_DOMAIN_NAME]);

/// `status` of a call that was given the points; where it says that some lie outside the domain and
/// they would fill it in mm or um, the line says so too.
clast_status cli_points_status(clast_status status, const cli_points *points,
                               const clast_domain *domain, const clast_cloud *cloud);

enum { CLI_LINE_SIZE = 1000 };

/// "clast COMMAND: warning: LINE" on stderr; nothing of an empty line.
void cli_warn(const cli_common *common, const char *line);

/// Says on stderr that the points lie in a corner of the domain (clast_cloud_corner_words). Called
/// by all ranks.
void cli_warn_of_units(const cli_common *common, const clast_domain *domain,
                       const clast_cloud *cloud);

/// Says on stderr that a column of weights is not read (clast_cloud_weight_words).
void cli_warn_of_weight(const cli_common *common, const clast_cloud *cloud, const char *path);
