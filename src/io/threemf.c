// 3MF, for printers: one object in millimetres in a ZIP [3MF core specification 1.3].
#include "base/file.h"
#include "base/number.h"
#include "base/status.h"
#include "io/mesh_io.h"
#include "io/zip.h"
#include <clast/field.h>
#include <stdio.h>
#include <string.h>

static const char content_types[] =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">"
    "<Default Extension=\"rels\" "
    "ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>"
    "<Default Extension=\"model\" "
    "ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/></Types>\n";

static const char relations[] =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
    "<Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
    "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>\n";

static clast_status write_entry(clx_zip *zip, const char *name, const char *text)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_zip_begin_entry(zip, name));
    CLX_TRY(clx_zip_write(zip, text, strlen(text)));
    CLX_TRY(clx_zip_end_entry(zip));
done:
    return status;
}

/// Text for an attribute; control characters and what does not fit are left out.
static void escape(const char *text, char *out, size_t size)
{
    static const struct {
        char letter;
        const char *entity;
    } special[] = {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}};
    size_t n = 0;
    for (; *text != '\0' && n + 8 < size; ++text) {
        const char *entity = NULL;
        for (size_t i = 0; i < sizeof special / sizeof special[0]; ++i) {
            entity = special[i].letter == *text ? special[i].entity : entity;
        }
        if (entity != NULL) {
            n += (size_t)snprintf(out + n, size - n, "%s", entity);
        } else if (*text >= ' ' && *text <= '~') {
            out[n++] = *text;
        }
    }
    out[n] = '\0';
}

static clast_status write_vertices(clx_zip *zip, const clast_mesh *mesh, double scale)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_zip_print(zip, "<mesh><vertices>\n"));
    for (int32_t i = 0; i < mesh->n_vert; ++i) {
        char number[3][CLX_NUMBER_SIZE];
        for (int k = 0; k < 3; ++k) {
            (void)clx_number_format(scale * mesh->vert[i][k], number[k]);
        }
        CLX_TRY(clx_zip_print(zip, "<vertex x=\"%s\" y=\"%s\" z=\"%s\"/>\n", number[0], number[1],
                              number[2]));
    }
    CLX_TRY(clx_zip_print(zip, "</vertices>"));
done:
    return status;
}

static clast_status write_triangles(clx_zip *zip, const clast_mesh *mesh)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_zip_print(zip, "<triangles>\n"));
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        const int32_t *tri = mesh->tri[t];
        CLX_TRY(clx_zip_print(zip, "<triangle v1=\"%d\" v2=\"%d\" v3=\"%d\"/>\n", tri[0], tri[1],
                              tri[2]));
    }
    CLX_TRY(clx_zip_print(zip, "</triangles></mesh>"));
done:
    return status;
}

static clast_status write_model(clx_zip *zip, const clast_mesh *mesh, const char *name,
                                double scale)
{
    clast_status status = CLAST_OK;
    char escaped[256];
    escape(name, escaped, sizeof escaped);
    CLX_TRY(clx_zip_begin_entry(zip, "3D/3dmodel.model"));
    CLX_TRY(clx_zip_print(
        zip,
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"millimeter\" xml:lang=\"en-US\" "
        "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">"
        "<metadata name=\"Application\">clast %s</metadata><resources>"
        "<object id=\"1\" type=\"model\" name=\"%s\">",
        clast_version(), escaped));
    CLX_TRY(write_vertices(zip, mesh, scale));
    CLX_TRY(write_triangles(zip, mesh));
    CLX_TRY(clx_zip_print(zip, "</object></resources><build><item objectid=\"1\"/></build>"
                               "</model>\n"));
    CLX_TRY(clx_zip_end_entry(zip));
done:
    return status;
}

/// Millimetres in one of the unit; the format demands triangles of three different vertices.
static clast_status check(const clast_mesh *mesh, const char *unit, double *scale)
{
    clast_status status = CLAST_OK;
    double metre = 0.0;
    CLX_CHECK(unit != NULL && strcmp(unit, "model") != 0, CLAST_E_USAGE,
              "3MF is in millimetres: say which unit the coordinates have");
    CLX_TRY(clast_unit_factor(unit, "m", &metre));
    CLX_CHECK(mesh->n_tri > 0, CLAST_E_GEOMETRY, "3MF needs at least one triangle");
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        const int32_t *v = mesh->tri[t];
        CLX_CHECK(v[0] != v[1] && v[1] != v[2] && v[2] != v[0], CLAST_E_GEOMETRY,
                  "triangle %d names a vertex twice, which 3MF forbids; run `clast mesh repair`",
                  t);
    }
    *scale = 1000.0 * metre;
done:
    return status;
}

clast_status clx_threemf_write(const clast_mesh *mesh, const clast_mesh_write_options *options,
                               clx_file *file)
{
    clast_status status = CLAST_OK;
    clx_zip zip = {.file = file};
    double scale = 1.0;
    CLX_TRY(check(mesh, options->unit, &scale));
    CLX_TRY(write_entry(&zip, "[Content_Types].xml", content_types));
    CLX_TRY(write_entry(&zip, "_rels/.rels", relations));
    CLX_TRY(write_model(&zip, mesh, options->name != NULL ? options->name : "surface", scale));
    CLX_TRY(clx_zip_finish(&zip));
done:
    clx_zip_free(&zip);
    return status;
}
