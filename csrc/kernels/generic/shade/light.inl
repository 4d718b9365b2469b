/* light: sums of Lambert and Blinn-Phong (Blinn 1977) for a batch over all lights, in their order (R31). */
#pragma once

#include "base/always_inline.h"
#include "base/limits.h"
#include "e3d.h"
#include "kernels/types/shading.h"
#include "kernels/generic/surface.inl"
#include "kernels/generic/interpolate.inl"
#include "kernels/generic/shade/environment.inl"
#include "kernels/generic/shade/shadow.inl"

/* One vector of lit samples. If all light is grey, the first channel stands for all three. */
typedef struct lit_lanes {
    vf32 position[3], normal[3], view[3];
    vf32 energy[3], shine[3];
} lit_lanes;

/* R43: the factor of a light's range. */
static inline vf32 light_gltf_window(vf32 d2, float over_range2)
{
    vf32 x = v_mul(d2, v_setf(over_range2)), one = v_setf(1.0f);
    return v_max(v_sub(one, v_mul(x, x)), v_setf(0.0f));
}

/* R43: the factor of a spot light's cone in this direction. */
static inline vf32 light_cone(const e3d_light *light, const vf32 l[3])
{
    const vf32 axis[3] = {v_setf(light->to_light[0]), v_setf(light->to_light[1]), v_setf(light->to_light[2])};
    vf32 t = v_mul(v_sub(dot_three(l, axis), v_setf(light->cone[0])), v_setf(light->cone[1]));
    t = v_min(v_max(t, v_setf(0.0f)), v_setf(1.0f));
    return v_mul(t, t);
}

/* Finds the unit vector to a light that has a position, and its attenuation, by the formula of R51 if by_product; returns the
 * lanes within its range. */
static ALWAYS_INLINE vmask light_towards(const e3d_lighting *lighting, int n, const vf32 position[3], int by_product, vf32 l[3],
                                         vf32 *attenuation)
{
    const e3d_light *light = &lighting->lights[n];
    vf32 one = v_setf(1.0f);
    for (int k = 0; k < 3; k++)
        l[k] = v_sub(v_setf(light->position[k]), position[k]);
    vf32 d2 = dot_three(l, l);
    vmask near = v_mnot(v_ge(d2, v_setf(lighting->reach[3][n])));
    d2 = v_max(d2, v_setf(0x1p-40f));
    vf32 inverse = v_div(one, v_sqrt(d2));
    for (int k = 0; k < 3; k++)
        l[k] = v_mul(l[k], inverse);
    if (light->falloff == E3D_FALLOFF_WINDOW) {
        vf32 t = v_sub(one, v_mul(d2, v_setf(lighting->reach[4][n])));
        *attenuation = v_mul(t, t);
    } else {
        vf32 window = light->falloff == E3D_FALLOFF_GLTF ? light_gltf_window(d2, lighting->reach[4][n]) : one;
        *attenuation = by_product ? v_mul(window, v_mul(inverse, inverse)) : v_div(window, d2);
    }
    if (e3d_light_traits_of(light->kind).emission == E3D_EMITS_CONE)
        *attenuation = v_mul(*attenuation, light_cone(light, l));
    return near;
}

/* Adds color * amount to the sums, in the lanes `near`; NULL: in all lanes. */
static ALWAYS_INLINE void light_sum(vf32 sums[3], const float color[3], vf32 amount, const vmask *near)
{
    for (int k = 0; k < 3; k++) {
        vf32 more = v_add(sums[k], v_mul(v_setf(color[k]), amount));
        sums[k] = near ? v_self(*near, more, sums[k]) : more;
    }
}

static ALWAYS_INLINE void light_highlight(const float shown[3], const vf32 l[3], vf32 facing, vf32 attenuation, const vmask *near,
                                          float shininess, lit_lanes *lit)
{
    vf32 zero = v_setf(0.0f), h[3];
    for (int k = 0; k < 3; k++)
        h[k] = v_add(l[k], lit->view[k]);
    unit_length(h);
    vf32 x = v_max(dot_three(lit->normal, h), zero);
    vmask some = v_mand(v_gt(facing, zero), v_ge(x, v_setf(0x1p-100f)));
    vf32 safe = v_self(some, x, v_setf(1.0f));
    vf32 power = v_self(some, exp2_poly(v_mul(v_setf(shininess), log2_poly(safe))), zero);
    light_sum(lit->shine, shown, v_mul(attenuation, power), near);
}

