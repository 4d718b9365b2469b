/* BRDF: physically based materials at the samples of a vector (R49, R134, R141, R168, R193). */
#pragma once

#include "base/always_inline.h"
#include "base/limits.h"
#include "e3d.h"
#include "kernels/types/texture_slots.h"
#include "kernels/types/shading.h"
#include "kernels/generic/surface.inl"
#include "kernels/generic/interpolate.inl"
#include "kernels/generic/shade/environment.inl"
#include "kernels/generic/shade/texture_slots.inl"
#include "kernels/generic/shade/anisotropy.inl"
#include "kernels/generic/shade/iridescence.inl"

/* So many vectors are interleaved, since each step loops over them. One vector has a chain of some thousand operations with
 * roots and quotients, of which a processor sees only a few hundred at once. */
enum { BRDF_VECTORS = 4 };

/* A lobe of GGX about a normal. */
typedef struct lobe_lanes {
    vf32 facing; /* n . v, of either sign */
    vf32 nv, roughness, A, root;
    vf32 own, more; /* R193: A without what was added to it, and twice that */
} lobe_lanes;

/* One vector of a batch: its surface, and the light on it so far. What the batch holds is read again there, since loads cost
 * less than stores. */
typedef struct brdf_lanes {
    vf32 view[3];
    lobe_lanes base, coat;
    vf32 metallic, top, diffuse[3], f0[3];
    vf32 rise, f_rise[3]; /* what Schlick's term adds at a grazing angle: to `top`, to `f0` */
    vf32 sheen_power; /* 1 / alpha of the sheen */
    vf32 transmission, rest; /* rest: 1 - transmission (R134) */
    vf32 passing, scattered; /* D of R168; scattered: 1 - D */
    stretch_lanes stretch;
    vf32 film_share, film[3], film_top; /* R141: what a film reflects of each channel, and the greatest of that without metal */
    vf32 other_f0[3], metal_f0[3];
    vf32 direct[3], coat_light[3], fuzz[3];
} brdf_lanes;

static ALWAYS_INLINE void load_three(const e3d_lane_array *lanes, int i, vf32 out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = v_loadf(lanes[k] + i);
}

static ALWAYS_INLINE const e3d_lane_array *coat_normals(const e3d_texture_batch *m, const e3d_brdf *brdf)
{
    return brdf->coat_is_mapped ? m->coat_normal : m->shading_normal;
}

/* R49 */
static ALWAYS_INLINE void lobe_width(vf32 roughness, lobe_lanes *lobe)
{
    lobe->roughness = v_min(v_max(roughness, v_setf(E3D_LEAST_ROUGHNESS)), v_setf(1.0f));
    vf32 alpha = v_mul(lobe->roughness, lobe->roughness);
    lobe->A = lobe->own = v_mul(alpha, alpha);
    lobe->more = v_setf(0.0f);
}

/* R193 */
static ALWAYS_INLINE void lobe_widen(vf32 wide, lobe_lanes *lobe)
{
    vf32 one = v_setf(1.0f), some = v_min(v_add(lobe->own, v_mul(wide, v_setf(0.25f))), one);
    lobe->A = v_min(v_add(lobe->own, wide), one);
    lobe->more = v_mul(v_setf(2.0f), v_sub(lobe->A, lobe->own));
    lobe->roughness = v_self(v_gt(wide, v_setf(0.0f)), v_sqrt(v_sqrt(some)), lobe->roughness);
}

static ALWAYS_INLINE void lobe_begin(const vf32 normal[3], const vf32 view[3], lobe_lanes *lobe)
{
    vf32 one = v_setf(1.0f);
    lobe->facing = dot_three(normal, view);
    lobe->nv = v_max(environment_abs(lobe->facing), v_setf(E3D_LEAST_COSINE));
    lobe->root = v_sqrt(v_add(lobe->A, v_mul(v_sub(one, lobe->A), v_mul(lobe->nv, lobe->nv))));
}

/* Finds the direction towards the eye (R31). */
static ALWAYS_INLINE void brdf_view(const float eye[4], const float *const position[3], int i, vf32 view[3])
{
    for (int k = 0; k < 3; k++)
        view[k] = eye[3] != 0.0f ? v_sub(v_setf(eye[k]), v_loadf(position[k] + i)) : v_setf(eye[k]);
    if (eye[3] != 0.0f)
        unit_length(view);
}

static ALWAYS_INLINE vf32 brdf_reflectance(const e3d_brdf *brdf, int k, int i)
{
    return v_mul(v_min(varying_at(&brdf->reflectance[k], i), v_setf(1.0f)), varying_at(&brdf->specular, i));
}

static ALWAYS_INLINE vf32 usable_sheen_roughness(const e3d_brdf *brdf, int i)
{
    return v_min(v_max(varying_at(&brdf->sheen_roughness, i), v_setf(E3D_LEAST_SHEEN_ROUGHNESS)), v_setf(1.0f));
}

