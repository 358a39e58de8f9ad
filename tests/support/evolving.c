// Clouds of true shapes for the tests, from the texts of their options.
#include "evolving.h"

#include "support.h"
#include <stdio.h>
#include <string.h>

void evolving_set(clast_evolve_config *config, const char *option)
{
    char key[64];
    const char *equal = strchr(option, '=');
    assert_non_null(equal);
    (void)snprintf(key, sizeof key, "%.*s", (int)(equal - option), option);
    const clast_field *field = clast_fields_find(clast_evolve_fields, key);
    assert_non_null(field);
    CHECK_OK(clast_field_set(field, config, equal + 1, false));
}

void evolving_open(evolving *cloud, const char *const *option)
{
    *cloud = (evolving){0};
    CHECK_OK(clast_fields_default(clast_evolve_fields, &cloud->config));
    for (; *option != NULL; ++option) {
        evolving_set(&cloud->config, *option);
    }
    CHECK_OK(clast_evolve_load(&cloud->config, &cloud->source));
}

void evolving_begin(evolving *cloud, const char *const *option)
{
    evolving_open(cloud, option);
    CHECK_OK(clast_evolve_create(&cloud->config, &cloud->source.input, &cloud->evolve));
}

clast_evolve_result evolving_follow(evolving *cloud)
{
    clast_evolve_result result;
    while (!clast_evolve_is_over(cloud->evolve)) {
        CHECK_OK(clast_evolve_advance(cloud->evolve));
    }
    CHECK_OK(clast_evolve_measure(cloud->evolve, &result));
    return result;
}

void evolving_end(evolving *cloud)
{
    clast_evolve_destroy(cloud->evolve);
    clast_evolve_unload(&cloud->source);
    clast_fields_free(clast_evolve_fields, &cloud->config);
}
