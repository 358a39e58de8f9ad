#pragma once
// Reads the D2SD reference tables: points_<set>.csv and expected.csv.
#include <clast/status.h>

enum { ORACLE_MAX_POINT = 5000 };

typedef struct oracle_set {
    int64_t n;
    int32_t d;
    double u[ORACLE_MAX_POINT * 3];
} oracle_set;

/// Points of a set; fails the test when the file is missing.
void oracle_points(const char *set, oracle_set *points);

/// Value of a quantity of a set; fails the test when there is none.
double oracle_value(const char *set, const char *quantity);

/// The same, false when there is none.
bool oracle_find(const char *set, const char *quantity, double *value);
