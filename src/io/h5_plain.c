// In place of h5.c and h5_read.c where clast is built without HDF5: named arrays and attributes in
// memory; h5_plain_image.c and h5_plain_parse.c turn them into a file and back.
#include "io/h5_plain.h"

#include "base/alloc.h"
#include "base/file.h"
#include "io/h5_trailer.h"
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ATTRIBUTE_LIMIT = 65000 }; // bytes that fit a header's message
static const clx_h5_node nothing = {0};
static const int64_t file_limit = INT64_C(1) << 40;

clast_status clx_h5_available(void)
{
    return CLAST_OK;
}

static uint32_t hash_of(const char *name)
{
    return clx_h5_sum(name, (int64_t)strlen(name));
}

/// Where a name stands among the slots, or the empty one where it would.
static int64_t *slot_of(const clx_h5 *h5, const char *name, uint32_t hash)
{
    for (int64_t k = hash;; ++k) {
        int64_t *slot = &h5->slot[k & (h5->n_slot - 1)];
        const int64_t i = *slot - 1;
        if (i < 0 || (h5->node[i].hash == hash && strcmp(h5->node[i].name, name) == 0)) {
            return slot;
        }
    }
}

/// Number of an array or folder, -1 if there is none.
static int64_t find(const clx_h5 *h5, const char *name)
{
    return *slot_of(h5, name, hash_of(name)) - 1;
}

/// Ensures a slot for one name more.
static clast_status grow_slots(clx_h5 *h5)
{
    clast_status status = CLAST_OK;
    int64_t *slot = NULL;
    const int64_t n = h5->n_slot > 0 ? 2 * h5->n_slot : 32;
    if (2 * (h5->n + 1) <= h5->n_slot) {
        return CLAST_OK;
    }
    CLX_TRY(clx_alloc(&slot, n, sizeof *slot));
    clx_free(h5->slot);
    h5->slot = slot;
    h5->n_slot = n;
    for (int64_t i = 0; i < h5->n; ++i) {
        *slot_of(h5, h5->node[i].name, h5->node[i].hash) = i + 1;
    }
done:
    return status;
}

/// Number of the folder that holds `name`, -1 if there is none.
static int64_t parent_of(const clx_h5 *h5, const char *name)
{
    char part[CLX_H5_NAME_LIMIT];
    const char *slash = strrchr(name, '/');
    const int n = slash == name ? 1 : (int)(slash - name);
    (void)snprintf(part, sizeof part, "%.*s", n, name);
    return find(h5, part);
}

clast_status clx_h5_plain_add(clx_h5 *h5, const char *name, int64_t *number)
{
    clast_status status = CLAST_OK;
    clx_free(h5->member);
    h5->member = NULL;
    clx_h5_node made = {.hash = hash_of(name)};
    int64_t parent = -1;
    CLX_TRY(grow_slots(h5));
    if (h5->n > 0) {
        parent = parent_of(h5, name);
        CLX_CHECK(parent >= 0 && h5->node[parent].is_folder, CLAST_E_FORMAT,
                  "%s: %s lies in no folder", h5->label, name);
        CLX_CHECK(find(h5, name) < 0, CLAST_E_USAGE, "%s is written twice", name);
    }
    CLX_TRY(clx_grow(&h5->node, &h5->capacity, h5->n + 1, sizeof *h5->node));
    CLX_TRY(clx_alloc_text(&made.name, name));
    if (parent >= 0) {
        clx_h5_node *folder = &h5->node[parent];
        *(folder->last > 0 ? &h5->node[folder->last].next : &folder->first) = h5->n;
        folder->last = h5->n;
    }
    *slot_of(h5, name, made.hash) = h5->n + 1;
    *number = h5->n;
    h5->node[h5->n++] = made;
done:
    return status;
}

clast_status clx_h5_plain_begin(const char *label, clx_h5 **h5)
{
    clast_status status = CLAST_OK;
    clx_h5 *made = NULL;
    int64_t root = 0;
    CLX_TRY(clx_alloc(&made, 1, sizeof *made));
    (void)snprintf(made->label, sizeof made->label, "%s", label);
    CLX_TRY(clx_h5_plain_add(made, "/", &root));
    made->node[root].is_folder = true;
    *h5 = made;
    made = NULL;
done:
    clx_h5_close(made);
    return status;
}

clast_status clx_h5_create(clx_h5 **h5)
{
    const clast_status status = clx_h5_plain_begin("state", h5);
    if (status == CLAST_OK) {
        (*h5)->is_writing = true;
    }
    return status;
}

