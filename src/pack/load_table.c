// load.csv: what the bed carries and where its energy goes, over time.
#include "pack/load.h"

#include "base/alloc.h"
#include "dem/ranks.h"
#include <math.h>
#include <stddef.h>

typedef struct {
    const char *name, *unit;
} column;

static const column first[] = {{"step", "-"}, {"time_s", "s"}};
static const column of_cell[] = {
    {"stage", "-"},         {"width_m", "m"},       {"depth_m", "m"},
    {"height_m", "m"},      {"strain_x", "-"},      {"strain_y", "-"},
    {"strain_z", "-"},      {"shear_strain", "-"},  {"porosity", "-"},
    {"stress_xx_Pa", "Pa"}, {"stress_yy_Pa", "Pa"}, {"stress_zz_Pa", "Pa"},
    {"stress_xy_Pa", "Pa"}, {"stress_xz_Pa", "Pa"}, {"stress_yz_Pa", "Pa"},
    {"pressure_Pa", "Pa"},  {"deviator_Pa", "Pa"},  {"kinetic_pressure_Pa", "Pa"}};
static const column of_contacts[] = {
    {"n_contact", "-"},         {"coordination", "-"},     {"n_rattler", "-"},
    {"coordination_held", "-"}, {"fabric_xx", "-"},        {"fabric_yy", "-"},
    {"fabric_zz", "-"},         {"fabric_xz", "-"},        {"unbalanced", "-"},
    {"force_mean_N", "N"},      {"force_below_50_N", "N"}, {"force_below_90_N", "N"},
    {"force_below_99_N", "N"}};
static const column of_energy[] = {
    {"energy_put_in_J", "J"},         {"energy_made_J", "J"},
    {"energy_gravity_J", "J"},        {"energy_shaking_J", "J"},
    {"energy_cell_J", "J"},           {"energy_walls_J", "J"},
    {"energy_translation_J", "J"},    {"energy_rotation_J", "J"},
    {"energy_normal_springs_J", "J"}, {"energy_tangential_springs_J", "J"},
    {"energy_attraction_J", "J"},     {"lost_damping_grains_J", "J"},
    {"lost_damping_walls_J", "J"},    {"lost_friction_grains_J", "J"},
    {"lost_friction_walls_J", "J"},   {"lost_rolling_grains_J", "J"},
    {"lost_rolling_walls_J", "J"},    {"lost_fluid_J", "J"},
    {"lost_calming_J", "J"},          {"lost_left_J", "J"},
    {"lost_scheme_J", "J"},           {"energy_rest_J", "J"}};
#define COUNT(a) ((int)(sizeof(a) / sizeof *(a)))
enum { MOST = 64 };

bool clx_pack_has_load(const clast_pack_config *config)
{
    return config->energy || config->dem.domain == CLAST_DEM_CELL;
}

static clast_status append_columns(clast_table *table, int n, const column *c)
{
    clast_status status = CLAST_OK;
    for (int k = 0; k < n; ++k) {
        CLX_TRY(clast_table_add_number(table, c[k].name, c[k].unit, NULL));
    }
done:
    return status;
}

clast_status clx_pack_load_table(clast_pack *p)
{
    clast_status status = CLAST_OK;
    const bool is_cell = p->config.dem.domain == CLAST_DEM_CELL;
    if (!clx_pack_has_load(&p->config)) {
        return CLAST_OK;
    }
    CLX_TRY(clast_table_init(&p->load.table, "load", 0));
    CLX_TRY(append_columns(&p->load.table, COUNT(first), first));
    CLX_TRY(append_columns(&p->load.table, is_cell ? COUNT(of_cell) : 0, of_cell));
    CLX_TRY(append_columns(&p->load.table, COUNT(of_contacts), of_contacts));
    CLX_TRY(append_columns(&p->load.table, p->config.energy ? COUNT(of_energy) : 0, of_energy));
done:
    return status;
}

static int write_cell(const clast_pack *p, const clast_dem_load *load, double *x)
{
    clast_dem_cell cell;
    double s[6];
    int n = 0;
    double square = 0.0;
    clast_dem_read_cell(p->dem, &cell);
    for (int e = 0; e < 6; ++e) {
        s[e] = load->stress[e] + load->kinetic_stress[e];
    }
    const double pressure = (s[0] + s[1] + s[2]) / 3.0;
    x[n++] = p->load.stage + 1;
    for (int k = 0; k < 3; ++k) {
        x[n + k] = cell.side[k];
        x[n + 3 + k] = cell.strain[k];
    }
    n += 6;
    x[n++] = cell.shear_strain;
    x[n++] = 1.0 - load->solid / load->volume;
    for (int e = 0; e < 6; ++e) {
        const double off = e < 3 ? s[e] - pressure : s[e];
        x[n++] = s[e];
        square += (e < 3 ? 1.0 : 2.0) * off * off;
    }
    x[n++] = pressure;
    x[n++] = sqrt(1.5 * square);
    x[n++] = (load->kinetic_stress[0] + load->kinetic_stress[1] + load->kinetic_stress[2]) / 3.0;
    return n;
}

static int write_contacts(const clast_dem_load *load, double *x)
{
    const double value[] = {(double)load->n_contact, load->coordination,   load->n_rattler,
                            load->coordination_held, load->fabric[0],      load->fabric[1],
                            load->fabric[2],         load->fabric[4],      load->unbalanced,
                            load->force_mean,        load->force_below[0], load->force_below[1],
                            load->force_below[2]};
    static_assert(COUNT(value) == COUNT(of_contacts), "a value a column");
    for (int k = 0; k < COUNT(value); ++k) {
        x[k] = value[k];
    }
    return COUNT(value);
}

static int write_energy(const clast_dem_energy *e, double *x)
{
    const double value[] = {
        e->put_in,     e->made,        e->gravity,    e->shaking,        e->cell,
        e->walls,      e->translation, e->rotation,   e->normal_springs, e->tangential_springs,
        e->attraction, e->damping[0],  e->damping[1], e->friction[0],    e->friction[1],
        e->rolling[0], e->rolling[1],  e->fluid,      e->calming,        e->left,
        e->scheme,     e->rest};
    static_assert(COUNT(value) == COUNT(of_energy), "a value a column");
    for (int k = 0; k < COUNT(value); ++k) {
        x[k] = value[k];
    }
    return COUNT(value);
}

clast_status clx_pack_load_row(clast_pack *p)
{
    clast_status status = CLAST_OK;
    clast_table *table = &p->load.table;
    const int64_t row = table->n_row;
    const double step = (double)clast_dem_n_step(p->dem);
    double x[MOST] = {step, clast_dem_time(p->dem)};
    int n = 2;
    clast_dem_load load;
    clast_dem_energy energy = {0};
    if (!clx_pack_has_load(&p->config) ||
        (row > 0 && clast_table_numbers(table, "step")[row - 1] >= step)) {
        return CLAST_OK;
    }
    CLX_TRY(clx_dem_gather_load(p->dem, &load, &energy));
    n += p->config.dem.domain == CLAST_DEM_CELL ? write_cell(p, &load, x + n) : 0;
    n += write_contacts(&load, x + n);
    n += p->config.energy ? write_energy(&energy, x + n) : 0;
    CLAST_ASSERT(n == table->n_column && n <= MOST);
    CLX_TRY(clast_table_resize(table, row + 1));
    for (int k = 0; k < n; ++k) {
        table->column[k].number[row] = x[k];
    }
done:
    return status;
}

const clast_table *clast_pack_load_table(const clast_pack *pack)
{
    return pack != NULL && clx_pack_has_load(&pack->config) ? &pack->load.table : NULL;
}
