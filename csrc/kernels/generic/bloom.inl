/* bloom: rows of its pyramid (R124). The parts in plain C have no order of operations beyond that of each element, so that
 * compilers vectorise them. */
#pragma once

#include <string.h>

#include "data/bloom_levels.h"
#include "base/always_inline.h"
#include "kernels/generic/encode.inl"

static ALWAYS_INLINE vf32 bloom_above(const float *light)
{
    return v_min(v_max(v_sub(v_loadf(light), v_setf(1.0f)), v_setf(0.0f)), v_setf(E3D_MOST_BLOOM));
}

/* Does one vector, and returns it; the channels of a pixel follow each other. */
static ALWAYS_INLINE vf32 bloom_bright_vector(const float *const rows[4], int i, float *out)
{
    vf32 outer = v_add(bloom_above(rows[0] + i), bloom_above(rows[3] + i));
    vf32 inner = v_add(bloom_above(rows[1] + i), bloom_above(rows[2] + i));
    vf32 light = v_mul(v_add(outer, v_mul(inner, v_setf(3.0f))), v_setf(0.125f));
    v_storef(out, light);
    return light;
}

static ALWAYS_INLINE float bloom_filter(float a, float b, float c, float d) { return ((a + d) + (b + c) * 3.0f) * 0.125f; }

/* Does the last ones of a row, behind which nothing may be read. */
static vf32 bloom_bright_rest(const float *const rows[4], int first, int end, float *out)
{
    float room[4][V_LANES] = {{0}}, done[V_LANES];
    const float *const from[4] = {room[0], room[1], room[2], room[3]};
    for (int i = first; i < end; i++)
        for (int r = 0; r < 4; r++)
            room[r][i - first] = rows[r][i];
    vf32 light = bloom_bright_vector(from, 0, done);
    for (int i = first; i < end; i++)
        out[i] = done[i - first];
    return light;
}

static int kernel_bloom_bright(const float *const rows[4], int width, float *const planes[3])
{
    enum { AT_ONCE = 64 }; /* pixels */
    float some[3 * AT_ONCE];
    vf32 most = v_setf(0.0f);
    for (int x = 0; x < width; x += AT_ONCE) {
        int count = width - x < AT_ONCE ? width - x : AT_ONCE, whole = 3 * count / V_LANES * V_LANES;
        const float *const from[4] = {rows[0] + 3 * x, rows[1] + 3 * x, rows[2] + 3 * x, rows[3] + 3 * x};
        for (int i = 0; i < whole; i += V_LANES)
            most = v_max(most, bloom_bright_vector(from, i, some + i));
        most = v_max(most, bloom_bright_rest(from, whole, 3 * count, some));
        for (int k = 0; k < 3; k++)
            for (int i = 0; i < count; i++)
                planes[k][x + i] = some[3 * i + k];
    }
    return v_any(v_gt(most, v_setf(0.0f)));
}

static void kernel_bloom_rows(const float *const rows[4], int count, float *restrict out)
{
    const float *restrict a = rows[0], *restrict b = rows[1], *restrict c = rows[2], *restrict d = rows[3];
    for (int i = 0; i < count; i++)
        out[i] = bloom_filter(a[i], b[i], c[i], d[i]);
}

static void kernel_bloom_halve(const float *restrict row, int width, float *restrict out)
{
    /* Inner: up to here no neighbour lies beyond the end */
    int half = (width + 1) / 2, last = width - 1, inner = (width - 1) / 2;
    out[0] = bloom_filter(row[0], row[0], row[last < 1 ? last : 1], row[last < 2 ? last : 2]);
    for (int x = 1; x < inner; x++)
        out[x] = bloom_filter(row[2 * x - 1], row[2 * x], row[2 * x + 1], row[2 * x + 2]);
    for (int x = inner > 1 ? inner : 1; x < half; x++) {
        int c = 2 * x + 1 < last ? 2 * x + 1 : last;
        out[x] = bloom_filter(row[2 * x - 1], row[2 * x], row[c], row[last]);
    }
}

static void kernel_bloom_mix(const float *restrict near, const float *restrict far, int count, float *restrict out)
{
    for (int i = 0; i < count; i++)
        out[i] = near[i] * 0.75f + far[i] * 0.25f;
}

static ALWAYS_INLINE void bloom_put(float value, int add, float *out) { *out = add ? *out + value : value; }

/* Inlined for each `add`, so that the compiler sees a constant. */
static ALWAYS_INLINE void bloom_widen(const float *restrict row, int width, int add, float *restrict out)
{
    int half = (width + 1) / 2, pairs = width / 2;
    bloom_put(row[0] * 0.75f + row[0] * 0.25f, add, out);
    for (int x = 0; x + 1 < half; x++) {
        bloom_put(row[x] * 0.75f + row[x + 1] * 0.25f, add, out + 2 * x + 1);
        bloom_put(row[x + 1] * 0.75f + row[x] * 0.25f, add, out + 2 * x + 2);
    }
    if (pairs == half)
        bloom_put(row[half - 1] * 0.75f + row[half - 1] * 0.25f, add, out + width - 1);
}

static void kernel_bloom_spread(const float *row, int width, int add, float *out)
{
    if (add)
        bloom_widen(row, width, 1, out);
    else
        bloom_widen(row, width, 0, out);
}

static ALWAYS_INLINE vi32 bloom_lay_vector(const vcurve *curve, const vf32 glow[3], vf32 scale, const float *decode, int srgb, vi32 rgba)
{
    vf32 one = v_setf(1.0f), color[3];
    for (int k = 0; k < 3; k++) {
        vf32 shown = v_asf(v_gatheri(decode, v_andi(v_shr(rgba, 8 * k), v_seti(255)))), g = v_mul(glow[k], scale);
        g = v_div(g, v_add(one, g));
        color[k] = v_add(shown, v_mul(v_sub(one, shown), g));
    }
    return v_ori(v_andi(encode_vector(curve, color, srgb), v_seti(0xFFFFFF)), v_andi(rgba, v_seti((int32_t)0xFF000000u)));
}

static void kernel_bloom_lay(const float *const glow[3], float scale, const float decode[256], int srgb, int count, uint32_t *rgba)
{
    const vcurve curve = encode_curve();
    for (int x = 0; x < count; x += V_LANES) {
        uint32_t pixels[V_LANES] = {0};
        int lanes = count - x < V_LANES ? count - x : V_LANES;
        const vf32 light[3] = {v_loadf(glow[0] + x), v_loadf(glow[1] + x), v_loadf(glow[2] + x)};
        vf32 most = v_max(v_max(light[0], light[1]), light[2]);
        if (!v_any(v_gt(most, v_setf(0.0f)))) /* without glow, codes would decode and encode to themselves */
            continue;
        memcpy(pixels, rgba + x, sizeof *pixels * (size_t)lanes);
        v_storei(pixels, bloom_lay_vector(&curve, light, v_setf(scale), decode, srgb, v_loadi(pixels)));
        memcpy(rgba + x, pixels, sizeof *pixels * (size_t)lanes);
    }
}
