#pragma once
#include <clast/table.h>

CLAST_BEGIN

// Charts of an aggregation from its tables, as files or as SVG in memory.

/// What to draw, from which table.
typedef enum {
    CLAST_AGGREGATE_CHART_POROSITY, ///< history: every porosity_* column over n
    CLAST_AGGREGATE_CHART_DIAMETER, ///< history: d_agg_m over n
    CLAST_AGGREGATE_CHART_DENSITY,  ///< history: density_kg/m^3 over n
    CLAST_AGGREGATE_CHART_SIZES,    ///< history: distribution of size_m, beside the wanted one
    CLAST_AGGREGATE_CHART_RADIAL,   ///< radial: solid_fraction over radius_low_m
                                    ///< (clast_assembly_radial_profile)
    CLAST_N_AGGREGATE_CHART
} clast_aggregate_chart;

/// File name without extension ("history", "diameter", ...), and a title for people.
CLAST_API const char *clast_aggregate_chart_name(clast_aggregate_chart chart);
CLAST_API const char *clast_aggregate_chart_title(clast_aggregate_chart chart);

/// True when the table has the columns and rows that the chart needs.
CLAST_API bool clast_aggregate_chart_fits(clast_aggregate_chart chart, const clast_table *table);

/// Draws one chart into a file: .svg, .pdf or .png.
///
/// History rows of equal n (repeats) become their mean and a band of one sample standard deviation
/// to either side. Rows that are not finite are left out. Lines of more than 600 points are thinned
/// evenly, first and last kept.
///
/// @param table   history of clast_aggregate_history (column repeat is optional), or radial
/// @param wanted  SIZES only, may be NULL: columns low_m, high_m and count or wanted; else NULL
/// @return CLAST_E_FORMAT when the table does not fit
CLAST_API clast_status clast_aggregate_chart_write(clast_aggregate_chart chart,
                                                   const clast_table *table,
                                                   const clast_table *wanted, const char *path);

/// The same as SVG text; free *bytes with clast_bytes_free.
CLAST_API clast_status clast_aggregate_chart_svg(clast_aggregate_chart chart,
                                                 const clast_table *table,
                                                 const clast_table *wanted, unsigned char **bytes,
                                                 size_t *n);

/// All charts that fit as FOLDER/NAME.svg: history.svg, diameter.svg, density.svg, sizes.svg.
CLAST_API clast_status clast_aggregate_charts_write(const clast_table *history,
                                                    const clast_table *wanted, const char *folder);

CLAST_END
