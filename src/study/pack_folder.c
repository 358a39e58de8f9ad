// What a packing leaves in its run folder.
#include "study/pack_folder.h"

#include "base/alloc.h"
#include "base/column_unit.h"
#include "base/path.h"
#include "plot/series.h"
#include "run/checkpoint.h"
#include "run/pack_state.h"
#include "run/run.h"
#include "study/frames.h"
#include <clast/assembly.h>
#include <clast/chart.h>
#include <clast/form.h>
#include <clast/run_folder.h>
#include <clast/state.h>
#include <clast/table.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static clast_status write_profile(const char *folder, const clast_pack *pack,
                                  const clast_pack_config *c, const clast_pack_result *r)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    clast_assembly a = {0};
    clast_table profile = {0};
    const clast_bed bed = clast_pack_bed(pack);
    const clast_porosity_options o = clast_pack_porosity(c);
    clast_porosity_bulk bulk = {.porosity = r->porosity, .z_low = r->z_low, .z_high = r->z_high};
    CLX_TRY(clast_dem_assembly(clast_pack_dem(pack), &a));
    CLX_TRY(clast_porosity_profile(&a, &bed, &o, &profile));
    CLX_TRY(clx_run_write_table(folder, "profile.csv", &profile));
    if (isfinite(r->porosity)) {
        CLX_TRY(clx_path_join(path, folder, "profile.svg"));
        CLX_TRY(clast_chart_porosity(&profile, &bulk, "m", path));
    }
done:
    clast_table_free(&profile);
    clast_assembly_free(&a);
    return status;
}

static clast_status draw_energy(const char *folder, const clast_table *series)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    static const char *const name[3] = {"kinetic_energy_J", "elastic_energy_J",
                                        "potential_energy_J"};
    static const char *const label[3] = {"kinetic", "elastic", "potential"};
    clast_series line[3];
    bool is_any = false;
    for (int k = 0; k < 3; ++k) {
        const double *y = clast_table_numbers(series, name[k]);
        line[k] = clx_series(CLAST_SERIES_LINE, label[k], clast_table_numbers(series, "time_s"), y,
                             series->n_row, k);
        for (int64_t i = 0; i < series->n_row; ++i) {
            is_any = is_any || y[i] > 0.0;
        }
    }
    const clast_chart chart = {.title = "Energy",
                               .x = {.label = "time (s)"},
                               .y = {.label = "energy (J)", .log = true},
                               .series = line,
                               .n_series = 3};
    if (series->n_row < 2 || !is_any) {
        return CLAST_OK;
    }
    CLX_TRY(clx_path_join(path, folder, "energy.svg"));
    CLX_TRY(clast_chart_write(&chart, path));
done:
    return status;
}

/// Lines of the load's table over time.
static clast_status draw_lines(const char *path, const clast_table *load, const char *title,
                               const char *unit, int n, const char *const (*name)[2])
{
    clast_series line[8];
    CLAST_ASSERT(n >= 1 && n <= 8);
    for (int k = 0; k < n; ++k) {
        line[k] = clx_series(CLAST_SERIES_LINE, name[k][1], clast_table_numbers(load, "time_s"),
                             clast_table_numbers(load, name[k][0]), load->n_row, k);
    }
    const clast_chart chart = {.title = title,
                               .x = {.label = "time (s)"},
                               .y = {.label = unit},
                               .series = line,
                               .n_series = n};
    return clast_chart_write(&chart, path);
}

/// Energy that was put in, and where it is or went: curves that add up to the first (the book's own
/// kinds, rolling at grains and walls as one).
static const char *const energy_kind[][3] = {
    {"put in", "energy_put_in_J", NULL},
    {"kinetic", "energy_translation_J", NULL},
    {"rotation", "energy_rotation_J", NULL},
    {"normal springs", "energy_normal_springs_J", NULL},
    {"tangential springs", "energy_tangential_springs_J", NULL},
    {"attraction", "energy_attraction_J", NULL},
    {"damping, grains", "lost_damping_grains_J", NULL},
    {"damping, walls", "lost_damping_walls_J", NULL},
    {"friction, grains", "lost_friction_grains_J", NULL},
    {"friction, walls", "lost_friction_walls_J", NULL},
    {"rolling", "lost_rolling_grains_J", "lost_rolling_walls_J"},
    {"fluid", "lost_fluid_J", NULL},
    {"damping of all velocities", "lost_calming_J", NULL},
    {"left with grains", "lost_left_J", NULL},
    {"scheme", "lost_scheme_J", NULL},
    {"all else", "energy_rest_J", NULL}};
