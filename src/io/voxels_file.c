// Voxel text files: sizes, edge, then one whole number a cube.
#include <clast/volume.h>

#include "base/alloc.h"
#include "base/file.h"
#include "io/text.h"

static const int64_t LARGEST_FILE = INT64_C(1) << 34;

typedef struct {
    int64_t n[3];
    double edge;
} voxel_header;

/// One `Name: value` line. *is_header is false, and nothing is taken, when the line begins with a
/// number.
static clast_status header_line(clx_text *text, voxel_header *header, bool *is_header)
{
    static const char *const sizes[3] = {"xsize:", "ysize:", "zsize:"};
    clast_status status = CLAST_OK;
    clx_text peek = *text;
    clx_word word;
    char shown[CLX_WORD_SHOWN];
    int64_t number = 0;
    if (!clx_text_word(&peek, &word)) {
        goto done; // a blank line
    }
    *is_header = !clx_word_integer(word, &number);
    if (!*is_header) {
        goto done;
    }
    *text = peek;
    for (int k = 0; k < 3; ++k) {
        if (clx_word_is(word, sizes[k])) {
            CLX_TRY(clx_text_integer(text, sizes[k], 1, INT32_MAX, &header->n[k]));
            goto done;
        }
    }
    if (clx_word_is(word, "resolution:") || clx_word_is(word, "voxelscale:")) {
        CLX_TRY(clx_text_number(text, "edge of a voxel", &header->edge));
        goto done;
    }
    CLX_CHECK(word.n > 1 && word.text[word.n - 1] == ':', CLAST_E_FORMAT,
              "line %lld: '%s' where `Name: value` or a voxel's number was expected",
              (long long)text->line, clx_word_show(word, shown));
    while (clx_text_word(text, &word)) { // another property
    }
done:
    return status;
}

static clast_status read_header(clx_text *text, voxel_header *header)
{
    clast_status status = CLAST_OK;
    bool is_header = true;
    *header = (voxel_header){.edge = 0.0};
    for (bool more = true; more && is_header; more = is_header && clx_text_next_line(text)) {
        CLX_TRY(header_line(text, header, &is_header));
    }
    CLX_CHECK(header->n[0] > 0 && header->n[1] > 0 && header->n[2] > 0, CLAST_E_FORMAT,
              "line %lld: the lines Xsize:, Ysize: and Zsize: must come before the voxels",
              (long long)text->line);
    CLX_CHECK(header->edge > 0.0, CLAST_E_FORMAT,
              "line %lld: a positive edge of a voxel (Resolution: or VoxelScale:) must come before "
              "the voxels",
              (long long)text->line);
done:
    return status;
}

clast_status clast_voxels_parse(const void *bytes, size_t n, clast_voxels *voxels)
{
    CLX_ARGUMENTS(voxels);
    CLX_ARRAY(bytes, n);
    clast_status status = CLAST_OK;
    clast_voxels made = {0};
    voxel_header header;
    clx_word word;
    clx_text text = clx_text_begin(bytes, n, '#', false);
    CLX_TRY(read_header(&text, &header));
    const int32_t size[3] = {(int32_t)header.n[0], (int32_t)header.n[1], (int32_t)header.n[2]};
    // each number takes a digit and a blank
    CLX_CHECK((double)size[0] * size[1] * size[2] <= 0.5 * ((double)n + 1.0), CLAST_E_FORMAT,
              "%d x %d x %d voxels are promised, %zu bytes cannot hold so many numbers", size[0],
              size[1], size[2], n);
    CLX_TRY(clast_voxels_alloc(size, header.edge, &made));
    const int64_t n_voxel = (int64_t)size[0] * size[1] * size[2];
    for (int64_t i = 0; i < n_voxel; ++i) {
        char shown[CLX_WORD_SHOWN];
        int64_t label = 0;
        CLX_CHECK(clx_text_any_word(&text, &word), CLAST_E_FORMAT,
                  "line %lld: the file ends after %lld of %lld voxels", (long long)text.line,
                  (long long)i, (long long)n_voxel);
        CLX_CHECK(clx_word_integer(word, &label) && label >= 0 && label <= INT32_MAX,
                  CLAST_E_FORMAT, "line %lld: voxel %lld is '%s'; a whole number >= 0 was expected",
                  (long long)text.line, (long long)i + 1, clx_word_show(word, shown));
        made.label[i] = (int32_t)label;
    }
    CLX_CHECK(!clx_text_any_word(&text, &word), CLAST_E_FORMAT,
              "line %lld: more numbers than the %lld voxels of %d x %d x %d", (long long)text.line,
              (long long)n_voxel, size[0], size[1], size[2]);
    *voxels = made;
    made = (clast_voxels){0};
done:
    clast_voxels_free(&made);
    return status;
}

clast_status clast_voxels_read(const char *path, clast_voxels *voxels)
{
    CLX_ARGUMENTS(path, voxels);
    clast_status status = CLAST_OK;
    char *bytes = NULL;
    int64_t n = 0;
    CLX_TRY(clx_file_read_all(path, LARGEST_FILE, &bytes, &n));
    status = clast_voxels_parse(bytes, (size_t)n, voxels);
    if (status != CLAST_OK) {
        clx_fail_prefix("%s", path);
    }
done:
    clx_free(bytes);
    return status;
}
