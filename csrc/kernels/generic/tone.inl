/* tone: fog over colours, and tone mapping (R117-R121). */
#pragma once

#include "base/always_inline.h"
#include "data/tone_tables.h"
#include "e3d.h"
#include "kernels/types/fog.h"
#include "kernels/generic/surface.inl"
#include "kernels/generic/interpolate.inl"
#include "kernels/generic/encode.inl"

static inline vf32 tone_limit(vf32 v) { return v_min(v_max(v, v_setf(0.0f)), v_setf(E3D_MOST_LIGHT)); }

static ALWAYS_INLINE void tone_multiply(const float matrix[3][3], const vf32 v[3], vf32 out[3])
{
    for (int row = 0; row < 3; row++)
        out[row] = v_add(v_add(v_mul(v_setf(matrix[row][0]), v[0]), v_mul(v_setf(matrix[row][1]), v[1])),
                         v_mul(v_setf(matrix[row][2]), v[2]));
}

/* Mappers interleave several vectors in short steps, since within one vector most operations would wait for those before. */
enum { TONE_SIDE = 4 };

/* The colours of `side` vectors, channel by channel; `side` is a constant for the compiler. */
typedef vf32 tone_colors[TONE_SIDE][3];

#define TONE_EACH(side, j) for (int j = 0; j < side; j++)

static ALWAYS_INLINE void tone_load(float *const planes[3], int at, int side, tone_colors out)
{
    TONE_EACH (side, j)
        for (int k = 0; k < 3; k++)
            out[j][k] = v_loadf(planes[k] + at + j * V_LANES);
}

static ALWAYS_INLINE void tone_store(float *const planes[3], int at, int side, tone_colors color)
{
    TONE_EACH (side, j)
        for (int k = 0; k < 3; k++)
            v_storef(planes[k] + at + j * V_LANES, encode_clamp(color[j][k]));
}

static ALWAYS_INLINE void tone_limit_all(int side, tone_colors color)
{
    TONE_EACH (side, j)
        for (int k = 0; k < 3; k++)
            color[j][k] = tone_limit(color[j][k]);
}

static ALWAYS_INLINE void tone_multiply_all(const float matrix[3][3], int side, tone_colors color)
{
    TONE_EACH (side, j) {
        const vf32 v[3] = {color[j][0], color[j][1], color[j][2]};
        tone_multiply(matrix, v, color[j]);
    }
}

/* R118: takes the toe from dark colours; returns the greatest channel. */
static ALWAYS_INLINE vf32 tone_neutral_dark(vf32 color[3])
{
    vf32 least = v_min(v_min(color[0], color[1]), color[2]);
    vf32 dark = v_sub(least, v_mul(v_mul(v_setf(6.25f), least), least));
    vf32 offset = v_self(v_lt(least, v_setf(0.08f)), dark, v_setf(0.04f));
    for (int k = 0; k < 3; k++)
        color[k] = v_sub(color[k], offset);
    return v_max(v_max(color[0], color[1]), color[2]);
}

/* R118. If no lane is bright, nothing is divided. */
static ALWAYS_INLINE void tone_neutral(int side, tone_colors color)
{
    vf32 peak[TONE_SIDE], lower[TONE_SIDE], scale[TONE_SIDE], whiter[TONE_SIDE], one = v_setf(1.0f), start = v_setf(0.76f), most;
    vmask bright[TONE_SIDE];
    TONE_EACH (side, j)
        peak[j] = tone_neutral_dark(color[j]);
    most = peak[0];
    TONE_EACH (side, j)
        most = v_max(most, peak[j]);
    if (!v_any(v_mnot(v_lt(most, start))))
        return;
    TONE_EACH (side, j) {
        bright[j] = v_mnot(v_lt(peak[j], start));
        peak[j] = v_max(peak[j], start); /* in the other lanes any number will do */
        lower[j] = v_sub(one, v_div(v_setf(0.0576f), v_sub(peak[j], v_setf(0.52f))));
    }
    TONE_EACH (side, j)
        scale[j] = v_div(lower[j], peak[j]);
    TONE_EACH (side, j)
        whiter[j] = v_sub(one, v_div(one, v_add(v_mul(v_setf(0.15f), v_sub(peak[j], lower[j])), one)));
    TONE_EACH (side, j)
        for (int k = 0; k < 3; k++) {
            vf32 scaled = v_mul(color[j][k], scale[j]);
            color[j][k] = v_self(bright[j], v_add(scaled, v_mul(v_sub(lower[j], scaled), whiter[j])), color[j][k]);
        }
}

