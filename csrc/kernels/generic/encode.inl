/* encode: colours, clamped to [0, 1] (R33), to 8 bits (R34). */
#pragma once

#include "base/always_inline.h"
#include "data/encode_tables.h"

static inline vf32 encode_clamp(vf32 v) { return v_min(v_max(v, v_setf(0.0f)), v_setf(1.0f)); }

/* The codes of one vector of colours, which need not be clamped. */
static ALWAYS_INLINE vi32 encode_linear(const vf32 color[3])
{
    vi32 code[3];
    for (int k = 0; k < 3; k++)
        /* NaN becomes INT32_MIN, which v_rgba takes as 0 */
        code[k] = v_rint(v_mul(v_setf(255.0f), v_min(v_setf(1.0f), color[k])));
    return v_rgba(code);
}

/* The number of thresholds <= v, found by the curve of encode_tables.h. */
static ALWAYS_INLINE vi32 encode_srgb(const vcurve *curve, const vf32 color[3])
{
    vi32 place[3];
    for (int k = 0; k < 3; k++)
        place[k] = v_shr(v_asi(v_add(encode_clamp(color[k]), v_setf(ENCODE_SHIFT))), 4);
    return v_curve_rgba(curve, place);
}

static ALWAYS_INLINE vi32 encode_vector(const vcurve *curve, const vf32 color[3], int srgb)
{
    return srgb ? encode_srgb(curve, color) : encode_linear(color);
}

static inline vcurve encode_curve(void)
{
    vcurve curve;
    v_curve(ENCODE_CURVE, &curve);
    return curve;
}

static void kernel_encode(const float *red, const float *green, const float *blue, int count, int srgb,
                          uint32_t *rgba)
{
    const vcurve curve = encode_curve();
    for (int i = 0; i < count; i += V_LANES) {
        const vf32 color[3] = {v_loadf(red + i), v_loadf(green + i), v_loadf(blue + i)};
        v_storei(rgba + i, encode_vector(&curve, color, srgb));
    }
}
