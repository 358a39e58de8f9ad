// clast_comm over shared memory, for tests of whatever runs on ranks.
#define _DEFAULT_SOURCE // MAP_ANONYMOUS
#include "ranks.h"

#include "support.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

enum { RANKS = 8, BOX = 512, PIECE = 1 << 16 };

typedef struct {
    pthread_mutex_t lock;
    pthread_barrier_t barrier;
    int32_t n_rank;
    struct {
        int32_t n, from[BOX];
        int64_t word[BOX][CLAST_COMM_WORDS];
    } box[RANKS];
    int64_t value[RANKS];
    char bytes[PIECE];
} board;

typedef struct {
    board *board;
    int32_t rank;
} place;

void *support_shared_memory(size_t size)
{
    void *block = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    assert_true(block != MAP_FAILED);
    return block;
}

static void send(void *context, int32_t to, const int64_t word[CLAST_COMM_WORDS])
{
    const place *p = context;
    board *b = p->board;
    (void)pthread_mutex_lock(&b->lock);
    if (b->box[to].n == BOX) {
        abort();
    }
    b->box[to].from[b->box[to].n] = p->rank;
    memcpy(b->box[to].word[b->box[to].n++], word, sizeof b->box[to].word[0]);
    (void)pthread_mutex_unlock(&b->lock);
}

static bool take(void *context, int32_t *from, int64_t word[CLAST_COMM_WORDS])
{
    const place *p = context;
    board *b = p->board;
    (void)pthread_mutex_lock(&b->lock);
    const bool found = b->box[p->rank].n > 0;
    if (found) {
        *from = b->box[p->rank].from[0];
        memcpy(word, b->box[p->rank].word[0], sizeof b->box[p->rank].word[0]);
        --b->box[p->rank].n;
        memmove(&b->box[p->rank].from[0], &b->box[p->rank].from[1],
                (size_t)b->box[p->rank].n * sizeof(int32_t));
        memmove(&b->box[p->rank].word[0], &b->box[p->rank].word[1],
                (size_t)b->box[p->rank].n * sizeof b->box[p->rank].word[0]);
    }
    (void)pthread_mutex_unlock(&b->lock);
    return found;
}

static void meet(const place *p)
{
    (void)pthread_barrier_wait(&p->board->barrier);
}

static int64_t least(void *context, int64_t value)
{
    const place *p = context;
    p->board->value[p->rank] = value;
    meet(p);
    for (int32_t k = 0; k < p->board->n_rank; ++k) {
        value = p->board->value[k] < value ? p->board->value[k] : value;
    }
    meet(p);
    return value;
}

/// Piece by piece over the board, from `root` to the ranks that give `to`.
static void pass(const place *p, int32_t root, const char *from, char *to, int64_t n)
{
    for (int64_t at = 0; at < n; at += PIECE) {
        const size_t piece = (size_t)(n - at < PIECE ? n - at : PIECE);
        if (p->rank == root) {
            memcpy(p->board->bytes, from + at, piece);
        }
        meet(p);
        if (p->rank != root && to != NULL) {
            memcpy(to + at, p->board->bytes, piece);
        }
        meet(p);
    }
}

static void broadcast(void *context, int32_t root, void *bytes, int64_t n)
{
    pass(context, root, bytes, bytes, n);
}

static void gather(void *context, const void *bytes, int64_t n, const int64_t *count, void *all)
{
    const place *p = context;
    char *to = all;
    p->board->value[p->rank] = n;
    meet(p);
    int64_t each[RANKS];
    memcpy(each, p->board->value, sizeof each);
    meet(p);
    for (int32_t k = 0; k < p->board->n_rank; ++k) {
        if (k == 0 && p->rank == 0 && n > 0) {
            memcpy(to, bytes, (size_t)n);
        } else if (k > 0) {
            pass(p, k, bytes, p->rank == 0 ? to : NULL, each[k]);
        }
        to += p->rank == 0 ? count[k] : 0;
    }
}

