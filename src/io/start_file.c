// A bed to begin with: a run's state, or grains of another program.
#include "io/start_file.h"

#include "assembly/whole.h"
#include "base/alloc.h"
#include "base/path.h"
#include "io/packing.h"
#include <clast/assembly.h>
#include <clast/field.h>
#include <clast/state.h>
#include <clast/status.h>
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

/// Density of grains that are given none [kg/m^3], as in pack/density.c.
static const double USUAL = 2650.0;

/// Share by which sides that were written down may differ from a cell's.
static const double ROUNDED = 0.01;

static bool is_folder(const char *path)
{
    struct stat s;
    return stat(path, &s) == 0 && S_ISDIR(s.st_mode);
}

/// Lengths to metres.
static void scale_all(clast_assembly *a, double factor)
{
    for (int32_t i = 0; i < a->n_grain; ++i) {
        a->scale[i] *= factor;
        for (int k = 0; k < 3; ++k) {
            a->position[i][k] *= factor;
        }
    }
}

static clast_status to_metres(const clast_pack_config *c, clast_assembly *a)
{
    clast_status status = CLAST_OK;
    const bool is_model = a->unit[0] == '\0' || strcmp(a->unit, "model") == 0;
    double factor = 1.0;
    CLX_CHECK(!is_model || c->start_unit[0] != '\0', CLAST_E_CONFIG,
              "the unit of its lengths is not known; give it (start_unit: mm)");
    CLX_CHECK(is_model || c->start_unit[0] == '\0' || strcmp(c->start_unit, a->unit) == 0,
              CLAST_E_CONFIG, "its lengths are in %s, not in %s (start_unit)", a->unit,
              c->start_unit);
    CLX_TRY(clast_unit_factor(is_model ? c->start_unit : a->unit, "m", &factor));
    scale_all(a, factor);
    (void)snprintf(a->unit, sizeof a->unit, "m");
done:
    return status;
}

static clast_status refuse_density(const clast_pack_config *c, const char *whose)
{
    return c->density.n == 0
               ? CLAST_OK
               : clx_fail(CLAST_E_CONFIG, "density is the %s's own; leave it out", whose);
}

/// What only packings of other programs leave open.
static clast_status refuse_options(const clast_pack_config *c, const char *whose)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(c->start_columns[0] == '\0' && c->start_diameter == 0.0, CLAST_E_CONFIG,
              "start_columns and start_diameter are for packings of spheres from other programs");
    CLX_CHECK(c->start_frame == -1 || c->start_frame == CLX_START_OLD, CLAST_E_CONFIG,
              "start_frame is for packings of several snapshots from other programs");
    CLX_TRY(refuse_density(c, whose));
done:
    return status;
}

static clast_status read_state(const clast_pack_config *c, clast_assembly *a,
                               clast_packing_frame *frame)
{
    clast_status status = CLAST_OK;
    clast_packing_frame found; // its step is of a run, not of a snapshot
    CLX_TRY(refuse_options(c, "state"));
    CLX_TRY(clast_state_read_assembly(c->start, a));
    CLX_TRY(clast_state_read_frame(c->start, &found));
    found.step = frame->step;
    *frame = found;
    CLX_TRY(to_metres(c, a));
done:
    return status;
}

/// Whether the unit that was given is that of the file, where this says one.
static clast_status check_unit(const clast_pack_config *c, const clx_packing_told *told)
{
    const char *own = told->units != NULL ? told->units->length : told->unit;
    double factor = 0.0;
    return c->start_unit[0] == '\0' || own[0] == '\0' || strcmp(c->start_unit, own) == 0 ||
                   (told->units == NULL && strcmp(c->start_unit, "m") == 0)
               ? CLAST_OK
           : clast_unit_factor(c->start_unit, "m", &factor) != CLAST_OK
               ? CLAST_E_CONFIG
               : clx_fail(CLAST_E_CONFIG, "its lengths are in %s, not in %s (start_unit)", own,
                          c->start_unit);
}

