/* area_light: rectangles, discs and tubes that shine, as integrals over polygons; a lobe of GGX sees them through a linear
 * transform (R231-R236, R239). Sources: Lambert 1760 (the integral); Heitz, Dupuy, Hill and Neubelt 2016 (the transform). */
#pragma once

#include "base/always_inline.h"
#include "base/limits.h"
#include "data/light_corners.h"
#include "e3d.h"
#include "kernels/types/shading.h"
#include "kernels/generic/surface.inl"
#include "kernels/generic/interpolate.inl"
#include "kernels/generic/shade/albedo.inl"
#include "kernels/generic/shade/anisotropy.inl"
#include "kernels/generic/shade/environment.inl"
#include "kernels/generic/shade/light.inl"
#include "kernels/generic/shade/shadow.inl"

/* A light as samples see it: its middle, and the vectors of its extent. */
typedef struct area_lanes {
    vf32 d[3], u[3], v[3];
} area_lanes;

/* R233: the axes of a lobe: where it leans, beside that, and the normal. */
typedef struct area_axes {
    vf32 axis[3][3], sine, cosine;
} area_axes;

/* A light on one vector: the light in the axes of the normal, the mean direction to it, the share of it that arrives, e of R236,
 * and the lanes in which it adds light. */
typedef struct area_lit {
    area_lanes turned;
    vf32 l[3], share, e;
    vmask lit;
} area_lit;

/* ---- R231, R232 ---- */

static ALWAYS_INLINE int area_is_disc(const e3d_light *light) { return e3d_light_traits_of(light->kind).shape == E3D_SHAPE_DISC; }

static ALWAYS_INLINE void area_tube(const e3d_light *light, area_lanes *out)
{
    vf32 least = v_setf(E3D_AREA_LEAST), one = v_setf(1.0f), axis2 = dot_three(out->u, out->u);
    float r2 = light->radius * light->radius;
    cross_three(out->d, out->u, out->v);
    vf32 away2 = v_mul(dot_three(out->v, out->v), v_div(one, v_max(axis2, least)));
    vf32 beside2 = v_max(v_sub(away2, v_setf(r2)), v_setf(r2 * 0.25f));
    vf32 wide = v_div(v_setf(light->radius), v_sqrt(v_max(v_mul(axis2, beside2), least)));
    for (int c = 0; c < 3; c++)
        out->v[c] = v_mul(out->v[c], wide);
}

/* The light as seen from `position`. */
static ALWAYS_INLINE void area_place(const e3d_light *light, const vf32 position[3], area_lanes *out)
{
    for (int c = 0; c < 3; c++) {
        out->d[c] = v_sub(v_setf(light->position[c]), position[c]);
        out->u[c] = v_setf(light->extent[0][c]);
        out->v[c] = v_setf(light->extent[1][c]);
    }
    if (e3d_light_traits_of(light->kind).shape == E3D_SHAPE_TUBE)
        area_tube(light, out);
}

/* The lanes that the light reaches, and the factor of its range. */
static ALWAYS_INLINE vmask area_reaches(const e3d_lighting *lighting, int n, const vf32 d[3], vf32 *window)
{
    const e3d_light *light = &lighting->lights[n];
    vf32 one = v_setf(1.0f), d2 = dot_three(d, d);
    vmask near = v_mnot(v_ge(d2, v_setf(lighting->reach[3][n])));
    *window = one;
    if (light->falloff == E3D_FALLOFF_WINDOW) {
        vf32 t = v_sub(one, v_mul(d2, v_setf(lighting->reach[4][n])));
        *window = v_mul(t, t);
    }
    if (light->falloff == E3D_FALLOFF_GLTF)
        *window = light_gltf_window(d2, lighting->reach[4][n]);
    if (e3d_light_traits_of(light->kind).emission != E3D_EMITS_AHEAD)
        return near;
    const vf32 axis[3] = {v_setf(light->to_light[0]), v_setf(light->to_light[1]), v_setf(light->to_light[2])};
    return v_mand(near, v_gt(dot_three(d, axis), v_setf(0.0f)));
}

