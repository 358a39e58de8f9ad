// MPI: a solver's program decomposes its particles where its ranks have them, with a communicator
// of its own: however they are dealt, the cells and events of one process. Ends with 0, or the line
// of the check that failed.
#include <clast/decompose.h>
#include <clast/mpi.h>

#include <clast/cloud.h>
#include <clast/machine.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CHECK(condition)                                                                           \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            (void)fprintf(stderr, "test_decompose: line %d: %s (%s)\n", __LINE__, #condition,      \
                          clast_error_detail());                                                   \
            return __LINE__;                                                                       \
        }                                                                                          \
    } while (0)

enum { N = 3000, N_DEAL = 4 };

/// Particles denser towards one corner, and what they stand for.
static void fill(double *x, double *weight)
{
    uint64_t state = 1;
    for (int i = 0; i < 3 * N; ++i) {
        state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
        const double u = (double)(state >> 11) * 0x1p-53;
        x[i] = i / 3 % 2 == 0 ? u * u * u : u;
    }
    for (int i = 0; i < N; ++i) {
        weight[i] = 1.0 + i % 7 * (i % 11 == 0 ? 100.0 : 1.0);
    }
}

/// In turn, in stretches, all to the last rank, by place.
static int dealt_to(int deal, int i, const double *x, int n_rank)
{
    const int place = (int)(x[2] * n_rank);
    return deal == 0 ? i % n_rank : deal == 1 ? i * n_rank / N : deal == 2 ? n_rank - 1 : place;
}

static int compare(const clast_comm *comm, const clast_domain *domain, clast_cloud *whole, int deal)
{
    static double x[3 * N];
    static double weight[N];
    static int number[N];
    clast_decompose_config config;
    clast_decomposition alone = {0};
    clast_decomposition shared = {0};
    clast_cloud part = {.dimension = 3, .x = x, .weight = whole->weight != NULL ? weight : NULL};
    for (int i = 0; i < N; ++i) {
        if (dealt_to(deal, i, whole->x + (ptrdiff_t)3 * i, comm->n_rank) == comm->rank) {
            memcpy(x + 3 * part.n, whole->x + (ptrdiff_t)3 * i, 3 * sizeof *x);
            weight[part.n] = whole->weight != NULL ? whole->weight[i] : 1.0;
            number[part.n++] = i;
        }
    }
    CHECK(clast_fields_default(clast_decompose_fields, &config) == CLAST_OK);
    config.crossfit = whole->weight != NULL;
    CHECK(clast_decompose_in(domain, whole, &config, &alone) == CLAST_OK);
    CHECK(clast_decompose_ranks(comm, domain, &part, &config, &shared) == CLAST_OK);
    CHECK(shared.n == N && shared.n_here == part.n && shared.n_test == alone.n_test);
    CHECK(shared.cells.n == alone.cells.n && alone.cells.n > 8);
    CHECK(memcmp(&shared.events, &alone.events, 3 * sizeof(double)) == 0);
    CHECK(memcmp(&shared.events_cross, &alone.events_cross, sizeof(double)) == 0);
    CHECK(memcmp(shared.cells.events, alone.cells.events, (size_t)alone.cells.n * 8) == 0);
    CHECK(memcmp(shared.cells.weight, alone.cells.weight, (size_t)alone.cells.n * 8) == 0);
    for (int64_t i = 0; i < part.n; ++i) {
        CHECK(shared.cells.of_point[i] == alone.cells.of_point[number[i]]);
    }
    clast_decomposition_free(&alone);
    clast_decomposition_free(&shared);
    clast_fields_free(clast_decompose_fields, &config);
    return 0;
}

/// All ways of dealing, with weights and without.
static int particles_stay_where_they_are(const clast_comm *comm)
{
    static double x[3 * N];
    static double weight[N];
    clast_domain domain = {0};
    clast_cloud whole = {.n = N, .dimension = 3, .x = x};
    int line = 0;
    fill(x, weight);
    CHECK(clast_domain_parse("box:0,0,0,1,1,1", &domain) == CLAST_OK);
    for (int deal = 0; deal < 2 * N_DEAL && line == 0; ++deal) {
        whole.weight = deal < N_DEAL ? NULL : weight;
        line = compare(comm, &domain, &whole, deal % N_DEAL);
    }
    return line;
}

int main(int argc, char **argv)
{
    clast_comm comm = {0};
    MPI_Comm own;
    int rank = 0;
    int n = 0;
    (void)MPI_Init(&argc, &argv);
    (void)MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    (void)MPI_Comm_size(MPI_COMM_WORLD, &n);
    (void)MPI_Comm_split(MPI_COMM_WORLD, 0, n - rank, &own); // the other way round
    if (clast_mpi_create((int32_t)MPI_Comm_c2f(own), &comm) != CLAST_OK ||
        particles_stay_where_they_are(&comm) != 0) {
        (void)MPI_Abort(MPI_COMM_WORLD, 1);
    }
    clast_mpi_destroy(&comm);
    (void)MPI_Comm_free(&own);
    (void)MPI_Finalize();
    return 0;
}
