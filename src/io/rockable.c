// Configurations of Rockable and their libraries of shapes. [Rockable's documentation, "Format of
// configuration files", "Format of shape-files"]
//
// Of a configuration the shapes' file, densities of groups and the particles are read. A shape of
// one vertex is a sphere; one of radius 0 with faces is that polyhedron; any other is the convex
// hull of balls of its radius at its vertices, of 42 points each, which lies inside of the rounded
// body. Polyhedra that are not convex and driven bodies (walls) are refused.
#include "io/packing.h"

#include "base/alloc.h"
#include "base/status.h"
#include "io/text.h"
#include "math/vec3.h"
#include <clast/assembly.h>
#include <clast/mesh.h>
#include <clast/shape.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { NAME = 128, MOST_GROUPS = 1024, MOST_WORDS = 32, LEAST_WORDS = 17, BALL_LEVEL = 1 };

/// How far a corner may lie outside of a face of a convex body, and a centroid off the origin, by
/// its size.
static const double FLAT = 1e-9;
static const double CENTRED = 1e-12;

/// A shape of the library as it stands there.
typedef struct {
    char name[NAME];
    double radius;
    clast_mesh mesh; ///< vertices; triangles of its faces
} solid;

typedef struct {
    clx_text text;
    const char *file;
    solid now;
} shape_library;

static clast_status copy_word(clx_word word, char *out, size_t size)
{
    if (word.n >= (int64_t)size) {
        return clx_fail(CLAST_E_FORMAT, "a name of %" PRId64 " letters", word.n);
    }
    memcpy(out, word.text, (size_t)word.n);
    out[word.n] = '\0';
    return strlen(out) == (size_t)word.n ? CLAST_OK
                                         : clx_fail(CLAST_E_FORMAT, "a name holds a zero byte");
}

/// Goes to the next line and reads n numbers there.
static clast_status next_numbers(shape_library *l, const char *what, int n, double *value)
{
    clast_status status = CLAST_OK;
    clx_word word;
    clx_text peek;
    do {
        CLX_CHECK(clx_text_next_line(&l->text), CLAST_E_FORMAT, "the file ends within %s", what);
        peek = l->text;
    } while (!clx_text_word(&peek, &word)); // blank lines and comments
    for (int k = 0; k < n; ++k) {
        CLX_TRY(clx_text_number(&l->text, what, &value[k]));
    }
done:
    return status;
}

static clast_status read_count(shape_library *l, const char *what, int64_t *n)
{
    return clx_text_integer(&l->text, what, 0, (l->text.end - l->text.at) / 2 + 1, n);
}

static clast_status read_vertices(shape_library *l)
{
    clast_status status = CLAST_OK;
    int64_t n = 0;
    CLX_TRY(read_count(l, "nv", &n));
    CLX_CHECK(l->now.mesh.n_vert == 0 && n > 0 && n < INT32_MAX / 64, CLAST_E_FORMAT,
              "shape %s has %" PRId64 " vertices, or has them twice", l->now.name, n);
    CLX_TRY(clast_mesh_alloc((int32_t)n, 0, &l->now.mesh));
    for (int64_t i = 0; i < n; ++i) {
        CLX_TRY(next_numbers(l, "a vertex", 3, l->now.mesh.vert[i]));
    }
done:
    return status;
}

static clast_status read_corner(shape_library *l, int32_t *corner)
{
    clast_status status = CLAST_OK;
    int64_t v = 0;
    CLX_TRY(clx_text_integer(&l->text, "corner of a face", 0, l->now.mesh.n_vert - 1, &v));
    *corner = (int32_t)v;
done:
    return status;
}

/// Faces of any number of corners as fans of triangles.
static clast_status read_faces(shape_library *l)
{
    clast_status status = CLAST_OK;
    int64_t n = 0;
    int32_t n_tri = 0;
    clast_mesh *mesh = &l->now.mesh;
    CLX_TRY(read_count(l, "nf", &n));
    CLX_CHECK(mesh->n_vert > 0 && mesh->n_tri == 0, CLAST_E_FORMAT,
              "faces of shape %s stand before its vertices, or twice", l->now.name);
    for (int64_t f = 0; f < n; ++f) {
        double corners = 0.0;
        int32_t tri[3];
        CLX_TRY(next_numbers(l, "a face", 1, &corners));
        CLX_CHECK(corners >= 3.0 && corners <= mesh->n_vert && corners == floor(corners),
                  CLAST_E_FORMAT, "a face of shape %s has %g corners", l->now.name, corners);
        CLX_TRY(read_corner(l, &tri[0]));
        CLX_TRY(read_corner(l, &tri[2]));
        for (int k = 2; k < (int)corners; ++k) {
            tri[1] = tri[2];
            CLX_TRY(read_corner(l, &tri[2]));
            CLX_TRY(clx_realloc(&mesh->tri, n_tri + 1, sizeof *mesh->tri));
            memcpy(mesh->tri[n_tri], tri, sizeof tri);
            mesh->n_tri = ++n_tri;
        }
    }
done:
    return status;
}

