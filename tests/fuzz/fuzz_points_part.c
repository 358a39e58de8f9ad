// Ranks read any bytes as one process does.
#include "points_parts.h"

#include <unistd.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n);

static char path[64];

static void remove_file(void)
{
    (void)remove(path);
}

/// A file of this process, removed at its end.
static bool write_text(const char *text, size_t n)
{
    if (path[0] == '\0') {
        (void)snprintf(path, sizeof path, "/tmp/clast-fuzz-%d.csv", (int)getpid());
        (void)atexit(remove_file);
    }
    FILE *file = fopen(path, "wb");
    const bool is_written = file != NULL && fwrite(text, 1, n, file) == n;
    return file != NULL && fclose(file) == 0 && is_written;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n)
{
    const size_t skip = n > 0; // the first byte is the number of ranks
    const char *text = (const char *)bytes + skip;
    if (write_text(text, n - skip) &&
        !reads_alike(path, text, n - skip, skip > 0 ? 1 + bytes[0] % 8 : 1)) {
        abort();
    }
    return 0;
}
