/* paint: shades a batch of samples to encoded pixels (R19-R34, R117-R121). It runs the other kernels one after the other, but
 * from light on colours stay in registers. A single loop from the texels on would not fit the out-of-order window: 3.04
 * instead of 2.86 ms for the head on Zen 4. */
#pragma once

#include "base/always_inline.h"
#include "e3d.h"
#include "kernels/types/shading.h"
#include "kernels/generic/interpolate.inl"
#include "kernels/generic/shade/anisotropic.inl"
#include "kernels/generic/shade/light.inl"
#include "kernels/generic/shade/shadow.inl"
#include "kernels/generic/encode.inl"
#include "kernels/generic/tone.inl"
#include "kernels/generic/samples.inl"

/* ---- light ---- */

/* How samples are lit, as a constant for the compiler. */
enum paint_lit { PAINT_UNLIT = 0,
                 PAINT_LIT,
                 PAINT_SHADOWED,
                 PAINT_VARIED };

/* R31 for all lights, which are few. Whether there are highlights is a constant for the compiler, too. */
static ALWAYS_INLINE void paint_light(const e3d_batch *batch, int i, const e3d_paint *paint, enum light_variety varied, float shininess,
                                      vf32 color[3])
{
    const e3d_lighting *lighting = paint->lighting;
    lit_lanes lit = light_begin(batch, i, lighting, varied, shininess);
    for (int n = 0; n < lighting->light_count; n++)
        light_one(lighting, n, batch, i, varied, shininess, &lit);
    for (int k = 0; k < 3; k++)
        lit.energy[k] = light_clamp(lighting, lit.energy[k]);
    combine_vector(lit.energy, lit.shine, paint->specular, paint->emissive, lighting->exposure, color);
}

/* ---- albedo ---- */

/* Finds the colours of a batch; returns 0 if they are the base everywhere, and then writes nothing. */
static inline int paint_albedo(e3d_batch *batch, const e3d_surfaces *surfaces, const e3d_paint *paint)
{
    const float *base = paint->base;
    if (paint->texture) {
        kernel_texture(batch, surfaces, paint->texture, base);
        base = NULL;
    }
    tint_all(batch, surfaces, paint->by_vertex, paint->by_instance, base);
    return !base || paint->by_vertex || paint->by_instance;
}

static ALWAYS_INLINE void paint_load(const e3d_batch *batch, int i, vf32 color[3])
{
    for (int k = 0; k < 3; k++)
        color[k] = v_loadf(batch->color[k] + i);
}

/* ---- pixels ---- */

/* Stores the first `lanes` pixels of a vector, or all of them if the lanes beyond the batch's end repeat the last sample. */
static ALWAYS_INLINE void paint_store(const int32_t *sample, vi32 pixels, int lanes, uint32_t *rgba)
{
    if (lanes == V_LANES && v_store_runs(rgba, sample, pixels))
        return;
    uint32_t pixel[V_LANES];
    v_storei(pixel, pixels);
    for (int lane = 0; lane < lanes; lane++)
        rgba[sample[lane]] = pixel[lane];
}

/* Finds the colours of one vector. */
static ALWAYS_INLINE void paint_color(const e3d_batch *batch, int i, const e3d_paint *paint, int colored, enum paint_lit lit, float shininess,
                                      vf32 color[3])
{
    for (int k = 0; k < 3; k++)
        color[k] = colored ? v_loadf(batch->color[k] + i) : v_setf(paint->base[k]);
    if (lit)
        paint_light(batch, i, paint, (enum light_variety)(lit - PAINT_LIT), shininess, color);
}

/* Shades and encodes a batch to RGBA8. */
static ALWAYS_INLINE void paint_codes(const e3d_batch *batch, const e3d_paint *paint, int colored, enum paint_lit lit, float shininess, int srgb,
                                      uint32_t *rgba)
{
    const vcurve curve = encode_curve();
    for (int i = 0; i < batch->count; i += V_LANES) {
        vf32 color[3];
        paint_color(batch, i, paint, colored, lit, shininess, color);
        paint_store(batch->sample + i, encode_vector(&curve, color, srgb), V_LANES, rgba);
    }
}

/* Keeps the colours of a batch in the batch. */
static ALWAYS_INLINE void paint_colors(e3d_batch *batch, const e3d_paint *paint, int colored, enum paint_lit lit, float shininess)
{
    for (int i = 0; i < batch->count; i += V_LANES) {
        vf32 color[3];
        paint_color(batch, i, paint, colored, lit, shininess, color);
        for (int k = 0; k < 3; k++)
            v_storef(batch->color[k] + i, color[k]);
    }
}