/// Turns faces outwards, and refuses what is not convex.
static clast_status orient(solid *s)
{
    clast_status status = CLAST_OK;
    clast_mesh *mesh = &s->mesh;
    double middle[3] = {0.0, 0.0, 0.0};
    double size = 0.0;
    CLX_CHECK((double)mesh->n_vert * mesh->n_tri <= 1e9, CLAST_E_LIMIT,
              "shape %s has %d vertices and %d triangles", s->name, mesh->n_vert, mesh->n_tri);
    for (int32_t i = 0; i < mesh->n_vert; ++i) {
        v3_axpy(middle, middle, 1.0 / mesh->n_vert, mesh->vert[i]);
    }
    for (int32_t i = 0; i < mesh->n_vert; ++i) {
        size = fmax(size, v3_distance(middle, mesh->vert[i]));
    }
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        int32_t *tri = mesh->tri[t];
        double u[3];
        double v[3];
        double n[3];
        v3_sub(u, mesh->vert[tri[1]], mesh->vert[tri[0]]);
        v3_sub(v, mesh->vert[tri[2]], mesh->vert[tri[0]]);
        v3_cross(n, u, v);
        v3_sub(u, mesh->vert[tri[0]], middle);
        if (v3_dot(n, u) < 0.0) {
            const int32_t swap = tri[1];
            tri[1] = tri[2];
            tri[2] = swap;
            v3_scale(n, -1.0, n);
        }
        const double length = v3_norm(n);
        for (int32_t i = 0; i < mesh->n_vert && length > 0.0; ++i) {
            v3_sub(u, mesh->vert[i], mesh->vert[tri[0]]);
            CLX_CHECK(v3_dot(n, u) <= FLAT * size * length, CLAST_E_GEOMETRY,
                      "shape %s is not convex: vertex %d lies outside of face %d", s->name, i, t);
        }
    }
done:
    return status;
}

/// The hull of balls at the vertices.
static clast_status dilate(const solid *s, clast_mesh *mesh)
{
    clast_status status = CLAST_OK;
    clast_mesh ball = {0};
    clast_mesh all = {0};
    int32_t n = 0;
    if (s->radius > 0.0) {
        CLX_TRY(
            clast_mesh_ellipsoid((double[3]){s->radius, s->radius, s->radius}, BALL_LEVEL, &ball));
    } else {
        CLX_TRY(clast_mesh_alloc(1, 0, &ball));
    }
    CLX_CHECK((int64_t)ball.n_vert * s->mesh.n_vert < INT32_MAX / 4, CLAST_E_LIMIT,
              "shape %s has too many vertices", s->name);
    CLX_TRY(clast_mesh_alloc(ball.n_vert * s->mesh.n_vert, 0, &all));
    for (int32_t i = 0; i < s->mesh.n_vert; ++i) {
        for (int32_t k = 0; k < ball.n_vert; ++k) {
            v3_add(all.vert[n++], s->mesh.vert[i], ball.vert[k]);
        }
    }
    CLX_TRY(clast_mesh_hull(&all, mesh));
done:
    clast_mesh_free(&ball);
    clast_mesh_free(&all);
    return status;
}

/// A centroid at the origin, but for rounding, stays there: what clast wrote comes back as it was.
static void keep_vertices(const clast_mesh *mesh, clast_shape *shape)
{
    if (v3_norm(shape->source_origin) <= CENTRED * shape->bounding_radius) {
        memcpy(shape->mesh.vert, mesh->vert, (size_t)mesh->n_vert * sizeof *mesh->vert);
        v3_set(shape->source_origin, 0.0, 0.0, 0.0);
    }
}

