#pragma once
// Types of numbers in VTK's files, old and new.
#include "base/status.h"

typedef enum {
    CLX_VTK_F32,
    CLX_VTK_F64,
    CLX_VTK_I8,
    CLX_VTK_U8,
    CLX_VTK_I16,
    CLX_VTK_U16,
    CLX_VTK_I32,
    CLX_VTK_U32,
    CLX_VTK_I64,
    CLX_VTK_U64
} clx_vtk_number;

/// Type by its name in legacy ("unsigned_char") or XML ("UInt8") files of any case; false for
/// others.
bool clx_vtk_number_of(const char *name, size_t length, clx_vtk_number *type);

/// Bytes of one number.
int clx_vtk_number_size(clx_vtk_number type);

/// n numbers at `from` to doubles; big: most significant byte first.
void clx_vtk_numbers(const void *from, int64_t n, clx_vtk_number type, bool big, double *value);
