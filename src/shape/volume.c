// Volumes of grey values: bytes to values, values to labels, parts above a threshold.
#include <clast/volume.h>

#include "base/alloc.h"
#include "base/status.h"
#include "shape/whole.h"
#include <math.h>
#include <string.h>

static const float LARGEST_WHOLE = 0x1p24F; ///< beyond this floats skip whole numbers

int32_t clast_volume_type_size(clast_volume_type type)
{
    static const int32_t size[CLAST_N_VOLUME_TYPE] = {1, 1, 2, 2, 4, 4, 4, 8};
    return type >= 0 && type < CLAST_N_VOLUME_TYPE ? size[type] : 0;
}

clast_status clast_volume_alloc(const int32_t n[3], clast_volume *volume)
{
    CLX_ARGUMENTS(n, volume);
    clast_status status = CLAST_OK;
    CLX_CHECK(n[0] > 0 && n[1] > 0 && n[2] > 0, CLAST_E_FORMAT,
              "a volume of %d x %d x %d voxels; each must be positive", n[0], n[1], n[2]);
    CLX_CHECK((double)n[0] * n[1] * n[2] < 0x1p31, CLAST_E_LIMIT,
              "%d x %d x %d voxels are beyond 2^31; cut the volume in pieces", n[0], n[1], n[2]);
    CLX_TRY(clx_alloc(&volume->value, (int64_t)n[0] * n[1] * n[2], sizeof *volume->value));
    for (int k = 0; k < 3; ++k) {
        volume->n[k] = n[k];
        volume->edge[k] = 1.0;
    }
done:
    return status;
}

void clast_volume_free(clast_volume *volume)
{
    if (volume == NULL) {
        return;
    }
    clx_free(volume->value);
    *volume = (clast_volume){0};
}

/// One value; `raw` holds its bytes, least significant first.
static float value_of(clast_volume_type type, uint64_t raw)
{
    float single;
    double full;
    const uint32_t low = (uint32_t)raw;
    switch (type) {
    case CLAST_VOLUME_I8:
        return (float)(int8_t)(uint8_t)raw;
    case CLAST_VOLUME_I16:
        return (float)(int16_t)(uint16_t)raw;
    case CLAST_VOLUME_I32:
        return (float)(int32_t)low;
    case CLAST_VOLUME_F32:
        memcpy(&single, &low, sizeof single);
        return single;
    case CLAST_VOLUME_F64:
        memcpy(&full, &raw, sizeof full);
        return (float)full;
    default:
        return (float)raw;
    }
}

void clast_volume_fill(clast_volume *volume, int64_t first, int64_t n, clast_volume_type type,
                       bool is_big_endian, const void *bytes)
{
    if (clx_volume_fault(volume) != NULL || bytes == NULL) {
        return;
    }
    const int32_t size = clast_volume_type_size(type);
    const int64_t room = (int64_t)volume->n[0] * volume->n[1] * volume->n[2];
    if (size == 0 || first < 0 || n > room - first) {
        return;
    }
    const uint8_t *at = bytes;
    for (int64_t i = 0; i < n; ++i, at += size) {
        uint64_t raw = 0;
        for (int32_t k = 0; k < size; ++k) {
            raw |= (uint64_t)at[is_big_endian ? size - 1 - k : k] << (8 * k);
        }
        volume->value[first + i] = value_of(type, raw);
    }
}

static int64_t count(const clast_volume *volume)
{
    return (int64_t)volume->n[0] * volume->n[1] * volume->n[2];
}

static clast_status begin_voxels(const clast_volume *volume, clast_voxels *voxels)
{
    clast_status status = CLAST_OK;
    for (int k = 0; k < 3; ++k) {
        CLX_CHECK(volume->edge[k] > 0.0 && isfinite(volume->edge[k]), CLAST_E_FORMAT,
                  "a voxel's edge of %g; it must be positive and finite", volume->edge[k]);
    }
    CLX_TRY(clast_voxels_alloc(volume->n, volume->edge[0], voxels));
    for (int k = 0; k < 3; ++k) {
        voxels->edge[k] = volume->edge[k];
    }
done:
    return status;
}