enum { N_ENERGY = sizeof energy_kind / sizeof *energy_kind };

/// Curves of `n` rows each in y: kinds that never reach a hundredth of the most that was put in
/// join the last.
static int32_t gather_energy(const clast_table *load, double *y, clast_series line[N_ENERGY])
{
    const int64_t n = load->n_row;
    double *const rest = y + (N_ENERGY - 1) * n;
    double most = 0.0;
    int32_t n_line = 0;
    for (int k = 0; k < N_ENERGY; ++k) {
        double greatest = 0.0;
        for (int c = 1; c < 3 && energy_kind[k][c] != NULL; ++c) {
            const double *column = clast_table_numbers(load, energy_kind[k][c]);
            for (int64_t i = 0; i < n; ++i) {
                y[k * n + i] += column[i];
            }
        }
        for (int64_t i = 0; i < n; ++i) {
            greatest = fmax(greatest, fabs(y[k * n + i]));
        }
        most = k == 0 ? greatest : most;
        if (greatest > 0.01 * most || k == 0 || k == N_ENERGY - 1) {
            line[n_line] = (clast_series){.kind = CLAST_SERIES_LINE,
                                          .label = energy_kind[k][0],
                                          .x = clast_table_numbers(load, "time_s"),
                                          .y = y + k * n,
                                          .n = n,
                                          .colour = n_line % 8,
                                          .dashed = n_line >= 8};
            ++n_line;
        } else {
            for (int64_t i = 0; i < n; ++i) {
                rest[i] += y[k * n + i];
            }
        }
    }
    return n_line;
}

static clast_status draw_energy_book(const char *path, const clast_table *load)
{
    clast_status status = CLAST_OK;
    double *y = NULL;
    clast_series line[N_ENERGY];
    CLX_TRY(clx_alloc(&y, N_ENERGY * load->n_row, sizeof *y));
    const clast_chart chart = {.title = "Energy by kind",
                               .x = {.label = "time (s)"},
                               .y = {.label = "energy (J)"},
                               .series = line,
                               .n_series = gather_energy(load, y, line),
                               .width = 600.0,
                               .height = 420.0};
    CLX_TRY(clast_chart_write(&chart, path));
done:
    clx_free(y);
    return status;
}

/// load.csv, and what it shows: stresses of a cell, energy by kind where it is booked.
static clast_status write_load(const char *folder, const clast_pack *pack)
{
    static const char *const stress[4][2] = {{"stress_xx_Pa", "xx"},
                                             {"stress_yy_Pa", "yy"},
                                             {"stress_zz_Pa", "zz"},
                                             {"stress_xz_Pa", "xz"}};
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    const clast_table *load = clast_pack_load_table(pack);
    if (load == NULL) {
        return CLAST_OK;
    }
    CLX_TRY(clx_run_write_table(folder, "load.csv", load));
    if (load->n_row > 1 && clast_table_numbers(load, stress[0][0]) != NULL) {
        CLX_TRY(clx_path_join(path, folder, "load.svg"));
        CLX_TRY(draw_lines(path, load, "Stress, pressure above 0", "stress (Pa)", 4, stress));
    }
    if (load->n_row > 1 && clast_table_numbers(load, energy_kind[0][1]) != NULL) {
        CLX_TRY(clx_path_join(path, folder, "energy_book.svg"));
        CLX_TRY(draw_energy_book(path, load));
    }
done:
    return status;
}

