// Types of numbers in VTK's files, old and new.
#include "io/vtk_number.h"

#include <string.h>
#include <strings.h>

bool clx_vtk_number_of(const char *name, size_t length, clx_vtk_number *type)
{
    static const struct {
        const char *name;
        clx_vtk_number type;
    } names[] = {{"float32", CLX_VTK_F32},
                 {"float64", CLX_VTK_F64},
                 {"int8", CLX_VTK_I8},
                 {"uint8", CLX_VTK_U8},
                 {"int16", CLX_VTK_I16},
                 {"uint16", CLX_VTK_U16},
                 {"int32", CLX_VTK_I32},
                 {"uint32", CLX_VTK_U32},
                 {"int64", CLX_VTK_I64},
                 {"uint64", CLX_VTK_U64},
                 {"float", CLX_VTK_F32},
                 {"double", CLX_VTK_F64},
                 {"char", CLX_VTK_I8},
                 {"unsigned_char", CLX_VTK_U8},
                 {"short", CLX_VTK_I16},
                 {"unsigned_short", CLX_VTK_U16},
                 {"int", CLX_VTK_I32},
                 {"unsigned_int", CLX_VTK_U32},
                 {"long", CLX_VTK_I64},
                 {"unsigned_long", CLX_VTK_U64},
                 {"vtkidtype", CLX_VTK_I32},
                 {"vtktypeint64", CLX_VTK_I64},
                 {"vtktypeuint64", CLX_VTK_U64},
                 {"vtktypeint32", CLX_VTK_I32},
                 {"vtktypefloat32", CLX_VTK_F32},
                 {"vtktypefloat64", CLX_VTK_F64}};
    for (size_t k = 0; k < sizeof names / sizeof names[0]; ++k) {
        if (strlen(names[k].name) == length && strncasecmp(names[k].name, name, length) == 0) {
            *type = names[k].type;
            return true;
        }
    }
    return false;
}

int clx_vtk_number_size(clx_vtk_number type)
{
    static const int size[] = {4, 8, 1, 1, 2, 2, 4, 4, 8, 8};
    return size[type];
}

/// The low bits as a signed number of `bits` bits.
static int64_t as_signed(uint64_t word, int bits)
{
    const uint64_t sign = UINT64_C(1) << (bits - 1);
    int64_t value = 0;
    word = (word ^ sign) - sign; // two's complement, extended
    memcpy(&value, &word, sizeof value);
    return value;
}

static double to_double(uint64_t word, clx_vtk_number type)
{
    if (type == CLX_VTK_F32) {
        const uint32_t low = (uint32_t)word;
        float value = 0.0F;
        memcpy(&value, &low, sizeof value);
        return (double)value;
    }
    if (type == CLX_VTK_F64) {
        double value = 0.0;
        memcpy(&value, &word, sizeof value);
        return value;
    }
    const bool is_signed =
        type == CLX_VTK_I8 || type == CLX_VTK_I16 || type == CLX_VTK_I32 || type == CLX_VTK_I64;
    return is_signed ? (double)as_signed(word, 8 * clx_vtk_number_size(type)) : (double)word;
}

void clx_vtk_numbers(const void *from, int64_t n, clx_vtk_number type, bool big, double *value)
{
    const uint8_t *b = from;
    const int size = clx_vtk_number_size(type);
    for (int64_t i = 0; i < n; ++i) {
        uint64_t word = 0;
        for (int k = 0; k < size; ++k) {
            word = word << 8 | b[i * size + (big ? k : size - 1 - k)];
        }
        value[i] = to_double(word, type);
    }
}
