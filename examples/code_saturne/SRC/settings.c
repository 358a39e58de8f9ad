// SPDX-License-Identifier: BSD-3-Clause
// A solver linked with it is under the GPL as a whole: README.md.
#include "settings.h"
#include "cs_headers.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static run_settings read_already;

static int read_numbers(char *text, double *number, int limit)
{
    int n = 0;
    for (char *word = strtok(text, " \n"); word != NULL && n < limit; word = strtok(NULL, " \n")) {
        number[n++] = strtod(word, NULL);
    }
    return n;
}

static void read_task(const char *word, run_settings *s)
{
    static const char *name[] = {"count", "own", "grow", "snapshot"};
    for (int k = 0; k < 4; ++k) {
        if (strcmp(word, name[k]) == 0) {
            s->task = (run_task)k;
            return;
        }
    }
    bft_error(__FILE__, __LINE__, 0, "settings.txt: no task %s: count, own, grow or snapshot",
              word);
}

static void read_integer(const char *text, int *number)
{
    *number = (int)strtol(text, NULL, 10);
}

static void read_line(const char *name, char *rest, run_settings *s)
{
    struct {
        const char *name;
        double *number;
        int limit;
    } row[] = {{"dt", &s->dt, 1},
               {"velocity", s->velocity, 3},
               {"hydraulic_diameter", &s->hydraulic_diameter, 1},
               {"density", &s->density, 1},
               {"viscosity", &s->viscosity, 1},
               {"period", s->period, MAX_SETS},
               {"weight", s->weight, MAX_SETS},
               {"diameter", &s->diameter, 1},
               {"particle_density", &s->particle_density, 1},
               {"kernel", &s->kernel, 1}};
    for (size_t k = 0; k < sizeof row / sizeof row[0]; ++k) {
        if (strcmp(name, row[k].name) == 0) {
            read_numbers(rest, row[k].number, row[k].limit);
            return;
        }
    }
    rest[strcspn(rest, "\n")] = '\0';
    if (strcmp(name, "parcels") == 0) {
        s->n_set = read_numbers(rest, s->parcels, MAX_SETS);
    } else if (strcmp(name, "task") == 0) {
        read_task(rest, s);
    } else if (strcmp(name, "steps") == 0) {
        read_integer(rest, &s->n_step);
    } else if (strcmp(name, "every") == 0) {
        read_integer(rest, &s->every);
    } else if (strcmp(name, "spare") == 0) {
        read_integer(rest, &s->spare);
    } else if (strcmp(name, "domain") == 0) {
        strncpy(s->domain, rest, sizeof s->domain - 1);
    } else {
        bft_error(__FILE__, __LINE__, 0, "settings.txt: nothing is called %s", name);
    }
}

const run_settings *settings(void)
{
    run_settings *s = &read_already;
    if (s->n_step > 0) {
        return s;
    }
    FILE *file = fopen("settings.txt", "r");
    char line[256];
    if (file == NULL) {
        bft_error(__FILE__, __LINE__, 0, "settings.txt is not in the folder of the run");
    }
    while (fgets(line, sizeof line, file) != NULL) {
        char *rest = strchr(line, ' ');
        if (rest != NULL) {
            *rest = '\0';
            read_line(line, rest + 1, s);
        }
    }
    fclose(file);
    if (s->n_step < 1 || s->every < 1 || s->n_set < 1 || !(s->dt > 0.0)) {
        bft_error(__FILE__, __LINE__, 0, "settings.txt: steps, every, parcels or dt is missing");
    }
    return s;
}
