/* samples: keeps the colours of several samples a pixel until the tile is drawn, and averages them then (R33, R34). */
#pragma once

#include "base/always_inline.h"
#include "base/limits.h"
#include "kernels/types/samples.h"
#include "kernels/types/shading.h"
#include "kernels/generic/encode.inl"

/* Whether a vector's samples are neighbours in a row, in order. */
static ALWAYS_INLINE int samples_are_neighbours(const int32_t *sample)
{
    vi32 row = v_addi(v_seti(sample[0]), v_iota());
    return !v_any(v_mnot(v_eqi(v_loadi(sample), row)));
}

/* Stores the colours of the first `lanes` samples of a vector, or of all if the lanes beyond the batch's end repeat the last
 * sample. */
static ALWAYS_INLINE void samples_keep(const int32_t *sample, const vf32 color[3], int lanes, e3d_samples *samples)
{
    float kept[3][V_LANES];
    int neighbours = samples_are_neighbours(sample) && lanes == V_LANES;
    for (int k = 0; k < 3; k++)
        v_storef(neighbours ? samples->color[k] + sample[0] : kept[k], encode_clamp(color[k]));
    if (neighbours) {
        v_storef(samples->counts + sample[0], v_setf(1.0f));
        return;
    }
    for (int lane = 0; lane < lanes; lane++) {
        for (int k = 0; k < 3; k++)
            samples->color[k][sample[lane]] = kept[k][lane];
        samples->counts[sample[lane]] = 1.0f;
    }
}

static void kernel_keep(const e3d_batch *batch, e3d_samples *samples)
{
    for (int i = 0; i < batch->count; i += V_LANES) {
        const vf32 color[3] = {v_loadf(batch->color[0] + i), v_loadf(batch->color[1] + i), v_loadf(batch->color[2] + i)};
        int lanes = batch->count - i < V_LANES ? batch->count - i : V_LANES;
        samples_keep(batch->sample + i, color, lanes, samples);
    }
}

/* Splits a row of samples: the first one of each pixel, the second one, and so on. */
static ALWAYS_INLINE void samples_columns(const float *row, int axis, vf32 column[4])
{
    vf32 even[2], odd[2];
    if (axis == 1) {
        column[0] = v_loadf(row);
        return;
    }
    for (int i = 0; i < axis / 2; i++)
        v_split(v_loadf(row + 2 * i * V_LANES), v_loadf(row + (2 * i + 1) * V_LANES), &even[i], &odd[i]);
    if (axis == 2) {
        column[0] = even[0];
        column[1] = odd[0];
        return;
    }
    v_split(even[0], even[1], &column[0], &column[2]);
    v_split(odd[0], odd[1], &column[1], &column[3]);
}

static ALWAYS_INLINE vf32 samples_sum(const float *first, int axis)
{
    vf32 sum = v_setf(0.0f), column[4];
    for (int y = 0; y < axis; y++) {
        samples_columns(first + y * E3D_TILE, axis, column);
        for (int x = 0; x < axis; x++)
            sum = v_add(sum, column[x]);
    }
    return sum;
}

static ALWAYS_INLINE void samples_average(const e3d_samples *samples, int axis, int row, int width, const float background[3],
                                          int srgb, uint32_t *rgba)
{
    const vcurve curve = encode_curve();
    float all = (float)(axis * axis);
    for (int x = 0; x < width; x += V_LANES) {
        int first = row * E3D_TILE + x * axis;
        vf32 color[3], one = v_setf(1.0f), count = samples_sum(samples->counts + first, axis);
        vmask some = v_gt(count, v_setf(0.0f));
        vf32 scale = v_div(one, v_self(some, count, one));
        for (int k = 0; k < 3; k++)
            color[k] = v_self(some, v_mul(samples_sum(samples->color[k] + first, axis), scale), v_setf(background[k]));
        vi32 alpha = v_rint(v_mul(v_setf(255.0f), v_mul(count, v_setf(1.0f / all))));
        v_storei(rgba + x, v_ori(v_andi(encode_vector(&curve, color, srgb), v_seti(0xFFFFFF)), v_shl(alpha, 24)));
    }
}

static void kernel_average(const e3d_samples *samples, int axis, int row, int width, const float background[3], int srgb,
                           uint32_t *rgba)
{
    if (axis == 1)
        samples_average(samples, 1, row, width, background, srgb, rgba);
    else if (axis == 2)
        samples_average(samples, 2, row, width, background, srgb, rgba);
    else
        samples_average(samples, 4, row, width, background, srgb, rgba);
}
