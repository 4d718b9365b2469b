/* Lights on physically based materials, and light from all around (R50-R55, R138, R168). */
#pragma once

#include "base/always_inline.h"
#include "base/limits.h"
#include "e3d.h"
#include "kernels/types/texture_slots.h"
#include "kernels/types/shading.h"
#include "kernels/generic/surface.inl"
#include "kernels/generic/interpolate.inl"
#include "kernels/generic/shade/light.inl"
#include "kernels/generic/shade/shadow.inl"
#include "kernels/generic/shade/albedo.inl"
#include "kernels/generic/shade/environment.inl"
#include "kernels/generic/shade/texture_slots.inl"
#include "kernels/generic/shade/anisotropy.inl"
#include "kernels/generic/shade/brdf.inl"

/* A light at a sample, by the half vector h = l + v. */
typedef struct half_lanes {
    vf32 h[3], square;
} half_lanes;

/* R50 and R217: D times V. */
static ALWAYS_INLINE vf32 lobe_reflect(const lobe_lanes *lobe, const vf32 normal[3], const half_lanes *h, vf32 nl)
{
    vf32 k[3], nh = v_add(nl, lobe->facing), zero = v_setf(0.0f);
    cross_three(normal, h->h, k);
    vf32 core = v_mul(lobe->A, v_mul(nh, nh)), t = v_add(dot_three(k, k), core);
    vf32 root = v_sqrt(v_add(lobe->A, v_mul(v_sub(v_setf(1.0f), lobe->A), v_mul(nl, nl))));
    vf32 u = v_add(v_mul(lobe->nv, root), v_mul(nl, lobe->root));
    vf32 width = v_add(lobe->own, v_mul(lobe->more, v_div(core, t)));
    vf32 above = v_mul(v_mul(width, v_setf(E3D_OVER_2PI)), v_mul(h->square, h->square));
    return v_self(v_gt(nh, zero), v_div(above, v_mul(v_mul(t, t), u)), zero);
}

static ALWAYS_INLINE vf32 fifth_power(vf32 w)
{
    vf32 w2 = v_mul(w, w);
    return v_mul(v_mul(w2, w2), w);
}

/* R27 */
static inline vf32 pow_poly(vf32 x, vf32 n)
{
    vmask some = v_ge(x, v_setf(0x1p-100f));
    vf32 safe = v_self(some, x, v_setf(1.0f));
    return v_self(some, exp2_poly(v_mul(n, log2_poly(safe))), v_setf(0.0f));
}

/* R53: D times V. */
static inline vf32 sheen_reflect(const brdf_lanes *at, const vf32 normal[3], const half_lanes *h, vf32 nl)
{
    vf32 k[3], one = v_setf(1.0f), nv = v_min(at->base.nv, one);
    cross_three(normal, h->h, k);
    vf32 x = v_div(dot_three(k, k), h->square), i = at->sheen_power;
    vf32 d = v_mul(v_mul(v_add(v_setf(2.0f), i), v_setf(E3D_OVER_2PI)), pow_poly(x, v_mul(i, v_setf(0.5f))));
    vf32 v = v_mul(v_setf(4.0f), v_sub(v_add(nl, nv), v_mul(nl, nv)));
    return v_mul(d, v_div(one, v));
}

/* A light on one vector: the direction to it, the lanes in which it adds light, and att, e, d and w5 of R51. */
typedef struct light_lanes {
    vf32 l[3], nl, attenuation, e, d, w5;
    vmask lit;
} light_lanes;