static clast_status read_others(const clast_pack_config *c, clast_assembly *a,
                                clast_packing_report *report)
{
    clast_status status = CLAST_OK;
    const bool is_old = c->start_frame == CLX_START_OLD;
    const clx_packing_wanted wanted = {
        .spheres = {.options = {.columns = c->start_columns, .diameter = c->start_diameter},
                    .prefix = "--start-"},
        .unit = c->start_unit,
        .frame = is_old ? 0 : c->start_frame,
        .has_frame = !is_old && c->start_frame != -1,
        .is_old = is_old};
    clx_packing_told told;
    const double density = c->density.n == 0 ? USUAL : c->density.n == 1 ? c->density.item[0] : 0.0;
    CLX_CHECK(density > 0.0, CLAST_E_CONFIG,
              "grains of another program have one density, above 0 (density)");
    CLX_TRY(clx_packing_read(c->start, &wanted, a, &told));
    CLX_TRY(check_unit(c, &told));
    CLX_CHECK(strcmp(a->unit, "m") == 0, CLAST_E_CONFIG,
              "the unit of its lengths is not known; give it (start_unit: mm)");
    CLX_TRY(a->no_density ? CLAST_OK : refuse_density(c, "file"));
    for (int32_t i = 0; i < a->n_grain && a->no_density; ++i) {
        a->density[i] = density;
    }
    a->no_density = false;
    *report = told.report;
done:
    return status;
}

clast_status clx_start_poses(const clast_pack_config *config, clast_table *table)
{
    clast_status status = CLAST_OK;
    clast_table made = {0};
    if (!clx_path_is(config->start, "csv")) {
        return CLAST_OK;
    }
    CLX_TRY(clast_table_read_csv(config->start, NULL, &made, NULL));
    if (clast_table_numbers(&made, "qw") != NULL && clast_table_numbers(&made, "scale") != NULL) {
        *table = made;
        made = (clast_table){0};
    }
done:
    if (status != CLAST_OK) {
        clx_fail_prefix("start");
    }
    clast_table_free(&made);
    return status;
}

/// The three columns x, y, z, whose names may end in a unit; and that unit, or "model".
static clast_status find_places(const clast_table *t, const double *x[3], char unit[16])
{
    clast_status status = CLAST_OK;
    static const char *const name[3] = {"x", "y", "z"};
    for (int k = 0; k < 3; ++k) {
        x[k] = NULL;
        for (int32_t c = 0; c < t->n_column; ++c) {
            const char *at = t->column[c].name;
            const char *end = at[0] != '\0' && at[1] == '_' ? at + 2 : "model";
            if (at[0] == name[k][0] && (at[1] == '\0' || at[1] == '_') && strlen(end) < 16 &&
                t->column[c].number != NULL && x[k] == NULL) {
                CLX_CHECK(k == 0 || strcmp(unit, end) == 0, CLAST_E_FORMAT,
                          "columns x, y and z are in different units");
                (void)snprintf(unit, 16, "%s", end);
                x[k] = t->column[c].number;
            }
        }
        CLX_CHECK(x[k] != NULL, CLAST_E_FORMAT, "there is no column %s", name[k]);
    }
done:
    return status;
}

static const char *const *text_column(const clast_table *t, const char *name)
{
    for (int32_t c = 0; c < t->n_column; ++c) {
        if (strcmp(t->column[c].name, name) == 0 && t->column[c].text != NULL) {
            return (const char *const *)t->column[c].text;
        }
    }
    return NULL;
}

/// The shape of this name, or of the file of this name with its ending left out; or -1.
static int32_t find_shape(const clast_assembly *a, const char *name)
{
    const size_t n = strlen(name);
    int32_t found = -1;
    int32_t n_found = 0;
    for (int32_t i = 0; i < a->n_shape; ++i) {
        const char *own = a->shape[i].name;
        if (strcmp(own, name) == 0) {
            return i;
        }
        if (strncmp(own, name, n) == 0 && own[n] == '.' && isalpha((unsigned char)own[n + 1])) {
            found = i;
            ++n_found;
        }
    }
    return n_found == 1 ? found : -1;
}

/// Names the shapes that there are, as far as a line holds them.
static clast_status refuse_name(const clast_assembly *a, int64_t row, const char *name)
{
    enum { MOST = 4 };
    char names[256] = "";
    size_t n = 0;
    for (int32_t i = 0; i < a->n_shape && i < MOST && n < sizeof names; ++i) {
        n += (size_t)snprintf(names + n, sizeof names - n, "%s%s", i > 0 ? ", " : "",
                              a->shape[i].name);
    }
    return clx_fail(CLAST_E_FORMAT, "row %lld: shape '%s' is none of shapes: %s%s",
                    (long long)row + 1, name, names, a->n_shape > MOST ? ", ..." : "");
}