/// Vertical forces of grains on walls over time.
static clast_status draw_walls(const char *folder, const clast_table *walls)
{
    static const char ending[] = "_force_z_N";
    enum { MOST = 8, NAME = 48 };
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    char label[MOST][NAME];
    const char *name[MOST][2];
    char title[2 * NAME];
    int n = 0;
    int n_wall = 0;
    for (int32_t c = 0; c < walls->n_column; ++c) {
        const char *column = walls->column[c].name;
        const size_t length = strlen(column);
        const size_t tail = sizeof ending - 1;
        if (length <= tail || strcmp(column + length - tail, ending) != 0) {
            continue;
        }
        if (n_wall++ < MOST) {
            (void)snprintf(label[n], NAME, "%.*s", (int)(length - tail), column);
            name[n][0] = column;
            name[n][1] = label[n];
            ++n;
        }
    }
    if (n > 0) {
        (void)snprintf(title, sizeof title, "Vertical force of grains on walls");
        if (n < n_wall) {
            (void)snprintf(title, sizeof title,
                           "Vertical force of grains on walls (the first %d of %d)", n, n_wall);
        }
        CLX_TRY(clx_path_join(path, folder, "walls.svg"));
        CLX_TRY(draw_lines(path, walls, title, "force (N)", n, (const char *const(*)[2])name));
    }
done:
    return status;
}

/// walls.csv, and the mass inside over time where grains leave.
static clast_status write_walls(const char *folder, const clast_pack *pack)
{
    static const char *const mass[2][2] = {{"mass_kg", "inside"}, {"mass_left_kg", "left"}};
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    const clast_table *walls = clast_pack_wall_table(pack);
    if (walls == NULL) {
        return CLAST_OK;
    }
    CLX_TRY(clx_run_write_table(folder, "walls.csv", walls));
    if (walls->n_row > 1) {
        CLX_TRY(draw_walls(folder, walls));
    }
    if (walls->n_row > 1 && clast_table_numbers(walls, "mass_left_kg")[walls->n_row - 1] > 0.0) {
        CLX_TRY(clx_path_join(path, folder, "outflow.svg"));
        CLX_TRY(draw_lines(path, walls, "Grains that leave", "mass (kg)", 2, mass));
    }
done:
    return status;
}

static clast_status write_achieved(const char *folder, const clast_pack *pack)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    clast_table achieved = {0};
    status = clast_pack_achieved(pack, &achieved);
    if (status == CLAST_E_USAGE) {
        return CLAST_OK; // sizes follow no sieve curve
    }
    if (status == CLAST_OK) {
        CLX_TRY(clx_run_write_table(folder, "achieved.csv", &achieved));
        CLX_TRY(clx_path_join(path, folder, "achieved.svg"));
        CLX_TRY(clast_chart_grading(&achieved, path));
    }
done:
    clast_table_free(&achieved);
    return status;
}

/// Where grain i is and how it is turned, in columns `first` on.
static void write_pose(const clast_assembly *a, int32_t i, clast_table *table, int32_t first)
{
    CLAST_ASSERT(i >= 0 && i < a->n_grain);
    for (int k = 0; k < 3; ++k) {
        table->column[first + k].number[i] = a->position[i][k];
    }
    for (int k = 0; k < 4; ++k) {
        table->column[first + 3 + k].number[i] = a->orientation[i][k];
    }
}

