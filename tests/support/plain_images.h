#pragma once
// Hostile images of plain states: a changed byte would fall to a checksum, so these are set right.
#include "base/alloc.h"
#include "io/h5_plain.h"
#include "io/h5_trailer.h"
#include <stdlib.h>
#include <string.h>

static inline void plain_put_word(char *at, int width, uint64_t word)
{
    for (int k = 0; k < width; ++k) {
        at[k] = (char)(word >> 8 * k & 0xff);
    }
}

/// Sets the length of the file and the checksums of the superblock and of each header.
static inline void plain_mend(char *image, int64_t n)
{
    for (int64_t at = 48; at + 10 <= n; ++at) {
        if (memcmp(image + at, "OHDR", 4) == 0) {
            int64_t size = 10;
            for (int k = 0; k < 4; ++k) {
                size += (int64_t)(unsigned char)image[at + 6 + k] << 8 * k;
            }
            if (size <= n - at - 4) {
                plain_put_word(image + at + size, 4, clx_h5_sum(image + at, size));
            }
        }
    }
    if (n >= 48) {
        plain_put_word(image + 28, 8, (uint64_t)n);
        plain_put_word(image + 44, 4, clx_h5_sum(image, 44));
    }
}

/// Parses an image of its exact length, so that a sanitizer sees each byte read beyond it.
static inline clast_status plain_parse(const char *image, int64_t n, clx_h5 **h5)
{
    clast_status status = CLAST_OK;
    char *own = NULL;
    clx_h5 *made = NULL;
    CLX_TRY(clx_alloc(&own, n, 1));
    if (n > 0) {
        memcpy(own, image, (size_t)n);
    }
    CLX_TRY(clx_h5_plain_begin("image", &made));
    CLX_TRY(clx_h5_plain_parse(own, n, made));
    *h5 = made;
    made = NULL;
done:
    clx_h5_close(made);
    clx_free(own);
    return status;
}

/// Whether what an image holds has the sizes that it tells and lies within its length, and written
/// anew and read again it gives the same bytes. false too where memory is out.
static inline bool plain_is_kept(clx_h5 *h5, int64_t n)
{
    char *image[2] = {0};
    int64_t size[2] = {0};
    int64_t held = 0;
    clx_h5 *again = NULL;
    for (int64_t i = 0; i < h5->n; ++i) {
        int64_t told = h5->node[i].is_folder ? 0 : clx_h5_plain_width(h5->node[i].type);
        for (int32_t d = 0; d < h5->node[i].rank; ++d) {
            told *= h5->node[i].shape[d];
        }
        held += told == h5->node[i].size ? told : n + 1;
        for (int64_t k = 0; k < h5->node[i].n_attribute; ++k) {
            held += h5->node[i].attribute[k].size;
        }
    }
    const bool is_kept = held <= n && clx_h5_plain_image(h5, &image[0], &size[0]) == CLAST_OK &&
                         plain_parse(image[0], size[0], &again) == CLAST_OK &&
                         clx_h5_plain_image(again, &image[1], &size[1]) == CLAST_OK &&
                         size[0] == size[1] && memcmp(image[0], image[1], (size_t)size[0]) == 0;
    clx_h5_close(again);
    clx_free(image[0]);
    clx_free(image[1]);
    return is_kept;
}