static clast_status add_solid(solid *s, clast_assembly *a)
{
    clast_status status = CLAST_OK;
    clast_mesh hull = {0};
    clast_shape shape = {0};
    CLX_CHECK(s->name[0] != '\0' && s->mesh.n_vert > 0, CLAST_E_FORMAT,
              "a shape without a name or vertices");
    CLX_CHECK(s->radius >= 0.0 && (s->radius > 0.0 || s->mesh.n_vert > 3), CLAST_E_FORMAT,
              "shape %s has no body: radius %g, %d vertices", s->name, s->radius, s->mesh.n_vert);
    CLX_TRY(orient(s));
    if (s->mesh.n_vert == 1) {
        CLX_TRY(clast_shape_sphere(s->name, s->radius, &shape));
        v3_copy(shape.source_origin, s->mesh.vert[0]);
    } else if (s->radius == 0.0 && s->mesh.n_tri > 3) {
        CLX_TRY(clast_shape_mesh(s->name, &s->mesh, &shape));
        keep_vertices(&s->mesh, &shape);
    } else {
        CLX_TRY(dilate(s, &hull));
        CLX_TRY(clast_shape_mesh(s->name, &hull, &shape));
    }
    CLX_TRY(clast_assembly_add_shape(a, &shape, NULL));
done:
    clast_shape_free(&shape);
    clast_mesh_free(&hull);
    return status;
}

static clast_status read_line(shape_library *l, clx_word word, clast_assembly *a)
{
    clast_status status = CLAST_OK;
    clx_word name;
    if (clx_word_is(word, "<")) {
        clast_mesh_free(&l->now.mesh);
        l->now = (solid){{0}, 0.0, {0}};
    } else if (clx_word_is(word, ">")) {
        CLX_TRY(add_solid(&l->now, a));
    } else if (clx_word_is(word, "name")) {
        CLX_CHECK(clx_text_word(&l->text, &name), CLAST_E_FORMAT, "a shape's name is missing");
        CLX_TRY(copy_word(name, l->now.name, sizeof l->now.name));
    } else if (clx_word_is(word, "radius")) {
        CLX_TRY(clx_text_number(&l->text, "radius", &l->now.radius));
    } else if (clx_word_is(word, "nv")) {
        CLX_TRY(read_vertices(l));
    } else if (clx_word_is(word, "nf")) {
        CLX_TRY(read_faces(l));
    } else if (clx_word_is(word, "ne")) {
        int64_t n = 0;
        CLX_TRY(read_count(l, "ne", &n));
        for (int64_t i = 0; i < n; ++i) {
            double edge[2];
            CLX_TRY(next_numbers(l, "an edge", 2, edge));
        }
    } // others follow from these
done:
    return status;
}

static clast_status read_library(const char *file, const char *bytes, size_t n, clast_assembly *a)
{
    shape_library l = {.text = clx_text_begin(bytes, n, '#', false), .file = file};
    clx_word word;
    clast_status status = CLAST_OK;
    bool more = true;
    while (more && status == CLAST_OK) {
        if (clx_text_word(&l.text, &word)) {
            status = read_line(&l, word, a);
        }
        more = status == CLAST_OK && clx_text_next_line(&l.text);
    }
    if (status != CLAST_OK) {
        clx_fail_prefix("%s:%" PRId64, file, l.text.line);
    }
    clast_mesh_free(&l.now.mesh);
    return status;
}

/// What a configuration says of its groups.
typedef struct {
    clx_text text;
    int32_t n_density;
    double group[MOST_GROUPS], density[MOST_GROUPS];
    char *library;
    clast_assembly *assembly; ///< NULL: only the library's name is looked for
    bool has_library;
} configuration;

/// Density of a group, or 1 where the file tells none at all.
static clast_status find_density(const configuration *c, double group, double *density)
{
    for (int32_t i = c->n_density; i-- > 0;) {
        if (c->group[i] == group) {
            *density = c->density[i];
            return CLAST_OK;
        }
    }
    *density = 1.0;
    return c->n_density == 0 ? CLAST_OK
                             : clx_fail(CLAST_E_FORMAT, "group %g has no density", group);
}

/// name group cluster homothety, position, velocity, acceleration, quaternion, ...
static clast_status read_particle(configuration *c, int n, const clx_word *word)
{
    clast_status status = CLAST_OK;
    clast_assembly *a = c->assembly;
    double x[LEAST_WORDS] = {0.0};
    double density = 1.0;
    double arm[3];
    char name[NAME];
    char shown[CLX_WORD_SHOWN];
    int32_t shape = 0;
    CLX_CHECK(n >= LEAST_WORDS, CLAST_E_FORMAT, "%d words, a particle has 23", n);
    CLX_TRY(copy_word(word[0], name, sizeof name));
    while (shape < a->n_shape && strcmp(a->shape[shape].name, name) != 0) {
        ++shape;
    }
    CLX_CHECK(shape < a->n_shape, CLAST_E_FORMAT, "shape '%s' is none of its library", name);
    for (int k = 1; k < LEAST_WORDS; ++k) {
        CLX_CHECK(clx_word_number(word[k], &x[k]), CLAST_E_FORMAT, "word %d, '%s', is no number",
                  k + 1, clx_word_show(word[k], shown));
    }
    CLX_TRY(find_density(c, x[1], &density));
    double *q = &x[13];
    const double length = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    CLX_CHECK(length > 0.5 && length < 2.0, CLAST_E_FORMAT,
              "(%g, %g, %g, %g) is no quaternion of length 1", q[0], q[1], q[2], q[3]);
    if (fabs(length - 1.0) > CENTRED) {
        q_unit(q);
    }
    q_rotate(arm, q, a->shape[shape].source_origin);
    v3_axpy(&x[4], &x[4], x[3], arm);
    status = clast_assembly_add_grain(a, shape, &x[4], q, x[3], density);
    status = status == CLAST_E_USAGE ? CLAST_E_FORMAT : status;
done:
    return status;
}

