/* physical: adds up all light on physically based materials, layer by layer (R56, R57, R134, R168). */
#pragma once

#include "base/always_inline.h"
#include "base/limits.h"
#include "e3d.h"
#include "kernels/types/texture_slots.h"
#include "kernels/types/shading.h"
#include "kernels/generic/interpolate.inl"
#include "kernels/generic/shade/light.inl"
#include "kernels/generic/shade/shadow.inl"
#include "kernels/generic/shade/albedo.inl"
#include "kernels/generic/shade/environment.inl"
#include "kernels/generic/shade/texture_slots.inl"
#include "kernels/generic/shade/brdf.inl"
#include "kernels/generic/shade/brdf_lights.inl"

/* ---- sums (R56, R57) ---- */

static ALWAYS_INLINE void brdf_sheen(const e3d_brdf *brdf, const brdf_lanes *at, const vf32 irradiance[3], vf32 occlusion, int i,
                                     vf32 color[3])
{
    vf32 sheen[3], one = v_setf(1.0f);
    albedo_place place = albedo_find(usable_sheen_roughness(brdf, i), at->base.nv, E3D_DFG_SIZE);
    vf32 e = albedo_of(E3D_DFG_SHEEN, &place);
    for (int k = 0; k < 3; k++)
        sheen[k] = varying_at(&brdf->sheen[k], i);
    vf32 keep = v_sub(one, v_mul(v_max(v_max(sheen[0], sheen[1]), sheen[2]), e));
    for (int k = 0; k < 3; k++) {
        vf32 fuzz = v_add(at->fuzz[k], v_mul(v_mul(irradiance[k], e), occlusion));
        color[k] = v_add(v_mul(color[k], keep), v_mul(sheen[k], fuzz));
    }
}

/* R52 */
static ALWAYS_INLINE vf32 brdf_coat_share(const e3d_brdf *brdf, const brdf_lanes *at, int i)
{
    vf32 one = v_setf(1.0f), w5 = fifth_power(v_sub(one, v_min(at->coat.nv, one)));
    return v_mul(varying_at(&brdf->coat, i), v_add(v_setf(0.04f), v_mul(v_setf(0.96f), w5)));
}

static ALWAYS_INLINE void brdf_add_layer(const e3d_brdf *brdf, const e3d_lighting *lighting, const environment_plan *plan,
                                         const vf32 normal[3], const brdf_lanes *at, vf32 occlusion, int i, vf32 color[3])
{
    vf32 radiance[3], one = v_setf(1.0f), fc = brdf_coat_share(brdf, at, i);
    around_radiance(lighting, plan, normal, &at->coat, at->view, radiance);
    for (int k = 0; k < 3; k++) {
        vf32 coat = v_add(at->coat_light[k], v_mul(radiance[k], occlusion));
        color[k] = v_add(v_mul(color[k], v_sub(one, fc)), v_mul(fc, coat));
    }
}

/* R134: the share of the light behind that layers and the volume leave. */
static ALWAYS_INLINE void brdf_through(const e3d_brdf *brdf, int has_coat, int has_sheen, const brdf_lanes *at, int i,
                                       vf32 through[3], e3d_texture_batch *m)
{
    vf32 one = v_setf(1.0f), zero = v_setf(0.0f), depth = zero, fuzz = one, coat = one;
    if (has_sheen) {
        albedo_place place = albedo_find(usable_sheen_roughness(brdf, i), at->base.nv, E3D_DFG_SIZE);
        vf32 most = v_max(v_max(varying_at(&brdf->sheen[0], i), varying_at(&brdf->sheen[1], i)), varying_at(&brdf->sheen[2], i));
        fuzz = v_sub(one, v_mul(most, albedo_of(E3D_DFG_SHEEN, &place)));
    }
    if (has_coat)
        coat = v_sub(one, brdf_coat_share(brdf, at, i));
    if (brdf->absorbs)
        depth = v_mul(varying_at(&brdf->thickness, i), v_loadf(m->depth + i));
    for (int k = 0; k < 3; k++) {
        vf32 share = has_sheen ? v_mul(through[k], fuzz) : through[k];
        share = has_coat ? v_mul(share, coat) : share;
        if (brdf->absorbs)
            share = v_mul(share, exp2_poly(v_mul(depth, v_setf(brdf->absorption[k]))));
        v_storef(m->through[k] + i, v_self(v_gt(share, zero), v_self(v_lt(share, one), share, one), zero));
    }
}

