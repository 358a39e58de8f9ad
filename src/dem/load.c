// What a bed carries: stress, fabric, coordination and forces of contacts, at a moment.
//
// Contacts are worked out afresh where the grains are now, whole grains by the SIMD lanes of a
// step, block by block, and summed in the order of the list: the same bytes whatever the threads.
// [docs/theory/load.md]
#include "dem/load.h"

#include "base/alloc.h"
#include "dem/cell.h"
#include "dem/pair_force.h"
#include "dem/ranks.h"
#include <clast/machine.h>
#include <clast/status.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCK = 1024 };

/// A contact's force of a on b, branch from a's centre to b's, and the slope of its normal force.
typedef struct {
    int32_t a, b; ///< a -1: no contact; b -1: a wall
    bool is_first;
    double force[3], branch[3], normal[3];
    double stiffness;
} contact;

/// Pairs that touched in the last step, where they are up to date, and their contacts.
typedef struct {
    const clast_dem *dem;
    const clx_dem_pair **pair; ///< [n]
    contact *row;              ///< [n]
    int64_t n;
} work;

/// From copies, so that its history stays.
static void measure_pair(const clast_dem *dem, const clx_dem_pair *pair, contact *out)
{
    clx_dem_pair copy = *pair;
    const clx_contact_history *own = clx_pair_history(dem, pair);
    clx_contact_history history = own != NULL ? *own : (clx_contact_history){0};
    clx_dem_touch t;
    clx_force_torque on_a = {0};
    clx_force_torque on_b = {0};
    clx_meeting m;
    *out = (contact){.a = -1};
    if (!clx_pair_holds(dem, pair, &t)) {
        return;
    }
    clx_add_pair_force(dem, &copy, &history, &t, &on_a, &on_b);
    clx_meet_pair(dem, pair, &history, &t, &m);
    const double share =
        dem->config.clump_contacts == CLAST_DEM_SHARED ? 1.0 / clx_sub_contacts(dem, pair) : 1.0;
    out->a = clx_item_grain(dem, pair->a);
    out->b = pair->b >= 0 ? clx_item_grain(dem, pair->b) : -1;
    out->is_first = clx_is_first_contact(dem, pair);
    out->stiffness = share * clx_law_stiffness(clx_pair_law(dem, pair), &m);
    v3_scale(out->force, share, on_b.force);
    v3_copy(out->normal, t.normal);
    v3_copy(out->branch, t.arm_a);
    if (pair->b >= 0) {
        v3_sub(out->branch, t.arm_a, t.arm_b);
    }
}

static void measure_block(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const work *w = context;
    (void)worker;
    for (int64_t k = begin; k < end; ++k) {
        measure_pair(w->dem, w->pair[k], &w->row[k]);
    }
}

/// A contact that lanes found again.
static void take_contact(const clast_dem *dem, const clx_dem_pair *pair,
                         const clx_pair_force *force, const clx_dem_touch *t, contact *out)
{
    clx_meeting m;
    clx_contact_history none = {0};
    *out = (contact){
        .a = pair->touches != 0 ? pair->a : -1, .b = pair->b >= 0 ? pair->b : -1, .is_first = true};
    if (out->a < 0) {
        return;
    }
    clx_meet_pair(dem, pair, &none, t, &m);
    out->stiffness = clx_law_stiffness(&dem->law, &m);
    v3_copy(out->force, force->force);
    v3_copy(out->normal, t->normal);
    v3_copy(out->branch, t->arm_a);
    if (pair->b >= 0) {
        v3_sub(out->branch, t->arm_a, t->arm_b);
    }
}

/// The same bits by the lanes of a step, from copies of pairs and warm starts.
static void measure_lanes(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const work *w = context;
    const clast_dem *dem = w->dem;
    clx_packed_pair packed[CLX_MOST_AGAIN + CLX_PREFETCH_PAIRS];
    clx_pair_force force[CLX_MOST_AGAIN];
    clx_dem_touch touch[CLX_MOST_AGAIN];
    (void)worker;
    for (int64_t k = begin; k < end; ++k) {
        const clx_dem_pair *pair = w->pair[k];
        clx_packed_pair *to = &packed[k - begin];
        if (dem->inner.is_packed) {
            *to = *(const clx_packed_pair *)(const void *)pair;
            continue;
        }
        to->pair = *pair;
        if (pair->slot != 0) {
            to->warm_start = dem->list.warm_start[pair->slot].record;
        }
    }
    clx_contacts_again(dem, (int32_t)(end - begin), packed, force, touch);
    for (int64_t k = begin; k < end; ++k) {
        take_contact(dem, &packed[k - begin].pair, &force[k - begin], &touch[k - begin],
                     &w->row[k]);
    }
}

