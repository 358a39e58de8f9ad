// Any text is a domain with a volume, whose map stays in the unit cube, or one line of complaint.
#include <clast/cloud.h>

#include <clast/status.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n);

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n)
{
    char text[256];
    clast_domain domain = {0};
    const size_t used = n < sizeof text - 1 ? n : sizeof text - 1;
    memcpy(text, bytes, used);
    text[used] = '\0';
    if (clast_domain_parse(text, &domain) != CLAST_OK) {
        if (strchr(clast_error_detail(), '\n') != NULL && strchr(text, '\n') == NULL) {
            abort();
        }
        return 0;
    }
    double x[3] = {0};
    double u[3] = {0.5, 0.5, 0.5};
    clast_domain_unmap(&domain, u, x);
    if (!(clast_domain_volume(&domain) >= 0.0) || domain.dimension < 1 || domain.dimension > 3) {
        abort();
    }
    if (clast_domain_map(&domain, x, u)) {
        for (int j = 0; j < domain.dimension; ++j) {
            if (!(u[j] >= 0.0 && u[j] <= 1.0)) {
                abort();
            }
        }
    }
    clast_domain_free(&domain);
    return 0;
}
