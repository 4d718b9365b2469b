/* physical: light on physically based materials (R49-R57). */
#ifndef E3D_KERNELS_PHYSICAL_INL
#define E3D_KERNELS_PHYSICAL_INL

#include "core/always_inline.h"
#include "core/limits.h"
#include "e3d.h"
#include "kernels/types/maps.h"
#include "kernels/types/shading.h"
#include "kernels/generic/surface.inl"
#include "kernels/generic/interpolate.inl"
#include "kernels/generic/light.inl"
#include "kernels/generic/shadow.inl"
#include "kernels/generic/albedo.inl"
#include "kernels/generic/environment.inl"
#include "kernels/generic/maps.inl"
#include "kernels/generic/anisotropy.inl"
#include "kernels/generic/film.inl"

/* ---- a sample (R49) ---- */

/* A lobe of GGX about a normal. */
typedef struct lobe_lanes {
    vf32 normal[3], facing; /* facing: n . v, of either sign */
    vf32 nv, roughness, A, root;
} lobe_lanes;

typedef struct model_lanes {
    vf32 position[3], view[3];
    lobe_lanes base, coat;
    vf32 metallic, albedo[3], reflectance[3], specular, top, diffuse[3], f0[3];
    vf32 rise, f_rise[3]; /* what Schlick's term adds at a grazing angle: to top, to f0 */
    vf32 sheen_power; /* 1 / alpha of the sheen */
    vf32 transmission, rest; /* rest: 1 less it (R134) */
    stretch_lanes stretch;
    vf32 film_share, film[3], film_top; /* R141: what a film reflects of all, and the most of what is no metal */
    vf32 other_f0[3], metal_f0[3];
    vf32 direct[3], coat_light[3], fuzz[3];
} model_lanes;

static ALWAYS_INLINE void lobe_begin(const vf32 view[3], vf32 roughness, lobe_lanes *lobe)
{
    vf32 one = v_setf(1.0f);
    lobe->roughness = v_min(v_max(roughness, v_setf(E3D_LEAST_ROUGHNESS)), one);
    vf32 alpha = v_mul(lobe->roughness, lobe->roughness);
    lobe->A = v_mul(alpha, alpha);
    lobe->facing = dot_three(lobe->normal, view);
    lobe->nv = v_max(environment_abs(lobe->facing), v_setf(E3D_LEAST_COSINE));
    lobe->root = v_sqrt(v_add(lobe->A, v_mul(v_sub(one, lobe->A), v_mul(lobe->nv, lobe->nv))));
}

static ALWAYS_INLINE void model_view(const e3d_lighting *lighting, model_lanes *at)
{
    for (int k = 0; k < 3; k++) {
        vf32 eye = v_setf(lighting->eye[k]);
        at->view[k] = lighting->eye[3] != 0.0f ? v_sub(eye, at->position[k]) : eye;
    }
    if (lighting->eye[3] != 0.0f)
        unit_length(at->view);
}

static ALWAYS_INLINE void model_coat(const e3d_batch *batch, const e3d_map_batch *m, const e3d_surface_model *model, int i, model_lanes *at)
{
    const e3d_lane_array *normal = model->coat_is_mapped ? m->coat_normal : m->shading_normal;
    (void)batch;
    for (int k = 0; k < 3; k++)
        at->coat.normal[k] = v_loadf(normal[k] + i);
    lobe_begin(at->view, varying_at(&model->coat_roughness, i), &at->coat);
}

static ALWAYS_INLINE vf32 usable_sheen_roughness(const e3d_surface_model *model, int i)
{
    return v_min(v_max(varying_at(&model->sheen_roughness, i), v_setf(E3D_LEAST_SHEEN_ROUGHNESS)), v_setf(1.0f));
}

