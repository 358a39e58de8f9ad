#pragma once
// --resume: everything but the folder comes from the run itself.
#include "command.h"

/// Refuses options and -o beside --resume, which would overrule them.
///
/// @param folder  the run's    @param config  of `size` bytes, as the command line made it
/// @param free_option  an option that may be given all the same, or NULL
/// @return CLAST_E_USAGE naming an option that was changed, CLAST_E_MEMORY
clast_status cli_resume_check(const cli_common *common, const char *folder,
                              const clast_field *fields, const void *config, size_t size,
                              const char *free_option);