void clx_h5_close(clx_h5 *h5)
{
    for (int64_t i = 0; h5 != NULL && i < h5->n; ++i) {
        clx_h5_node *node = &h5->node[i];
        for (int64_t k = 0; k < node->n_attribute; ++k) {
            CLX_FREE(node->attribute[k].name, node->attribute[k].value);
        }
        CLX_FREE(node->attribute, node->data, node->name);
    }
    if (h5 != NULL) {
        CLX_FREE(h5->node, h5->slot, h5->member, h5);
    }
}

clast_status clx_h5_write_folder(clx_h5 *h5, const char *name)
{
    clast_status status = CLAST_OK;
    char part[CLX_H5_NAME_LIMIT];
    CLX_TRY(clx_h5_check_name(h5->label, name));
    for (size_t n = 2; n <= strlen(name); ++n) {
        if (name[n] != '/' && name[n] != '\0') {
            continue;
        }
        int64_t number = 0;
        (void)snprintf(part, sizeof part, "%.*s", (int)n, name);
        if (find(h5, part) < 0) {
            CLX_TRY(clx_h5_plain_add(h5, part, &number));
            h5->node[number].is_folder = true;
        }
    }
done:
    return status;
}

clast_status clx_h5_write(clx_h5 *h5, const char *name, clx_h5_type type, int32_t rank,
                          const int64_t *shape, const void *data)
{
    CLAST_ASSERT(h5->is_writing && rank >= 0 && rank <= CLX_H5_RANK_LIMIT);
    clast_status status = CLAST_OK;
    char folder[CLX_H5_NAME_LIMIT];
    int64_t number = 0;
    int64_t size = clx_h5_plain_width(type);
    char *copy = NULL;
    CLX_TRY(clx_h5_check_name(h5->label, name));
    for (int32_t d = 0; d < rank; ++d) {
        CLX_CHECK(shape[d] >= 0, CLAST_E_USAGE, "%s has a size of %" PRId64, name, shape[d]);
        CLX_CHECK(shape[d] == 0 || size <= file_limit / shape[d], CLAST_E_LIMIT, "%s is too large",
                  name);
        size *= shape[d];
    }
    (void)snprintf(folder, sizeof folder, "%.*s", (int)(strrchr(name, '/') - name), name);
    if (folder[0] != '\0' && find(h5, folder) < 0) {
        CLX_TRY(clx_h5_write_folder(h5, folder));
    }
    CLX_TRY(clx_alloc(&copy, size, 1));
    CLX_TRY(clx_h5_plain_add(h5, name, &number));
    clx_h5_node *node = &h5->node[number];
    node->type = type;
    node->rank = rank;
    node->size = size;
    for (int32_t d = 0; d < rank; ++d) {
        node->shape[d] = shape[d];
    }
    if (size > 0) {
        memcpy(copy, data, (size_t)size);
    }
    node->data = copy;
    copy = NULL;
done:
    clx_free(copy);
    return status;
}

static clx_h5_attribute *find_attribute(const clx_h5 *h5, const char *object, const char *name)
{
    const int64_t number = find(h5, object);
    for (int64_t k = 0; number >= 0 && k < h5->node[number].n_attribute; ++k) {
        if (strcmp(h5->node[number].attribute[k].name, name) == 0) {
            return &h5->node[number].attribute[k];
        }
    }
    return NULL;
}

clast_status clx_h5_plain_attribute(clx_h5 *h5, int64_t node, const clx_h5_attribute *given)
{
    CLAST_ASSERT(given->size > 0);
    clast_status status = CLAST_OK;
    clx_h5_node *at = &h5->node[node];
    clx_h5_attribute made = {.is_text = given->is_text, .type = given->type, .size = given->size};
    CLX_CHECK(find_attribute(h5, at->name, given->name) == NULL, CLAST_E_USAGE,
              "attribute %s of %s is there already", given->name, at->name);
    CLX_CHECK(given->size <= ATTRIBUTE_LIMIT, CLAST_E_LIMIT,
              "attribute %s of %s has %" PRId64 " bytes; built without HDF5, clast keeps %d",
              given->name, at->name, given->size, (int)ATTRIBUTE_LIMIT);
    CLX_TRY(clx_grow(&at->attribute, &at->attribute_capacity, at->n_attribute + 1,
                     sizeof *at->attribute));
    CLX_TRY(clx_alloc(&made.value, given->size, 1));
    CLX_TRY(clx_alloc_text(&made.name, given->name));
    memcpy(made.value, given->value, (size_t)given->size);
    at->attribute[at->n_attribute++] = made;
    made.value = NULL;
done:
    clx_free(made.value);
    return status;
}