/* ---- R233 ---- */

static ALWAYS_INLINE void area_find_axes(const vf32 normal[3], const vf32 view[3], area_axes *out)
{
    vf32 c = dot_three(normal, view), *t = out->axis[0], any[3];
    for (int k = 0; k < 3; k++) {
        out->axis[2][k] = normal[k];
        t[k] = v_sub(v_mul(normal[k], c), view[k]);
    }
    vf32 sine2 = dot_three(t, t);
    out->sine = v_sqrt(sine2);
    out->cosine = environment_abs(c);
    vf32 inverse = v_div(v_setf(1.0f), out->sine);
    vmask leans = v_gt(sine2, v_setf(E3D_AREA_LEAST_SINE2));
    for (int k = 0; k < 3; k++)
        t[k] = v_mul(t[k], inverse);
    if (v_any(v_mnot(leans))) {
        stretch_anywhere(normal, any);
        for (int k = 0; k < 3; k++)
            t[k] = v_self(leans, t[k], any[k]);
    }
    cross_three(normal, t, out->axis[1]);
}

static ALWAYS_INLINE void area_turn_vector(const area_axes *axes, vf32 v[3])
{
    vf32 x = dot_three(axes->axis[0], v), y = dot_three(axes->axis[1], v), z = dot_three(axes->axis[2], v);
    v[0] = x;
    v[1] = y;
    v[2] = z;
}

static ALWAYS_INLINE void area_turn(const area_axes *axes, area_lanes *area)
{
    area_turn_vector(axes, area->d);
    area_turn_vector(axes, area->u);
    area_turn_vector(axes, area->v);
}

/* ---- R235 ---- */

/* Angles divided by their sines, from their cosines. */
static ALWAYS_INLINE vf32 area_over_sine(vf32 x)
{
    vf32 one = v_setf(1.0f), y = environment_abs(x);
    vf32 above = v_add(v_mul(v_add(v_mul(v_setf(0x1.aa822ep-6f), y), v_setf(0x1.cfc68p-1f)), y), v_setf(0x1.921fa6p+0f));
    vf32 below = v_add(v_mul(v_add(v_mul(v_setf(0x1.285874p-2f), y), v_setf(0x1.3696bcp+0f)), y), one);
    vf32 g = v_div(above, below);
    vmask wide = v_lt(x, v_setf(0.0f));
    if (!v_any(wide))
        return g;
    vf32 sine = v_sqrt(v_max(v_sub(one, v_mul(x, x)), v_setf(E3D_AREA_LEAST_TURN)));
    return v_self(wide, v_sub(v_div(v_setf(E3D_PI), sine), g), g);
}

static ALWAYS_INLINE vf32 area_over_length(const vf32 v[3])
{
    return v_div(v_setf(1.0f), v_sqrt(v_max(dot_three(v, v), v_setf(E3D_AREA_LEAST))));
}

/* Where the polygon goes below the horizon, where it comes up again, and whether it does in any lane. */
typedef struct area_cuts {
    vf32 leaves[3], enters[3];
    int any;
} area_cuts;

/* A corner and the next one, 1 over their lengths, and the lanes in which they are above the horizon. */
typedef struct area_edge {
    vf32 a[3], b[3], over_a, over_b;
    vmask begins, ends;
} area_edge;

/* The same cut at the horizon; returns by how much that scales the cross product. */
static inline vf32 area_cut(area_edge *edge, area_cuts *cuts)
{
    vf32 above = environment_abs(edge->a[2]), below = environment_abs(edge->b[2]), cut[3];
    vmask down = v_mandnot(edge->begins, edge->ends), up = v_mandnot(edge->ends, edge->begins);
    for (int c = 0; c < 3; c++)
        cut[c] = v_add(v_mul(edge->a[c], below), v_mul(edge->b[c], above));
    vf32 inverse = area_over_length(cut);
    for (int c = 0; c < 3; c++) {
        cuts->leaves[c] = v_self(down, cut[c], cuts->leaves[c]);
        cuts->enters[c] = v_self(up, cut[c], cuts->enters[c]);
        edge->a[c] = v_self(edge->begins, edge->a[c], cut[c]);
        edge->b[c] = v_self(edge->ends, edge->b[c], cut[c]);
    }
    cuts->any = 1;
    edge->over_a = v_self(edge->begins, edge->over_a, inverse);
    edge->over_b = v_self(edge->ends, edge->over_b, inverse);
    return v_self(down, above, v_self(up, below, v_setf(1.0f)));
}

