// MPI: a program of a user's, which has MPI already, gives its communicator to libclast_mpi and
// sees the same table as programs without MPI. Ends with 0, or the line of the check that failed.
#include <clast/mpi.h>

#include <clast/machine.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CHECK(condition)                                                                           \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            (void)fprintf(stderr, "test_comm: line %d: %s\n", __LINE__, #condition);               \
            return __LINE__;                                                                       \
        }                                                                                          \
    } while (0)

/// Each rank sends 200 numbered messages to every other; more than there are slots.
static int messages_keep_their_order(const clast_comm *comm)
{
    enum { EACH = 200 };
    int64_t next[64] = {0};
    int64_t word[CLAST_COMM_WORDS];
    int32_t from = 0;
    int64_t n_left = (int64_t)EACH * (comm->n_rank - 1);
    for (int64_t i = 0; i < EACH; ++i) {
        for (int32_t to = 0; to < comm->n_rank; ++to) {
            const int64_t mine[CLAST_COMM_WORDS] = {comm->rank, i, -i};
            if (to != comm->rank) {
                comm->send(comm->context, to, mine);
            }
        }
    }
    while (n_left > 0) {
        if (comm->take(comm->context, &from, word)) {
            CHECK(word[0] == from && word[1] == next[from] && word[2] == -word[1]);
            ++next[from];
            --n_left;
        }
    }
    return 0;
}

/// Rank k gives 300,000 k bytes.
static int pieces_come_in_order(const clast_comm *comm)
{
    int64_t count[64];
    int64_t total = 0;
    for (int32_t k = 0; k < comm->n_rank; ++k) {
        count[k] = INT64_C(300000) * k;
        total += count[k];
    }
    char *own = calloc((size_t)count[comm->rank] + 1, 1);
    char *all = calloc((size_t)total + 1, 1);
    CHECK(own != NULL && all != NULL);
    memset(own, 'a' + comm->rank, (size_t)count[comm->rank]);
    comm->gather(comm->context, own, count[comm->rank], count, all);
    const char *at = all;
    for (int32_t k = 0; comm->rank == 0 && k < comm->n_rank; ++k) {
        for (int64_t i = 0; i < count[k]; ++i, ++at) {
            CHECK(*at == 'a' + k);
        }
    }
    free(own);
    free(all);
    return 0;
}

static int integers_are_added(const clast_comm *comm)
{
    enum { MANY = 3000000 }; // more than one piece
    int64_t *value = calloc(MANY, sizeof *value);
    CHECK(value != NULL);
    for (int64_t i = 0; i < MANY; ++i) {
        value[i] = i * (comm->rank + 1) - (INT64_C(1) << 40);
    }
    comm->sum(comm->context, value, MANY);
    const int64_t n = comm->n_rank;
    for (int64_t i = 0; i < MANY; ++i) {
        CHECK(value[i] == i * n * (n + 1) / 2 - n * (INT64_C(1) << 40));
    }
    free(value);
    return 0;
}

/// Rank k sends 1000 (k + 1) (to + 1) bytes of its letter, none to itself where k is odd.
static int bytes_are_exchanged(const clast_comm *comm)
{
    int64_t n_out[64];
    int64_t n_in[64];
    int64_t sum[2] = {0, 0};
    for (int32_t k = 0; k < comm->n_rank; ++k) {
        const bool is_none = k == comm->rank && k % 2 == 1;
        n_out[k] = is_none ? 0 : INT64_C(1000) * (comm->rank + 1) * (k + 1);
        n_in[k] = is_none ? 0 : INT64_C(1000) * (k + 1) * (comm->rank + 1);
        sum[0] += n_out[k];
        sum[1] += n_in[k];
    }
    char *out = calloc((size_t)sum[0] + 1, 1);
    char *in = calloc((size_t)sum[1] + 1, 1);
    CHECK(out != NULL && in != NULL);
    memset(out, 'a' + comm->rank, (size_t)sum[0]);
    comm->exchange(comm->context, out, n_out, in, n_in);
    const char *at = in;
    for (int32_t k = 0; k < comm->n_rank; ++k) {
        for (int64_t i = 0; i < n_in[k]; ++i, ++at) {
            CHECK(*at == 'a' + k);
        }
    }
    free(out);
    free(in);
    return 0;
}

static int all_agree(const clast_comm *comm)
{
    const int32_t last = comm->n_rank - 1;
    char text[40];
    CHECK(comm->least(comm->context, 100 - comm->rank) == 100 - last);
    (void)snprintf(text, sizeof text, "rank %d: disk gone", (int)last);
    const clast_status mine = comm->rank == last ? CLAST_E_DISK : CLAST_OK;
    CHECK(clast_comm_agree(comm, mine, "disk gone") == CLAST_E_DISK);
    CHECK(last == 0 || strcmp(clast_error_detail(), text) == 0);
    return clast_comm_agree(comm, CLAST_OK, NULL) == CLAST_OK ? 0 : __LINE__;
}

int main(int argc, char **argv)
{
    clast_comm comm = {0};
    int32_t line = 0;
    int found = 0;
    if (clast_mpi_create(0, &comm) != CLAST_E_USAGE) {
        return 1; // MPI does not run yet
    }
    (void)MPI_Init(&argc, &argv);
    if (clast_mpi_begin(&comm) != CLAST_E_USAGE ||
        clast_mpi_create((int32_t)MPI_Comm_c2f(MPI_COMM_WORLD), &comm) != CLAST_OK) {
        return 1;
    }
    (void)MPI_Comm_size(MPI_COMM_WORLD, &found);
    line = found == comm.n_rank ? messages_keep_their_order(&comm) : __LINE__;
    line = line == 0 ? pieces_come_in_order(&comm) : line;
    line = line == 0 ? integers_are_added(&comm) : line;
    line = line == 0 ? bytes_are_exchanged(&comm) : line;
    line = line == 0 ? all_agree(&comm) : line;
    if (line != 0) {
        (void)MPI_Abort(MPI_COMM_WORLD, 1);
    }
    clast_mpi_destroy(&comm);
    clast_mpi_destroy(&comm);
    (void)MPI_Finalize();
    return 0;
}
