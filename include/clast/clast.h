#pragma once
// All public headers.
#include <clast/assembly.h>
#include <clast/bvh.h>
#include <clast/chart.h>
#include <clast/cloud.h>
#include <clast/config.h>
#include <clast/field.h>
#include <clast/hull.h>
#include <clast/mesh.h>
#include <clast/mesh_file.h>
#include <clast/monitor.h>
#include <clast/parallel.h>
#include <clast/printable.h>
#include <clast/shape.h>
#include <clast/status.h>
#include <clast/table.h>