/* R119 */
static ALWAYS_INLINE void tone_aces(int side, tone_colors color)
{
    tone_multiply_all(E3D_ACES_IN, side, color);
    TONE_EACH (side, j)
        for (int k = 0; k < 3; k++) {
            vf32 v = color[j][k], a = v_sub(v_mul(v, v_add(v, v_setf(0.0245786f))), v_setf(0.000090537f));
            vf32 b = v_add(v_mul(v, v_add(v_mul(v_setf(0.983729f), v), v_setf(0.432951f))), v_setf(0.238081f));
            color[j][k] = v_div(a, b);
        }
    tone_multiply_all(E3D_ACES_OUT, side, color);
}

/* R119: applies the first matrix, and the limits of the curve. */
static ALWAYS_INLINE void tone_agx_in(vf32 c[3])
{
    const float (*in)[3] = E3D_AGX_IN;
    const vf32 v[3] = {v_add(v_add(c[0], v_mul(v_setf(in[0][1]), c[1])), v_mul(v_setf(in[0][2]), c[2])),
                       v_add(v_add(v_mul(v_setf(in[1][0]), c[0]), c[1]), v_mul(v_setf(in[1][2]), c[2])),
                       v_add(v_add(v_mul(v_setf(in[2][0]), c[0]), v_mul(v_setf(in[2][1]), c[1])), c[2])};
    for (int k = 0; k < 3; k++)
        c[k] = v_min(v_max(v[k], v_setf(E3D_AGX_LEAST[k])), v_setf(E3D_AGX_MOST[k]));
}

/* Finds the stops from the middle of the curve. */
static ALWAYS_INLINE void tone_agx_stops(int side, tone_colors v)
{
    tone_colors m, sum;
#define TONE_STEP(step) \
    TONE_EACH (side, j) \
        for (int k = 0; k < 3; k++) \
            step;
    TONE_STEP(m[j][k] = v_asf(v_ori(v_andi(v_asi(v[j][k]), v_seti(0x7FFFFF)), v_seti(0x3F800000))))
    TONE_STEP(v[j][k] = v_asf(v_ori(v_shr(v_asi(v[j][k]), 9), v_seti(0x44000000))))
    TONE_STEP(sum[j][k] = v_add(v_mul(v_setf(E3D_AGX_LOG[2]), m[j][k]), v_setf(E3D_AGX_LOG[1])))
    TONE_STEP(sum[j][k] = v_add(v_mul(sum[j][k], m[j][k]), v_setf(E3D_AGX_LOG[0])))
    TONE_STEP(sum[j][k] = v_add(v_mul(sum[j][k], m[j][k]), v_setf(E3D_AGX_START[k])))
    TONE_STEP(v[j][k] = v_add(v[j][k], sum[j][k]))
}

static ALWAYS_INLINE void tone_agx_curve(int side, tone_colors v)
{
    tone_colors sum;
    TONE_STEP(sum[j][k] = v_add(v[j][k], v_setf(E3D_AGX_CURVE[5])))
    for (int n = 4; n >= 0; n--)
        TONE_STEP(sum[j][k] = v_add(v_mul(sum[j][k], v[j][k]), v_setf(E3D_AGX_CURVE[n])))
    TONE_STEP(v[j][k] = sum[j][k])
}

/* Raises to the power of 2.2. */
static ALWAYS_INLINE void tone_agx_power(int side, tone_colors v)
{
    tone_colors root;
    TONE_EACH (side, j) {
        vf32 sum = v_add(v_mul(v_setf(E3D_AGX_OUT[0]), v[j][0]), v_mul(v_setf(E3D_AGX_OUT[1]), v[j][1]));
        sum = v_add(sum, v_mul(v_setf(E3D_AGX_OUT[2]), v[j][2]));
        for (int k = 0; k < 3; k++)
            v[j][k] = v_max(v_add(v[j][k], sum), v_setf(0.0f));
    }
    TONE_STEP(root[j][k] = v_sqrt(v[j][k]))
    TONE_STEP(root[j][k] = v_add(v_add(v[j][k], v_setf(E3D_AGX_POWER[0])), v_mul(v_setf(E3D_AGX_POWER[1]), root[j][k])))
    TONE_STEP(v[j][k] = v_mul(v_mul(v[j][k], v[j][k]), root[j][k]))
#undef TONE_STEP
}

