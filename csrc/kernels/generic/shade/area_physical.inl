/* area_physical: area lights on physically based materials (R237, R238). */
#pragma once

#include "base/always_inline.h"
#include "base/limits.h"
#include "e3d.h"
#include "kernels/types/shading.h"
#include "kernels/types/texture_slots.h"
#include "kernels/generic/surface.inl"
#include "kernels/generic/interpolate.inl"
#include "kernels/generic/shade/albedo.inl"
#include "kernels/generic/shade/anisotropy.inl"
#include "kernels/generic/shade/area_light.inl"
#include "kernels/generic/shade/brdf.inl"
#include "kernels/generic/shade/brdf_lights.inl"
#include "kernels/generic/shade/light.inl"
#include "kernels/generic/shade/physical.inl"
#include "kernels/generic/shade/shadow.inl"

/* What a lobe needs for all area lights: its axes, its transform, its albedos, and what it reflects of each channel. */
typedef struct area_shape {
    area_axes axes;
    area_lobe lobe;
    vf32 a, b;
} area_shape;

static ALWAYS_INLINE void area_find_shape(const vf32 normal[3], const vf32 view[3], const lobe_lanes *lobe, area_shape *out)
{
    albedo_place place = albedo_find(lobe->roughness, lobe->nv, E3D_DFG_SIZE);
    out->a = albedo_of(E3D_DFG_A, &place);
    out->b = albedo_of(E3D_DFG_B, &place);
    area_find_axes(normal, view, &out->axes);
    area_find_lobe(&out->axes, lobe->roughness, &out->lobe);
}

/* The axes of the normal, the lobes of a material, and where they are. */
typedef struct area_sample {
    vf32 position[3], normal[3];
    area_axes axes;
    area_shape base, coat;
    int bends; /* the base has other axes */
} area_sample;

static ALWAYS_INLINE void area_find_sample(const e3d_batch *batch, const e3d_brdf *rare, const e3d_lane_array *coat, int i,
                                           const brdf_lanes *at, area_sample *out)
{
    vf32 bent[3];
    load_three(batch->position, i, out->position);
    load_three(batch->normal, i, out->normal);
    area_find_axes(out->normal, at->view, &out->axes);
    out->bends = rare && rare->anisotropic;
    for (int k = 0; k < 3; k++)
        bent[k] = out->normal[k];
    if (out->bends)
        stretch_bend(&at->stretch, out->normal, at->view, at->base.roughness, bent);
    area_find_shape(bent, at->view, &at->base, &out->base);
    if (!coat)
        return;
    load_three(coat, i, bent);
    area_find_shape(bent, at->view, &at->coat, &out->coat);
}

/* R237: the share of a light that a lobe reflects, before F. `turned` is in the lobe's axes, or NULL. */
static ALWAYS_INLINE vf32 area_shine_of(const e3d_light *light, const vf32 position[3], const area_lanes *turned, const area_shape *of)
{
    area_lanes area;
    if (!turned) {
        area_place(light, position, &area);
        area_turn(&of->axes, &area);
        turned = &area;
    }
    return v_mul(area_shine(light, turned, &of->lobe), v_setf(E3D_OVER_2PI));
}

static ALWAYS_INLINE void area_brdf_base(const e3d_light *light, const e3d_brdf *rare, const area_sample *sample, const area_lit *on,
                                         vf32 w5, brdf_lanes *at)
{
    const area_shape *base = &sample->base;
    vf32 top = v_add(at->top, v_mul(at->rise, w5)), both = v_add(base->a, base->b);
    if (rare && rare->iridescent)
        top = v_add(top, v_mul(v_sub(at->film_top, top), at->film_share));
    vf32 keep = v_mul(v_sub(v_setf(1.0f), top), on->e);
    vf32 shine = v_mul(area_shine_of(light, sample->position, sample->bends ? NULL : &on->turned, base), on->share);
    for (int k = 0; k < 3; k++) {
        vf32 albedo = v_add(v_mul(at->f0[k], both), v_mul(at->f_rise[k], base->b));
        if (rare && rare->iridescent)
            albedo = v_add(albedo, v_mul(v_sub(v_mul(at->film[k], both), albedo), at->film_share));
        vf32 shown = v_add(v_mul(at->diffuse[k], keep), v_mul(shine, albedo));
        at->direct[k] = v_self(on->lit, v_add(at->direct[k], v_mul(v_setf(light->color[k]), shown)), at->direct[k]);
    }
}

/* Adds light n to a vector. coat: the coat's normals, or NULL. */
static __attribute__((noinline)) void area_brdf_add(const e3d_lighting *lighting, int n, const e3d_batch *batch, int i,
                                                    const e3d_brdf *brdf, const area_sample *sample, brdf_lanes *at)
{
    const e3d_light *light = &lighting->lights[n];
    const e3d_brdf *rare = brdf->is_rare ? brdf : NULL;
    area_lit on;
    half_lanes h;
    if (!area_meet(lighting, n, batch, i, sample->position, &sample->axes, &on))
        return;
    for (int k = 0; k < 3; k++)
        h.h[k] = v_add(on.l[k], at->view[k]);
    h.square = dot_three(h.h, h.h);
    vf32 w5 = fifth_power(v_max(v_sub(v_setf(1.0f), v_mul(v_sqrt(h.square), v_setf(0.5f))), v_setf(0.0f)));
    area_brdf_base(light, rare, sample, &on, w5, at);
    if (brdf->has_coat) {
        vf32 shine = area_shine_of(light, sample->position, NULL, &sample->coat);
        shine = v_mul(v_mul(shine, v_add(sample->coat.a, sample->coat.b)), on.share);
        light_sum(at->coat_light, light->color, shine, &on.lit);
    }
    if (brdf->has_sheen) {
        vf32 fuzz = sheen_reflect(at, sample->normal, &h, dot_three(sample->normal, on.l));
        light_sum(at->fuzz, light->color, v_mul(fuzz, on.e), &on.lit);
    }
}

static void kernel_area_physical(e3d_batch *batch, const e3d_brdf *brdf, const e3d_lighting *lighting, e3d_texture_batch *m)
{
    enum { AT_ONCE = 256 };
    int32_t chosen[AT_ONCE + E3D_PAD];
    light_box box;
    int boxed = light_bounds(batch, &box);
    shadow_no_suns(batch);
    const e3d_lane_array *coat = brdf->has_coat ? coat_normals(m, brdf) : NULL;
    for (int first = 0; first < lighting->light_count; first += AT_ONCE) {
        int rest = lighting->light_count - first, end = first + (rest < AT_ONCE ? rest : AT_ONCE);
        int count = light_choose(lighting, first, end, boxed ? &box : NULL, 1, chosen);
        const chosen_lights lights = {chosen, count, first == 0, end == lighting->light_count};
        for (int i = 0; i < batch->count; i += V_LANES) {
            brdf_lanes at;
            area_sample sample;
            brdf_begin(batch, m, brdf, lighting, brdf->has_coat, brdf->has_sheen, i, &at);
            if (brdf->is_rare)
                brdf_rare(batch, m, brdf, i, &at);
            brdf_sums(m, &lights, brdf->has_coat, brdf->has_sheen, i, &at);
            area_find_sample(batch, brdf->is_rare ? brdf : NULL, coat, i, &at, &sample);
            for (int n = 0; n < count; n++)
                area_brdf_add(lighting, chosen[n], batch, i, brdf, &sample, &at);
            brdf_keep_sums(m, brdf->has_coat, brdf->has_sheen, i, &at);
        }
    }
}