static ALWAYS_INLINE void model_begin(const e3d_batch *batch, const e3d_map_batch *m, const e3d_surface_model *model,
                                      const e3d_lighting *lighting, int i, model_lanes *at)
{
    vf32 one = v_setf(1.0f);
    for (int k = 0; k < 3; k++) {
        at->position[k] = v_loadf(batch->position[k] + i);
        at->base.normal[k] = v_loadf(batch->normal[k] + i);
        at->albedo[k] = v_loadf(batch->color[k] + i);
    }
    model_view(lighting, at);
    lobe_begin(at->view, varying_at(&model->roughness, i), &at->base);
    at->metallic = varying_at(&model->metallic, i);
    at->specular = varying_at(&model->specular, i);
    vf32 rest = v_sub(one, at->metallic);
    for (int k = 0; k < 3; k++) {
        vf32 f = v_mul(v_min(varying_at(&model->reflectance[k], i), one), at->specular);
        at->reflectance[k] = f;
        at->f0[k] = v_add(f, v_mul(v_sub(at->albedo[k], f), at->metallic));
        at->diffuse[k] = v_mul(v_mul(at->albedo[k], rest), v_setf(E3D_OVER_PI));
    }
    vf32 f90 = v_add(at->specular, v_mul(v_sub(one, at->specular), at->metallic));
    at->top = v_max(v_max(at->reflectance[0], at->reflectance[1]), at->reflectance[2]);
    at->rise = v_sub(at->specular, at->top);
    for (int k = 0; k < 3; k++)
        at->f_rise[k] = v_sub(f90, at->f0[k]);
    if (model->has_coat)
        model_coat(batch, m, model, i, at);
    if (model->has_sheen) {
        vf32 rough = usable_sheen_roughness(model, i);
        at->sheen_power = v_div(one, v_mul(rough, rough));
    }
}

/* ---- lights (R50-R53) ---- */

/* A light at a sample, in terms of h = l + v. */
typedef struct half_lanes {
    vf32 h[3], square;
} half_lanes;