/* Adds one light from direction l (R31); shown: its colour by R154. */
static ALWAYS_INLINE void light_from(const float shown[3], const vf32 l[3], vf32 attenuation, const vmask *near,
                                     float shininess, lit_lanes *lit)
{
    vf32 zero = v_setf(0.0f), facing = v_max(dot_three(lit->normal, l), zero);
    light_sum(lit->energy, shown, v_mul(attenuation, facing), near);
    vmask faces = v_gt(facing, zero);
    if (shininess > 0.0f && v_any(near ? v_mand(*near, faces) : faces)) /* where no lane faces the light, the highlight is 0 */
        light_highlight(shown, l, facing, attenuation, near, shininess, lit);
}

/* R90: the attenuation times the share of a light that reaches samples. Samples that face away from it get no light anyway. What a call
 * may point into lies in memory, before and after it: so calls get copies, and not the lanes. */
static ALWAYS_INLINE vf32 light_shadowed(const e3d_lighting *lighting, int n, const e3d_batch *batch, int i, const lit_lanes *lit,
                                         const vf32 l[3], vf32 attenuation)
{
    if (!lighting->shadows || !lighting->lights[n].shadow.kind)
        return attenuation;
    const float *found = shadow_found(batch, n);
    if (found)
        return v_mul(attenuation, v_loadf(found + i));
    if (!v_any(v_gt(dot_three(lit->normal, l), v_setf(0.0f))))
        return attenuation;
    const vf32 position[3] = {lit->position[0], lit->position[1], lit->position[2]}, towards[3] = {l[0], l[1], l[2]};
    return v_mul(attenuation, light_reached(lighting, n, batch, i, position, towards));
}

/* What varies from sample to sample besides the surface, as a constant for the compiler: nothing; the share of lights that
 * arrives; or light from all around, too. */
enum light_variety { LIGHT_ALIKE = 0,
                     LIGHT_SHADOWED,
                     LIGHT_VARIED };

/* Adds a light to samples of the batch from i on. */
static ALWAYS_INLINE void light_one(const e3d_lighting *lighting, int n, const e3d_batch *batch, int i, enum light_variety varied,
                                    float shininess, lit_lanes *lit)
{
    const e3d_light *light = &lighting->lights[n];
    vf32 l[3], attenuation = v_setf(1.0f);
    if (!e3d_light_traits_of(light->kind).has_position) {
        for (int k = 0; k < 3; k++)
            l[k] = v_setf(light->to_light[k]);
        if (varied)
            attenuation = light_shadowed(lighting, n, batch, i, lit, l, attenuation);
        light_from(lighting->shown[n], l, attenuation, NULL, shininess, lit);
        return;
    }
    vmask near = light_towards(lighting, n, lit->position, 0, l, &attenuation);
    if (!v_any(near))
        return;
    if (varied)
        attenuation = light_shadowed(lighting, n, batch, i, lit, l, attenuation);
    light_from(lighting->shown[n], l, attenuation, &near, shininess, lit);
}

static inline void light_view(const e3d_lighting *lighting, lit_lanes *lit)
{
    for (int k = 0; k < 3; k++) {
        vf32 eye = v_setf(lighting->eye[k]);
        lit->view[k] = lighting->eye[3] != 0.0f ? v_sub(eye, lit->position[k]) : eye;
    }
    if (lighting->eye[3] != 0.0f)
        unit_length(lit->view);
}

/* ---- lights that may reach a batch ---- */

typedef struct light_box {
    float low[3], high[3];
} light_box;

static inline int light_is_finite(const e3d_batch *batch, int i)
{
    vf32 zero = v_setf(0.0f), sum = zero;
    for (int k = 0; k < 3; k++) {
        vf32 p = v_loadf(batch->position[k] + i);
        sum = v_add(sum, v_sub(p, p)); /* 0, or a NaN */
    }
    return !v_any(v_mnot(v_eq(sum, zero)));
}

/* Finds the box of the batch's positions; 0 if one isn't finite. */
static inline int light_bounds(const e3d_batch *batch, light_box *box)
{
    for (int i = 0; i < batch->count; i += V_LANES)
        if (!light_is_finite(batch, i))
            return 0;
    for (int k = 0; k < 3; k++) {
        vf32 low = v_loadf(batch->position[k]), high = low;
        for (int i = V_LANES; i < batch->count; i += V_LANES) {
            vf32 p = v_loadf(batch->position[k] + i);
            low = v_min(low, p);
            high = v_max(high, p);
        }
        float lows[V_LANES], highs[V_LANES];
        v_storef(lows, low);
        v_storef(highs, high);
        box->low[k] = lows[0];
        box->high[k] = highs[0];
        for (int lane = 1; lane < V_LANES; lane++) {
            box->low[k] = lows[lane] < box->low[k] ? lows[lane] : box->low[k];
            box->high[k] = highs[lane] > box->high[k] ? highs[lane] : box->high[k];
        }
    }
    return 1;
}

