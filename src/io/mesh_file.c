// Surfaces from files and to files: which format, and the way there and back.
#include <clast/mesh.h>

#include "base/alloc.h"
#include "base/file.h"
#include "base/path.h"
#include "base/status.h"
#include "geom/whole.h"
#include "io/mesh_io.h"
#include <clast/field.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

static const struct {
    clast_mesh_format format;
    const char *name;
} names[] = {{CLAST_MESH_STL, "stl"},
             {CLAST_MESH_OBJ, "obj"},
             {CLAST_MESH_PLY, "ply"},
             {CLAST_MESH_OFF, "off"},
             {CLAST_MESH_3MF, "3mf"}};

enum { N_NAME = sizeof names / sizeof names[0] };

const char *clast_mesh_format_name(clast_mesh_format format)
{
    for (int i = 0; i < N_NAME; ++i) {
        if (names[i].format == format) {
            return names[i].name;
        }
    }
    return "any";
}

clast_mesh_format clast_mesh_format_of_path(const char *path)
{
    if (path == NULL) {
        return (clast_mesh_format){0};
    }
    for (int i = 0; i < N_NAME; ++i) {
        if (clx_path_is(path, names[i].name)) {
            return names[i].format;
        }
    }
    return CLAST_MESH_ANY;
}

static clast_status parse(const void *bytes, size_t n, clast_mesh_format format, clast_mesh *mesh,
                          clast_mesh_read_report *report)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(n > 0, CLAST_E_FORMAT, "the file is empty (0 bytes)");
    CLX_CHECK(clx_stl_is_exact(bytes, n) || !clx_text_is_utf16(bytes, n), CLAST_E_FORMAT,
              "byte 0: this is UTF-16 text; save it as UTF-8 or ASCII");
    switch (format) {
    case CLAST_MESH_STL:
        return clx_stl_parse(bytes, n, mesh, report);
    case CLAST_MESH_OBJ:
        return clx_obj_parse(bytes, n, mesh, report);
    case CLAST_MESH_PLY:
        return clx_ply_parse(bytes, n, mesh, report);
    case CLAST_MESH_OFF:
        return clx_off_parse(bytes, n, mesh, report);
    case CLAST_MESH_3MF:
        return clx_fail(CLAST_E_FORMAT, "this is a 3MF or ZIP file: 3MF is written only; STL, OBJ, "
                                        "PLY and OFF are read");
    default:
        return clx_fail(CLAST_E_FORMAT, "neither content nor name say that this is a surface; STL, "
                                        "OBJ, PLY and OFF are read");
    }
done:
    return status;
}

static bool skip_word(const char **text, const char *word)
{
    const size_t n = strlen(word);
    const bool is_there = strncmp(*text, word, n) == 0;
    *text += is_there ? n : 0;
    return is_there;
}

/// The unit in the line "clast VERSION, unit U" that our writers begin with (in an STL "clast
/// VERSION binary STL, unit U"); "" where there is none, or none of length.
static void find_unit(const char *bytes, size_t n, char unit[16])
{
    static const char *const before[] = {"", "# ", "OFF\n# ",
                                         "ply\nformat binary_little_endian 1.0\ncomment "};
    static const char *const after[] = {", unit ", " binary STL, unit "};
    char head[128] = "";
    double factor = 0.0;
    memcpy(head, bytes, n < sizeof head ? n : sizeof head - 1);
    unit[0] = '\0';
    for (int k = 0; k < 8; ++k) {
        const char *text = head;
        if (!skip_word(&text, before[k / 2]) || !skip_word(&text, "clast ")) {
            continue;
        }
        text += strcspn(text, " ,\n"); // the version
        const size_t length = skip_word(&text, after[k % 2]) ? strcspn(text, ",\r\n") : 0;
        if (length > 0 && length < 16) {
            (void)snprintf(unit, 16, "%.*s", (int)length, text);
        }
    }
    if (unit[0] != '\0' && clast_unit_factor(unit, "m", &factor) != CLAST_OK) {
        unit[0] = '\0'; // "not stated", "model"
    }
}