bool clx_dem_stress_is_fast(const clast_dem *dem)
{
    return dem->item == NULL && dem->container == NULL && dem->laws.n == 0 && !dem->law.has_history;
}

/// Pairs that touched in the last step, in the order of the list: the inner list has them all. A
/// rank's: those whose first grain it moves.
static clast_status list_touching(work *w)
{
    clast_status status = CLAST_OK;
    const clast_dem *dem = w->dem;
    const bool is_packed = dem->inner.is_packed;
    const int64_t n = is_packed ? dem->inner.n : dem->list.n_pair;
    CLX_TRY(clx_alloc(&w->pair, n, sizeof(*w->pair)));
    for (int64_t k = 0; k < n; ++k) {
        const clx_dem_pair *pair = is_packed ? &dem->inner.packed[k].pair : &dem->list.pair[k];
        w->pair[w->n] = pair;
        w->n += pair->touches != 0 && !clx_are_ghosts(dem, pair->a, pair->a);
    }
done:
    return status;
}

/// Contacts of all ranks, by the whole's numbers, in the order of its list: each rank has those of
/// its own grains in that order.
static clast_status share_rows(const clx_ranks *r, clast_status status, contact **row, int64_t *n)
{
    clx_gathered all = {0};
    contact *sorted = NULL;
    int64_t *next = NULL;
    CLX_TRY(clast_comm_agree(r->comm, status, NULL));
    for (int64_t k = 0; k < *n; ++k) {
        contact *c = &(*row)[k];
        c->a = r->number[c->a];
        c->b = c->b >= 0 ? r->number[c->b] : -1;
    }
    CLX_TRY(clx_comm_share(r->comm, *row, *n * (int64_t)sizeof **row, &all));
    const contact *from = (const contact *)(const void *)all.bytes;
    const int64_t m = all.n / (int64_t)sizeof *from;
    status = clx_alloc(&sorted, m, sizeof *sorted);
    status = status == CLAST_OK ? clx_alloc(&next, r->n_synced + 2, sizeof *next) : status;
    CLX_TRY(clast_comm_agree(r->comm, status, NULL));
    CLAST_ASSERT(next != NULL && (sorted != NULL || m == 0)); // for the analyzer
    for (int64_t k = 0; k < m; ++k) {
        ++next[from[k].a + 1];
    }
    for (int32_t i = 0; i < r->n_synced; ++i) {
        next[i + 1] += next[i];
    }
    for (int64_t k = 0; k < m; ++k) {
        sorted[next[from[k].a]++] = from[k];
    }
    clx_free(*row);
    *row = sorted;
    *n = m;
    sorted = NULL;
done:
    CLX_FREE(sorted, next);
    clx_gathered_free(&all);
    return status;
}

/// All contacts, in the order of the list.
static clast_status find(const clast_dem *dem, contact **row, int64_t *n)
{
    clast_status status = CLAST_OK;
    work w = {.dem = dem};
    CLX_TRY(list_touching(&w));
    CLX_TRY(clx_alloc(&w.row, w.n, sizeof *w.row));
    if (clx_dem_stress_is_fast(dem)) {
        clx_dem_for(dem, w.n, CLX_MOST_AGAIN, measure_lanes, &w);
    } else {
        clx_dem_for(dem, w.n, BLOCK, measure_block, &w);
    }
    *n = 0;
    for (int64_t k = 0; k < w.n; ++k) {
        if (w.row[k].a >= 0) {
            w.row[(*n)++] = w.row[k];
        }
    }
    *row = w.row;
    w.row = NULL;
done:
    CLX_FREE(w.pair, w.row);
    return status;
}