/* Adds an edge whose cross product is n. */
static ALWAYS_INLINE void area_add_edge(const area_edge *whole, const vf32 n[3], area_cuts *cuts, vf32 sum[3])
{
    vmask some = v_mor(whole->begins, whole->ends), all = v_mand(whole->begins, whole->ends);
    area_edge edge = *whole;
    vf32 share = v_setf(1.0f);
    if (!v_any(some))
        return;
    int is_cut = v_any(v_mnot(all));
    if (is_cut)
        share = area_cut(&edge, cuts);
    vf32 i = v_mul(edge.over_a, edge.over_b), f = area_over_sine(v_mul(dot_three(edge.a, edge.b), i));
    f = v_mul(is_cut ? v_mul(f, share) : f, i);
    for (int c = 0; c < 3; c++) {
        vf32 more = v_add(sum[c], v_mul(n[c], f));
        sum[c] = is_cut ? v_self(some, more, sum[c]) : more;
    }
}

static ALWAYS_INLINE void area_corner(const area_lanes *seen, const e3d_light_corner at, vf32 out[3])
{
    for (int c = 0; c < 3; c++)
        out[c] = v_add(v_add(seen->d[c], v_mul(seen->u[c], v_setf(at[0]))), v_mul(seen->v[c], v_setf(at[1])));
}

/* Integrates the polygon over what is above the horizon. */
static __attribute__((noinline)) void area_integral(const area_lanes *seen, int is_disc, vf32 sum[3])
{
    const e3d_light_corner *corner = is_disc ? E3D_DISC_CORNER : E3D_RECTANGLE_CORNER;
    vf32 zero = v_setf(0.0f);
    area_cuts cuts = {{zero, zero, zero}, {zero, zero, zero}, 0};
    area_edge edge;
    sum[0] = sum[1] = sum[2] = zero;
    area_corner(seen, corner[0], edge.b);
    edge.over_b = area_over_length(edge.b);
    edge.ends = v_gt(edge.b[2], zero);
    for (int k = 0; k < (is_disc ? E3D_DISC_CORNERS : E3D_RECTANGLE_CORNERS); k++) {
        vf32 x = v_setf(corner[k + 1][0] - corner[k][0]), y = v_setf(corner[k + 1][1] - corner[k][1]), e[3], n[3];
        for (int c = 0; c < 3; c++) {
            edge.a[c] = edge.b[c];
            e[c] = v_add(v_mul(seen->u[c], x), v_mul(seen->v[c], y));
        }
        edge.over_a = edge.over_b;
        edge.begins = edge.ends;
        area_corner(seen, corner[k + 1], edge.b);
        edge.over_b = area_over_length(edge.b);
        edge.ends = v_gt(edge.b[2], zero);
        cross_three(edge.a, e, n);
        area_add_edge(&edge, n, &cuts, sum);
    }
    if (!cuts.any)
        return;
    vf32 i = v_mul(area_over_length(cuts.leaves), area_over_length(cuts.enters));
    vf32 across = v_sub(v_mul(cuts.leaves[0], cuts.enters[1]), v_mul(cuts.leaves[1], cuts.enters[0]));
    sum[2] = v_add(sum[2], v_mul(across, v_mul(area_over_sine(v_mul(dot_three(cuts.leaves, cuts.enters), i)), i)));
}

/* ---- R234 ---- */

/* A lobe's transform: the turn to its mean direction, and what divides and skews. */
typedef struct area_lobe {
    vf32 zs, zc, over_along, over_across, skew;
} area_lobe;