static clast_status write_attribute(clx_h5 *h5, const char *object, const clx_h5_attribute *given)
{
    clast_status status = CLAST_OK;
    const int64_t node = find(h5, object);
    CLX_CHECK(node >= 0, CLAST_E_USAGE, "attribute %s of %s, which does not exist", given->name,
              object);
    CLX_TRY(clx_h5_plain_attribute(h5, node, given));
done:
    return status;
}

clast_status clx_h5_write_text(clx_h5 *h5, const char *object, const char *name, const char *text)
{
    return write_attribute(h5, object,
                           &(clx_h5_attribute){.name = (char *)name,
                                               .is_text = true,
                                               .size = (int64_t)strlen(text) + 1,
                                               .value = (char *)text});
}

clast_status clx_h5_write_number(clx_h5 *h5, const char *object, const char *name, clx_h5_type type,
                                 const void *value)
{
    return write_attribute(h5, object,
                           &(clx_h5_attribute){.name = (char *)name,
                                               .type = type,
                                               .size = clx_h5_plain_width(type),
                                               .value = (char *)value});
}

clast_status clx_h5_commit(clx_h5 *h5, const char *path)
{
    CLAST_ASSERT(h5->is_writing);
    clast_status status = CLAST_OK;
    char *image = NULL;
    int64_t n = 0;
    CLX_TRY(clx_h5_plain_image(h5, &image, &n));
    CLX_TRY(clx_h5_write_image(path, image, n));
done:
    clx_free(image);
    return status;
}

clast_status clx_h5_open(const char *path, clx_h5 **h5)
{
    clast_status status = CLAST_OK;
    char *image = NULL;
    int64_t n = 0;
    clx_h5 *made = NULL;
    CLX_TRY(clx_h5_verify(path));
    CLX_TRY(clx_file_read_all(path, file_limit, &image, &n));
    CLX_TRY(clx_h5_plain_begin(path, &made));
    CLX_TRY(clx_h5_plain_parse(image, n - CLX_H5_TRAILER_SIZE, made));
    *h5 = made;
    made = NULL;
done:
    clx_h5_close(made);
    clx_free(image);
    return status;
}

bool clx_h5_has(clx_h5 *h5, const char *name)
{
    return find(h5, name) >= 0;
}

bool clx_h5_has_attribute(clx_h5 *h5, const char *object, const char *name)
{
    return find_attribute(h5, object, name) != NULL;
}

/// The array of this name, type and rank.
static clast_status read_array(const clx_h5 *h5, const char *name, clx_h5_type type, int32_t rank,
                               const clx_h5_node **array)
{
    CLAST_ASSERT(rank >= 0 && rank <= CLX_H5_RANK_LIMIT);
    clast_status status = CLAST_OK;
    const int64_t number = find(h5, name);
    CLX_CHECK(number >= 0 && !h5->node[number].is_folder, CLAST_E_FORMAT,
              "%s: there is no array %s", h5->label, name);
    CLX_CHECK(h5->node[number].type == type, CLAST_E_FORMAT,
              "%s: array %s holds another type of number", h5->label, name);
    CLX_CHECK(h5->node[number].rank == rank, CLAST_E_FORMAT,
              "%s: array %s does not have %d dimensions", h5->label, name, rank);
    *array = &h5->node[number];
done:
    return status;
}

clast_status clx_h5_shape(clx_h5 *h5, const char *name, clx_h5_type type, int32_t rank,
                          int64_t *shape)
{
    clast_status status = CLAST_OK;
    const clx_h5_node *array = &nothing;
    CLX_TRY(read_array(h5, name, type, rank, &array));
    memcpy(shape, array->shape, (size_t)rank * sizeof *shape);
done:
    return status;
}

clast_status clx_h5_read(clx_h5 *h5, const char *name, clx_h5_type type, int32_t rank,
                         const int64_t *shape, void *data)
{
    clast_status status = CLAST_OK;
    const clx_h5_node *array = &nothing;
    CLX_TRY(read_array(h5, name, type, rank, &array));
    for (int32_t d = 0; d < rank; ++d) {
        CLX_CHECK(array->shape[d] == shape[d], CLAST_E_FORMAT,
                  "%s: size %d of array %s is %" PRId64 ", expected %" PRId64, h5->label, d, name,
                  array->shape[d], shape[d]);
    }
    if (array->size > 0) {
        memcpy(data, array->data, (size_t)array->size);
    }
done:
    return status;
}