/* Light has a loop of its own if the sRGB curve is looked up in memory: a single loop would not fit the out-of-order window. */
static ALWAYS_INLINE void paint_in_turn(e3d_batch *batch, const e3d_paint *paint, int colored, enum paint_lit lit, float shininess, uint32_t *rgba)
{
    paint_colors(batch, paint, colored, lit, shininess);
    paint_codes(batch, paint, 1, PAINT_UNLIT, 0.0f, 1, rgba);
}

static ALWAYS_INLINE void paint_samples(const e3d_batch *batch, const e3d_paint *paint, int colored, enum paint_lit lit, float shininess)
{
    for (int i = 0; i < batch->count; i += V_LANES) {
        vf32 color[3];
        paint_color(batch, i, paint, colored, lit, shininess, color);
        samples_keep(batch->sample + i, color, V_LANES, paint->samples);
    }
}

static ALWAYS_INLINE void paint_pixels(e3d_batch *batch, const e3d_paint *paint, int colored, enum paint_lit lit, float shininess, uint32_t *rgba)
{
    if (paint->samples)
        paint_samples(batch, paint, colored, lit, shininess);
    else if (!rgba)
        paint_colors(batch, paint, colored, lit, shininess);
    else if (paint->srgb && V_LANES < 16)
        paint_in_turn(batch, paint, colored, lit, shininess, rgba);
    else if (paint->srgb)
        paint_codes(batch, paint, colored, lit, shininess, 1, rgba);
    else
        paint_codes(batch, paint, colored, lit, shininess, 0, rgba);
}

/* Fog and tone mapping have loops of their own. */
static void paint_toned(e3d_batch *batch, const e3d_paint *paint, int colored, uint32_t *rgba)
{
    float *const color[3] = {batch->color[0], batch->color[1], batch->color[2]};
    const e3d_lane_array *places = e3d_batch_places(batch);
    const float *const position[3] = {places[0], places[1], places[2]};
    if (!paint->lighting)
        paint_colors(batch, paint, colored, PAINT_UNLIT, 0.0f);
    else if (light_varies(paint->lighting))
        paint_colors(batch, paint, colored, PAINT_VARIED, paint->shininess);
    else if (paint->shininess > 0.0f)
        paint_colors(batch, paint, colored, PAINT_LIT, paint->shininess);
    else
        paint_colors(batch, paint, colored, PAINT_LIT, 0.0f);
    if (paint->fog)
        kernel_fog(paint->fog, position, batch->count, color);
    if (paint->tone != E3D_TONE_NONE)
        kernel_tone(paint->tone, color, batch->count);
    if (paint->samples)
        paint_samples(batch, paint, 1, PAINT_UNLIT, 0.0f);
    else if (rgba)
        paint_codes(batch, paint, 1, PAINT_UNLIT, 0.0f, paint->srgb, rgba);
}

static void kernel_put(const e3d_batch *batch, int srgb, uint32_t *rgba)
{
    const vcurve curve = encode_curve();
    for (int i = 0; i < batch->count; i += V_LANES) {
        vf32 color[3];
        paint_load(batch, i, color);
        int lanes = batch->count - i < V_LANES ? batch->count - i : V_LANES;
        paint_store(batch->sample + i, encode_vector(&curve, color, srgb), lanes, rgba);
    }
}

static void kernel_paint(e3d_batch *batch, const e3d_surfaces *surfaces, const e3d_paint *paint, uint32_t *rgba)
{
    if (paint->wanted & E3D_WANT_SURFACE)
        kernel_interpolate(batch, surfaces, paint->wanted);
    int colored = paint_albedo(batch, surfaces, paint);
    if (paint->lighting)
        shadow_suns(paint->lighting, batch);
    if (paint->fog || paint->tone != E3D_TONE_NONE)
        paint_toned(batch, paint, colored, rgba);
    else if (!paint->lighting)
        paint_pixels(batch, paint, colored, PAINT_UNLIT, 0.0f, rgba);
    else if (light_varies(paint->lighting) == LIGHT_SHADOWED && !(paint->shininess > 0.0f))
        paint_pixels(batch, paint, colored, PAINT_SHADOWED, 0.0f, rgba);
    else if (light_varies(paint->lighting))
        paint_pixels(batch, paint, colored, PAINT_VARIED, paint->shininess, rgba);
    else if (paint->shininess > 0.0f)
        paint_pixels(batch, paint, colored, PAINT_LIT, paint->shininess, rgba);
    else
        paint_pixels(batch, paint, colored, PAINT_LIT, 0.0f, rgba);
}
