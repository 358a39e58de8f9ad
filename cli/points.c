// Options that say which columns of a file hold what.
#include "points.h"

#define TEXT(name, help)                                                                           \
    {                                                                                              \
#name, offsetof(clast_cloud_columns, name), CLAST_FIELD_TEXT, 0, 0, 0, "-", help, ""       \
    }
static const clast_field table[] = {
    {"columns", offsetof(clast_cloud_columns, columns), CLAST_FIELD_TEXT_LIST, 0, 0, 0, "-",
     "columns of the coordinates, as many as dimensions", "x,y,z"},
    TEXT(radius_column, "column of radii [m]"),
    TEXT(diameter_column, "column of diameters [m], instead of radii"),
    TEXT(mass_column, "column of masses [kg]"),
    {"velocity_columns", offsetof(clast_cloud_columns, velocity_columns), CLAST_FIELD_TEXT_LIST, 0,
     0, 0, "-", "columns of velocities [m/s], as many as dimensions", ""},
    TEXT(weight_column, "column of weights: real particles that a parcel stands for"),
};
#undef TEXT

int cli_point_fields(clast_field *fields, int n, size_t offset)
{
    for (size_t k = 0; k < sizeof table / sizeof table[0]; ++k) {
        fields[n] = table[k];
        fields[n++].offset += offset;
    }
    return n;
}