clast_status clast_volume_labels(const clast_volume *volume, clast_voxels *voxels)
{
    CLX_ARGUMENTS(volume, voxels);
    CLX_WHOLE(volume, volume);
    clast_status status = CLAST_OK;
    clast_voxels made = {0};
    const int64_t n = count(volume);
    CLX_TRY(begin_voxels(volume, &made));
    for (int64_t i = 0; i < n; ++i) {
        const float value = volume->value[i];
        CLX_CHECK(value >= 0.0F && value == floorf(value), CLAST_E_FORMAT,
                  "voxel %lld of %lld is %g, no label (0, 1, 2, ...): grey values need a threshold",
                  (long long)i + 1, (long long)n, (double)value);
        CLX_CHECK(value < LARGEST_WHOLE, CLAST_E_LIMIT, "voxel %lld has label %g, beyond 2^24",
                  (long long)i + 1, (double)value);
        made.label[i] = (int32_t)value;
    }
    *voxels = made;
    made = (clast_voxels){0};
done:
    clast_voxels_free(&made);
    return status;
}

/// Gives one part, from its first brick on, its label. `stack` has room for all bricks.
static void flood(const clast_volume *volume, float threshold, int32_t label, int32_t first,
                  clast_voxels *voxels, int32_t *stack)
{
    CLAST_ASSERT(first >= 0 && label > 0);
    const int32_t *n = volume->n;
    const int64_t stride[3] = {1, n[0], (int64_t)n[0] * n[1]};
    int64_t n_stack = 0;
    stack[n_stack++] = first;
    voxels->label[first] = label;
    while (n_stack > 0) {
        const int64_t at = stack[--n_stack];
        const int64_t place[3] = {at % n[0], at / n[0] % n[1], at / stride[2]};
        for (int side = 0; side < 6; ++side) {
            const int k = side / 2;
            const int64_t step = side % 2 == 0 ? -1 : 1;
            if (place[k] + step < 0 || place[k] + step >= n[k]) {
                continue;
            }
            const int64_t next = at + step * stride[k];
            if (voxels->label[next] == 0 && volume->value[next] > threshold) {
                voxels->label[next] = label;
                stack[n_stack++] = (int32_t)next;
            }
        }
    }
}

/// Least and greatest of the values met.
typedef struct {
    float low, high;
} range;

static void widen(range *r, float value)
{
    r->low = fminf(r->low, value);
    r->high = fmaxf(r->high, value);
}

/// True where bricks that meet across the threshold have one value inside and one outside: a mask,
/// whose values say nothing of where between two centres its surface lies.
static bool is_mask(const clast_volume *volume, float threshold)
{
    const int32_t *n = volume->n;
    const int64_t stride[3] = {1, n[0], (int64_t)n[0] * n[1]};
    range side[2] = {{INFINITY, -INFINITY}, {INFINITY, -INFINITY}};
    for (int64_t i = 0; i < count(volume); ++i) {
        const int64_t place[3] = {i % n[0], i / n[0] % n[1], i / stride[2]};
        const float own = volume->value[i];
        for (int k = 0; k < 3; ++k) {
            const float next = place[k] + 1 < n[k] ? volume->value[i + stride[k]] : own;
            if ((own > threshold) != (next > threshold)) {
                widen(&side[own > threshold], own);
                widen(&side[next > threshold], next);
            }
        }
        if (side[0].low < side[0].high || side[1].low < side[1].high) {
            return false;
        }
    }
    return true;
}

clast_status clast_volume_parts(clast_volume *volume, double threshold, clast_voxels *voxels)
{
    CLX_ARGUMENTS(volume, voxels);
    CLX_WHOLE(volume, volume);
    clast_status status = CLAST_OK;
    clast_voxels made = {0};
    int32_t *stack = NULL;
    int32_t n_part = 0;
    const int64_t n = count(volume);
    CLX_CHECK(isfinite(threshold), CLAST_E_USAGE, "a threshold of %g", threshold);
    CLX_TRY(begin_voxels(volume, &made));
    CLX_TRY(clx_alloc(&stack, n, sizeof *stack));
    CLAST_ASSERT(n == 0 || made.label != NULL);
    for (int64_t i = 0; i < n; ++i) {
        if (made.label[i] == 0 && volume->value[i] > (float)threshold) {
            flood(volume, (float)threshold, ++n_part, (int32_t)i, &made, stack);
        }
    }
    made.threshold = (double)(float)threshold;
    if (!is_mask(volume, (float)threshold)) {
        made.grey = volume->value;
        volume->value = NULL;
    }
    clast_volume_free(volume);
    *voxels = made;
    made = (clast_voxels){0};
done:
    clx_free(stack);
    clast_voxels_free(&made);
    return status;
}
