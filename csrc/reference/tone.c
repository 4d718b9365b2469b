/* Tone: the colour of a surface before it is clamped: fog, and tone mapping.
 * In: a colour of R31, R32 or R57, after exposure. Out: the colour that R33 and R84 clamp.
 * Rules: R117 ... R121, and the colours of a gradient, R122. */
#include <string.h>

#include "data/tone_tables.h"
#include "reference/decoding.h"
#include "reference/surface.h"

static void limit(float color[3])
{
    for (int c = 0; c < 3; c++)
        color[c] = ref_clamp(color[c], 0.0f, E3D_MOST_LIGHT);
}

static void multiply(const float matrix[3][3], const float v[3], float out[3])
{
    for (int row = 0; row < 3; row++)
        out[row] = ref_dot3(matrix[row], v);
}

/* R118 */
static void map_neutral(float color[3])
{
    float least = ref_min(ref_min(color[0], color[1]), color[2]);
    float offset = least < 0.08f ? least - 6.25f * least * least : 0.04f;
    for (int c = 0; c < 3; c++)
        color[c] = color[c] - offset;
    float peak = ref_max(ref_max(color[0], color[1]), color[2]);
    if (peak < 0.76f)
        return;
    float lower = 1.0f - 0.0576f / (peak - 0.52f), scale = lower / peak;
    float whiter = 1.0f - 1.0f / (0.15f * (peak - lower) + 1.0f);
    for (int c = 0; c < 3; c++) {
        float scaled = color[c] * scale;
        color[c] = scaled + (lower - scaled) * whiter;
    }
}

/* R119 */
static void map_aces(float color[3])
{
    float v[3];
    multiply(E3D_ACES_IN, color, v);
    for (int c = 0; c < 3; c++) {
        float a = v[c] * (v[c] + 0.0245786f) - 0.000090537f;
        float b = v[c] * (0.983729f * v[c] + 0.432951f) + 0.238081f;
        v[c] = a / b;
    }
    multiply(E3D_ACES_OUT, v, color);
}

static float float_of(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* Stops from the middle of the curve. */
static float agx_stops(float v, int channel)
{
    const float *k = E3D_AGX_LOG;
    float limited = ref_clamp(v, E3D_AGX_LEAST[channel], E3D_AGX_MOST[channel]);
    uint32_t bits;
    memcpy(&bits, &limited, sizeof bits);
    float stops = float_of(bits >> 9 | 0x44000000u), m = float_of((bits & 0x7FFFFFu) | 0x3F800000u);
    return stops + (((k[2] * m + k[1]) * m + k[0]) * m + E3D_AGX_START[channel]);
}

/* R119 */
static float agx_curve(float stops)
{
    float sum = stops + E3D_AGX_CURVE[5];
    for (int k = 4; k >= 0; k--)
        sum = sum * stops + E3D_AGX_CURVE[k];
    return sum;
}

/* R119 */
static void map_agx(float color[3])
{
    const float (*in)[3] = E3D_AGX_IN;
    float r = color[0], g = color[1], b = color[2], power[3];
    float v[3] = {(r + in[0][1] * g) + in[0][2] * b, (in[1][0] * r + g) + in[1][2] * b, (in[2][0] * r + in[2][1] * g) + b};
    for (int c = 0; c < 3; c++)
        v[c] = agx_curve(agx_stops(v[c], c));
    float sum = ref_dot3(E3D_AGX_OUT, v);
    for (int c = 0; c < 3; c++) {
        float w = ref_max(v[c] + sum, 0.0f);
        power[c] = (w * w) * ((w + E3D_AGX_POWER[0]) + E3D_AGX_POWER[1] * sqrtf(w));
    }
    multiply(E3D_AGX_SRGB, power, color);
}

/* R117 */
void ref_map_tone(e3d_tone_mapping mapping, float color[3])
{
    if (mapping == E3D_TONE_NONE)
        return;
    if (mapping == E3D_TONE_AGX) { /* it has limits of its own */
        map_agx(color);
        return;
    }
    limit(color);
    if (mapping == E3D_TONE_NEUTRAL)
        map_neutral(color);
    else
        map_aces(color);
}

/* R120 */
static float share_of_fog(const e3d_fog *fog, float metric_depth)
{
    float depth = ref_max(metric_depth, 0.0f);
    if (fog->kind == E3D_FOG_LINEAR) {
        float scale = 1.0f / (fog->far - fog->near);
        return ref_clamp((depth - fog->near) * scale, 0.0f, 1.0f);
    }
    float u = depth * fog->density;
    return 1.0f - ref_exp2((u * u) * E3D_MINUS_LOG2_E);
}

/* R121 */
void ref_add_fog(const e3d_fog *fog, float metric_depth, int is_lit, float color[3])
{
    const float *fog_color = is_lit ? fog->lit_color : fog->color;
    float share = share_of_fog(fog, metric_depth);
    limit(color);
    for (int c = 0; c < 3; c++)
        color[c] = color[c] + (fog_color[c] - color[c]) * share;
}

/* R122 */
void ref_gradient(const e3d_frame *frame, int32_t x, int32_t y, float out[3])
{
    const e3d_gradient *gradient = &frame->gradient;
    int is_srgb = frame->encode_srgb && (frame->mode == E3D_MODE_LIT || frame->mode == E3D_MODE_UNLIT);
    float t = ((float)y + 0.5f) / (float)frame->height;
    float threshold = ((float)E3D_DITHER_ORDER[y % E3D_DITHER][x % E3D_DITHER] + 0.5f) * 0x1p-6f;
    for (int c = 0; c < 3; c++) {
        float v = (gradient->top[c] + (gradient->bottom[c] - gradient->top[c]) * t) * 255.0f;
        int32_t code = (int32_t)ref_min(v + threshold, 255.0f);
        out[c] = ref_decode(code, is_srgb);
    }
}
