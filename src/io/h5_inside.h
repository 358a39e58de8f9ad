#pragma once
// What h5.c and h5_read.c share.
#include "io/h5.h"

#define H5_USE_110_API 1 // some functions take other arguments from 1.12 on
#include <hdf5.h>

struct clx_h5 {
    hid_t file;
    bool is_writing;
    char label[256]; ///< file's name for messages
};

/// One thread at a time inside HDF5, with its printing of errors off.
typedef struct clx_h5_session {
    H5E_auto2_t report;
    void *context;
} clx_h5_session;
clx_h5_session clx_h5_enter(void);
void clx_h5_leave(const clx_h5_session *session);

hid_t clx_h5_memory_type(clx_h5_type type);
hid_t clx_h5_file_type(clx_h5_type type);
size_t clx_h5_type_size(clx_h5_type type);
