/* bend: how far surfaces that light passes through shift what is behind them, and how much they blur it (R164, R165). */
#pragma once

#include "base/always_inline.h"
#include "base/limits.h"
#include "kernels/types/texture_slots.h"
#include "kernels/generic/surface.inl"
#include "kernels/generic/interpolate.inl"
#include "kernels/generic/shade/environment.inl"
#include "kernels/generic/shade/texture_slots.inl"
#include "kernels/generic/shade/brdf.inl"

/* A vector of samples, and where their rays leave the surface for. */
typedef struct bend_lanes {
    vf32 view[3], normal[3], cosine, size; /* size: of the cosine */
    vf32 depth;                            /* down to which the ray goes */
    vf32 across, down, w;                  /* the sample's place in clip space: across and down over w */
} bend_lanes;

static ALWAYS_INLINE void bend_load(const float *const lanes[3], int i, vf32 out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = v_loadf(lanes[k] + i);
}

static ALWAYS_INLINE void bend_begin(const e3d_bending *b, const float *scale, int i, bend_lanes *at)
{
    vi32 sample = v_loadi(b->sample + i);
    vf32 half = v_setf(0.5f), one = v_setf(1.0f), place[3];
    vf32 x = v_float(v_addi(v_andi(sample, v_seti(E3D_TILE - 1)), v_seti(b->x)));
    vf32 y = v_float(v_addi(v_shr(sample, E3D_TILE_SHIFT), v_seti(b->y)));
    brdf_view(b->eye, b->lit_position, i, at->view);
    bend_load(b->normal, i, at->normal);
    bend_load(b->position, i, place);
    at->cosine = dot_three(at->normal, at->view);
    at->size = environment_abs(at->cosine);
    at->depth = v_mul(varying_at(&b->thickness, i), v_loadf(scale + i));
    x = v_mul(v_add(x, half), v_setf(b->pixels_a_sample));
    y = v_mul(v_add(y, half), v_setf(b->pixels_a_sample));
    at->across = v_sub(v_mul(x, v_setf(2.0f / b->width)), one);
    at->down = v_sub(one, v_mul(y, v_setf(2.0f / b->height)));
    const vf32 row[3] = {v_setf(b->rows[2][0]), v_setf(b->rows[2][1]), v_setf(b->rows[2][2])};
    at->w = v_add(dot_three(row, place), v_setf(b->rows[2][3]));
}

static ALWAYS_INLINE vf32 bend_along(const float row[4], const vf32 ray[3])
{
    const vf32 rows[3] = {v_setf(row[0]), v_setf(row[1]), v_setf(row[2])};
    return dot_three(rows, ray);
}

static ALWAYS_INLINE vi32 bend_whole(vf32 shift)
{
    vmask usual = v_mand(v_gt(shift, v_setf(-0x1p20f)), v_lt(shift, v_setf(0x1p20f)));
    return v_seli(usual, v_rint(v_self(usual, shift, v_setf(0.0f))), v_seti(0));
}

/* R164 for one index of refraction. */
static ALWAYS_INLINE void bend_shift(const e3d_bending *b, const bend_lanes *at, float index, vi32 out[2])
{
    vf32 one = v_setf(1.0f), zero = v_setf(0.0f), e = v_div(one, v_setf(index)), ray[3];
    vf32 k = v_max(v_sub(one, v_mul(v_mul(e, e), v_sub(one, v_mul(at->size, at->size)))), zero);
    vf32 g = v_sub(v_mul(e, at->size), v_sqrt(k));
    g = v_self(v_lt(at->cosine, zero), v_sub(zero, g), g);
    for (int c = 0; c < 3; c++)
        ray[c] = v_mul(v_sub(v_mul(at->normal[c], g), v_mul(at->view[c], e)), at->depth);
    vf32 x = bend_along(b->rows[0], ray), y = bend_along(b->rows[1], ray), z = bend_along(b->rows[2], ray);
    vf32 h = v_max(v_add(at->w, z), v_mul(at->w, v_setf(0.25f)));
    out[0] = bend_whole(v_mul(v_div(v_sub(x, v_mul(at->across, z)), h), v_setf(128.0f * b->width)));
    out[1] = bend_whole(v_mul(v_div(v_sub(v_mul(at->down, z), y), h), v_setf(128.0f * b->height)));
}

/* R165 */
static ALWAYS_INLINE vi32 bend_blur(const e3d_bending *b, const float *scale, int i)
{
    vf32 one = v_setf(1.0f), zero = v_setf(0.0f);
    vf32 most = v_mul(log2_poly(v_setf(b->blur_width)), v_setf(b->blur_share));
    vf32 level = v_mul(v_min(v_max(varying_at(&b->roughness, i), zero), one), most);
    vf32 area = v_mul(v_sub(exp2_poly(v_add(level, level)), one), v_setf(b->blur_area));
    vf32 blur = v_mul(v_min(area, v_setf(0x1p20f)), v_setf(256.0f));
    vmask none = v_mand(v_eq(v_loadf(scale + i), zero), v_gti(v_seti(b->is_body), v_seti(0)));
    return v_seli(none, v_seti(0), v_rint(blur));
}

/* R21 */
static ALWAYS_INLINE vf32 bend_depth(const e3d_bending *b, int i)
{
    vf32 place[3];
    bend_load(b->position, i, place);
    return v_sub(v_setf(0.0f), v_add(bend_along(b->depth_row, place), v_setf(b->depth_row[3])));
}

static void kernel_bend(const e3d_bending *bending, const float *scale, int count, e3d_bend_batch *out)
{
    for (int i = 0; i < count; i += V_LANES) {
        bend_lanes at;
        vi32 shift[2];
        bend_begin(bending, scale, i, &at);
        for (int c = 0; c < 3; c++) {
            if (c == 0 || bending->is_dispersive)
                bend_shift(bending, &at, bending->index[c], shift);
            v_storei(out->shift[c][0] + i, shift[0]);
            v_storei(out->shift[c][1] + i, shift[1]);
        }
        v_storei(out->blur + i, bend_blur(bending, scale, i));
        v_storef(out->depth + i, bend_depth(bending, i));
    }
}
