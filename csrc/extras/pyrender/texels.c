/* Texels: finds a texture's colour at a point, as OpenGL on a processor does (R148).
 * In: a texture, coordinates, texels a pixel. Out: four channels.
 * Always: 8-bit arithmetic like that of Mesa's llvmpipe, which rounds after each blend. Textures of frames don't (R30), so
 * the two share no code. */
#include <math.h>
#include <string.h>

#include "extras/pyrender/picture.h"

typedef struct level_view {
    const uint8_t *texels;
    int32_t width, height, channels;
    const int32_t *wrap;
} level_view;

static level_view level_of(const e3d_pyr_texture *texture, int32_t level)
{
    int32_t width = texture->width >> level, height = texture->height >> level;
    return (level_view){.texels = texture->level[level],
                        .width = width > 1 ? width : 1,
                        .height = height > 1 ? height : 1,
                        .channels = texture->channels,
                        .wrap = texture->wrap};
}

static int32_t clamped(int64_t i, int32_t size)
{
    if (i < 0)
        return 0;
    return i < size ? (int32_t)i : size - 1;
}

/* The number of a texel along a side, wrapped from anywhere. */
static int32_t wrapped(int64_t i, int32_t size, int32_t wrap)
{
    if (wrap == E3D_PYR_CLAMP)
        return clamped(i, size);
    int64_t period = wrap == E3D_PYR_MIRROR ? 2 * (int64_t)size : size;
    int64_t rest = i % period;
    rest = rest < 0 ? rest + period : rest;
    return (int32_t)(rest < size ? rest : period - 1 - rest);
}

/* A coordinate in 1/256 texel; a number that is far out, or NaN, counts as 0. */
static int64_t scaled(float coordinate, int32_t size)
{
    float p = rintf(coordinate * (float)size * 256.0f);
    return fabsf(p) < 0x1p60f ? (int64_t)p : 0;
}

static void read_nearest(level_view level, float u, float v, float out[4])
{
    int32_t x = wrapped(scaled(u, level.width) >> 8, level.width, level.wrap[0]);
    int32_t y = wrapped(scaled(v, level.height) >> 8, level.height, level.wrap[1]);
    const uint8_t *texel = level.texels + ((size_t)y * (size_t)level.width + (size_t)x) * (size_t)level.channels;
    for (int c = 0; c < level.channels; c++)
        out[c] = texel[c];
}

/* share: 0 .. 255; its upper half counts for one more, so that 255 gives all of b. */
static int32_t between(int32_t a, int32_t b, int32_t share)
{
    return a + (((b - a) * (share + (share >> 7)) + 128) >> 8);
}

static void read_linear(level_view level, float u, float v, float out[4])
{
    int64_t sx = scaled(u, level.width) - 128, sy = scaled(v, level.height) - 128;
    int32_t fx = (int32_t)(sx & 255), fy = (int32_t)(sy & 255);
    size_t channels = (size_t)level.channels, row = (size_t)level.width * channels;
    size_t x0 = (size_t)wrapped(sx >> 8, level.width, level.wrap[0]) * channels;
    size_t x1 = (size_t)wrapped((sx >> 8) + 1, level.width, level.wrap[0]) * channels;
    const uint8_t *low = level.texels + (size_t)wrapped(sy >> 8, level.height, level.wrap[1]) * row;
    const uint8_t *high = level.texels + (size_t)wrapped((sy >> 8) + 1, level.height, level.wrap[1]) * row;
    for (size_t c = 0; c < channels; c++)
        out[c] = (float)between(between(low[x0 + c], low[x1 + c], fx), between(high[x0 + c], high[x1 + c], fx), fy);
}

/* The logarithm of a number of at least 1, to 2e-6; the mantissa's is a polynomial (that of R27). */
static float log2_of(float v)
{
    static const float TERMS[7] = {0x1.c5507p-2f, -0x1.1d270ep-2f, 0x1.99e72p-3f, -0x1.2cc076p-3f,
                                   0x1.823526p-4f, -0x1.5a65f6p-5f, 0x1.2b619ap-7f};
    int power;
    float t = frexpf(v, &power) * 2 - 1, sum = TERMS[6];
    for (int k = 5; k >= 0; k--)
        sum = sum * t + TERMS[k];
    return (float)(power - 1) + (t + (t * (1 - t)) * sum);
}

/* Finds the level, and the share of the next one in 1/256. */
static int32_t find_level(const e3d_pyr_texture *texture, float detail, int32_t *share)
{
    *share = 0;
    if (!(detail > 1))
        return 0;
    float lod = log2_of(detail < 0x1p60f ? detail : 0x1p60f);
    int32_t level = (int32_t)lod;
    if (level >= texture->levels - 1)
        return texture->levels - 1;
    *share = (int32_t)((lod - (float)level) * 256);
    return level;
}

static void read_level(const e3d_pyr_texture *texture, int32_t level, int is_linear, float u, float v, float out[4])
{
    if (is_linear)
        read_linear(level_of(texture, level), u, v, out);
    else
        read_nearest(level_of(texture, level), u, v, out);
}

void pyr_sample(const e3d_pyr_texture *texture, float u, float v, float detail, float out[4])
{
    float other[4];
    int32_t share, level = find_level(texture, detail, &share);
    int is_linear = detail > 1 ? texture->linear_far : texture->linear_near;
    out[0] = out[1] = out[2] = out[3] = 255;
    if (!texture->blends_levels && share > 128)
        level++;
    read_level(texture, level, is_linear, u, v, out);
    if (texture->blends_levels && share > 0) {
        read_level(texture, level + 1, is_linear, u, v, other);
        for (int c = 0; c < texture->channels; c++)
            out[c] = (float)between((int32_t)out[c], (int32_t)other[c], share);
    }
    for (int c = 0; c < 4; c++)
        out[c] *= 1.0f / 255;
}