/// A row a grain: its shape, form, size and density, as `clast fit --grains` and `clast shape` read
/// them, then its pose.
static clast_status write_grains(const char *folder, const clast_pack *pack)
{
    static const char *const column[][2] = {{"flatness", "-"},
                                            {"elongation", "-"},
                                            {"sieve_size_m", "m"},
                                            {"density_kg/m^3", "kg/m^3"},
                                            {"x_m", "m"},
                                            {"y_m", "m"},
                                            {"z_m", "m"},
                                            {"qw", "-"},
                                            {"qx", "-"},
                                            {"qy", "-"},
                                            {"qz", "-"}};
    clast_status status = CLAST_OK;
    clast_assembly a = {0};
    clast_table table = {0};
    double *flatness = NULL;
    double *elongation = NULL;
    double *size = NULL;
    double *density = NULL;
    CLX_TRY(clast_dem_assembly(clast_pack_dem(pack), &a));
    CLX_TRY(clast_table_init(&table, "grains", a.n_grain));
    CLX_TRY(clast_table_add_text(&table, "shape"));
    CLX_TRY(CLX_ADD_COLUMNS(&table, column));
    flatness = clast_table_numbers(&table, "flatness");
    elongation = clast_table_numbers(&table, "elongation");
    size = clast_table_numbers(&table, "sieve_size_m");
    density = clast_table_numbers(&table, "density_kg/m^3");
    for (int32_t i = 0; i < a.n_grain; ++i) {
        const clast_shape *shape = &a.shape[a.shape_id[i]];
        const double *s = shape->semi_axes; // a >= b >= c
        CLX_TRY(clast_table_set_text(&table, 0, i, shape->name));
        flatness[i] = s[2] / s[1];
        elongation[i] = s[1] / s[0];
        density[i] = a.density[i];
        write_pose(&a, i, &table, 5);
        size[i] = clast_form_sieve_size(2.0 * a.scale[i] * s[1], 2.0 * a.scale[i] * s[2]);
    }
    CLX_TRY(clx_run_write_table(folder, "grains.csv", &table));
done:
    clast_table_free(&table);
    clast_assembly_free(&a);
    return status;
}

static clast_status write_summary(const char *folder, const clast_pack_result *result)
{
    char *text = NULL;
    const clast_status made = clast_pack_result_json(result, false, &text);
    return clx_run_write_summary(folder, made, text);
}

/// The bed as it is, and how it came there.
static clast_status write_bed(const char *folder, const char *config, clast_pack *pack)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    CLX_TRY(clx_path_join(path, folder, "state.h5"));
    CLX_TRY(clx_pack_state_write(path, config, pack));
    CLX_TRY(clx_run_write_table(folder, "series.csv", clast_pack_series(pack)));
    CLX_TRY(draw_energy(folder, clast_pack_series(pack)));
    CLX_TRY(write_load(folder, pack));
    CLX_TRY(write_walls(folder, pack));
done:
    return status;
}

clast_status clx_pack_write_end(const char *folder, const char *config, clast_pack *pack)
{
    clast_status status = CLAST_OK;
    CLX_TRY(write_bed(folder, config, pack));
    CLX_TRY(clx_checkpoint_clear(folder));
done:
    return status;
}

clast_status clx_pack_write_results(const char *folder, const char *config, clast_pack *pack,
                                    const clast_pack_config *physics,
                                    const clast_pack_result *result)
{
    clast_status status = CLAST_OK;
    CLX_TRY(write_bed(folder, config, pack));
    if (result->dem.n_grain > 0 && physics->dem.domain == CLAST_DEM_CELL) {
        CLX_TRY(write_achieved(folder, pack));
        CLX_TRY(write_grains(folder, pack));
    } else if (result->dem.n_grain > 0) {
        CLX_TRY(write_profile(folder, pack, physics, result));
        CLX_TRY(write_achieved(folder, pack));
        CLX_TRY(write_grains(folder, pack));
    }
    CLX_TRY(write_summary(folder, result));
    CLX_TRY(clx_checkpoint_clear(folder));
done:
    return status;
}

clast_status clx_pack_write_frame(const char *folder, int64_t index, const clast_pack *pack)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    clast_assembly a = {0};
    const clast_export_options options = {.format = CLAST_EXPORT_VTU, .level = 1};
    CLX_TRY(clx_frame_path(folder, index, path));
    CLX_TRY(clast_dem_assembly(clast_pack_dem(pack), &a));
    CLX_TRY(clast_assembly_write(&a, path, &options, NULL));
done:
    clast_assembly_free(&a);
    return status;
}

clast_status clx_pack_write_collection(const char *folder, int64_t last, double interval,
                                       int64_t *n_frame)
{
    clast_status status = CLAST_OK;
    double *time = NULL;
    CLX_TRY(clx_alloc(&time, last, sizeof *time));
    for (int64_t k = 0; k < last; ++k) {
        time[k] = (double)(k + 1) * interval;
    }
    CLX_TRY(clx_frames_collect(folder, 1, last, time, n_frame));
done:
    clx_free(time);
    return status;
}