/* R168 */
static ALWAYS_INLINE void brdf_pass(const e3d_brdf *brdf, const e3d_texture_batch *m, const vf32 passed[3], int i, vf32 color[3])
{
    for (int k = 0; k < 3; k++) {
        vf32 left = passed[k];
        if (brdf->absorbs)
            left = v_mul(left, exp2_poly(v_mul(v_loadf(m->body + i), v_setf(brdf->absorption[k]))));
        color[k] = v_add(color[k], left);
    }
}

/* R46 and R129 */
static ALWAYS_INLINE vf32 brdf_occlusion(const e3d_batch *batch, const e3d_brdf *brdf, const e3d_lighting *lighting, int i)
{
    vf32 one = v_setf(1.0f), occlusion = one;
    if (brdf->occlusion.lanes)
        occlusion = v_add(one, v_mul(v_setf(brdf->occlusion_strength), v_sub(varying_at(&brdf->occlusion, i), one)));
    return lighting->has_visibility ? v_mul(occlusion, v_loadf(batch->visibility + i)) : occlusion;
}

/* Finishes a vector. coat: the coat's normals, or NULL. */
static ALWAYS_INLINE void brdf_finish(const e3d_batch *batch, const e3d_brdf *brdf, const e3d_lighting *lighting,
                                      const environment_plan *plan, const e3d_lane_array *coat, int has_sheen, const e3d_brdf *rare,
                                      const brdf_lanes *at, const around_lanes *around, int i, e3d_texture_batch *m, vf32 color[3])
{
    vf32 indirect[3], through[3], passed[3], normal[3], occlusion = brdf_occlusion(batch, brdf, lighting, i);
    around_indirect(batch, brdf, rare, i, at, around, through, passed, indirect);
    if (rare && rare->transmits)
        brdf_through(brdf, coat != NULL, has_sheen, at, i, through, m);
    for (int k = 0; k < 3; k++)
        color[k] = v_add(at->direct[k], v_mul(indirect[k], occlusion));
    if (rare && rare->translucent)
        brdf_pass(brdf, m, passed, i, color);
    if (has_sheen)
        brdf_sheen(brdf, at, around->irradiance, occlusion, i, color);
    for (int k = 0; k < 3; k++)
        color[k] = v_add(color[k], varying_at(&brdf->emissive[k], i));
    if (coat) {
        load_three(coat, i, normal);
        brdf_add_layer(brdf, lighting, plan, normal, at, occlusion, i, color);
    }
    for (int k = 0; k < 3; k++)
        color[k] = v_mul(color[k], v_setf(lighting->exposure));
}

/* ---- batches ---- */

/* Some of the lights. The earlier ones are added up in the batch already; others may follow. */
typedef struct chosen_lights {
    const int32_t *numbers;
    int count, is_first, is_last;
} chosen_lights;

static ALWAYS_INLINE void brdf_sums(const e3d_texture_batch *m, const chosen_lights *lights, int has_coat, int has_sheen, int i,
                                    brdf_lanes *at)
{
    vf32 zero = v_setf(0.0f);
    for (int k = 0; k < 3; k++) {
        at->direct[k] = lights->is_first ? zero : v_loadf(m->direct[k] + i);
        if (has_coat)
            at->coat_light[k] = lights->is_first ? zero : v_loadf(m->coat[k] + i);
        if (has_sheen)
            at->fuzz[k] = lights->is_first ? zero : v_loadf(m->fuzz[k] + i);
    }
}

static ALWAYS_INLINE void brdf_keep_sums(e3d_texture_batch *m, int has_coat, int has_sheen, int i, const brdf_lanes *at)
{
    for (int k = 0; k < 3; k++) {
        v_storef(m->direct[k] + i, at->direct[k]);
        if (has_coat)
            v_storef(m->coat[k] + i, at->coat_light[k]);
        if (has_sheen)
            v_storef(m->fuzz[k] + i, at->fuzz[k]);
    }
}

