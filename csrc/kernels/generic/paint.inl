/* paint: a batch of samples to encoded pixels (R19-R34). It runs the other kernels one after the other, but from light on colours
 * stay in registers; where the out-of-order window is large (e3d_cpu_looks_ahead), from the texels on.
 */
#ifndef E3D_KERNELS_PAINT_INL
#define E3D_KERNELS_PAINT_INL

#include "core/always_inline.h"
#include "e3d.h"
#include "kernels/types/shading.h"
#include "kernels/generic/interpolate.inl"
#include "kernels/generic/texture.inl"
#include "kernels/generic/light.inl"
#include "kernels/generic/encode.inl"
#include "kernels/generic/samples.inl"

/* Where a vector's albedo is. */
typedef enum paint_source { PAINT_BASE, PAINT_COLOR, PAINT_TEXELS } paint_source;

typedef struct paint_plan {
    const e3d_paint *paint;
    const texture_plan *texture; /* for PAINT_TEXELS: texture_is_bilinear8 */
    paint_source source;
} paint_plan;

/* ---- light ---- */

/* R31 of all lights, which are few. Whether there are highlights is a constant for the compiler. */
static ALWAYS_INLINE void paint_light(const e3d_batch *batch, int i, const e3d_paint *paint, float shininess, vf32 color[3])
{
    const e3d_lighting *lighting = paint->lighting;
    lit_lanes lit;
    for (int k = 0; k < 3; k++) {
        lit.position[k] = v_loadf(batch->position[k] + i);
        lit.normal[k] = v_loadf(batch->normal[k] + i);
        lit.view[k] = v_setf(0.0f);
        lit.energy[k] = v_setf(lighting->ambient[k]);
        lit.shine[k] = v_setf(0.0f);
    }
    if (shininess > 0.0f)
        light_view(lighting, &lit);
    for (int n = 0; n < lighting->light_count; n++)
        light_one(lighting, n, shininess, &lit);
    for (int k = 0; k < 3; k++)
        lit.energy[k] = light_clamp(lighting, lit.energy[k]);
    combine_vector(lit.energy, lit.shine, paint->specular, paint->emissive, color);
}

/* ---- albedo ---- */

static inline void paint_base(e3d_batch *batch, const float base[3])
{
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < batch->count; i += V_LANES)
            v_storef(batch->color[k] + i, v_setf(base[k]));
}

static inline paint_source paint_untextured(e3d_batch *batch, const e3d_surfaces *surfaces, const e3d_paint *paint)
{
    if (!paint->by_vertex && !paint->by_instance)
        return PAINT_BASE;
    if (!paint->by_vertex) {
        each_vector(batch, surfaces, stage_instance_base, paint->base);
        return PAINT_COLOR;
    }
    paint_base(batch, paint->base);
    kernel_tint(batch, surfaces, 1, paint->by_instance);
    return PAINT_COLOR;
}

static inline paint_source paint_textured(e3d_batch *batch, const e3d_surfaces *surfaces, const e3d_paint *paint, texture_plan *plan)
{
    if (paint->looks_ahead && texture_is_bilinear8(paint->texture) && !paint->by_vertex && !paint->by_instance) {
        texture_prepare(plan, paint->texture, paint->base, batch);
        return PAINT_TEXELS;
    }
    kernel_texture(batch, paint->texture, paint->base);
    kernel_tint(batch, surfaces, paint->by_vertex, paint->by_instance);
    return PAINT_COLOR;
}

static ALWAYS_INLINE void paint_load(const e3d_batch *batch, int i, vf32 color[3])
{
    for (int k = 0; k < 3; k++)
        color[k] = v_loadf(batch->color[k] + i);
}

/* ---- pixels ---- */

/* Stores the first `lanes` pixels of a vector, or all of them where lanes past the batch's end repeat the last sample. */
static ALWAYS_INLINE void paint_store(const int32_t *sample, vi32 pixels, int lanes, uint32_t *rgba)
{
    if (lanes == V_LANES && v_store_runs(rgba, sample, pixels))
        return;
    uint32_t pixel[V_LANES];
    v_storei(pixel, pixels);
    for (int lane = 0; lane < lanes; lane++)
        rgba[sample[lane]] = pixel[lane];
}

/* The colours of one vector. */
static ALWAYS_INLINE void paint_color(const e3d_batch *batch, int i, const paint_plan *plan, int lit, float shininess,
                                      vf32 color[3])
{
    if (plan->source == PAINT_TEXELS)
        texture_color(plan->texture, E3D_BILINEAR, 8, i, color);
    else if (plan->source == PAINT_COLOR)
        paint_load(batch, i, color);
    for (int k = 0; k < 3 && plan->source == PAINT_BASE; k++)
        color[k] = v_setf(plan->paint->base[k]);
    if (lit)
        paint_light(batch, i, plan->paint, shininess, color);
}

/* Shades and encodes a batch to RGBA8. */
static ALWAYS_INLINE void paint_codes(const e3d_batch *batch, const paint_plan *plan, int lit, float shininess, int srgb,
                                      uint32_t *rgba)
{
    const vcurve curve = encode_curve();
    for (int i = 0; i < batch->count; i += V_LANES) {
        vf32 color[3];
        paint_color(batch, i, plan, lit, shininess, color);
        paint_store(batch->sample + i, encode_vector(&curve, color, srgb), V_LANES, rgba);
    }
}

/* Where the sRGB curve is looked up in memory, light has a loop of its own: one of both would not fit the out-of-order window. */
static ALWAYS_INLINE void paint_in_turn(e3d_batch *batch, const paint_plan *plan, int lit, float shininess, uint32_t *rgba)
{
    paint_plan done = *plan;
    done.source = PAINT_COLOR;
    for (int i = 0; i < batch->count; i += V_LANES) {
        vf32 color[3];
        paint_color(batch, i, plan, lit, shininess, color);
        for (int k = 0; k < 3; k++)
            v_storef(batch->color[k] + i, color[k]);
    }
    paint_codes(batch, &done, 0, 0.0f, 1, rgba);
}

static ALWAYS_INLINE void paint_samples(const e3d_batch *batch, const paint_plan *plan, int lit, float shininess)
{
    for (int i = 0; i < batch->count; i += V_LANES) {
        vf32 color[3];
        paint_color(batch, i, plan, lit, shininess, color);
        samples_keep(batch->sample + i, color, V_LANES, plan->paint->samples);
    }
}

static ALWAYS_INLINE void paint_pixels(e3d_batch *batch, const paint_plan *plan, int lit, float shininess, uint32_t *rgba)
{
    if (plan->paint->samples)
        paint_samples(batch, plan, lit, shininess);
    else if (plan->paint->srgb && V_LANES < 16)
        paint_in_turn(batch, plan, lit, shininess, rgba);
    else if (plan->paint->srgb)
        paint_codes(batch, plan, lit, shininess, 1, rgba);
    else
        paint_codes(batch, plan, lit, shininess, 0, rgba);
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
    texture_plan texture;
    paint_plan plan = {.paint = paint, .texture = &texture};
    if (paint->wanted & E3D_WANT_SURFACE)
        kernel_interpolate(batch, surfaces, paint->wanted);
    plan.source = paint->texture ? paint_textured(batch, surfaces, paint, &texture) : paint_untextured(batch, surfaces, paint);
    if (!paint->lighting)
        paint_pixels(batch, &plan, 0, 0.0f, rgba);
    else if (paint->shininess > 0.0f)
        paint_pixels(batch, &plan, 1, paint->shininess, rgba);
    else
        paint_pixels(batch, &plan, 1, 0.0f, rgba);
}

#endif
