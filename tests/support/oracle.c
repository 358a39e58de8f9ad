#include "oracle.h"

#include "support.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void oracle_points(const char *set, oracle_set *points)
{
    char name[128];
    char line[256];
    (void)snprintf(name, sizeof name, "d2sd/points_%s.csv", set);
    FILE *file = fopen(support_data(name), "r");
    assert_non_null(file);
    points->n = 0;
    points->d = 1;
    assert_non_null(fgets(line, sizeof line, file));
    for (const char *c = line; *c != '\0'; ++c) {
        points->d += *c == ',' ? 1 : 0;
    }
    while (fgets(line, sizeof line, file) != NULL) {
        char *at = line;
        for (int32_t j = 0; j < points->d; ++j) {
            points->u[points->n * points->d + j] = strtod(at, &at);
            at += *at == ',' ? 1 : 0;
        }
        ++points->n;
    }
    (void)fclose(file);
}

bool oracle_find(const char *set, const char *quantity, double *value)
{
    char line[256];
    char wanted[192];
    bool found = false;
    FILE *file = fopen(support_data("d2sd/expected.csv"), "r");
    assert_non_null(file);
    (void)snprintf(wanted, sizeof wanted, "%s,%s,", set, quantity);
    while (!found && fgets(line, sizeof line, file) != NULL) {
        if (strncmp(line, wanted, strlen(wanted)) == 0) {
            *value = strtod(line + strlen(wanted), NULL);
            found = true;
        }
    }
    (void)fclose(file);
    return found;
}

double oracle_value(const char *set, const char *quantity)
{
    double value = 0.0;
    if (!oracle_find(set, quantity, &value)) {
        fail_msg("expected.csv has no %s of %s", quantity, set);
    }
    return value;
}
