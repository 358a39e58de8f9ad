#pragma once
#include <clast/domain.h>

CLAST_BEGIN

/// As clast_domain_parse, and "mesh:FILE": the inside of a closed surface (STL, OBJ, PLY, OFF).
///
/// @param unit  of bare lengths and of the file's coordinates ("mm"); NULL or "": metres
/// @return as clast_mesh_read and clast_domain_of_mesh, with the file's name; CLAST_E_CONFIG for an
/// unknown unit
CLAST_API clast_status clast_domain_read(const char *text, const char *unit, clast_domain *domain);

CLAST_END