/* Finds the direction to a light, and the share of it that arrives; 0 if no lane gets any. */
static ALWAYS_INLINE int brdf_meet(const e3d_lighting *lighting, int n, const e3d_batch *batch, int i, int has_coat,
                                   light_lanes *on)
{
    const e3d_light *light = &lighting->lights[n];
    vf32 position[3], normal[3], l[3], attenuation = v_setf(1.0f), zero = v_setf(0.0f);
    vmask near = v_eq(zero, zero);
    load_three(batch->position, i, position);
    load_three(batch->normal, i, normal);
    if (e3d_light_traits_of(light->kind).has_position)
        near = light_towards(lighting, n, position, 1, l, &attenuation);
    else
        for (int k = 0; k < 3; k++)
            l[k] = v_setf(light->to_light[k]);
    vf32 nl = dot_three(normal, l);
    vmask lit = v_mand(near, v_gt(nl, zero));
    if (lighting->shadows && light->shadow.kind && v_any(lit)) {
        vf32 reached = light_reached(lighting, n, batch, i, position, l);
        lit = v_mand(lit, v_gt(reached, zero));
        attenuation = v_mul(attenuation, reached);
    }
    for (int k = 0; k < 3; k++)
        on->l[k] = l[k];
    on->nl = nl;
    on->e = v_mul(attenuation, nl);
    if (has_coat)
        on->attenuation = attenuation;
    on->lit = lit;
    return v_any(lit);
}

static ALWAYS_INLINE void brdf_add_coat(const e3d_light *light, const vf32 normal[3], const light_lanes *on,
                                        const half_lanes *h, brdf_lanes *at)
{
    vf32 nl = dot_three(normal, on->l);
    vmask lit = v_mand(on->lit, v_gt(nl, v_setf(0.0f)));
    light_sum(at->coat_light, light->color, v_mul(lobe_reflect(&at->coat, normal, h, nl), v_mul(on->attenuation, nl)), &lit);
}

/* Finds the specular terms of R51 that all channels share. coat: the coat's normals, or NULL. */
static ALWAYS_INLINE void brdf_shine(const e3d_light *light, const e3d_batch *batch, int i, const e3d_lane_array *coat,
                                     int has_sheen,
                                     const e3d_brdf *rare, brdf_lanes *at, light_lanes *on)
{
    vf32 normal[3], one = v_setf(1.0f), zero = v_setf(0.0f), nl = on->nl, d;
    half_lanes h;
    load_three(batch->normal, i, normal);
    for (int k = 0; k < 3; k++)
        h.h[k] = v_add(on->l[k], at->view[k]);
    h.square = dot_three(h.h, h.h);
    on->w5 = fifth_power(v_max(v_sub(one, v_mul(v_sqrt(h.square), v_setf(0.5f))), zero));
    if (rare && rare->anisotropic)
        d = stretch_reflect(&at->stretch, at->base.nv, on->l, nl, h.h, h.square, v_add(nl, at->base.facing));
    else
        d = lobe_reflect(&at->base, normal, &h, nl);
    on->d = v_mul(d, on->e);
    if (has_sheen)
        light_sum(at->fuzz, light->color, v_mul(sheen_reflect(at, normal, &h, nl), on->e), &on->lit);
    if (coat) {
        load_three(coat, i, normal);
        brdf_add_coat(light, normal, on, &h, at);
    }
}

static ALWAYS_INLINE void brdf_add(const e3d_light *light, const e3d_brdf *rare, const light_lanes *on, brdf_lanes *at)
{
    vf32 top = v_add(at->top, v_mul(at->rise, on->w5));
    if (rare && rare->iridescent)
        top = v_add(top, v_mul(v_sub(at->film_top, top), at->film_share));
    vf32 keep = v_mul(v_sub(v_setf(1.0f), top), on->e);
    for (int k = 0; k < 3; k++) {
        vf32 fresnel = v_add(at->f0[k], v_mul(at->f_rise[k], on->w5));
        if (rare && rare->iridescent)
            fresnel = v_add(fresnel, v_mul(v_sub(at->film[k], fresnel), at->film_share));
        vf32 shown = v_add(v_mul(at->diffuse[k], keep), v_mul(on->d, fresnel));
        at->direct[k] = v_self(on->lit, v_add(at->direct[k], v_mul(v_setf(light->color[k]), shown)), at->direct[k]);
    }
}