static ALWAYS_INLINE vf32 area_number(e3d_area_table table, const albedo_place *at)
{
    vf32 upper = albedo_row(E3D_AREA_TABLE[table], at), lower = albedo_row(E3D_AREA_TABLE[table] + E3D_AREA_SIZE, at);
    return v_add(upper, v_mul(v_sub(lower, upper), at->by_roughness));
}

static ALWAYS_INLINE void area_find_lobe(const area_axes *axes, vf32 roughness, area_lobe *out)
{
    const albedo_place at = albedo_find(roughness, axes->cosine, E3D_AREA_SIZE);
    vf32 one = v_setf(1.0f), alpha = v_mul(roughness, roughness), rise = area_number(E3D_AREA_RISE, &at), left = v_sub(one, rise);
    vf32 zs = v_mul(axes->sine, left), zc = v_add(v_mul(axes->cosine, left), rise);
    vf32 i = v_div(one, v_sqrt(v_add(v_mul(zs, zs), v_mul(zc, zc))));
    out->zs = v_mul(zs, i);
    out->zc = v_mul(zc, i);
    out->over_along = v_div(one, v_mul(area_number(E3D_AREA_ALONG, &at), alpha));
    out->over_across = v_div(one, v_mul(area_number(E3D_AREA_ACROSS, &at), alpha));
    out->skew = v_mul(area_number(E3D_AREA_SKEW, &at), axes->sine);
}

static ALWAYS_INLINE void area_through_lobe(const area_lobe *lobe, const vf32 v[3], vf32 out[3])
{
    vf32 x = v_sub(v_mul(lobe->zc, v[0]), v_mul(lobe->zs, v[2])), z = v_add(v_mul(lobe->zs, v[0]), v_mul(lobe->zc, v[2]));
    out[0] = v_sub(v_mul(x, lobe->over_along), v_mul(z, lobe->skew));
    out[1] = v_mul(v[1], lobe->over_across);
    out[2] = z;
}

/* sum_z of the light as a lobe sees it. */
static ALWAYS_INLINE vf32 area_shine(const e3d_light *light, const area_lanes *turned, const area_lobe *lobe)
{
    area_lanes seen;
    vf32 sum[3];
    area_through_lobe(lobe, turned->d, seen.d);
    area_through_lobe(lobe, turned->u, seen.u);
    area_through_lobe(lobe, turned->v, seen.v);
    area_integral(&seen, area_is_disc(light), sum);
    return v_max(sum[2], v_setf(0.0f));
}

/* ---- R236 ---- */

/* R240: how much of shadows counts, by how much of the light is above the surface. */
static ALWAYS_INLINE vf32 area_shadow_share(const area_lanes *turned)
{
    vf32 reach = v_add(environment_abs(turned->u[2]), environment_abs(turned->v[2]));
    return v_min(v_max(v_div(turned->d[2], reach), v_setf(0.0f)), v_setf(1.0f));
}

/* R240 */
static ALWAYS_INLINE void area_add_shadow(const e3d_lighting *lighting, int n, const e3d_batch *batch, int i, const vf32 position[3],
                                          const vf32 normal[3], area_lit *on)
{
    vf32 l[3], attenuation, one = v_setf(1.0f);
    if (!lighting->shadows || !lighting->lights[n].shadow.kind)
        return;
    light_towards(lighting, n, position, 0, l, &attenuation);
    vmask faces = v_gt(dot_three(normal, l), v_setf(0.0f));
    if (!v_any(v_mand(on->lit, faces)))
        return;
    vf32 hidden = v_sub(one, light_reached(lighting, n, batch, i, position, l));
    vf32 reached = v_self(faces, v_sub(one, v_mul(hidden, area_shadow_share(&on->turned))), one);
    on->share = v_mul(on->share, reached);
    on->e = v_mul(on->e, reached);
    on->lit = v_mand(on->lit, v_gt(reached, v_setf(0.0f)));
}