static ALWAYS_INLINE void brdf_begin(const e3d_batch *batch, const e3d_texture_batch *m, const e3d_brdf *brdf,
                                     const e3d_lighting *lighting, int has_coat, int has_sheen, int i, brdf_lanes *at)
{
    vf32 one = v_setf(1.0f), normal[3], albedo[3], f[3], specular = varying_at(&brdf->specular, i);
    load_three(batch->normal, i, normal);
    load_three(batch->color, i, albedo);
    const float *const position[3] = {batch->position[0], batch->position[1], batch->position[2]};
    brdf_view(lighting->eye, position, i, at->view);
    lobe_width(varying_at(&brdf->roughness, i), &at->base);
    if (brdf->is_widened)
        lobe_widen(varying_at(&brdf->wide, i), &at->base);
    lobe_begin(normal, at->view, &at->base);
    at->metallic = varying_at(&brdf->metallic, i);
    vf32 rest = v_sub(one, at->metallic), f90 = v_add(specular, v_mul(v_sub(one, specular), at->metallic));
    for (int k = 0; k < 3; k++) {
        f[k] = brdf_reflectance(brdf, k, i);
        vf32 f0 = v_add(f[k], v_mul(v_sub(albedo[k], f[k]), at->metallic));
        at->f0[k] = f0;
        at->f_rise[k] = v_sub(f90, f0);
        at->diffuse[k] = v_mul(v_mul(albedo[k], rest), v_setf(E3D_OVER_PI));
    }
    at->top = v_max(v_max(f[0], f[1]), f[2]);
    at->rise = v_sub(specular, at->top);
    if (has_coat) {
        load_three(coat_normals(m, brdf), i, normal);
        lobe_width(varying_at(&brdf->coat_roughness, i), &at->coat);
        if (brdf->is_widened)
            lobe_widen(varying_at(&brdf->coat_wide, i), &at->coat);
        lobe_begin(normal, at->view, &at->coat);
    }
    if (has_sheen) {
        vf32 rough = usable_sheen_roughness(brdf, i);
        at->sheen_power = v_div(one, v_mul(rough, rough));
    }
}

/* ---- what few materials have ---- */

/* R134: light that passes is not scattered. */
static ALWAYS_INLINE void brdf_transmission(const e3d_brdf *brdf, int i, brdf_lanes *at)
{
    at->transmission = varying_at(&brdf->transmission, i);
    at->rest = v_sub(v_setf(1.0f), at->transmission);
    for (int k = 0; k < 3; k++)
        at->diffuse[k] = v_mul(at->diffuse[k], at->rest);
}

/* R168: nor is light that passes scattered to this side. */
static ALWAYS_INLINE void brdf_translucency(const e3d_brdf *brdf, int i, brdf_lanes *at)
{
    at->passing = varying_at(&brdf->diffuse_transmission, i);
    at->scattered = v_sub(v_setf(1.0f), at->passing);
    for (int k = 0; k < 3; k++)
        at->diffuse[k] = v_mul(at->diffuse[k], at->scattered);
}

/* R141 */
static inline void brdf_iridescence(const e3d_batch *batch, const e3d_brdf *brdf, int i, brdf_lanes *at)
{
    vf32 other[3], metal[3], zero = v_setf(0.0f), cosine = v_min(at->base.nv, v_setf(1.0f));
    load_three(batch->color, i, at->metal_f0);
    for (int k = 0; k < 3; k++)
        at->other_f0[k] = brdf_reflectance(brdf, k, i);
    vf32 thickness = v_add(v_setf(brdf->iridescence_thickness_least), varying_at(&brdf->iridescence_thickness, i));
    if (!brdf->iridescence_thickness.lanes)
        thickness = v_setf(brdf->iridescence_thickness.factor);
    at->film_share = v_self(v_gt(thickness, zero), varying_at(&brdf->iridescence, i), zero);
    iridescence_reflect(cosine, brdf->iridescence_ior, thickness, at->other_f0, other);
    iridescence_reflect(cosine, brdf->iridescence_ior, thickness, at->metal_f0, metal);
    for (int k = 0; k < 3; k++)
        at->film[k] = v_add(other[k], v_mul(v_sub(metal[k], other[k]), at->metallic));
    at->film_top = v_max(v_max(other[0], other[1]), other[2]);
    iridescence_mix_f0(cosine, other, at->film_share, at->other_f0);
    iridescence_mix_f0(cosine, metal, at->film_share, at->metal_f0);
}

static ALWAYS_INLINE void brdf_rare(const e3d_batch *batch, const e3d_texture_batch *m, const e3d_brdf *brdf, int i,
                                    brdf_lanes *at)
{
    vf32 normal[3];
    load_three(batch->normal, i, normal);
    if (brdf->translucent)
        brdf_translucency(brdf, i, at);
    if (brdf->transmits)
        brdf_transmission(brdf, i, at);
    if (brdf->anisotropic)
        stretch_begin(m, &brdf->stretch, normal, at->view, at->base.nv, at->base.roughness, i, &at->stretch);
    if (brdf->iridescent)
        brdf_iridescence(batch, brdf, i, at);
}