/* R51: adds one light to vectors from i on. rare: NULL, or the BRDF if it has what few materials have. */
static ALWAYS_INLINE void brdf_add_light(const e3d_lighting *lighting, int n, const e3d_batch *batch, int i, int count,
                                         const e3d_lane_array *coat, int has_sheen, const e3d_brdf *rare,
                                         brdf_lanes at[BRDF_VECTORS])
{
    const e3d_light *light = &lighting->lights[n];
    light_lanes on[BRDF_VECTORS];
    int lit[BRDF_VECTORS + 1], lit_count = 0;
    for (int s = 0; s < count; s++) {
        lit[lit_count] = s;
        lit_count += brdf_meet(lighting, n, batch, i + s * V_LANES, coat != NULL, &on[s]);
    }
    for (int s = 0; s < lit_count; s++)
        brdf_shine(light, batch, i + lit[s] * V_LANES, coat, has_sheen, rare, &at[lit[s]], &on[lit[s]]);
    for (int s = 0; s < lit_count; s++)
        brdf_add(light, rare, &on[lit[s]], &at[lit[s]]);
}

/* ---- light from all around (R54, R55, R138) ---- */

static ALWAYS_INLINE void around_irradiance(const e3d_lighting *lighting, const environment_plan *plan, const vf32 normal[3], vf32 out[3])
{
    vf32 more[3];
    if (plan)
        environment_irradiance(plan, normal, more);
    ambient_light(lighting, normal, out);
    for (int k = 0; k < 3 && plan; k++)
        out[k] = v_add(out[k], more[k]);
}

static ALWAYS_INLINE void around_radiance(const e3d_lighting *lighting, const environment_plan *plan, const vf32 normal[3],
                                          const lobe_lanes *lobe, const vf32 view[3], vf32 out[3])
{
    vf32 mirrored[3], more[3], twice = v_add(lobe->facing, lobe->facing);
    for (int k = 0; k < 3 && (plan || lighting->ambient_terms); k++)
        mirrored[k] = v_sub(v_mul(normal[k], twice), view[k]);
    if (plan)
        environment_specular(plan, mirrored, lobe->roughness, more);
    ambient_light(lighting, mirrored, out);
    for (int k = 0; k < 3 && plan; k++)
        out[k] = v_add(out[k], more[k]);
}

/* R55: a lobe under light that is 1 all around. once: the share that it reflects once; twice: a factor for light reflected
 * more often. */
typedef struct scatter_lanes {
    vf32 once, twice, q;
} scatter_lanes;

static ALWAYS_INLINE scatter_lanes around_scatter(vf32 f0, vf32 f90, vf32 a, vf32 b, vf32 rest)
{
    vf32 one = v_setf(1.0f), x = v_add(v_mul(f0, a), v_mul(f90, b));
    vf32 y = v_add(f0, v_mul(v_sub(f90, f0), v_setf(E3D_OVER_21)));
    return (scatter_lanes){x, v_mul(x, y), v_sub(one, v_mul(rest, y))};
}

/* R138: the radiance that the base mirrors. */
static ALWAYS_INLINE void around_base(const e3d_lighting *lighting, const environment_plan *plan, const vf32 normal[3],
                                      const brdf_lanes *at,
                                      const e3d_brdf *rare, vf32 out[3])
{
    if (!rare || !rare->anisotropic) {
        around_radiance(lighting, plan, normal, &at->base, at->view, out);
        return;
    }
    lobe_lanes base = at->base;
    vf32 bent[3];
    stretch_bend(&at->stretch, normal, at->view, at->base.roughness, bent);
    base.facing = dot_three(bent, at->view);
    around_radiance(lighting, plan, bent, &base, at->view, out);
}

/* Light from all around on one vector, and the albedos of its base. */
typedef struct around_lanes {
    albedo_place place;
    vf32 irradiance[3], radiance[3], a, b;
} around_lanes;

