// Force chains of a bed: contacts as lines between grains, and which of them carry it.
//
// A grain's stress is sum f r / V over its contacts, r from its centre to the contact. Grains whose
// greatest pressure is above the mean of all are stressed; two of them that touch are linked where
// the branch lies within 45 degrees of both directions of greatest pressure; three or more that are
// linked are a chain [Peters2005]. [docs/theory/load.md "Force chains"]
#include <clast/porosity.h>

#include "assembly/whole.h"
#include "base/alloc.h"
#include "base/status.h"
#include "geom/union_find.h"
#include "math/sym3.h"
#include "math/vec3.h"
#include "porosity/contact_columns.h"
#include "porosity/whole.h"
#include <clast/assembly.h>
#include <clast/shape.h>
#include <math.h>

/// Cosine of the angle within which a chain goes on.
static const double STRAIGHT = 0.70710678118654752440;

enum { LEAST_GRAINS = 3 };

typedef struct {
    double stress[3][3];
    double axis[3];  ///< of greatest pressure
    double pressure; ///< along it
} grain;

typedef struct {
    const clast_assembly *assembly;
    clx_contacts c;
    double period[3];
    double shift;       ///< along x of the images above
    grain *grain;       ///< [n_grain]
    int32_t *chain_of;  ///< [n_grain] set of linked grains, by its smallest member
    int32_t *n_in;      ///< [n_grain] grains of a set
    bool *is_linked;    ///< [n contact]
    double *force_norm; ///< [n contact]
} bed_chains;

static clast_status check_contacts(const clx_contacts *c, int32_t n_grain)
{
    clast_status status = CLAST_OK;
    for (int64_t k = 0; k < c->n; ++k) {
        CLX_CHECK(c->a[k] >= 0.0 && c->a[k] < n_grain && c->b[k] >= -1.0 && c->b[k] < n_grain,
                  CLAST_E_FORMAT, "contact %lld is one of grains %g and %g of %d", (long long)k + 1,
                  c->a[k], c->b[k], n_grain);
        for (int i = 0; i < 3; ++i) {
            CLX_CHECK(isfinite(c->force[i][k]) && isfinite(c->branch[i][k]) &&
                          isfinite(c->point[i][k]),
                      CLAST_E_FORMAT, "contact %lld has no finite force, branch and point",
                      (long long)k + 1);
        }
    }
done:
    return status;
}

/// Adds f r: the force on the grain, pressing inwards where the contact lies, is pressure.
static void add_arm(grain *g, const double force[3], const double arm[3])
{
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            g->stress[i][j] += 0.5 * (force[i] * arm[j] + force[j] * arm[i]);
        }
    }
}

static void add_contact(bed_chains *b, int64_t k)
{
    const clx_contacts *c = &b->c;
    const int32_t first = (int32_t)c->a[k];
    double arm[3];
    double force[3];
    double along = 0.0;
    for (int i = 2; i >= 0; --i) { // z first: it moves a sheared bed's images along x
        const double separation =
            c->point[i][k] - b->assembly->position[first][i] - (i == 0 ? along : 0.0);
        const double image = b->period[i] > 0.0 ? floor(separation / b->period[i] + 0.5) : 0.0;
        arm[i] = separation - b->period[i] * image;
        along = i == 2 ? image * b->shift : along;
        force[i] = c->force[i][k];
    }
    b->force_norm[k] = v3_norm(force);
    add_arm(&b->grain[first], force, arm);
    if (c->b[k] >= 0.0) {
        for (int i = 0; i < 3; ++i) {
            arm[i] -= c->branch[i][k];
        }
        v3_scale(force, -1.0, force);
        add_arm(&b->grain[(int32_t)c->b[k]], force, arm);
    }
}

/// Principal pressures; their mean over all grains.
static double find_pressures(bed_chains *b)
{
    const clast_assembly *a = b->assembly;
    double sum = 0.0;
    for (int32_t i = 0; i < a->n_grain; ++i) {
        grain *g = &b->grain[i];
        double value[3];
        double vector[3][3];
        const double s = a->scale[i];
        clx_sym3_eigen(g->stress, value, vector);
        g->pressure = value[0] / (s * s * s * a->shape[a->shape_id[i]].volume);
        v3_copy(g->axis, vector[0]);
        sum += g->pressure;
    }
    return sum / a->n_grain;
}

static bool goes_on(const bed_chains *b, int64_t k, double mean)
{
    const clx_contacts *c = &b->c;
    if (c->b[k] < 0.0) {
        return false;
    }
    const grain *one = &b->grain[(int32_t)c->a[k]];
    const grain *other = &b->grain[(int32_t)c->b[k]];
    const double branch[3] = {c->branch[0][k], c->branch[1][k], c->branch[2][k]};
    const double least = STRAIGHT * v3_norm(branch);
    return one->pressure > mean && other->pressure > mean &&
           fabs(v3_dot(branch, one->axis)) >= least && fabs(v3_dot(branch, other->axis)) >= least;
}