/* Shades `count` vectors from i on. Which parts a material has is mostly a constant for the compiler. */
static ALWAYS_INLINE void physical_block(e3d_batch *batch, int i, int count, e3d_texture_batch *m, const e3d_brdf *brdf,
                                         const e3d_lighting *lighting, const environment_plan *plan, const chosen_lights *lights, int has_coat,
                                         int has_sheen, const e3d_brdf *rare)
{
    const e3d_lane_array *coat = has_coat ? coat_normals(m, brdf) : NULL;
    brdf_lanes at[BRDF_VECTORS];
    around_lanes around[BRDF_VECTORS];
    for (int s = 0; s < count; s++) {
        brdf_begin(batch, m, brdf, lighting, has_coat, has_sheen, i + s * V_LANES, &at[s]);
        if (rare)
            brdf_rare(batch, m, rare, i + s * V_LANES, &at[s]);
        brdf_sums(m, lights, has_coat, has_sheen, i + s * V_LANES, &at[s]);
    }
    for (int n = 0; n < lights->count; n++)
        brdf_add_light(lighting, lights->numbers[n], batch, i, count, coat, has_sheen, rare, at);
    if (!lights->is_last) {
        for (int s = 0; s < count; s++)
            brdf_keep_sums(m, has_coat, has_sheen, i + s * V_LANES, &at[s]);
        return;
    }
    around_find(lighting, plan, batch, i, count, rare, at, around);
    for (int s = 0; s < count; s++) {
        vf32 color[3];
        brdf_finish(batch, brdf, lighting, plan, coat, has_sheen, rare, &at[s], &around[s], i + s * V_LANES, m, color);
        for (int k = 0; k < 3; k++)
            v_storef(batch->color[k] + i + s * V_LANES, color[k]);
    }
}

static ALWAYS_INLINE void physical_vectors(e3d_batch *batch, e3d_texture_batch *m, const e3d_brdf *brdf,
                                           const e3d_lighting *lighting,
                                           const environment_plan *plan, const chosen_lights *lights, int has_coat, int has_sheen,
                                           const e3d_brdf *rare)
{
    for (int i = 0; i < batch->count; i += BRDF_VECTORS * V_LANES) {
        int left = (batch->count - i + V_LANES - 1) / V_LANES, count = left < BRDF_VECTORS ? left : BRDF_VECTORS;
        physical_block(batch, i, count, m, brdf, lighting, plan, lights, has_coat, has_sheen, rare);
    }
}

static void physical_some(e3d_batch *batch, e3d_texture_batch *m, const e3d_brdf *brdf, const e3d_lighting *lighting,
                          const environment_plan *plan, const chosen_lights *lights)
{
    if (brdf->is_rare)
        physical_vectors(batch, m, brdf, lighting, plan, lights, brdf->has_coat, brdf->has_sheen, brdf);
    else if (brdf->has_coat || brdf->has_sheen)
        physical_vectors(batch, m, brdf, lighting, plan, lights, brdf->has_coat, brdf->has_sheen, NULL);
    else
        physical_vectors(batch, m, brdf, lighting, plan, lights, 0, 0, NULL);
}

static void kernel_physical(e3d_batch *batch, const e3d_brdf *brdf, const e3d_lighting *lighting, e3d_texture_batch *m)
{
    enum { AT_ONCE = 256 };
    int32_t chosen[AT_ONCE + E3D_PAD];
    light_box box;
    environment_plan plan;
    const environment_plan *around = lighting->environment ? &plan : NULL;
    int boxed = lighting->light_count > E3D_FEW_LIGHTS && light_bounds(batch, &box), first = 0;
    if (around)
        environment_begin(lighting->environment, &plan);
    shadow_suns(lighting, batch);
    do {
        int rest = lighting->light_count - first, end = first + (rest < AT_ONCE ? rest : AT_ONCE);
        int count = light_choose(lighting, first, end, boxed ? &box : NULL, 0, chosen);
        const chosen_lights lights = {chosen, count, first == 0 && !lighting->has_area_lights, end == lighting->light_count};
        physical_some(batch, m, brdf, lighting, around, &lights);
        first = end;
    } while (first < lighting->light_count);
}
