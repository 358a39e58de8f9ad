#pragma once
#include <clast/porosity_model.h>

CLAST_BEGIN

// Porosity models from files and to files.

/// Reads a model file, JSON as clast_porosity_model_write makes it.
///
/// @return CLAST_E_IO, CLAST_E_FORMAT (with the key), CLAST_E_LIMIT beyond 1 MiB or 1000 terms
CLAST_API clast_status clast_porosity_model_read(const char *path, clast_porosity_model *model);

/// The same from memory; `name` stands for the path in messages.
CLAST_API clast_status clast_porosity_model_parse(const char *name, const void *bytes, size_t n,
                                                  clast_porosity_model *model);

/// Writes the model as JSON that reads back as the same doubles; the file appears whole or not at
/// all.
///
/// @param provenance  [n][2] keys and texts kept with it, may be NULL
CLAST_API clast_status clast_porosity_model_write(const clast_porosity_model *model,
                                                  const char *const (*provenance)[2], int32_t n,
                                                  const char *path);

CLAST_END
