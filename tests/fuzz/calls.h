// Public structs filled from bytes, and calls of public functions with them: calls.inc, which
// make_calls.py writes from the headers, stands on what is here.
//
// What is filled is what a hurried caller could hand over: NULL, counts of -1 to 8 with arrays of
// at least that many items, any enumerator, NaN. What no callee could notice (a count beyond its
// array, a pointer to freed memory) is left out.
#pragma once
#include <clast/clast.h>

// Not every type is an argument.
#pragma GCC diagnostic ignored "-Wunused-function"
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum {
    ITEMS = 8,
    ARRAY_BYTES = 8 * ITEMS * ITEMS * ITEMS, ///< three counts of 8, of doubles
    ARENA_BYTES = 1 << 24
};

typedef struct source {
    const uint8_t *byte;
    size_t n, next;
    size_t used; ///< bytes of the arena
    int depth;
    bool is_hollow;      ///< pointers are NULL: what a function may reallocate or free
    unsigned char blank; ///< what outputs are filled with
    unsigned char *output[16];
    int n_output;
    bool is_other;     ///< an item after the first
    bool is_good;      ///< all holds together but for one number
    int n_number;      ///< doubles and enumerators of the call so far
    int spoilt;        ///< which of them is NaN, or an enumerator that there is not
    const char *wrong; ///< its name, NULL before
} source;

typedef struct public_call {
    const char *name;
    int (*call)(source *s, int null); ///< argument `null` is NULL; its status, or -1 for none
    unsigned pointers;                ///< bit k: argument k may be NULL at all
    unsigned needed;                  ///< bit k: ... and must not be
    bool is_long;                     ///< called with NULL only
    bool has_status;
} public_call;

static _Alignas(16) unsigned char arena[ARENA_BYTES];
static clast_decompose_config fields_config;

static unsigned take_byte(source *s)
{
    const size_t i = s->next++;
    return s->n == 0 ? 0 : s->byte[i % s->n] + 31 * (unsigned)(i / s->n); // round and round
}

/// NULL once the arena is full, for hollow objects, and now and then.
static void *take_room(source *s, size_t n)
{
    n = (n + 15) / 16 * 16;
    if (s->is_hollow || s->n == 0 || (!s->is_good && take_byte(s) % 8 == 1) ||
        n > sizeof arena - s->used) {
        return NULL;
    }
    void *room = arena + s->used;
    s->used += n;
    return room;
}

static void *take_items(source *s, size_t size)
{
    return s->depth > 3 ? NULL : take_room(s, ITEMS * size);
}

static double take_f64(source *s)
{
    if (s->is_good) { // rising
        return 1e-3 * (double)++s->next;
    }
    static const double value[] = {1.0,
                                   0.5,
                                   2.0,
                                   1e-3,
                                   0.25,
                                   3.0,
                                   1.0,
                                   0.1,
                                   0.0,
                                   0.75,
                                   1.5,
                                   -1.0,
                                   1e300,
                                   (double)NAN,
                                   1e-320,
                                   (double)INFINITY,
                                   -(double)INFINITY,
                                   -0.0,
                                   7e15,
                                   100.0};
    const unsigned b = take_byte(s) % 256;
    return b < 160 ? value[b % 12] : b < 176 ? value[b % 20] : (double)b / 256.0;
}

/// Whether this number of the call, a double or an enumerator, is the wrong one.
static bool is_wrong(source *s, const char *name)
{
    const bool is = s->depth <= 1 && !s->is_other && s->n_number++ == s->spoilt;
    s->wrong = is ? name : s->wrong;
    return is;
}

/// A double by its name, "clast_period.low".
static double take_number(source *s, const char *name)
{
    if (!s->is_good) {
        return take_f64(s);
    }
    return is_wrong(s, name) ? (double)NAN : 0.5;
}

static float take_f32(source *s)
{
    return (float)take_f64(s);
}

static int64_t take_count(source *s)
{
    if (s->is_good) {
        return 2;
    }
    static const int64_t value[] = {1, 2, 3, 4, ITEMS, 0, 5, 2, -1, INT32_MIN};
    const unsigned b = take_byte(s) % 256;
    return b < 240 ? value[b % 8] : value[b % 10];
}

static int32_t take_i32(source *s)
{
    if (s->is_good) {
        return 1;
    }
    static const int32_t value[] = {0, 1, 2, 3, 1, 0, 2, 1, -1, 77, INT32_MAX, INT32_MIN};
    const unsigned b = take_byte(s) % 256;
    return b < 224 ? value[b % 8] : value[b % 12];
}

/// An enumerator by its name.
static int32_t take_number_choice(source *s, const char *name)
{
    if (!s->is_good) {
        return take_i32(s);
    }
    return is_wrong(s, name) ? 77 : 0;
}

