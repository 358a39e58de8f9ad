#pragma once
#include <clast/chart.h>

/// Title for people.
const char *clx_aggregate_chart_title(clast_aggregate_chart chart);
