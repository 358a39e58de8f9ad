// Any bytes as the image of a plain state, its checksums set right, are refused by a line or hold
// no more than they have bytes, and are the same written anew.
#include "../support/plain_images.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n);

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n)
{
    clx_h5 *h5 = NULL;
    char *image = malloc(n + 1);
    if (image == NULL) {
        return 0;
    }
    memcpy(image, bytes, n);
    plain_mend(image, (int64_t)n);
    if (plain_parse(image, (int64_t)n, &h5) == CLAST_OK && !plain_is_kept(h5, (int64_t)n)) {
        abort();
    }
    clx_h5_close(h5);
    free(image);
    return 0;
}