static int64_t take_i64(source *s)
{
    const int64_t value = take_i32(s);
    return value == INT32_MAX ? INT64_MAX : value == INT32_MIN ? INT64_MIN : value;
}

#define take_int(s)    take_i32(s)
#define take_choice(s) (s->is_good ? 0 : take_i32(s))
#define take_u32(s)    (uint32_t) take_i32(s)
#define take_u64(s)    (uint64_t) take_i64(s)
#define take_size(s)   (size_t)((uint64_t)take_count(s) % (ITEMS + 1))
#define take_u8(s)     (uint8_t) take_byte(s)
#define take_char(s)   (char)take_byte(s)
#define take_flag(s)   (take_byte(s) % 2 == 1)

#define ARRAY_OF(type, kind)                                                                       \
    static type *take_array_##kind(source *s)                                                      \
    {                                                                                              \
        type *item = take_room(s, ARRAY_BYTES);                                                    \
        for (size_t i = 0; item != NULL && i < ARRAY_BYTES / sizeof *item; ++i) {                  \
            item[i] = (type)take_##kind(s);                                                        \
        }                                                                                          \
        return item;                                                                               \
    }
ARRAY_OF(double, f64)
ARRAY_OF(float, f32)
ARRAY_OF(int32_t, i32)
ARRAY_OF(int64_t, i64)
ARRAY_OF(uint32_t, u32)
ARRAY_OF(uint64_t, u64)
ARRAY_OF(uint8_t, u8)
ARRAY_OF(bool, flag)
ARRAY_OF(int, int)
ARRAY_OF(size_t, size)

/// A text of the caller's: a word that some function knows, or bytes.
static char *take_text(source *s)
{
    static const char *const word[] = {"",
                                       "a",
                                       "m",
                                       "x",
                                       "1",
                                       "box:0,0,0,1,1,1",
                                       "sphere:1",
                                       "1mm",
                                       "x,y,z",
                                       "sphere",
                                       "-",
                                       "porosity",
                                       "/nonexistent/a.csv",
                                       "/nonexistent/a.h5",
                                       "/nonexistent/a.stl",
                                       "/nonexistent/a.svg",
                                       "/nonexistent/a.json",
                                       "z_low_m",
                                       "cylinder:0.1,0.2",
                                       "kg/m3",
                                       "L,I,S",
                                       "brownian",
                                       "\xff\n"};
    const unsigned b = take_byte(s) % 256;
    char *text = take_room(s, 64);
    if (text == NULL) {
        return NULL;
    }
    memset(text, 0, 64);
    if (b < 200) {
        strcpy(text, word[b % (sizeof word / sizeof word[0])]);
    }
    for (unsigned i = 0; b >= 200 && i < b - 200; ++i) {
        text[i] = (char)take_byte(s);
    }
    return text;
}

/// A path where nothing is and nothing can be written.
static char *take_path(source *s)
{
    char *path = take_room(s, 128);
    const char *text = take_text(s);
    if (path != NULL) {
        (void)snprintf(path, 128, "/nonexistent/%s", text != NULL ? text : "");
    }
    return path;
}

static char **take_texts(source *s)
{
    char **text = take_room(s, 2 * ITEMS * sizeof *text);
    for (int i = 0; text != NULL && i < 2 * ITEMS; ++i) {
        text[i] = take_text(s);
    }
    return text;
}

static void take_label(source *s, char *label, size_t size)
{
    const char *text = take_text(s);
    memset(label, 0, size);
    if (text != NULL) {
        strncpy(label, text, size - 1);
    }
}

static void *take_bytes(source *s)
{
    return take_array_u8(s);
}

static const clast_comm *take_comm(source *s)
{
    static const clast_comm none;
    const unsigned b = take_byte(s) % 3;
    return b == 0 ? NULL : b == 1 ? &none : clast_comm_one();
}

static void *take_output(source *s)
{
    unsigned char *out = arena + s->used;
    if (ARRAY_BYTES > sizeof arena - s->used || s->n_output == 16) {
        return NULL;
    }
    s->used += ARRAY_BYTES;
    memset(out, s->blank, ARRAY_BYTES);
    s->output[s->n_output++] = out;
    return out;
}

/// An output that a refused call has written to.
static bool has_written(const source *s)
{
    for (int i = 0; i < s->n_output; ++i) {
        for (size_t k = 0; k < ARRAY_BYTES; ++k) {
            if (s->output[i][k] != s->blank) {
                return true;
            }
        }
    }
    return false;
}

static clast_decompose_config *config_of_fields(void)
{
    if (fields_config.domain == NULL) {
        (void)clast_fields_default(clast_decompose_fields, &fields_config);
    }
    return &fields_config;
}

#include "live_objects.h"

#include "calls.inc"

enum { N_CALLS = sizeof calls / sizeof calls[0] };
