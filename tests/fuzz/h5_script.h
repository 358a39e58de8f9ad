#pragma once
// Files of the HDF5 layer from a script, for fuzzing: mutated bytes would fall to the CRC-32, so a
// script says what the file holds and the library's own writer builds it.
//
//     t OBJECT NAME TEXT           text attribute
//     n OBJECT NAME TYPE NUMBER    number attribute; TYPE d, i, l, u or b
//     a NAME TYPE SIZE[,SIZE...] NUMBER...   array; the numbers are repeated as needed
#include "base/alloc.h"
#include "io/h5.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { N_LIMIT = 4096, N_WORD = 512, LINE = 8192 };

static char path[64];

static void remove_file(void)
{
    (void)remove(path);
}

/// A file of this process, removed at its end.
static void name_file(void)
{
    if (path[0] == '\0') {
        (void)snprintf(path, sizeof path, "/tmp/clast-fuzz-%d.h5", (int)getpid());
        (void)atexit(remove_file);
    }
}

static clx_h5_type type_of(const char *word)
{
    switch (word != NULL ? word[0] : 'd') {
    case 'i':
        return CLX_H5_I32;
    case 'l':
        return CLX_H5_I64;
    case 'u':
        return CLX_H5_U64;
    case 'b':
        return CLX_H5_U8;
    default:
        return CLX_H5_F64;
    }
}

/// Writes a number as item i of an array of this type.
static void put(void *data, int64_t i, clx_h5_type type, const char *word)
{
    const double x = word != NULL ? strtod(word, NULL) : 0.0;
    const long long k = word != NULL ? strtoll(word, NULL, 10) : 0;
    switch (type) {
    case CLX_H5_I32:
        ((int32_t *)data)[i] = (int32_t)k;
        break;
    case CLX_H5_I64:
    case CLX_H5_U64:
        ((int64_t *)data)[i] = k;
        break;
    case CLX_H5_U8:
        ((uint8_t *)data)[i] = (uint8_t)k;
        break;
    default:
        ((double *)data)[i] = x;
    }
}

static void add_array(clx_h5 *h5, char **rest)
{
    static double data[N_LIMIT];
    const char *words[N_WORD];
    int64_t shape[CLX_H5_RANK_LIMIT];
    int32_t rank = 0;
    int64_t total = 1;
    int n = 0;
    const char *name = strtok_r(NULL, " ", rest);
    const clx_h5_type type = type_of(strtok_r(NULL, " ", rest));
    char *sizes = strtok_r(NULL, " ", rest);
    for (char *at = sizes; at != NULL && rank < CLX_H5_RANK_LIMIT; ++rank) {
        shape[rank] = strtoll(at, &at, 10);
        if (shape[rank] < 0 || (shape[rank] > 0 && total > N_LIMIT / shape[rank])) {
            return;
        }
        total *= shape[rank];
        at = *at == ',' ? at + 1 : NULL;
    }
    while (n < N_WORD && (words[n] = strtok_r(NULL, " ", rest)) != NULL) {
        ++n;
    }
    for (int64_t i = 0; i < total; ++i) {
        put(data, i, type, n > 0 ? words[i % n] : NULL);
    }
    if (name != NULL) {
        (void)clx_h5_write(h5, name, type, rank, shape, data);
    }
}

static void add_line(clx_h5 *h5, char *line)
{
    char *rest = NULL;
    const char *what = strtok_r(line, " ", &rest);
    if (what != NULL && what[0] == 'a') {
        add_array(h5, &rest);
        return;
    }
    const char *object = strtok_r(NULL, " ", &rest);
    const char *name = strtok_r(NULL, " ", &rest);
    if (name == NULL) {
        return;
    }
    if (object[0] == '/' && object[1] != '\0' && !clx_h5_has(h5, object)) {
        (void)clx_h5_write_folder(h5, object);
    }
    if (what[0] == 't') {
        (void)clx_h5_write_text(h5, object, name, rest != NULL ? rest : "");
    } else {
        double value = 0.0;
        const clx_h5_type type = type_of(strtok_r(NULL, " ", &rest));
        put(&value, 0, type, strtok_r(NULL, " ", &rest));
        (void)clx_h5_write_number(h5, object, name, type, &value);
    }
}

/// Builds the file that a script describes; false when it cannot be written.
static bool build(const uint8_t *bytes, size_t n)
{
    clx_h5 *h5 = NULL;
    char line[LINE];
    size_t used = 0;
    if (clx_h5_create(&h5) != CLAST_OK) {
        return false;
    }
    for (size_t i = 0; i <= n; ++i) {
        if (i == n || bytes[i] == '\n') {
            line[used] = '\0';
            add_line(h5, line);
            used = 0;
        } else if (used + 1 < sizeof line && bytes[i] != '\0') {
            line[used++] = (char)bytes[i];
        }
    }
    const bool is_written = clx_h5_commit(h5, path) == CLAST_OK;
    clx_h5_close(h5);
    return is_written;
}
