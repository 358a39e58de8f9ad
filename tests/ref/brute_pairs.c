#include "brute_pairs.h"

void brute_pairs(const clast_cloud *cloud, int32_t n_shell, const double *radius, int64_t *count)
{
    for (int64_t i = 0; i < cloud->n; ++i) {
        for (int64_t j = 0; j < i; ++j) {
            double r2 = 0.0;
            int32_t k = 0;
            for (int32_t a = 0; a < cloud->dimension; ++a) {
                const double t =
                    cloud->x[i * cloud->dimension + a] - cloud->x[j * cloud->dimension + a];
                r2 += t * t;
            }
            while (k < n_shell && r2 >= radius[k] * radius[k]) {
                ++k;
            }
            if (k < n_shell) {
                ++count[k];
            }
        }
    }
}