static void link_grains(bed_chains *b, double mean)
{
    const int32_t n = b->assembly->n_grain;
    clx_sets_init(b->chain_of, n);
    for (int64_t k = 0; k < b->c.n; ++k) {
        b->is_linked[k] = goes_on(b, k, mean);
        if (b->is_linked[k]) {
            clx_sets_join(b->chain_of, (int32_t)b->c.a[k], (int32_t)b->c.b[k]);
        }
    }
    for (int32_t i = 0; i < n; ++i) {
        ++b->n_in[clx_sets_find(b->chain_of, i)];
    }
    int32_t n_chain = 0; // numbers from 1, by their smallest grain; 0: none
    for (int32_t i = 0; i < n; ++i) {
        const int32_t root = clx_sets_find(b->chain_of, i);
        if (root == i) {
            b->n_in[i] = b->n_in[i] >= LEAST_GRAINS ? ++n_chain : 0;
        }
    }
}

static clast_status make_table(bed_chains *b, clast_table *table)
{
    static const struct {
        const char *name, *unit;
    } columns[] = {
        {"a", "-"},           {"b", "-"},         {"x0_m", "m"},           {"y0_m", "m"},
        {"z0_m", "m"},        {"x1_m", "m"},      {"y1_m", "m"},           {"z1_m", "m"},
        {"force_x_N", "N"},   {"force_y_N", "N"}, {"force_z_N", "N"},      {"force_N", "N"},
        {"force_share", "-"}, {"chain", "-"},     {"pressure_a_Pa", "Pa"}, {"pressure_b_Pa", "Pa"}};
    enum { N_COLUMN = sizeof columns / sizeof columns[0] };
    clast_status status = CLAST_OK;
    clast_table made = {0};
    double mean = 0.0;
    const clx_contacts *c = &b->c;
    for (int64_t k = 0; k < c->n; ++k) {
        mean += b->force_norm[k] / (double)c->n;
    }
    CLX_TRY(clast_table_init(&made, "chains", c->n));
    for (int k = 0; k < N_COLUMN; ++k) {
        CLX_TRY(clast_table_add_number(&made, columns[k].name, columns[k].unit, NULL));
    }
    for (int64_t k = 0; k < c->n; ++k) {
        const int32_t first = (int32_t)c->a[k];
        const double *x = b->assembly->position[first];
        const int32_t chain = b->is_linked[k] ? b->n_in[clx_sets_find(b->chain_of, first)] : 0;
        const double value[N_COLUMN] = {c->a[k],
                                        c->b[k],
                                        x[0],
                                        x[1],
                                        x[2],
                                        x[0] + c->branch[0][k],
                                        x[1] + c->branch[1][k],
                                        x[2] + c->branch[2][k],
                                        c->force[0][k],
                                        c->force[1][k],
                                        c->force[2][k],
                                        b->force_norm[k],
                                        mean > 0.0 ? b->force_norm[k] / mean : 0.0,
                                        chain,
                                        b->grain[first].pressure,
                                        c->b[k] >= 0.0 ? b->grain[(int32_t)c->b[k]].pressure
                                                       : (double)NAN};
        for (int i = 0; i < N_COLUMN; ++i) {
            made.column[i].number[k] = value[i];
        }
    }
    *table = made;
    made = (clast_table){0};
done:
    clast_table_free(&made);
    return status;
}

clast_status clast_bed_chains(const clast_bed *bed, const clast_assembly *assembly,
                              const clast_table *contacts, clast_table *table)
{
    CLX_ARGUMENTS(bed, assembly, contacts, table);
    CLX_WHOLE(bed, bed);
    CLX_WHOLE(assembly, assembly);
    CLX_WHOLE(table, contacts);
    clast_status status = CLAST_OK;
    bed_chains b = {.assembly = assembly};
    const int32_t n = assembly->n_grain;
    (void)clast_bed_period(bed, b.period);
    b.shift = b.period[2] > 0.0 ? bed->shift : 0.0;
    CLX_TRY(clx_contacts_read(contacts, &b.c));
    CLX_TRY(check_contacts(&b.c, n));
    CLX_TRY(clx_alloc(&b.grain, n, sizeof *b.grain));
    CLX_TRY(clx_alloc(&b.chain_of, n, sizeof *b.chain_of));
    CLX_TRY(clx_alloc(&b.n_in, n, sizeof *b.n_in));
    CLX_TRY(clx_alloc(&b.is_linked, b.c.n, sizeof *b.is_linked));
    CLX_TRY(clx_alloc(&b.force_norm, b.c.n, sizeof *b.force_norm));
    for (int64_t k = 0; k < b.c.n; ++k) {
        add_contact(&b, k);
    }
    link_grains(&b, find_pressures(&b));
    CLX_TRY(make_table(&b, table));
done:
    CLX_FREE(b.grain, b.chain_of, b.n_in, b.is_linked, b.force_norm);
    return status;
}