static ALWAYS_INLINE void tone_agx(int side, tone_colors color)
{
    TONE_EACH (side, j)
        tone_agx_in(color[j]);
    tone_agx_stops(side, color);
    tone_agx_curve(side, color);
    tone_agx_power(side, color);
    tone_multiply_all(E3D_AGX_SRGB, side, color);
}

/* Maps some vectors; the mapping is a constant for the compiler, too. */
static ALWAYS_INLINE void tone_some(e3d_tone_mapping mapping, float *const planes[3], int at, int side)
{
    tone_colors color;
    tone_load(planes, at, side, color);
    if (mapping == E3D_TONE_NEUTRAL || mapping == E3D_TONE_ACES)
        tone_limit_all(side, color);
    if (mapping == E3D_TONE_NEUTRAL)
        tone_neutral(side, color);
    else if (mapping == E3D_TONE_ACES)
        tone_aces(side, color);
    else if (mapping == E3D_TONE_AGX)
        tone_agx(side, color);
    tone_store(planes, at, side, color);
}

static ALWAYS_INLINE void tone_planes(e3d_tone_mapping mapping, float *const planes[3], int count)
{
    int i = 0;
    for (; i + (TONE_SIDE - 1) * V_LANES < count; i += TONE_SIDE * V_LANES)
        tone_some(mapping, planes, i, TONE_SIDE);
    for (; i < count; i += V_LANES)
        tone_some(mapping, planes, i, 1);
}

static void kernel_tone(e3d_tone_mapping mapping, float *const planes[3], int count)
{
    switch (mapping) {
    case E3D_TONE_NEUTRAL: tone_planes(E3D_TONE_NEUTRAL, planes, count); break;
    case E3D_TONE_ACES: tone_planes(E3D_TONE_ACES, planes, count); break;
    case E3D_TONE_AGX: tone_planes(E3D_TONE_AGX, planes, count); break;
    case E3D_TONE_NONE:
    case E3D_TONE_MAPPINGS: tone_planes(E3D_TONE_NONE, planes, count); break;
    }
}

/* ---- fog ---- */

static ALWAYS_INLINE vf32 fog_share(const e3d_fog_view *fog, const float *const position[3], int i, e3d_fog_kind kind)
{
    const float *row = fog->row;
    vf32 sum = v_mul(v_setf(row[0]), v_loadf(position[0] + i)), zero = v_setf(0.0f), one = v_setf(1.0f);
    sum = v_add(sum, v_mul(v_setf(row[1]), v_loadf(position[1] + i)));
    sum = v_add(v_add(sum, v_mul(v_setf(row[2]), v_loadf(position[2] + i))), v_setf(row[3]));
    vf32 depth = v_max(v_sub(zero, sum), zero);
    if (kind == E3D_FOG_LINEAR)
        return encode_clamp(v_mul(v_sub(depth, v_setf(fog->near)), v_setf(fog->scale)));
    vf32 u = v_mul(depth, v_setf(fog->density));
    return v_sub(one, exp2_poly(v_mul(v_mul(u, u), v_setf(E3D_MINUS_LOG2_E))));
}

/* Blends fog over planes of colours; the kind is a constant for the compiler. */
static ALWAYS_INLINE void fog_planes(const e3d_fog_view *fog, const float *const position[3], int count, float *const color[3],
                                     e3d_fog_kind kind)
{
    for (int i = 0; i < count; i += V_LANES) {
        vf32 share = fog_share(fog, position, i, kind);
        for (int k = 0; k < 3; k++) {
            vf32 before = tone_limit(v_loadf(color[k] + i));
            v_storef(color[k] + i, v_add(before, v_mul(v_sub(v_setf(fog->color[k]), before), share)));
        }
    }
}

static void kernel_fog(const e3d_fog_view *fog, const float *const position[3], int count, float *const color[3])
{
    if (fog->kind == E3D_FOG_LINEAR)
        fog_planes(fog, position, count, color, E3D_FOG_LINEAR);
    else
        fog_planes(fog, position, count, color, E3D_FOG_EXPONENTIAL);
}
