#pragma once
// Whether what a caller has filled himself holds together: counts that are not negative, arrays
// where counts say so, numbers of items that exist. Each noun has one function for it, in its own
// folder.
#include "base/status.h"

typedef struct clast_text_list clast_text_list;

/// Refuses the argument `object` of a public function where `noun`'s rules do not hold.
#define CLX_WHOLE(noun, object)                                                                    \
    CLX_GUARD(clx_fault_given(__func__, #object, clx_##noun##_fault(object)))

/// CLAST_E_ARGUMENT with the fault; CLAST_OK for none (NULL).
CLX_SHARED clast_status clx_fault_given(const char *function, const char *name, const char *fault);

/// What is wrong with a table, for people, or NULL.
CLX_SHARED const char *clx_table_fault(const clast_table *table);

/// CLAST_E_ARGUMENT for a list with a negative count, without items, or with one that is NULL.
clast_status clx_texts_given(const char *function, const char *name, const clast_text_list *list);

/// n >= 0 items have an array.
static inline bool clx_has_array(const void *array, int64_t n)
{
    return n >= 0 && (n == 0 || array != NULL);
}