static clast_status add_row(const clast_table *t, int64_t i, const char *const *name,
                            const double *const x[3], clast_assembly *a)
{
    clast_status status = CLAST_OK;
    static const char *const part[4] = {"qw", "qx", "qy", "qz"};
    CLAST_ASSERT(x[0] != NULL && x[1] != NULL && x[2] != NULL);
    const double *density = clast_table_numbers(t, "density_kg/m^3");
    const double place[3] = {x[0][i], x[1][i], x[2][i]};
    double q[4];
    const int32_t shape = find_shape(a, name[i]);
    CLX_TRY(shape >= 0 ? CLAST_OK : refuse_name(a, i, name[i]));
    for (int k = 0; k < 4; ++k) {
        const double *column = clast_table_numbers(t, part[k]);
        CLX_CHECK(column != NULL, CLAST_E_FORMAT, "there is no column %s", part[k]);
        q[k] = column[i];
    }
    CLX_CHECK(density != NULL, CLAST_E_FORMAT, "there is no column density_kg/m^3");
    status = clast_assembly_add_grain(a, shape, place, q, clast_table_numbers(t, "scale")[i],
                                      density[i]);
    if (status == CLAST_E_USAGE) {
        clx_fail_prefix("row %lld", (long long)i + 1);
        status = CLAST_E_FORMAT;
    }
done:
    return status;
}

/// To the caller; else the error names the key.
static clast_status finish(const clast_pack_config *config, clast_status status,
                           clast_assembly *made, clast_assembly *assembly)
{
    CLX_TRY(status);
    CLX_CHECK(made->n_grain > 0, CLAST_E_GEOMETRY, "%s holds no grain", config->start);
    *assembly = *made;
    *made = (clast_assembly){0};
done:
    if (status != CLAST_OK) {
        clx_fail_prefix("start");
    }
    clast_assembly_free(made);
    return status;
}

clast_status clx_start_of_poses(const clast_pack_config *config, const clast_table *table,
                                int32_t n_shape, const clast_shape *shape, clast_assembly *assembly)
{
    clast_status status = CLAST_OK;
    clast_assembly made = {0};
    const double *x[3];
    const char *const *name = text_column(table, "shape");
    CLX_CHECK(name != NULL, CLAST_E_FORMAT, "there is no column shape");
    CLX_TRY(refuse_options(config, "table"));
    CLX_TRY(find_places(table, x, made.unit));
    CLX_TRY(clx_assembly_add_shapes(&made, n_shape, shape, sizeof *shape));
    for (int64_t i = 0; i < table->n_row; ++i) {
        CLX_TRY(add_row(table, i, name, x, &made));
    }
    CLX_TRY(to_metres(config, &made));
done:
    return finish(config, status, &made, assembly);
}

double clx_start_shift(const clast_dem_config *c, const clast_packing_frame *frame)
{
    const double side[3] = {c->width, c->depth > 0.0 ? c->depth : c->width, c->height};
    bool is_same = c->domain == CLAST_DEM_CELL && frame->tilt[0] == 0.0 && frame->tilt[2] == 0.0;
    for (int k = 0; k < 3; ++k) {
        is_same = is_same && frame->has_box[k] && frame->is_periodic[k] &&
                  fabs(frame->high[k] - frame->low[k] - side[k]) <= ROUNDED * side[k];
    }
    const double s = frame->tilt[1];
    return is_same ? s - side[0] * floor(s / side[0] + 0.5) : 0.0;
}

clast_status clx_start_read(const clast_pack_config *config, clast_assembly *assembly,
                            clast_packing_report *report)
{
    clast_status status = CLAST_OK;
    clast_assembly made = {0};
    const bool is_state = clx_path_is(config->start, "h5");
    CLX_CHECK(!is_folder(config->start), CLAST_E_CONFIG, "%s is a folder; give the state.h5 in it",
              config->start);
    CLX_TRY(is_state ? read_state(config, &made, &report->frame)
                     : read_others(config, &made, report));
done:
    return finish(config, status, &made, assembly);
}
