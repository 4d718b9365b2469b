/* tone: fog over colours, and tone mapping (R117-R121). */
#ifndef E3D_KERNELS_TONE_INL
#define E3D_KERNELS_TONE_INL

#include "core/always_inline.h"
#include "core/tone_tables.h"
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

/* R118. Where no lane is bright, nothing is divided. */
static ALWAYS_INLINE void tone_neutral(vf32 color[3])
{
    vf32 one = v_setf(1.0f), least = v_min(v_min(color[0], color[1]), color[2]);
    vf32 dark = v_sub(least, v_mul(v_mul(v_setf(6.25f), least), least));
    vf32 offset = v_self(v_lt(least, v_setf(0.08f)), dark, v_setf(0.04f));
    for (int k = 0; k < 3; k++)
        color[k] = v_sub(color[k], offset);
    vf32 peak = v_max(v_max(color[0], color[1]), color[2]), start = v_setf(0.76f);
    vmask bright = v_mnot(v_lt(peak, start));
    if (!v_any(bright))
        return;
    peak = v_max(peak, start); /* in the other lanes any number will do */
    vf32 lower = v_sub(one, v_div(v_setf(0.0576f), v_sub(peak, v_setf(0.52f)))), scale = v_div(lower, peak);
    vf32 whiter = v_sub(one, v_div(one, v_add(v_mul(v_setf(0.15f), v_sub(peak, lower)), one)));
    for (int k = 0; k < 3; k++) {
        vf32 scaled = v_mul(color[k], scale);
        color[k] = v_self(bright, v_add(scaled, v_mul(v_sub(lower, scaled), whiter)), color[k]);
    }
}

/* R119 */
static ALWAYS_INLINE void tone_aces(vf32 color[3])
{
    vf32 v[3];
    tone_multiply(E3D_ACES_IN, color, v);
    for (int k = 0; k < 3; k++) {
        vf32 a = v_sub(v_mul(v[k], v_add(v[k], v_setf(0.0245786f))), v_setf(0.000090537f));
        vf32 b = v_add(v_mul(v[k], v_add(v_mul(v_setf(0.983729f), v[k]), v_setf(0.432951f))), v_setf(0.238081f));
        v[k] = v_div(a, b);
    }
    tone_multiply(E3D_ACES_OUT, v, color);
}

static ALWAYS_INLINE vf32 tone_polynomial(const float coefficients[7], vf32 t)
{
    vf32 sum = v_setf(coefficients[6]);
    for (int k = 5; k >= 0; k--)
        sum = v_add(v_mul(sum, t), v_setf(coefficients[k]));
    return sum;
}

static ALWAYS_INLINE vf32 tone_agx_curve(vf32 light)
{
    vf32 stops = log2_poly(v_max(light, v_setf(1e-10f)));
    vf32 t = v_add(v_mul(stops, v_setf(E3D_AGX_SCALE)), v_setf(E3D_AGX_OFFSET));
    return tone_polynomial(E3D_AGX_CURVE, v_min(v_max(t, v_setf(-0.5f)), v_setf(0.5f)));
}

/* v to the power of 2.2. */
static ALWAYS_INLINE vf32 tone_linear(vf32 v)
{
    vf32 w = v_max(v, v_setf(0.0f));
    return v_mul(v_mul(w, w), tone_polynomial(E3D_AGX_POWER, v_sqrt(w)));
}

/* R119 */
static ALWAYS_INLINE void tone_agx(vf32 color[3])
{
    vf32 v[3], wide[3];
    tone_multiply(E3D_AGX_IN, color, v);
    for (int k = 0; k < 3; k++)
        v[k] = tone_agx_curve(v[k]);
    tone_multiply(E3D_AGX_OUT, v, wide);
    for (int k = 0; k < 3; k++)
        wide[k] = tone_linear(wide[k]);
    tone_multiply(E3D_AGX_SRGB, wide, color);
}

/* The mapping is a constant for the compiler. */
static ALWAYS_INLINE void tone_planes(e3d_tone_mapping mapping, float *const planes[3], int count)
{
    for (int i = 0; i < count; i += V_LANES) {
        vf32 color[3];
        for (int k = 0; k < 3; k++) {
            color[k] = v_loadf(planes[k] + i);
            color[k] = mapping == E3D_TONE_NONE ? color[k] : tone_limit(color[k]);
        }
        if (mapping == E3D_TONE_NEUTRAL)
            tone_neutral(color);
        else if (mapping == E3D_TONE_ACES)
            tone_aces(color);
        else if (mapping == E3D_TONE_AGX)
            tone_agx(color);
        for (int k = 0; k < 3; k++)
            v_storef(planes[k] + i, encode_clamp(color[k]));
    }
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

/* The kind is a constant for the compiler. */
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

#endif