clast_status clast_mesh_parse(const void *bytes, size_t n, clast_mesh_format format,
                              clast_mesh *mesh, clast_mesh_read_report *report)
{
    CLX_ARGUMENTS(mesh);
    CLX_ARRAY(bytes, n);
    clast_mesh made = {0};
    const clast_mesh_format by_content = clx_mesh_detect(bytes, n);
    clast_mesh_read_report found = {.format = format != CLAST_MESH_ANY ? format : by_content,
                                    .n_byte = (int64_t)n};
    const clast_status status = parse(bytes, n, found.format, &made, &found);
    if (status == CLAST_OK) {
        find_unit(bytes, n, found.unit);
        *mesh = made;
        if (report != NULL) {
            *report = found;
        }
    }
    return status;
}

clast_status clast_mesh_read(const char *path, clast_mesh *mesh, clast_mesh_read_report *report)
{
    CLX_ARGUMENTS(path, mesh);
    clast_status status = CLAST_OK;
    char *bytes = NULL;
    int64_t n = 0;
    clast_mesh_read_report found = {0};
    const clast_mesh_format by_name = clast_mesh_format_of_path(path);
    CLX_TRY(clx_file_read_all(path, INT64_MAX, &bytes, &n));
    const clast_mesh_format by_content = clx_mesh_detect(bytes, (size_t)n);
    status = clast_mesh_parse(bytes, (size_t)n, by_content != CLAST_MESH_ANY ? by_content : by_name,
                              mesh, &found);
    if (status != CLAST_OK) {
        clx_fail_prefix("%s", path);
        goto done;
    }
    if (by_name != CLAST_MESH_ANY && by_name != found.format) {
        clx_report_warn(&found, "the content is %s although the name says %s",
                        clast_mesh_format_name(found.format), clast_mesh_format_name(by_name));
    }
    if (report != NULL) {
        *report = found;
    }
done:
    clx_free(bytes);
    return status;
}

static clast_status check_mesh(const clast_mesh *mesh)
{
    for (int32_t i = 0; i < mesh->n_vert; ++i) {
        for (int k = 0; k < 3; ++k) {
            if (!isfinite(mesh->vert[i][k])) {
                return clx_fail(CLAST_E_GEOMETRY, "coordinate %c of vertex %d is %g, not finite",
                                "xyz"[k], i, mesh -> vert[i][k]);
            }
        }
    }
    return CLAST_OK;
}

/// Units are told in headers: only those that the unit table knows, or "model".
static clast_status check_unit(const char *unit)
{
    double factor = 0.0;
    if (unit == NULL || strcmp(unit, "model") == 0) {
        return CLAST_OK;
    }
    return clast_unit_factor(unit, "m", &factor) == CLAST_OK ? CLAST_OK : CLAST_E_USAGE;
}

static clast_status write_format(clast_mesh_format format, const clast_mesh *mesh,
                                 const clast_mesh_write_options *options, clx_file *file)
{
    switch (format) {
    case CLAST_MESH_STL:
        return clx_stl_write(mesh, options, file);
    case CLAST_MESH_OBJ:
        return clx_obj_write(mesh, options, file);
    case CLAST_MESH_PLY:
        return clx_ply_write(mesh, options, file);
    case CLAST_MESH_OFF:
        return clx_off_write(mesh, options, file);
    case CLAST_MESH_3MF:
        return clx_threemf_write(mesh, options, file);
    default:
        return clx_fail(CLAST_E_USAGE, "no surface format has the number %d", (int)format);
    }
}

clast_status clast_mesh_write(const clast_mesh *mesh, const char *path,
                              const clast_mesh_write_options *options)
{
    CLX_ARGUMENTS(path, mesh);
    CLX_WHOLE(mesh, mesh);
    clast_status status = CLAST_OK;
    clx_file file = {0};
    const clast_mesh_write_options o = options != NULL ? *options : (clast_mesh_write_options){0};
    const clast_mesh_format format =
        o.format != CLAST_MESH_ANY ? o.format : clast_mesh_format_of_path(path);
    CLX_CHECK(format != CLAST_MESH_ANY, CLAST_E_USAGE,
              "no surface format by that name; write .stl, .obj, .ply, .off or .3mf");
    CLX_TRY(check_unit(o.unit));
    CLX_TRY(check_mesh(mesh));
    CLX_TRY(clx_file_begin(path, &file));
    CLX_TRY(write_format(format, mesh, &o, &file));
    CLX_TRY(clx_file_commit(&file));
done:
    if (status == CLAST_E_USAGE || status == CLAST_E_GEOMETRY) {
        clx_fail_prefix("%s", path);
    }
    clx_file_abandon(&file);
    return status;
}
