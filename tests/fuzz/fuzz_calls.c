// Any bytes in any public struct, handed to any public function: a status, and outputs as they were
// where it refuses.
#include "calls.h"

#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n);

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n)
{
    if (n < 3) {
        return 0;
    }
    const public_call *c = &calls[(bytes[0] + 256 * bytes[1]) % N_CALLS];
    source s = {.byte = bytes + 2, .n = n - 2};
    (void)clast_memory_set_limit(1 << 29);
    if (!c->is_long && c->call(&s, -1) > CLAST_OK && c->has_status &&
        (clast_error_detail()[0] == '\0' || has_written(&s))) {
        abort();
    }
    return 0;
}
