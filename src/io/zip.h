#pragma once
// A ZIP file of a few entries, deflated, with no times in it: equal contents give equal bytes.
#include <clast/status.h>

typedef struct clx_file clx_file;
#define ZLIB_CONST // input is read-only
#include <zlib.h>

enum { CLX_ZIP_N_ENTRY = 8, CLX_ZIP_NAME_SIZE = 64 };

typedef struct clx_zip_entry {
    char name[CLX_ZIP_NAME_SIZE];
    uint32_t crc;
    int64_t raw, packed, offset; ///< bytes
} clx_zip_entry;

/// A ZIP under construction; one entry is open at a time. {0} is empty.
typedef struct clx_zip {
    clx_file *file; ///< borrowed
    int64_t offset; ///< bytes written so far
    int32_t n_entry;
    clx_zip_entry entry[CLX_ZIP_N_ENTRY];
    z_stream stream; ///< of the open entry
    bool is_open;
    uint8_t *packed; ///< the open entry's bytes so far
    int64_t n_packed, capacity;
} clx_zip;

clast_status clx_zip_begin_entry(clx_zip *zip, const char *name);
clast_status clx_zip_write(clx_zip *zip, const void *bytes, size_t n);
clast_status clx_zip_print(clx_zip *zip, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/// Packs what is left of the entry and appends it to the file. CLAST_E_LIMIT beyond 4 GiB.
clast_status clx_zip_end_entry(clx_zip *zip);

/// Appends the directory; the file itself is the caller's to commit.
clast_status clx_zip_finish(clx_zip *zip);

void clx_zip_free(clx_zip *zip);
