// Domains named on the command line; those bounded by a surface are read from its file.
#include <clast/cloud.h>

#include "base/status.h"
#include <clast/field.h>
#include <clast/mesh.h>
#include <clast/mesh_repair.h>
#include <stdio.h>
#include <string.h>

static const char prefix[] = "mesh:";

static clast_status read_mesh(const char *path, const char *unit, clast_domain *domain)
{
    clast_status status = CLAST_OK;
    clast_mesh mesh = {0};
    clast_mesh_read_report report = {0};
    double scale = 1.0;
    CLX_TRY(clast_mesh_read(path, &mesh, &report));
    CLX_TRY(clast_mesh_require_unit(path, &report, unit));
    unit = unit[0] != '\0' ? unit : report.unit;
    CLX_TRY(unit[0] != '\0' ? clast_unit_factor(unit, "m", &scale) : CLAST_OK);
    CLX_TRY(clast_mesh_weld_auto(&mesh, NULL));
    CLX_TRY(clast_mesh_require_solid(&mesh, path, NULL));
    status = clast_domain_of_mesh(&mesh, scale, domain);
    if (status != CLAST_OK) {
        char why[512];
        (void)snprintf(why, sizeof why, "%s", clast_error_detail());
        (void)clx_fail(status, "%s: %s", path, why);
    }
done:
    clast_mesh_free(&mesh);
    return status;
}

clast_status clast_domain_read(const char *text, const char *unit, clast_domain *domain)
{
    CLX_ARGUMENTS(text, domain);
    clast_status status = CLAST_OK;
    double scale = 1.0;
    unit = unit != NULL ? unit : "";
    CLX_TRY(unit[0] != '\0' ? clast_unit_factor(unit, "m", &scale) : CLAST_OK);
    status = strncmp(text, prefix, sizeof prefix - 1) == 0
                 ? read_mesh(text + sizeof prefix - 1, unit, domain)
                 : clast_domain_parse_in(text, scale, domain);
done:
    return status;
}
