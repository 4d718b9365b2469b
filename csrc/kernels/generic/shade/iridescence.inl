/* Iridescence: the reflectance of a thin film on a surface, by channel (R139, R140). */
#pragma once

#include "base/always_inline.h"
#include "data/iridescence_tables.h"
#include "base/limits.h"
#include "kernels/generic/surface.inl"
#include "kernels/generic/interpolate.inl"

static inline vf32 iridescence_clamp(vf32 v, float low, float high)
{
    vf32 least = v_setf(low), most = v_setf(high), t = v_self(v_gt(v, least), v, least);
    return v_self(v_lt(t, most), t, most);
}

/* R139: one wave's response after a path. */
static inline vf32 iridescence_wave(int number, vf32 path)
{
    vf32 turns = v_mul(path, v_setf(E3D_FILM_TURNS[number]));
    vf32 rest = v_sub(turns, v_floor(v_add(turns, v_setf(0.5f)))), square = v_mul(rest, rest);
    vf32 cosine = v_setf(E3D_FILM_COSINES[E3D_FILM_COSINE - 1]);
    for (int k = E3D_FILM_COSINE - 2; k >= 0; k--)
        cosine = v_add(v_mul(cosine, square), v_setf(E3D_FILM_COSINES[k]));
    vf32 fade = exp2_poly(v_mul(v_mul(v_setf(E3D_FILM_FADE[number]), path), path));
    return v_mul(v_mul(v_setf(E3D_FILM_AMPLITUDE[number]), cosine), fade);
}

static inline void iridescence_sensitivity(vf32 path, const vf32 sign[3], vf32 out[3])
{
    vf32 xyz[3] = {v_mul(sign[0], v_add(iridescence_wave(0, path), iridescence_wave(3, path))), v_mul(sign[1], iridescence_wave(1, path)),
                   v_mul(sign[2], iridescence_wave(2, path))};
    for (int c = 0; c < 3; c++) {
        const vf32 row[3] = {v_setf(E3D_FILM_RGB[c][0]), v_setf(E3D_FILM_RGB[c][1]), v_setf(E3D_FILM_RGB[c][2])};
        out[c] = dot_three(row, xyz);
    }
}

static inline vf32 iridescence_schlick(vf32 f0, vf32 cosine)
{
    vf32 one = v_setf(1.0f), w = v_sub(one, cosine), w2 = v_mul(w, w);
    return v_add(f0, v_mul(v_sub(one, f0), v_mul(v_mul(w2, w2), w)));
}

/* R140 for one channel: the light that comes back at once, and after each round trip within the film. */
static inline vf32 iridescence_sum(vf32 r12, vf32 r23, vf32 once, vf32 twice)
{
    vf32 one = v_setf(1.0f), t = v_sub(one, r12);
    vf32 both = iridescence_clamp(v_mul(r12, r23), E3D_LEAST_IRIDESCENCE_PRODUCT, E3D_MOST_IRIDESCENCE_F0), root = v_sqrt(both);
    vf32 rs = v_div(v_mul(v_mul(t, t), r23), v_sub(one, both)), first = v_mul(v_sub(rs, t), root), second = v_mul(first, root);
    vf32 sum = v_add(v_add(r12, rs), v_mul(first, v_add(once, once)));
    return v_add(sum, v_mul(second, v_add(twice, twice)));
}

static inline void iridescence_reflect(vf32 cosine, float iridescence_ior, vf32 thickness, const vf32 f0[3], vf32 out[3])
{
    vf32 one = v_setf(1.0f), ior = v_setf(iridescence_ior), zero = v_setf(0.0f), sign[3], r23[3], once[3], twice[3];
    const vf32 always[3] = {one, one, one};
    vf32 outer = v_div(v_sub(ior, one), v_add(ior, one)), r12 = iridescence_schlick(v_mul(outer, outer), cosine);
    vf32 bent = v_mul(v_div(one, v_mul(ior, ior)), v_sub(one, v_mul(cosine, cosine))), square = v_sub(one, bent);
    vf32 below = v_sqrt(v_max(square, zero)), path = v_mul(v_mul(v_mul(v_setf(2.0f), ior), thickness), below);
    for (int c = 0; c < 3; c++) {
        vf32 root = v_sqrt(iridescence_clamp(f0[c], 0.0f, E3D_MOST_IRIDESCENCE_F0)), base = v_div(v_add(one, root), v_sub(one,
                                                                                                                          root));
        vf32 inner = v_div(v_sub(base, ior), v_add(base, ior));
        sign[c] = v_self(v_lt(base, ior), one, v_setf(-1.0f));
        r23[c] = iridescence_schlick(v_mul(inner, inner), below);
    }
    iridescence_sensitivity(path, sign, once);
    iridescence_sensitivity(v_add(path, path), always, twice);
    for (int c = 0; c < 3; c++)
        out[c] = v_self(v_lt(square, zero), one, iridescence_clamp(iridescence_sum(r12, r23[c], once[c], twice[c]), 0.0f, 1.0f));
}

/* R141: blends f0, by the film's share, towards the value that gives the film's reflectance in Schlick's term. */
static inline void iridescence_mix_f0(vf32 cosine, const vf32 film[3], vf32 share, vf32 f0[3])
{
    vf32 one = v_setf(1.0f), w = v_sub(one, cosine), w2 = v_mul(w, w);
    vf32 w5 = v_min(v_mul(v_mul(w2, w2), w), v_setf(E3D_MOST_IRIDESCENCE_F0));
    for (int c = 0; c < 3; c++) {
        vf32 found = iridescence_clamp(v_div(v_sub(film[c], w5), v_sub(one, w5)), 0.0f, 1.0f);
        f0[c] = v_add(f0[c], v_mul(v_sub(found, f0[c]), share));
    }
}