static const int ENTRY[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};

/// Sums of force times branch, of normals, and of k l^2 n^4, which is the modulus of even strain.
static void sum_contacts(int64_t n, const contact *row, clast_dem_load *load)
{
    for (int64_t k = 0; k < n; ++k) {
        const contact *c = &row[k];
        for (int e = 0; e < 6; ++e) {
            const int i = ENTRY[e][0];
            const int j = ENTRY[e][1];
            load->stress[e] += 0.5 * (c->force[i] * c->branch[j] + c->force[j] * c->branch[i]);
            load->fabric[e] += c->b >= 0 ? c->normal[i] * c->normal[j] : 0.0;
        }
        for (int i = 0; i < 3; ++i) {
            const double along = c->branch[i] * c->normal[i];
            load->modulus[i] += c->stiffness * along * along;
        }
        load->shear_modulus += c->stiffness * c->branch[2] * c->branch[2];
        load->n_contact += c->is_first && c->b >= 0 ? 1 : 0;
        load->n_force += c->b >= 0 ? 1 : 0;
    }
}

/// Stress of velocities beside the cell's even motion and the mean.
static void sum_motion(const clast_dem *dem, clast_dem_load *load)
{
    double mass = 0.0;
    double mean[3] = {0.0, 0.0, 0.0};
    for (int pass = 0; pass < 2; ++pass) {
        for (int32_t i = 0; i < dem->n_grain; ++i) {
            const clx_grain *g = &dem->grain[i];
            double v[3] = {0.0, 0.0, 0.0};
            if (dem->cell != NULL) {
                clx_cell_affine(dem->cell, g->position, v);
            }
            v3_sub(v, g->velocity, v);
            if (pass == 0) {
                mass += g->mass;
                v3_axpy(mean, mean, g->mass, v);
                continue;
            }
            v3_axpy(v, v, -1.0 / mass, mean);
            for (int e = 0; e < 6; ++e) {
                load->kinetic_stress[e] += g->mass * v[ENTRY[e][0]] * v[ENTRY[e][1]];
            }
        }
    }
}

/// Mean force on a grain over the mean force of a contact.
static clast_status measure_balance(const clast_dem *dem, int64_t n, const contact *row,
                                    clast_dem_load *load)
{
    clast_status status = CLAST_OK;
    double(*net)[3] = NULL;
    double sum = 0.0;
    CLX_TRY(clx_alloc(&net, dem->n_grain, sizeof *net));
    for (int64_t k = 0; k < n; ++k) {
        v3_sub(net[row[k].a], net[row[k].a], row[k].force);
        if (row[k].b >= 0) {
            v3_add(net[row[k].b], net[row[k].b], row[k].force);
        }
        load->force_mean += v3_norm(row[k].force);
    }
    load->force_mean = n > 0 ? load->force_mean / (double)n : 0.0;
    for (int32_t i = 0; i < dem->n_grain; ++i) {
        net[i][2] -= dem->config.gravity *
                     (dem->grain[i].mass - dem->config.fluid_density * dem->motion[i].volume);
        sum += v3_norm(net[i]);
    }
    load->unbalanced = load->force_mean > 0.0 ? sum / (double)dem->n_grain / load->force_mean : 0.0;
done:
    clx_free(net);
    return status;
}

/// Grains with too few contacts, their contacts left out, until none is left.
static clast_status count_rattlers(const clast_dem *dem, int64_t n, const contact *row,
                                   clast_dem_load *load)
{
    clast_status status = CLAST_OK;
    int32_t *count = NULL;
    bool *is_out = NULL;
    bool goes_on = true;
    const int32_t least = clx_grains_rub(dem) ? 2 : 4;
    int64_t held = 0;
    CLX_TRY(clx_alloc(&count, dem->n_grain, sizeof *count));
    CLX_TRY(clx_alloc(&is_out, dem->n_grain, sizeof *is_out));
    while (goes_on) {
        goes_on = false;
        held = 0;
        memset(count, 0, (size_t)dem->n_grain * sizeof *count);
        for (int64_t k = 0; k < n; ++k) {
            const contact *c = &row[k];
            if (!c->is_first || is_out[c->a] || (c->b >= 0 && is_out[c->b])) {
                continue;
            }
            ++count[c->a];
            if (c->b >= 0) {
                ++count[c->b];
                ++held;
            }
        }
        for (int32_t i = 0; i < dem->n_grain; ++i) {
            if (!is_out[i] && count[i] < least) {
                is_out[i] = goes_on = true;
                ++load->n_rattler;
            }
        }
    }
    const int32_t left = dem->n_grain - load->n_rattler;
    load->coordination_held = left > 0 ? 2.0 * (double)held / left : 0.0;
done:
    CLX_FREE(count, is_out);
    return status;
}

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return x < y ? -1 : x > y ? 1 : 0;
}

