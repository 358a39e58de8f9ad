#pragma once
#include <clast/status.h>

/// Points in one, two or three dimensions, with optional properties; arrays may be borrowed by the
/// functions that read them.
typedef struct clast_cloud {
    int64_t n;
    int32_t dimension; ///< 1, 2 or 3
    double *x;         ///< [n][dimension] m
    double *radius;    ///< [n] m, or NULL
    double *mass;      ///< [n] kg, or NULL
    double *weight;    ///< [n] real particles a parcel stands for, or NULL (1)
    double *velocity;  ///< [n][dimension] m/s, or NULL
} clast_cloud;

CLAST_API clast_status clast_cloud_alloc(int64_t n, int32_t dimension, clast_cloud *cloud);
CLAST_API void clast_cloud_free(clast_cloud *cloud);