/* Finds light from all around for vectors from i on, interleaved as for lights. */
static ALWAYS_INLINE void around_find(const e3d_lighting *lighting, const environment_plan *plan, const e3d_batch *batch, int i, int count,
                                      const e3d_brdf *rare, const brdf_lanes at[BRDF_VECTORS], around_lanes out[BRDF_VECTORS])
{
    vf32 normal[3];
    for (int s = 0; s < count; s++)
        out[s].place = albedo_find(at[s].base.roughness, at[s].base.nv, E3D_DFG_SIZE);
    for (int s = 0; s < count; s++) {
        load_three(batch->normal, i + s * V_LANES, normal);
        around_irradiance(lighting, plan, normal, out[s].irradiance);
    }
    for (int s = 0; s < count; s++) {
        load_three(batch->normal, i + s * V_LANES, normal);
        around_base(lighting, plan, normal, &at[s], rare, out[s].radiance);
    }
    for (int s = 0; s < count && rare && rare->unmirrored; s++) /* R211 */
        for (int k = 0; k < 3; k++)
            out[s].radiance[k] = v_mul(out[s].radiance[k], v_loadf(rare->unmirrored + i + s * V_LANES));
    for (int s = 0; s < count; s++) {
        out[s].a = albedo_of(E3D_DFG_A, &out[s].place);
        out[s].b = albedo_of(E3D_DFG_B, &out[s].place);
    }
}

/* R168: what shows of the light on the other side; left: the share that is not reflected. */
static ALWAYS_INLINE vf32 around_backlight(const e3d_batch *batch, const e3d_brdf *brdf, int k, int i, const brdf_lanes *at, vf32 left)
{
    vf32 one = v_setf(1.0f), share = brdf->transmits ? v_mul(at->passing, at->rest) : at->passing;
    vf32 light = v_mul(v_loadf(batch->energy[k] + i), v_mul(varying_at(&brdf->passing[k], i), left));
    return v_mul(v_mul(light, share), v_sub(one, at->metallic));
}

/* R55. through: the share of the light behind that passes (R134); passed: the light of R168, before it is absorbed. */
static ALWAYS_INLINE void around_indirect(const e3d_batch *batch, const e3d_brdf *brdf, const e3d_brdf *rare, int i,
                                          const brdf_lanes *at, const around_lanes *around, vf32 through[3], vf32 passed[3], vf32 out[3])
{
    const vf32 *radiance = around->radiance, *irradiance = around->irradiance;
    vf32 one = v_setf(1.0f), a = around->a, b = around->b, rest = v_sub(one, v_add(a, b)), specular = varying_at(&brdf->specular, i);
    scatter_lanes other = around_scatter(brdf_reflectance(brdf, 0, i), specular, a, b, rest);
    for (int k = 0; k < 3; k++) {
        vf32 albedo = v_loadf(batch->color[k] + i);
        scatter_lanes metal = around_scatter(rare && rare->iridescent ? at->metal_f0[k] : albedo, one, a, b, rest);
        if (rare && rare->iridescent)
            other = around_scatter(at->other_f0[k], specular, a, b, rest);
        else if (!brdf->is_grey)
            other = around_scatter(brdf_reflectance(brdf, k, i), specular, a, b, rest);
        vf32 r = v_div(one, v_mul(metal.q, other.q));
        vf32 zt = v_mul(v_mul(metal.twice, v_mul(r, other.q)), rest), zd = v_mul(v_mul(other.twice, v_mul(r, metal.q)), rest);
        vf32 t = v_add(v_mul(radiance[k], metal.once), v_mul(irradiance[k], zt));
        vf32 d = v_add(v_mul(radiance[k], other.once), v_mul(irradiance[k], zd));
        vf32 left = v_sub(one, v_add(other.once, zd)), below = v_mul(albedo, left);
        if (rare && rare->transmits)
            through[k] = v_mul(v_mul(below, at->transmission), v_sub(one, at->metallic));
        if (rare && rare->translucent) {
            passed[k] = around_backlight(batch, brdf, k, i, at, left);
            below = v_mul(below, at->scattered);
        }
        if (rare && rare->transmits)
            below = v_mul(below, at->rest);
        d = v_add(d, v_mul(irradiance[k], below));
        out[k] = v_add(d, v_mul(v_sub(t, d), at->metallic));
    }
}
