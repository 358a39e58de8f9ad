// What lies on the floor as a bed to begin with: every body one rigid grain, in a column, those
// that came first below. clast pack --start lets them fall and settles them.
#include "study/evolve_folder.h"

#include "io/rigid_grain.h"
#include <clast/assembly.h>
#include <clast/shape.h>
#include <clast/state.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const double ROOM = 1.05; ///< of a body's place, by its diameter

/// Where the next body's enclosing sphere goes: row by row, layer by layer.
typedef struct {
    double width;
    double x, y, z;    ///< low corner of the place that is free
    double row, layer; ///< greatest diameters so far
} shelf;

/// The centre of a sphere of this diameter.
static void next_place(shelf *s, double diameter, double centre[3])
{
    const double room = ROOM * diameter;
    if (s->x + room > s->width * (1.0 + 1e-12)) {
        s->x = 0.0;
        s->y += s->row;
        s->row = 0.0;
    }
    if (s->y + room > s->width * (1.0 + 1e-12)) {
        s->x = s->y = s->row = 0.0;
        s->z += s->layer;
        s->layer = 0.0;
    }
    centre[0] = s->x + 0.5 * room - 0.5 * s->width;
    centre[1] = s->y + 0.5 * room - 0.5 * s->width;
    centre[2] = s->z + 0.5 * room;
    s->x += room;
    s->row = fmax(s->row, room);
    s->layer = fmax(s->layer, room);
}

/// The shape of this name, or -1.
static int32_t find_shape(const clast_assembly *bed, const char *name)
{
    for (int32_t k = 0; k < bed->n_shape; ++k) {
        if (strcmp(bed->shape[k].name, name) == 0) {
            return k;
        }
    }
    return -1;
}

/// A single grain keeps its shape, at scale 1 and unturned, for others of its kind.
static void make_plain(clast_assembly *body)
{
    const double plain[4] = {1.0, 0.0, 0.0, 0.0};
    body->scale[0] = 1.0;
    memcpy(body->orientation[0], plain, sizeof plain);
    memset(body->position[0], 0, sizeof body->position[0]);
}

/// The rigid shape of a body, made once: of an aggregate under the name of its node.
static clast_status shape_of(clast_assembly *body, int64_t node, clast_assembly *bed, int32_t *id)
{
    static const clast_rigid_options hulls = {.hull = true};
    clast_status status = CLAST_OK;
    clast_shape shape = {0};
    const clast_shape *first = &body->shape[body->shape_id[0]];
    double added = 0.0;
    char name[256];
    (void)snprintf(name, sizeof name, "node-%08lld", (long long)node);
    if (body->n_grain == 1) {
        (void)snprintf(name, sizeof name, "%.200s", first->name);
        make_plain(body);
    }
    *id = body->n_grain == 1 ? find_shape(bed, name) : -1;
    if (*id >= 0) {
        return CLAST_OK;
    }
    if (body->n_grain == 1 &&
        (first->kind == CLAST_SHAPE_SPHERE || first->kind == CLAST_SHAPE_ELLIPSOID)) {
        CLX_TRY(clast_shape_copy(first, &shape));
    } else {
        CLX_TRY(clx_rigid_grain(body, name, &hulls, &shape, &added));
    }
    CLX_TRY(clast_assembly_add_shape(bed, &shape, id));
done:
    clast_shape_free(&shape);
    return status;
}

/// Adds a body, not yet anywhere.
static clast_status add_body(const clast_evolve *evolve, int64_t node, double mass,
                             clast_assembly *bed)
{
    clast_status status = CLAST_OK;
    clast_assembly body = {0};
    const double nowhere[3] = {0.0, 0.0, 0.0};
    double turn[4] = {1.0, 0.0, 0.0, 0.0};
    int32_t id = -1;
    CLX_TRY(clast_evolve_aggregate(evolve, node, &body));
    const double scale = body.n_grain == 1 ? body.scale[0] : 1.0;
    if (body.n_grain == 1) {
        memcpy(turn, body.orientation[0], sizeof turn);
    }
    CLX_TRY(shape_of(&body, node, bed, &id));
    CLX_TRY(clast_assembly_add_grain(bed, id, nowhere, turn, scale,
                                     mass / (bed->shape[id].volume * scale * scale * scale)));
done:
    clast_assembly_free(&body);
    return status;
}

static double diameter_of(const clast_assembly *bed, int32_t i)
{
    return 2.0 * bed->scale[i] * bed->shape[bed->shape_id[i]].bounding_radius;
}

/// Puts all into the column, which is no narrower than a periodic bed of them; its width and
/// height.
static void place_all(double width, clast_assembly *bed, clast_evolve_result *result)
{
    shelf s = {.width = width};
    for (int32_t i = 0; i < bed->n_grain; ++i) {
        s.width = fmax(s.width, ROOM * diameter_of(bed, i));
    }
    for (int32_t i = 0; i < bed->n_grain; ++i) {
        next_place(&s, diameter_of(bed, i), bed->position[i]);
    }
    result->bed_width = s.width;
    result->bed_height = s.z + s.layer;
}

clast_status clx_evolve_write_bed(const char *folder, double width, const clast_evolve *evolve,
                                  clast_evolve_result *result)
{
    clast_status status = CLAST_OK;
    clast_table deposit = {0};
    clast_assembly bed = {.unit = "m"};
    char path[CLX_PATH_LIMIT];
    CLX_TRY(clast_evolve_table(evolve, CLAST_EVOLVE_DEPOSIT, &deposit));
    for (int64_t i = 0; i < deposit.n_row; ++i) {
        CLX_TRY(add_body(evolve, (int64_t)clast_table_numbers(&deposit, "node")[i],
                         clast_table_numbers(&deposit, "mass_kg")[i], &bed));
    }
    if (deposit.n_row > 0) {
        place_all(width, &bed, result);
        CLX_TRY(clx_path_join(path, folder, "deposit.h5"));
        CLX_TRY(clast_state_write_assembly(&bed, path, NULL));
    }
done:
    clast_table_free(&deposit);
    clast_assembly_free(&bed);
    return status;
}