/* A lower bound of the squared distance of R31 from a box: each rounding is monotone, so no sample in the box is nearer. */
static inline vf32 light_distance2(const e3d_lighting *lighting, int n, const light_box *box)
{
    vf32 d[3];
    for (int k = 0; k < 3; k++) {
        vf32 at = v_loadf(lighting->reach[k] + n);
        vf32 below = v_sub(v_setf(box->low[k]), at), above = v_sub(at, v_setf(box->high[k]));
        d[k] = v_max(v_max(below, above), v_setf(0.0f));
    }
    return dot_three(d, d);
}

/* Whether a light is one of the area lights, or of the others, as is wanted. */
static inline int light_is_wanted(const e3d_lighting *lighting, int n, int areas)
{
    return !lighting->has_area_lights || e3d_is_area_light(lighting->lights[n].kind) == areas;
}

/* Lists those of the area lights (areas: 0: the others) first .. end - 1 that may reach the box (NULL: all). The rest would add
 * nothing. With 256 lights, shading then takes a ninth of the time. */
static inline int light_choose(const e3d_lighting *lighting, int first, int end, const light_box *box, int areas,
                               int32_t *chosen)
{
    int count = 0;
    for (int n = first; n < end; n += V_LANES) {
        uint32_t bits = (uint32_t)((1ull << V_LANES) - 1);
        if (box)
            bits = v_bits(v_mnot(v_ge(light_distance2(lighting, n, box), v_loadf(lighting->reach[3] + n))));
        for (; bits; bits &= bits - 1) {
            chosen[count] = n + __builtin_ctz(bits);
            count += chosen[count] < end && light_is_wanted(lighting, chosen[count], areas);
        }
    }
    return count;
}

/* ---- light from all around ---- */

/* Whether light from all around varies by direction (R54, R130) or from pixel to pixel (R129). */
static inline int around_varies(const e3d_lighting *lighting)
{
    return lighting->ambient_terms != NULL || lighting->has_visibility || lighting->environment != NULL;
}

/* R130: the ambient light that white surfaces of these normals show. */
static ALWAYS_INLINE void ambient_light(const e3d_lighting *lighting, const vf32 n[3], vf32 out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = v_setf(lighting->ambient[k]);
    if (!lighting->ambient_terms)
        return;
    vf32 square = v_mul(n[2], n[2]);
    const vf32 factors[E3D_AMBIENT_TERMS - 1] = {n[0], n[1], n[2], v_sub(v_mul(n[0], n[0]), square), v_sub(v_mul(n[1], n[1]), square),
                                                 v_mul(n[0], n[1]), v_mul(n[1], n[2]), v_mul(n[2], n[0])};
    for (int k = 0; k < 3; k++) {
        vf32 sum = v_add(out[k], v_setf(lighting->ambient_terms[0][k]));
        for (int t = 1; t < E3D_AMBIENT_TERMS; t++)
            sum = v_add(sum, v_mul(v_setf(lighting->ambient_terms[t][k]), factors[t - 1]));
        out[k] = v_max(sum, v_setf(0.0f));
    }
}

/* R54: the irradiance of an environment. */
static __attribute__((noinline)) void light_environment(const e3d_environment_light *light, const vf32 normal[3], vf32 out[3])
{
    environment_plan plan;
    environment_begin(light, &plan);
    environment_irradiance(&plan, normal, out);
}

/* Adds that; the call gets copies, as in light_shadowed. */
static ALWAYS_INLINE void light_add_environment(const e3d_environment_light *light, lit_lanes *lit)
{
    vf32 normal[3] = {lit->normal[0], lit->normal[1], lit->normal[2]}, more[3];
    light_environment(light, normal, more);
    for (int k = 0; k < 3; k++)
        lit->energy[k] = v_add(lit->energy[k], more[k]);
}

/* ---- the sums ---- */

static inline enum light_variety light_varies(const e3d_lighting *lighting)
{
    return around_varies(lighting) ? LIGHT_VARIED : lighting->shadows ? LIGHT_SHADOWED
                                                                      : LIGHT_ALIKE;
}

