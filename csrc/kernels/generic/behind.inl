/* behind: looks up the picture behind glass (R163). Samples lie anywhere in it, and each at a level of its own; a texel's four
 * channels are loaded at a time. */
#pragma once

#include <string.h>

#include "base/always_inline.h"
#include "base/limits.h"
#include "data/behind_levels.h"
#include "kernels/types/bending.h"
#include "kernels/generic/interpolate.inl"

/* A texel: four channels at a time, in the compiler's own vectors. */
typedef float behind_color __attribute__((vector_size(16)));

static ALWAYS_INLINE behind_color behind_load(const float *texel)
{
    behind_color color;
    memcpy(&color, texel, sizeof color);
    return color;
}

static ALWAYS_INLINE float behind_clamp(float v, float most)
{
    v = v > 0.0f ? v : 0.0f;
    return v < most ? v : most;
}

static ALWAYS_INLINE behind_color behind_mix(behind_color a, behind_color b, float weight) { return a + (b - a) * weight; }

static ALWAYS_INLINE behind_color behind_sharp(const e3d_behind_view *view, float x, float y)
{
    const e3d_behind_level *level = view->level;
    float u = behind_clamp(x, (float)(level->width - 1)), v = behind_clamp(y, (float)(level->height - 1));
    int32_t i = (int32_t)u, j = (int32_t)v;
    intptr_t right = i + 1 < level->width ? 4 : 0, below = j + 1 < level->height ? 4 * (intptr_t)level->width : 0;
    const float *texel = view->texels + 4 * ((intptr_t)j * level->width + i);
    float f = u - (float)i, g = v - (float)j;
    behind_color top = behind_mix(behind_load(texel), behind_load(texel + right), f);
    return behind_mix(top, behind_mix(behind_load(texel + below), behind_load(texel + below + right), f), g);
}

/* Three texels along an axis: the offsets of the first and the last from the one in the middle, in texels, and the weights. */
typedef struct behind_spline {
    int32_t middle, before, after;
    float weight[3];
} behind_spline;

static ALWAYS_INLINE behind_spline behind_find(float x, float scale, int32_t side)
{
    float u = behind_clamp((x + 0.5f) * scale - 0.5f, (float)(side - 1));
    int32_t i = (int32_t)(u + 0.5f);
    float d = u - (float)i, a = 0.5f - d, c = 0.5f + d;
    return (behind_spline){i, -(i > 0), i + 1 < side, {(a * a) * 0.5f, 0.75f - d * d, (c * c) * 0.5f}};
}

static ALWAYS_INLINE behind_color behind_row(const float *middle, const behind_spline *s)
{
    return (behind_load(middle + 4 * (intptr_t)s->before) * s->weight[0] + behind_load(middle) * s->weight[1]) + behind_load(middle + 4 * (intptr_t)s->after) * s->weight[2];
}

static ALWAYS_INLINE behind_color behind_smooth(const e3d_behind_view *view, int number, float x, float y)
{
    const e3d_behind_level *level = &view->level[number];
    float scale = 1.0f / (float)(1 << number);
    behind_spline across = behind_find(x, scale, level->width), down = behind_find(y, scale, level->height);
    const float *middle = view->texels + level->first + 4 * ((intptr_t)down.middle * level->width + across.middle);
    intptr_t pitch = 4 * (intptr_t)level->width;
    behind_color top = behind_row(middle + down.before * pitch, &across) * down.weight[0], centre = behind_row(middle, &across) * down.weight[1];
    return (top + centre) + behind_row(middle + down.after * pitch, &across) * down.weight[2];
}

static ALWAYS_INLINE behind_color behind_at(const e3d_behind_view *view, int number, float x, float y)
{
    return number ? behind_smooth(view, number, x, y) : behind_sharp(view, x, y);
}

static ALWAYS_INLINE behind_color behind_texel(const e3d_behind_view *view, float x, float y, float level)
{
    int number = (int)level;
    float f = level - (float)number;
    behind_color fine = behind_at(view, number, x, y);
    return f == 0.0f ? fine : behind_mix(fine, behind_smooth(view, number + 1, x, y), f);
}

/* R166, R167: finds the levels by the blurs. */
static void behind_find_levels(const e3d_behind_view *view, e3d_behind_batch *batch)
{
    vf32 one = v_setf(1.0f), half = v_setf(0.5f), zero = v_setf(0.0f);
    vf32 most = v_setf((float)(view->count - 1)), whole_most = v_setf((float)(view->whole_count - 1));
    for (int i = 0; i < batch->count; i += V_LANES) {
        vf32 blur = v_mul(v_max(v_float(v_loadi(batch->blur + i)), zero), v_setf(0x1p-8f));
        vf32 whole = v_mul(blur, v_setf(view->whole_share));
        v_storef(batch->level + i, v_min(v_mul(log2_poly(v_add(one, blur)), half), most));
        v_storef(batch->whole_level + i, v_min(v_mul(log2_poly(v_add(one, whole)), half), whole_most));
    }
}

static void kernel_behind(const e3d_behind_view *view, e3d_behind_batch *batch)
{
    behind_find_levels(view, batch);
    for (int i = 0; i < batch->count; i++) {
        float level = batch->level[i];
        behind_color green = behind_texel(view, batch->x[1][i], batch->y[1][i], level), red = green, blue = green;
        if (batch->is_dispersive) {
            red = behind_texel(view, batch->x[0][i], batch->y[0][i], level);
            blue = behind_texel(view, batch->x[2][i], batch->y[2][i], level);
        }
        batch->light[0][i] = red[0];
        batch->light[1][i] = green[1];
        batch->light[2][i] = blue[2];
        batch->light[3][i] = green[3];
    }
}