clast_status clx_h5_read_new(clx_h5 *h5, const char *name, clx_h5_type type, int32_t width,
                             int64_t *n, void *data)
{
    clast_status status = CLAST_OK;
    const clx_h5_node *array = &nothing;
    void *block = NULL;
    CLX_TRY(read_array(h5, name, type, width == 1 ? 1 : 2, &array));
    CLX_CHECK(width == 1 || array->shape[1] == width, CLAST_E_FORMAT,
              "%s: array %s has %" PRId64 " numbers an item, expected %d", h5->label, name,
              array->shape[1], width);
    CLX_TRY(clx_alloc(&block, array->size, 1));
    if (array->size > 0) {
        memcpy(block, array->data, (size_t)array->size);
    }
    *n = array->shape[0];
    memcpy(data, &block, sizeof block);
done:
    return status;
}

clast_status clx_h5_read_text(clx_h5 *h5, const char *object, const char *name, char **text)
{
    clast_status status = CLAST_OK;
    const clx_h5_attribute *found = find_attribute(h5, object, name);
    CLX_CHECK(found != NULL, CLAST_E_FORMAT, "%s: %s has no attribute %s", h5->label, object, name);
    CLX_CHECK(found->is_text, CLAST_E_FORMAT, "%s: attribute %s of %s is not a text", h5->label,
              name, object);
    CLX_TRY(clx_alloc(text, found->size + 1, 1));
    memcpy(*text, found->value, (size_t)found->size);
done:
    return status;
}

clast_status clx_h5_read_number(clx_h5 *h5, const char *object, const char *name, clx_h5_type type,
                                void *value)
{
    clast_status status = CLAST_OK;
    const clx_h5_attribute *found = find_attribute(h5, object, name);
    CLX_CHECK(found != NULL, CLAST_E_FORMAT, "%s: %s has no attribute %s", h5->label, object, name);
    CLX_CHECK(!found->is_text && found->type == type, CLAST_E_FORMAT,
              "%s: attribute %s of %s is of another type", h5->label, name, object);
    memcpy(value, found->value, (size_t)found->size);
done:
    return status;
}

/// Number of a folder.
static clast_status read_folder(const clx_h5 *h5, const char *folder, int64_t *number)
{
    clast_status status = CLAST_OK;
    *number = find(h5, folder);
    CLX_CHECK(*number >= 0 && h5->node[*number].is_folder, CLAST_E_FORMAT,
              "%s: there is no folder %s", h5->label, folder);
done:
    return status;
}

clast_status clx_h5_count(clx_h5 *h5, const char *folder, int64_t *n)
{
    clast_status status = CLAST_OK;
    int64_t at = 0;
    CLX_TRY(read_folder(h5, folder, &at));
    *n = 0;
    for (int64_t i = h5->node[at].first; i > 0; i = h5->node[i].next) {
        ++*n;
    }
done:
    return status;
}

static int by_name(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

/// Sorts the names of a folder's members, kept until a name is added.
static clast_status list_members(clx_h5 *h5, int64_t folder)
{
    clast_status status = CLAST_OK;
    if (h5->member != NULL && h5->listed == folder) {
        return CLAST_OK;
    }
    clx_free(h5->member);
    h5->member = NULL;
    CLX_TRY(clx_alloc(&h5->member, h5->n, sizeof *h5->member));
    h5->listed = folder;
    h5->n_member = 0;
    for (int64_t i = h5->node[folder].first; i > 0; i = h5->node[i].next) {
        h5->member[h5->n_member++] = h5->node[i].name;
    }
    qsort(h5->member, (size_t)h5->n_member, sizeof *h5->member, by_name);
done:
    return status;
}

clast_status clx_h5_member(clx_h5 *h5, const char *folder, int64_t index,
                           char name[CLX_H5_NAME_LIMIT])
{
    CLAST_ASSERT(index >= 0);
    clast_status status = CLAST_OK;
    int64_t at = 0;
    CLX_TRY(read_folder(h5, folder, &at));
    CLX_TRY(list_members(h5, at));
    CLX_CHECK(index < h5->n_member, CLAST_E_FORMAT, "%s: %s has no member %" PRId64, h5->label,
              folder, index);
    (void)snprintf(name, CLX_H5_NAME_LIMIT, "%s", strrchr(h5->member[index], '/') + 1);
done:
    return status;
}