/* Finds light n on a vector; 0 if no lane gets any. */
static ALWAYS_INLINE int area_meet(const e3d_lighting *lighting, int n, const e3d_batch *batch, int i, const vf32 position[3],
                                   const area_axes *axes, area_lit *on)
{
    const e3d_light *light = &lighting->lights[n];
    vf32 sum[3];
    area_place(light, position, &on->turned);
    on->lit = area_reaches(lighting, n, on->turned.d, &on->share);
    if (!v_any(on->lit))
        return 0;
    area_turn(axes, &on->turned);
    area_integral(&on->turned, area_is_disc(light), sum);
    on->e = v_mul(v_mul(on->share, v_setf(0.5f)), sum[2]);
    on->lit = v_mand(on->lit, v_gt(on->e, v_setf(0.0f)));
    if (!v_any(on->lit))
        return 0;
    for (int c = 0; c < 3; c++) {
        const vf32 along[3] = {axes->axis[0][c], axes->axis[1][c], axes->axis[2][c]};
        on->l[c] = dot_three(along, sum);
    }
    unit_length(on->l);
    area_add_shadow(lighting, n, batch, i, position, axes->axis[2], on);
    return v_any(on->lit);
}

/* ---- R239 ---- */

/* Adds the chosen lights to one vector, whose sums begin with 0. */
static ALWAYS_INLINE void area_light_vector(e3d_batch *batch, const e3d_lighting *lighting, const int32_t *chosen, int count, int i,
                                            float shininess, lit_lanes *lit)
{
    float square = sqrtf(2.0f / (shininess + 2.0f)), root = sqrtf(square);
    root = root > E3D_LEAST_ROUGHNESS ? root : E3D_LEAST_ROUGHNESS;
    vf32 roughness = v_setf(root < 1.0f ? root : 1.0f);
    area_axes axes;
    area_lobe lobe;
    light_view(lighting, lit);
    area_find_axes(lit->normal, lit->view, &axes);
    if (shininess > 0.0f)
        area_find_lobe(&axes, roughness, &lobe);
    for (int n = 0; n < count; n++) {
        const e3d_light *light = &lighting->lights[chosen[n]];
        area_lit on;
        if (!area_meet(lighting, chosen[n], batch, i, lit->position, &axes, &on))
            continue;
        light_sum(lit->energy, lighting->shown[chosen[n]], on.e, &on.lit);
        if (!(shininess > 0.0f))
            continue;
        vf32 k = v_mul(v_mul(axes.cosine, area_shine(light, &on.turned, &lobe)), v_setf(4.0f / (shininess + 2.0f)));
        light_sum(lit->shine, lighting->shown[chosen[n]], v_mul(on.share, k), &on.lit);
    }
}

static void kernel_area_light(e3d_batch *batch, const e3d_lighting *lighting, float shininess)
{
    enum { AT_ONCE = 256 };
    int32_t chosen[AT_ONCE + E3D_PAD];
    light_box box;
    int boxed = light_bounds(batch, &box);
    shadow_no_suns(batch);
    for (int first = 0; first < lighting->light_count; first += AT_ONCE) {
        int rest = lighting->light_count - first, end = first + (rest < AT_ONCE ? rest : AT_ONCE);
        int count = light_choose(lighting, first, end, boxed ? &box : NULL, 1, chosen);
        for (int i = 0; i < batch->count; i += V_LANES) {
            lit_lanes lit;
            for (int k = 0; k < 3; k++) {
                lit.position[k] = v_loadf(batch->position[k] + i);
                lit.normal[k] = v_loadf(batch->normal[k] + i);
                lit.energy[k] = first ? v_loadf(batch->energy[k] + i) : v_setf(0.0f);
                lit.shine[k] = first ? v_loadf(batch->shine[k] + i) : v_setf(0.0f);
            }
            area_light_vector(batch, lighting, chosen, count, i, shininess, &lit);
            for (int k = 0; k < 3; k++) {
                v_storef(batch->energy[k] + i, lit.energy[k]);
                v_storef(batch->shine[k] + i, lit.shine[k]);
            }
        }
    }
}