/* Loads one vector, lit only by ambient light so far; that is the same everywhere, unless it varies. */
static ALWAYS_INLINE lit_lanes light_begin(const e3d_batch *batch, int i, const e3d_lighting *lighting, enum light_variety varied,
                                           float shininess)
{
    lit_lanes lit;
    for (int k = 0; k < 3; k++) {
        lit.position[k] = v_loadf(batch->position[k] + i);
        lit.normal[k] = v_loadf(batch->normal[k] + i);
        lit.view[k] = lit.shine[k] = v_setf(0.0f);
        lit.energy[k] = v_setf(lighting->ambient[k]);
    }
    if (varied == LIGHT_VARIED)
        ambient_light(lighting, lit.normal, lit.energy);
    if (varied == LIGHT_VARIED && lighting->environment)
        light_add_environment(lighting->environment, &lit);
    if (varied == LIGHT_VARIED && lighting->has_visibility)
        for (int k = 0; k < 3; k++)
            lit.energy[k] = v_mul(lit.energy[k], v_loadf(batch->visibility + i));
    if (shininess > 0.0f)
        light_view(lighting, &lit);
    return lit;
}

static inline vf32 light_clamp(const e3d_lighting *lighting, vf32 energy)
{
    return v_min(v_max(energy, v_setf(lighting->clamp[0])), v_setf(lighting->clamp[1]));
}

/* Adds the chosen lights among those from `first` on. */
static ALWAYS_INLINE void light_add(e3d_batch *batch, const e3d_lighting *lighting, int first, const int32_t *chosen, int count,
                                    enum light_variety varied, float shininess)
{
    for (int i = 0; i < batch->count; i += V_LANES) {
        lit_lanes lit = light_begin(batch, i, lighting, varied, shininess);
        for (int k = 0; k < 3 && first; k++) {
            lit.energy[k] = v_loadf(batch->energy[k] + i);
            lit.shine[k] = v_loadf(batch->shine[k] + i);
        }
        for (int k = 0; k < 3 && !first && lighting->has_area_lights; k++) { /* R239 */
            lit.energy[k] = v_add(lit.energy[k], v_loadf(batch->energy[k] + i));
            lit.shine[k] = v_loadf(batch->shine[k] + i);
        }
        for (int n = 0; n < count; n++)
            light_one(lighting, chosen[n], batch, i, varied, shininess, &lit);
        for (int k = 0; k < 3; k++) {
            v_storef(batch->energy[k] + i, lit.energy[k]);
            v_storef(batch->shine[k] + i, lit.shine[k]);
        }
    }
}

static void kernel_light(e3d_batch *batch, const e3d_lighting *lighting, float shininess)
{
    enum { AT_ONCE = 256 };
    int32_t chosen[AT_ONCE + E3D_PAD];
    light_box box;
    int boxed = lighting->light_count > E3D_FEW_LIGHTS && light_bounds(batch, &box), first = 0;
    shadow_suns(lighting, batch);
    do {
        int rest = lighting->light_count - first, end = first + (rest < AT_ONCE ? rest : AT_ONCE);
        int count = light_choose(lighting, first, end, boxed ? &box : NULL, 0, chosen);
        if (light_varies(lighting))
            light_add(batch, lighting, first, chosen, count, LIGHT_VARIED, shininess);
        else
            light_add(batch, lighting, first, chosen, count, LIGHT_ALIKE, shininess);
        first = end;
    } while (first < lighting->light_count);
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < batch->count; i += V_LANES)
            v_storef(batch->energy[k] + i, light_clamp(lighting, v_loadf(batch->energy[k] + i)));
}

/* R31, R44: color = ((color * energy + specular * shine) + emissive) * exposure; NULL counts as 0. */
static ALWAYS_INLINE void combine_vector(const vf32 energy[3], const vf32 shine[3], const float *specular,
                                         const float emissive[3], float exposure, vf32 color[3])
{
    for (int k = 0; k < 3; k++) {
        color[k] = v_mul(color[k], energy[k]);
        if (specular)
            color[k] = v_add(color[k], v_mul(v_setf(specular[k]), shine[k]));
        if (emissive)
            color[k] = v_add(color[k], v_setf(emissive[k]));
        if (exposure != 1.0f)
            color[k] = v_mul(color[k], v_setf(exposure));
    }
}

static void kernel_combine(e3d_batch *batch, const float specular[3], const float emissive[3], float exposure)
{
    for (int i = 0; i < batch->count; i += V_LANES) {
        vf32 color[3], energy[3], shine[3];
        for (int k = 0; k < 3; k++) {
            color[k] = v_loadf(batch->color[k] + i);
            energy[k] = v_loadf(batch->energy[k] + i);
            shine[k] = v_loadf(batch->shine[k] + i);
        }
        combine_vector(energy, shine, specular, emissive, exposure, color);
        for (int k = 0; k < 3; k++)
            v_storef(batch->color[k] + i, color[k]);
    }
}