static clast_status read_particles(configuration *c, int64_t n)
{
    clast_status status = CLAST_OK;
    clx_word word[MOST_WORDS];
    for (int64_t i = 0; i < n;) {
        int k = 0;
        CLX_CHECK(clx_text_next_line(&c->text), CLAST_E_FORMAT,
                  "the file ends after %" PRId64 " of %" PRId64 " particles", i, n);
        while (k < MOST_WORDS && clx_text_word(&c->text, &word[k])) {
            ++k;
        }
        if (k > 0) {
            CLX_TRY(read_particle(c, k, word));
            ++i;
        }
    }
done:
    return status;
}

static clast_status read_key(configuration *c, clx_word key)
{
    clast_status status = CLAST_OK;
    clx_word word;
    int64_t n = 0;
    if (clx_word_is(key, "shapefile")) {
        CLX_CHECK(clx_text_word(&c->text, &word), CLAST_E_FORMAT, "shapeFile names no file");
        CLX_TRY(copy_word(word, c->library, 4096));
        c->has_library = true;
    } else if (clx_word_is(key, "density")) {
        const int32_t at = c->n_density;
        CLX_CHECK(at < MOST_GROUPS, CLAST_E_LIMIT, "more than %d densities", MOST_GROUPS);
        CLX_TRY(clx_text_number(&c->text, "group", &c->group[at]));
        CLX_TRY(clx_text_number(&c->text, "density", &c->density[at]));
        ++c->n_density;
    } else if (clx_word_is(key, "ndriven")) {
        CLX_TRY(clx_text_integer(&c->text, "nDriven", 0, INT32_MAX, &n));
        CLX_CHECK(n == 0, CLAST_E_FORMAT,
                  "its first %" PRId64 " bodies are driven (nDriven), walls of Rockable: take them "
                  "out and give walls by domain",
                  n);
    } else if (clx_word_is(key, "particles") && c->assembly != NULL) {
        CLX_TRY(clx_text_integer(&c->text, "Particles", 0, c->text.end - c->text.at, &n));
        CLX_TRY(read_particles(c, n));
    }
done:
    return status;
}

/// Goes over a configuration, whose first word the cursor is behind.
static clast_status read_configuration(configuration *c, const char *name)
{
    clast_status status = CLAST_OK;
    clx_word word;
    bool more = true;
    if (!clx_text_word(&c->text, &word) || !clx_word_is(word, "rockable")) {
        return clx_fail(CLAST_E_FORMAT, "%s:1: a configuration begins with 'Rockable DATE'", name);
    }
    while (more && status == CLAST_OK) {
        more = clx_text_next_line(&c->text);
        if (more && clx_text_word(&c->text, &word)) {
            status = read_key(c, word);
        }
    }
    if (status == CLAST_OK && !c->has_library) {
        status = clx_fail(CLAST_E_FORMAT, "no shapeFile is named");
    }
    if (status != CLAST_OK) {
        clx_fail_prefix("%s:%" PRId64, name, c->text.line);
    }
    return status;
}

clast_status clx_rockable_library(clx_rockable_files *files)
{
    configuration c = {.text = clx_text_begin(files->bytes, files->n, '#', false),
                       .library = files->library};
    return read_configuration(&c, files->name);
}

clast_status clx_rockable(clx_rockable_files *files, clast_assembly *assembly)
{
    clast_status status = CLAST_OK;
    configuration c = {.text = clx_text_begin(files->bytes, files->n, '#', false),
                       .library = files->library,
                       .assembly = assembly};
    CLX_TRY(read_library(files->library, files->shapes, files->n_shape, assembly));
    CLX_TRY(read_configuration(&c, files->name));
    (void)snprintf(assembly->unit, sizeof assembly->unit, "model");
    assembly->no_density = c.n_density == 0;
done:
    return status;
}