/// Shares of the forces between grains below which half, nine tenths, 99 % of them lie.
static clast_status measure_forces(int64_t n, const contact *row, clast_dem_load *load)
{
    static const double share[3] = {0.5, 0.9, 0.99};
    clast_status status = CLAST_OK;
    double *size = NULL;
    int64_t m = 0;
    CLX_TRY(clx_alloc(&size, n + 1, sizeof *size));
    for (int64_t k = 0; k < n; ++k) {
        if (row[k].b >= 0) {
            size[m++] = v3_norm(row[k].force);
        }
    }
    qsort(size, (size_t)m, sizeof *size, by_size);
    for (int s = 0; s < 3 && m > 0; ++s) {
        load->force_below[s] = size[(int64_t)(share[s] * (double)(m - 1))];
    }
done:
    clx_free(size);
    return status;
}

static void measure_volume(const clast_dem *dem, clast_dem_load *load)
{
    const double *side = dem->cell->side;
    load->volume = side[0] * side[1] * side[2];
    for (int32_t i = 0; i < dem->n_grain; ++i) {
        load->solid += dem->motion[i].volume;
    }
    for (int e = 0; e < 6; ++e) {
        load->stress[e] /= load->volume;
        load->kinetic_stress[e] /= load->volume;
    }
    for (int i = 0; i < 3; ++i) {
        load->modulus[i] /= load->volume;
    }
    load->shear_modulus /= load->volume;
}

/// Without counts and orders, and what is unbalanced, unless they are asked for.
static clast_status measure_load(const clast_dem *dem, bool is_whole, bool is_balanced,
                                 clast_dem_load *load)
{
    clast_status status = CLAST_OK;
    const clx_ranks *r =
        is_whole || dem->ranks == NULL || !dem->ranks->has_begun ? NULL : dem->ranks;
    contact *row = NULL;
    int64_t n = 0;
    clast_dem_load made = {0};
    status = find(r != NULL ? r->local : dem, &row, &n);
    CLX_TRY(r != NULL ? share_rows(r, status, &row, &n) : status);
    sum_contacts(n, row, &made);
    sum_motion(dem, &made);
    if (is_balanced) {
        status = measure_balance(dem, n, row, &made);
        CLX_TRY(r != NULL ? clast_comm_agree(r->comm, status, NULL) : status);
    }
    if (is_whole) {
        CLX_TRY(count_rattlers(dem, n, row, &made));
        CLX_TRY(measure_forces(n, row, &made));
    }
    for (int e = 0; e < 6 && made.n_force > 0; ++e) {
        made.fabric[e] /= (double)made.n_force;
    }
    made.coordination = dem->n_grain > 0 ? 2.0 * (double)made.n_contact / dem->n_grain : 0.0;
    if (dem->cell != NULL) {
        measure_volume(dem, &made);
    } else { // the bed's volume is not known here
        memset(made.stress, 0, sizeof made.stress);
        memset(made.kinetic_stress, 0, sizeof made.kinetic_stress);
        memset(made.modulus, 0, sizeof made.modulus);
        made.shear_modulus = 0.0;
    }
    *load = made;
done:
    clx_free(row);
    return status;
}

clast_status clx_dem_stress(const clast_dem *dem, bool is_balanced, clast_dem_load *load)
{
    return measure_load(dem, false, is_balanced, load);
}

clast_status clast_dem_load_measure(const clast_dem *dem, clast_dem_load *load)
{
    CLX_ARGUMENTS(dem, load);
    return measure_load(dem, true, true, load);
}
