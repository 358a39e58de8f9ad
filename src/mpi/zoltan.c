// Partitions by Zoltan: recursive coordinate bisection and Hilbert's space-filling curve.
//                                                                                  [Boman2012]
#include "mpi/zoltan.h"

#ifdef CLAST_HAVE_ZOLTAN
#include <zoltan.h>

typedef struct {
    int64_t n;
    const clast_site *site;
} sites;

static int count(void *data, int *error)
{
    const sites *s = data;
    *error = ZOLTAN_OK;
    return (int)s->n;
}

// NOLINTBEGIN(readability-non-const-parameter,readability-function-size): Zoltan's callbacks

static void list(void *data, int n_global, int n_local, ZOLTAN_ID_PTR global, ZOLTAN_ID_PTR local,
                 int n_weight, float *weight, int *error)
{
    const sites *s = data;
    (void)n_global;
    (void)n_local;
    (void)n_weight;
    for (int64_t i = 0; i < s->n; ++i) {
        global[i] = (ZOLTAN_ID_TYPE)s->site[i].number;
        local[i] = (ZOLTAN_ID_TYPE)i;
        weight[i] = (float)s->site[i].cost;
    }
    *error = ZOLTAN_OK;
}

static int dimension(void *data, int *error)
{
    (void)data;
    *error = ZOLTAN_OK;
    return 3;
}

static void places(void *data, int n_global, int n_local, int n, ZOLTAN_ID_PTR global,
                   ZOLTAN_ID_PTR local, int n_dimension, double *x, int *error)
{
    const sites *s = data;
    (void)n_global;
    (void)n_local;
    (void)global;
    (void)n_dimension;
    for (int i = 0; i < n; ++i) {
        for (int c = 0; c < 3; ++c) {
            x[3 * i + c] = s->site[local[i]].position[c];
        }
    }
    *error = ZOLTAN_OK;
}

// NOLINTEND(readability-non-const-parameter,readability-function-size)

static bool configure(struct Zoltan_Struct *z, const char *method, sites *s)
{
    // the level first: at its usual one the method is printed on stdout
    const char *const parameter[][2] = {{"DEBUG_LEVEL", "0"},     {"LB_METHOD", method},
                                        {"NUM_GID_ENTRIES", "1"}, {"NUM_LID_ENTRIES", "1"},
                                        {"OBJ_WEIGHT_DIM", "1"},  {"RETURN_LISTS", "PARTS"}};
    bool is_fine = true;
    for (size_t k = 0; k < sizeof parameter / sizeof parameter[0]; ++k) {
        is_fine = is_fine && Zoltan_Set_Param(z, parameter[k][0], parameter[k][1]) == ZOLTAN_OK;
    }
    return is_fine && Zoltan_Set_Num_Obj_Fn(z, count, s) == ZOLTAN_OK &&
           Zoltan_Set_Obj_List_Fn(z, list, s) == ZOLTAN_OK &&
           Zoltan_Set_Num_Geom_Fn(z, dimension, s) == ZOLTAN_OK &&
           Zoltan_Set_Geom_Multi_Fn(z, places, s) == ZOLTAN_OK;
}

bool clx_zoltan_partition(MPI_Comm comm, const char *method, int64_t n, const clast_site *site,
                          int32_t *rank)
{
    sites s = {n, site};
    float version = 0.0F;
    int has_changed = 0;
    int n_entry[2] = {0, 0};
    int n_in = 0;
    int n_out = 0;
    ZOLTAN_ID_PTR id[4] = {NULL, NULL, NULL, NULL};
    int *process[2] = {NULL, NULL};
    int *part[2] = {NULL, NULL};
    if (n > INT32_MAX || Zoltan_Initialize(0, NULL, &version) != ZOLTAN_OK) {
        return false;
    }
    struct Zoltan_Struct *z = Zoltan_Create(comm);
    const bool is_fine = z != NULL && configure(z, method, &s) &&
                         Zoltan_LB_Partition(z, &has_changed, &n_entry[0], &n_entry[1], &n_in,
                                             &id[0], &id[1], &process[0], &part[0], &n_out, &id[2],
                                             &id[3], &process[1], &part[1]) <= ZOLTAN_WARN &&
                         n_out == (int)n;
    for (int i = 0; is_fine && i < n_out; ++i) {
        rank[id[3][i]] = part[1][i];
    }
    (void)Zoltan_LB_Free_Part(&id[0], &id[1], &process[0], &part[0]);
    (void)Zoltan_LB_Free_Part(&id[2], &id[3], &process[1], &part[1]);
    Zoltan_Destroy(&z);
    return is_fine;
}

bool clx_zoltan_is_there(void)
{
    return true;
}

#else

// NOLINTBEGIN(misc-unused-parameters)
bool clx_zoltan_partition(MPI_Comm comm, const char *method, int64_t n, const clast_site *site,
                          int32_t *rank)
{
    (void)comm;
    (void)method;
    (void)n;
    (void)site;
    (void)rank;
    return false;
}
// NOLINTEND(misc-unused-parameters)

bool clx_zoltan_is_there(void)
{
    return false;
}

#endif
