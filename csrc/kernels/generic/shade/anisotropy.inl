/* anisotropy: a lobe that is rougher along one direction than across it (R136-R138). */
#pragma once

#include "base/always_inline.h"
#include "base/limits.h"
#include "kernels/types/texture_slots.h"
#include "kernels/generic/surface.inl"
#include "kernels/generic/interpolate.inl"
#include "kernels/generic/shade/texture_slots.inl"

/* The directions of the lobe, which is rougher along t. */
typedef struct stretch_lanes {
    vf32 t[3], b[3], strength;
    vf32 along, across, product; /* the alphas along t and along b */
    vf32 root;                   /* the root in Smith's term of the view */
} stretch_lanes;

/* Finds any direction along the surface, if nothing defines one. */
static inline void stretch_anywhere(const vf32 n[3], vf32 out[3])
{
    vf32 one = v_setf(1.0f), zero = v_setf(0.0f), x = v_self(v_gt(n[0], zero), n[0], v_sub(zero, n[0]));
    vmask low = v_lt(x, v_setf(0.5f));
    const vf32 axis[3] = {v_self(low, one, zero), v_self(low, zero, one), zero};
    cross_three(n, axis, out);
    unit_length(out);
}

/* R136 */
static inline void stretch_directions(const e3d_texture_batch *m, const e3d_anisotropy_texture *texture, const vf32 n[3], int i,
                                      stretch_lanes *out)
{
    vf32 one = v_setf(1.0f), zero = v_setf(0.0f), two = v_setf(2.0f), x = one, y = zero, tangent[3], normal[3], b[3];
    vf32 strength = v_setf(texture->strength), cosine = v_setf(texture->turn[0]), sine = v_setf(texture->turn[1]);
    if (texture->texels) {
        vf32 unit = v_setf(texture->unit);
        x = v_sub(v_mul(v_mul(v_loadf(texture->texels[0] + i), unit), two), one);
        y = v_sub(v_mul(v_mul(v_loadf(texture->texels[1] + i), unit), two), one);
        strength = v_mul(v_loadf(texture->texels[2] + i), v_mul(strength, unit));
    }
    vf32 along = v_sub(v_mul(cosine, x), v_mul(sine, y)), across = v_add(v_mul(sine, x), v_mul(cosine, y));
    for (int c = 0; c < 3; c++) {
        tangent[c] = v_loadf(m->tangent[c] + i);
        normal[c] = v_loadf(m->shading_normal[c] + i);
    }
    cross_three(normal, tangent, b);
    vf32 sign = v_loadf(m->tangent[3] + i), any[3];
    for (int c = 0; c < 3; c++)
        out->t[c] = v_add(v_mul(tangent[c], along), v_mul(v_mul(b[c], sign), across));
    vf32 over = dot_three(n, out->t);
    for (int c = 0; c < 3; c++)
        out->t[c] = v_sub(out->t[c], v_mul(n[c], over));
    unit_length(out->t);
    vmask known = v_gt(dot_three(out->t, out->t), v_setf(0.5f));
    stretch_anywhere(n, any);
    for (int c = 0; c < 3; c++)
        out->t[c] = v_self(known, out->t[c], any[c]);
    strength = v_self(v_gt(strength, zero), strength, zero);
    out->strength = v_self(known, v_self(v_lt(strength, one), strength, one), zero);
    cross_three(n, out->t, out->b);
}

/* The root in Smith's term of a direction. */
static ALWAYS_INLINE vf32 stretch_smith(const stretch_lanes *s, const vf32 direction[3], vf32 cosine)
{
    vf32 x = v_mul(s->along, dot_three(s->t, direction)), y = v_mul(s->across, dot_three(s->b, direction));
    return v_sqrt(v_add(v_add(v_mul(x, x), v_mul(y, y)), v_mul(cosine, cosine)));
}

static inline void stretch_begin(const e3d_texture_batch *m, const e3d_anisotropy_texture *texture, const vf32 n[3],
                                 const vf32 view[3], vf32 nv,
                                 vf32 roughness, int i, stretch_lanes *out)
{
    stretch_directions(m, texture, n, i, out);
    out->across = v_mul(roughness, roughness);
    out->along = v_add(out->across, v_mul(v_sub(v_setf(1.0f), out->across), v_mul(out->strength, out->strength)));
    out->product = v_mul(out->along, out->across);
    out->root = stretch_smith(out, view, nv);
}

/* R137: D times V. */
static ALWAYS_INLINE vf32 stretch_reflect(const stretch_lanes *s, vf32 nv, const vf32 l[3], vf32 nl, const vf32 h[3], vf32 square, vf32 nh)
{
    vf32 x = v_mul(s->across, dot_three(s->t, h)), y = v_mul(s->along, dot_three(s->b, h)), z = v_mul(s->product, nh);
    vf32 f = v_add(v_add(v_mul(x, x), v_mul(y, y)), v_mul(z, z));
    vf32 u = v_add(v_mul(nl, s->root), v_mul(nv, stretch_smith(s, l, nl)));
    vf32 third = v_mul(v_mul(s->product, s->product), s->product);
    vf32 above = v_mul(v_mul(third, v_setf(E3D_OVER_2PI)), v_mul(square, square));
    return v_self(v_gt(nh, v_setf(0.0f)), v_div(above, v_mul(v_mul(f, f), u)), v_setf(0.0f));
}

/* R138 */
static inline void stretch_bend(const stretch_lanes *s, const vf32 normal[3], const vf32 view[3], vf32 roughness, vf32 out[3])
{
    vf32 one = v_setf(1.0f), k = v_sub(one, v_mul(s->strength, v_sub(one, roughness))), k2 = v_mul(k, k), k4 = v_mul(k2, k2), e[3], p[3];
    cross_three(s->b, view, e);
    cross_three(e, s->b, p);
    unit_length(p);
    for (int c = 0; c < 3; c++)
        out[c] = v_add(p[c], v_mul(v_sub(normal[c], p[c]), k4));
    unit_length(out);
}