static void sum(void *context, int64_t *value, int64_t n)
{
    const place *p = context;
    int64_t *total = calloc((size_t)n + 1, sizeof *total);
    int64_t *other = calloc((size_t)n + 1, sizeof *other);
    if (total == NULL || other == NULL) {
        abort();
    }
    for (int32_t k = 0; k < p->board->n_rank; ++k) {
        memcpy(other, value, (size_t)n * sizeof *other);
        pass(p, k, (const char *)other, (char *)other, n * (int64_t)sizeof *other);
        for (int64_t i = 0; i < n; ++i) {
            total[i] += other[i];
        }
    }
    memcpy(value, total, (size_t)n * sizeof *total);
    free(total);
    free(other);
}

static void exchange(void *context, const void *out, const int64_t *n_out, void *in,
                     const int64_t *n_in)
{
    const place *p = context;
    const int32_t n_rank = p->board->n_rank;
    char *to = in;
    for (int32_t k = 0; k < n_rank; ++k) {
        const char *from = out;
        for (int32_t peer = 0; peer < n_rank; ++peer) { // what k sends to each, seen by all
            int64_t n = k == p->rank ? n_out[peer] : 0;
            pass(p, k, (const char *)&n, (char *)&n, (int64_t)sizeof n);
            if (k == peer && k == p->rank && n > 0) {
                memcpy(to, from, (size_t)n);
            } else if (k != peer) {
                pass(p, k, from, p->rank == peer ? to : NULL, n);
            }
            from += k == p->rank ? n : 0;
        }
        to += n_in[k];
    }
}

static board *make_board(int32_t n)
{
    board *b = support_shared_memory(sizeof *b);
    pthread_mutexattr_t for_lock;
    pthread_barrierattr_t for_barrier;
    b->n_rank = n;
    (void)pthread_mutexattr_init(&for_lock);
    (void)pthread_mutexattr_setpshared(&for_lock, PTHREAD_PROCESS_SHARED);
    (void)pthread_mutex_init(&b->lock, &for_lock);
    (void)pthread_barrierattr_init(&for_barrier);
    (void)pthread_barrierattr_setpshared(&for_barrier, PTHREAD_PROCESS_SHARED);
    (void)pthread_barrier_init(&b->barrier, &for_barrier, (unsigned)n);
    return b;
}

/// A rank's whole life, in a process of its own.
static int live(board *b, int32_t rank, int (*work)(const clast_comm *comm, void *context),
                void *context)
{
    place here = {b, rank};
    const clast_comm comm = {.rank = rank,
                             .n_rank = b->n_rank,
                             .send = send,
                             .take = take,
                             .least = least,
                             .broadcast = broadcast,
                             .gather = gather,
                             .sum = sum,
                             .exchange = exchange,
                             .context = &here};
    (void)alarm(300); // a rank that waits in vain ends by SIGALRM
    const int line = work(&comm, context);
    if (line != 0) {
        print_error("rank %d of %d: the check in line %d failed: %s\n", rank, b->n_rank, line,
                    clast_error_detail());
    }
    return line != 0;
}

void support_run_ranks(int32_t n, int (*work)(const clast_comm *comm, void *context), void *context)
{
    board *b = make_board(n);
    pid_t process[RANKS];
    int n_bad = 0;
    clast_parallel_set_threads(1); // a forked process has none of its parent's threads
    for (int32_t k = 0; k < n; ++k) {
        process[k] = fork();
        assert_true(process[k] >= 0);
        if (process[k] == 0) {
            _exit(live(b, k, work, context));
        }
    }
    for (int32_t k = 0; k < n; ++k) {
        int state = 0;
        assert_int_equal(waitpid(process[k], &state, 0), process[k]);
        n_bad += !WIFEXITED(state) || WEXITSTATUS(state) != 0;
    }
    (void)munmap(b, sizeof *b);
    clast_parallel_set_threads(0);
    assert_int_equal(n_bad, 0);
}