/* R50: D times V. */
static ALWAYS_INLINE vf32 lobe_reflect(const lobe_lanes *lobe, const half_lanes *h, vf32 nl)
{
    vf32 k[3], nh = v_add(nl, lobe->facing), zero = v_setf(0.0f);
    cross_three(lobe->normal, h->h, k);
    vf32 t = v_add(dot_three(k, k), v_mul(lobe->A, v_mul(nh, nh)));
    vf32 root = v_sqrt(v_add(lobe->A, v_mul(v_sub(v_setf(1.0f), lobe->A), v_mul(nl, nl))));
    vf32 u = v_add(v_mul(lobe->nv, root), v_mul(nl, lobe->root));
    vf32 above = v_mul(v_mul(lobe->A, v_setf(E3D_OVER_2PI)), v_mul(h->square, h->square));
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
static inline vf32 sheen_reflect(const model_lanes *at, const half_lanes *h, vf32 nl)
{
    vf32 k[3], one = v_setf(1.0f), nv = v_min(at->base.nv, one);
    cross_three(at->base.normal, h->h, k);
    vf32 x = v_div(dot_three(k, k), h->square), i = at->sheen_power;
    vf32 d = v_mul(v_mul(v_add(v_setf(2.0f), i), v_setf(E3D_OVER_2PI)), pow_poly(x, v_mul(i, v_setf(0.5f))));
    vf32 v = v_mul(v_setf(4.0f), v_sub(v_add(nl, nv), v_mul(nl, nv)));
    return v_mul(d, v_div(one, v));
}

static ALWAYS_INLINE void model_add_coat(const e3d_light *light, const vf32 l[3], vf32 attenuation, vmask lit, const half_lanes *h, model_lanes *at)
{
    vf32 nl = dot_three(at->coat.normal, l);
    lit = v_mand(lit, v_gt(nl, v_setf(0.0f)));
    light_sum(at->coat_light, light->lux, v_mul(lobe_reflect(&at->coat, h, nl), v_mul(attenuation, nl)), &lit);
}

/* D times V of the base. */
static ALWAYS_INLINE vf32 model_reflect(const e3d_surface_model *rare, const model_lanes *at, const vf32 l[3], const half_lanes *h, vf32 nl)
{
    if (rare && rare->anisotropic)
        return stretch_reflect(&at->stretch, at->base.nv, l, nl, h->h, h->square, v_add(nl, at->base.facing));
    return lobe_reflect(&at->base, h, nl);
}

/* R51 of one light. rare: NULL, or the model with what few materials have. */
static ALWAYS_INLINE void model_add_light(const e3d_lighting *lighting, int n, const e3d_batch *batch, int i, int has_coat, int has_sheen,
                                          const e3d_surface_model *rare, model_lanes *at)
{
    const e3d_light *light = &lighting->lights[n];
    vf32 l[3], attenuation = v_setf(1.0f), one = v_setf(1.0f), zero = v_setf(0.0f);
    int is_local = light->kind != E3D_LIGHT_DIRECTIONAL;
    vmask near = v_eq(zero, zero);
    if (is_local)
        near = light_towards(lighting, n, at->position, 1, l, &attenuation);
    for (int k = 0; k < 3 && !is_local; k++)
        l[k] = v_setf(light->to_light[k]);
    vf32 nl = dot_three(at->base.normal, l);
    vmask lit = v_mand(near, v_gt(nl, zero));
    if (!v_any(lit))
        return;
    if (lighting->shadows && light->shadow.kind) {
        vf32 reached = light_reached(lighting, n, batch, i, at->position, l);
        lit = v_mand(lit, v_gt(reached, zero));
        if (!v_any(lit))
            return;
        attenuation = v_mul(attenuation, reached);
    }
    half_lanes h;
    for (int k = 0; k < 3; k++)
        h.h[k] = v_add(l[k], at->view[k]);
    h.square = dot_three(h.h, h.h);
    vf32 w5 = fifth_power(v_max(v_sub(one, v_mul(v_sqrt(h.square), v_setf(0.5f))), zero)), e = v_mul(attenuation, nl);
    vf32 top = v_add(at->top, v_mul(at->rise, w5));
    if (rare && rare->iridescent)
        top = v_add(top, v_mul(v_sub(at->film_top, top), at->film_share));
    vf32 keep = v_mul(v_sub(one, top), e), d = v_mul(model_reflect(rare, at, l, &h, nl), e);
    for (int k = 0; k < 3; k++) {
        vf32 fresnel = v_add(at->f0[k], v_mul(at->f_rise[k], w5));
        if (rare && rare->iridescent)
            fresnel = v_add(fresnel, v_mul(v_sub(at->film[k], fresnel), at->film_share));
        vf32 shown = v_add(v_mul(at->diffuse[k], keep), v_mul(d, fresnel));
        at->direct[k] = v_self(lit, v_add(at->direct[k], v_mul(v_setf(light->lux[k]), shown)), at->direct[k]);
    }
    if (has_coat)
        model_add_coat(light, l, attenuation, lit, &h, at);
    if (has_sheen)
        light_sum(at->fuzz, light->lux, v_mul(sheen_reflect(at, &h, nl), e), &lit);
}

/* ---- light from all around (R54, R55) ---- */

static ALWAYS_INLINE void around_irradiance(const e3d_lighting *lighting, const environment_plan *plan, const vf32 normal[3], vf32 out[3])
{
    vf32 more[3];
    if (plan)
        environment_irradiance(plan, normal, more);
    ambient_light(lighting, normal, out);
    for (int k = 0; k < 3 && plan; k++)
        out[k] = v_add(out[k], more[k]);
}

static ALWAYS_INLINE void around_radiance(const e3d_lighting *lighting, const environment_plan *plan, const lobe_lanes *lobe,
                                          const vf32 view[3], vf32 out[3])
{
    vf32 mirrored[3], more[3], twice = v_add(lobe->facing, lobe->facing);
    for (int k = 0; k < 3 && (plan || lighting->ambient_terms); k++)
        mirrored[k] = v_sub(v_mul(lobe->normal[k], twice), view[k]);
    if (plan)
        environment_specular(plan, mirrored, lobe->roughness, more);
    ambient_light(lighting, mirrored, out);
    for (int k = 0; k < 3 && plan; k++)
        out[k] = v_add(out[k], more[k]);
}

/* R55: a lobe under light that is 1 all around: once is what it reflects once, twice a factor of what it reflects more often. */
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
static ALWAYS_INLINE void around_base(const e3d_lighting *lighting, const environment_plan *plan, const model_lanes *at,
                                      const e3d_surface_model *rare, vf32 out[3])
{
    if (!rare || !rare->anisotropic) {
        around_radiance(lighting, plan, &at->base, at->view, out);
        return;
    }
    lobe_lanes bent = at->base;
    stretch_bend(&at->stretch, at->base.normal, at->view, at->base.roughness, bent.normal);
    bent.facing = dot_three(bent.normal, at->view);
    around_radiance(lighting, plan, &bent, at->view, out);
}

/* is_grey: what is no metal reflects the same of all channels. through: what passes of light behind (R134). */
static ALWAYS_INLINE void around_indirect(const e3d_lighting *lighting, const environment_plan *plan, const model_lanes *at, int is_grey,
                                          const e3d_surface_model *rare, const vf32 irradiance[3], vf32 through[3], vf32 out[3])
{
    vf32 radiance[3], one = v_setf(1.0f);
    albedo_place place = albedo_find(at->base.roughness, at->base.nv);
    vf32 a = albedo_of(E3D_DFG_A, &place), b = albedo_of(E3D_DFG_B, &place), rest = v_sub(one, v_add(a, b));
    scatter_lanes other = around_scatter(at->reflectance[0], at->specular, a, b, rest);
    around_base(lighting, plan, at, rare, radiance);
    for (int k = 0; k < 3; k++) {
        vf32 albedo = at->albedo[k];
        scatter_lanes metal = around_scatter(rare && rare->iridescent ? at->metal_f0[k] : albedo, one, a, b, rest);
        if (rare && rare->iridescent)
            other = around_scatter(at->other_f0[k], at->specular, a, b, rest);
        else if (!is_grey)
            other = around_scatter(at->reflectance[k], at->specular, a, b, rest);
        vf32 r = v_div(one, v_mul(metal.q, other.q));
        vf32 zt = v_mul(v_mul(metal.twice, v_mul(r, other.q)), rest), zd = v_mul(v_mul(other.twice, v_mul(r, metal.q)), rest);
        vf32 t = v_add(v_mul(radiance[k], metal.once), v_mul(irradiance[k], zt));
        vf32 d = v_add(v_mul(radiance[k], other.once), v_mul(irradiance[k], zd));
        vf32 below = v_mul(albedo, v_sub(one, v_add(other.once, zd)));
        if (rare && rare->transmits) {
            through[k] = v_mul(v_mul(below, at->transmission), v_sub(one, at->metallic));
            below = v_mul(below, at->rest);
        }
        d = v_add(d, v_mul(irradiance[k], below));
        out[k] = v_add(d, v_mul(v_sub(t, d), at->metallic));
    }
}

/* ---- sums (R56, R57) ---- */

static ALWAYS_INLINE void model_sheen(const e3d_surface_model *model, const model_lanes *at, const vf32 irradiance[3], vf32 occlusion, int i,
                                      vf32 color[3])
{
    vf32 sheen[3], one = v_setf(1.0f);
    albedo_place place = albedo_find(usable_sheen_roughness(model, i), at->base.nv);
    vf32 e = albedo_of(E3D_DFG_SHEEN, &place);
    for (int k = 0; k < 3; k++)
        sheen[k] = varying_at(&model->sheen[k], i);
    vf32 keep = v_sub(one, v_mul(v_max(v_max(sheen[0], sheen[1]), sheen[2]), e));
    for (int k = 0; k < 3; k++) {
        vf32 fuzz = v_add(at->fuzz[k], v_mul(v_mul(irradiance[k], e), occlusion));
        color[k] = v_add(v_mul(color[k], keep), v_mul(sheen[k], fuzz));
    }
}

static ALWAYS_INLINE void model_add_layer(const e3d_surface_model *model, const e3d_lighting *lighting, const environment_plan *plan,
                                          const model_lanes *at, vf32 occlusion, int i, vf32 color[3])
{
    vf32 radiance[3], one = v_setf(1.0f), w5 = fifth_power(v_sub(one, v_min(at->coat.nv, one)));
    vf32 fc = v_mul(varying_at(&model->coat, i), v_add(v_setf(0.04f), v_mul(v_setf(0.96f), w5)));
    around_radiance(lighting, plan, &at->coat, at->view, radiance);
    for (int k = 0; k < 3; k++) {
        vf32 coat = v_add(at->coat_light[k], v_mul(radiance[k], occlusion));
        color[k] = v_add(v_mul(color[k], v_sub(one, fc)), v_mul(fc, coat));
    }
}

/* R134: what layers and the volume leave of it. */
static ALWAYS_INLINE void model_through(const e3d_surface_model *model, int has_coat, int has_sheen, const model_lanes *at, int i,
                                        vf32 through[3], e3d_map_batch *m)
{
    vf32 one = v_setf(1.0f), zero = v_setf(0.0f), depth = zero, fuzz = one, coat = one;
    if (has_sheen) {
        albedo_place place = albedo_find(usable_sheen_roughness(model, i), at->base.nv);
        vf32 most = v_max(v_max(varying_at(&model->sheen[0], i), varying_at(&model->sheen[1], i)), varying_at(&model->sheen[2], i));
        fuzz = v_sub(one, v_mul(most, albedo_of(E3D_DFG_SHEEN, &place)));
    }
    if (has_coat) {
        vf32 w5 = fifth_power(v_sub(one, v_min(at->coat.nv, one)));
        coat = v_sub(one, v_mul(varying_at(&model->coat, i), v_add(v_setf(0.04f), v_mul(v_setf(0.96f), w5))));
    }
    if (model->absorbs)
        depth = v_mul(varying_at(&model->thickness, i), v_loadf(m->depth + i));
    for (int k = 0; k < 3; k++) {
        vf32 share = has_sheen ? v_mul(through[k], fuzz) : through[k];
        share = has_coat ? v_mul(share, coat) : share;
        if (model->absorbs)
            share = v_mul(share, exp2_poly(v_mul(depth, v_setf(model->absorption[k]))));
        v_storef(m->through[k] + i, v_self(v_gt(share, zero), v_self(v_lt(share, one), share, one), zero));
    }
}

/* R46 and R129 */
static ALWAYS_INLINE vf32 model_occlusion(const e3d_batch *batch, const e3d_surface_model *model, const e3d_lighting *lighting, int i)
{
    vf32 one = v_setf(1.0f), occlusion = one;
    if (model->occlusion.lanes)
        occlusion = v_add(one, v_mul(v_setf(model->occlusion_strength), v_sub(varying_at(&model->occlusion, i), one)));
    return lighting->has_visibility ? v_mul(occlusion, v_loadf(batch->visibility + i)) : occlusion;
}

static ALWAYS_INLINE void model_finish(const e3d_batch *batch, const e3d_surface_model *model, const e3d_lighting *lighting,
                                       const environment_plan *plan, int has_coat, int has_sheen, const e3d_surface_model *rare,
                                       const model_lanes *at, int i, e3d_map_batch *m, vf32 color[3])
{
    vf32 irradiance[3], indirect[3], through[3], occlusion = model_occlusion(batch, model, lighting, i);
    around_irradiance(lighting, plan, at->base.normal, irradiance);
    around_indirect(lighting, plan, at, model->is_grey, rare, irradiance, through, indirect);
    if (rare && rare->transmits)
        model_through(model, has_coat, has_sheen, at, i, through, m);
    for (int k = 0; k < 3; k++)
        color[k] = v_add(at->direct[k], v_mul(indirect[k], occlusion));
    if (has_sheen)
        model_sheen(model, at, irradiance, occlusion, i, color);
    for (int k = 0; k < 3; k++)
        color[k] = v_add(color[k], varying_at(&model->emissive[k], i));
    if (has_coat)
        model_add_layer(model, lighting, plan, at, occlusion, i, color);
    for (int k = 0; k < 3; k++)
        color[k] = v_mul(color[k], v_setf(lighting->exposure));
}

/* ---- batches ---- */

/* Some of the lights: those before them are added up already, in the batch; others may follow. */
typedef struct chosen_lights {
    const int32_t *numbers;
    int count, is_first, is_last;
} chosen_lights;

static ALWAYS_INLINE void model_sums(e3d_map_batch *m, const chosen_lights *lights, int i, model_lanes *at)
{
    vf32 zero = v_setf(0.0f);
    for (int k = 0; k < 3; k++) {
        at->direct[k] = lights->is_first ? zero : v_loadf(m->direct[k] + i);
        at->coat_light[k] = lights->is_first ? zero : v_loadf(m->coat[k] + i);
        at->fuzz[k] = lights->is_first ? zero : v_loadf(m->fuzz[k] + i);
    }
}

/* R134: what passes is not scattered. */
static ALWAYS_INLINE void model_transmission(const e3d_surface_model *model, int i, model_lanes *at)
{
    at->transmission = varying_at(&model->transmission, i);
    at->rest = v_sub(v_setf(1.0f), at->transmission);
    for (int k = 0; k < 3; k++)
        at->diffuse[k] = v_mul(at->diffuse[k], at->rest);
}

/* R141 */
static inline void model_film(const e3d_surface_model *model, int i, model_lanes *at)
{
    vf32 other[3], metal[3], zero = v_setf(0.0f), cosine = v_min(at->base.nv, v_setf(1.0f));
    vf32 thickness = v_add(v_setf(model->film_least), varying_at(&model->film, i));
    if (!model->film.lanes)
        thickness = v_setf(model->film.factor);
    at->film_share = v_self(v_gt(thickness, zero), varying_at(&model->iridescence, i), zero);
    film_reflect(cosine, model->film_ior, thickness, at->reflectance, other);
    film_reflect(cosine, model->film_ior, thickness, at->albedo, metal);
    for (int k = 0; k < 3; k++) {
        at->film[k] = v_add(other[k], v_mul(v_sub(metal[k], other[k]), at->metallic));
        at->other_f0[k] = at->reflectance[k];
        at->metal_f0[k] = at->albedo[k];
    }
    at->film_top = v_max(v_max(other[0], other[1]), other[2]);
    film_mix_f0(cosine, other, at->film_share, at->other_f0);
    film_mix_f0(cosine, metal, at->film_share, at->metal_f0);
}

static ALWAYS_INLINE void model_rare(const e3d_map_batch *m, const e3d_surface_model *model, int i, model_lanes *at)
{
    if (model->transmits)
        model_transmission(model, i, at);
    if (model->anisotropic)
        stretch_begin(m, &model->stretch, at->base.normal, at->view, at->base.nv, at->base.roughness, i, &at->stretch);
    if (model->iridescent)
        model_film(model, i, at);
}

/* All vectors; which parts there are is mostly a constant for the compiler. */
static ALWAYS_INLINE void physical_vectors(e3d_batch *batch, e3d_map_batch *m, const e3d_surface_model *model, const e3d_lighting *lighting,
                                           const environment_plan *plan, const chosen_lights *lights, int has_coat, int has_sheen,
                                           const e3d_surface_model *rare)
{
    for (int i = 0; i < batch->count; i += V_LANES) {
        model_lanes at;
        vf32 color[3];
        model_begin(batch, m, model, lighting, i, &at);
        if (rare)
            model_rare(m, rare, i, &at);
        model_sums(m, lights, i, &at);
        for (int n = 0; n < lights->count; n++)
            model_add_light(lighting, lights->numbers[n], batch, i, has_coat, has_sheen, rare, &at);
        if (lights->is_last) {
            model_finish(batch, model, lighting, plan, has_coat, has_sheen, rare, &at, i, m, color);
            for (int k = 0; k < 3; k++)
                v_storef(batch->color[k] + i, color[k]);
            continue;
        }
        for (int k = 0; k < 3; k++) {
            v_storef(m->direct[k] + i, at.direct[k]);
            v_storef(m->coat[k] + i, at.coat_light[k]);
            v_storef(m->fuzz[k] + i, at.fuzz[k]);
        }
    }
}

static void physical_some(e3d_batch *batch, e3d_map_batch *m, const e3d_surface_model *model, const e3d_lighting *lighting,
                          const environment_plan *plan, const chosen_lights *lights)
{
    if (model->is_rare)
        physical_vectors(batch, m, model, lighting, plan, lights, model->has_coat, model->has_sheen, model);
    else if (model->has_coat || model->has_sheen)
        physical_vectors(batch, m, model, lighting, plan, lights, model->has_coat, model->has_sheen, NULL);
    else
        physical_vectors(batch, m, model, lighting, plan, lights, 0, 0, NULL);
}

static void kernel_physical(e3d_batch *batch, const e3d_surface_model *model, const e3d_lighting *lighting, e3d_map_batch *m)
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
        int count = light_choose(lighting, first, end, boxed ? &box : NULL, chosen);
        const chosen_lights lights = {chosen, count, first == 0, end == lighting->light_count};
        physical_some(batch, m, model, lighting, around, &lights);
        first = end;
    } while (first < lighting->light_count);
}

#endif
