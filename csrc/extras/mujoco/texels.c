/* Texels: a texture's colour at a point, with linear filters within and between levels (R263).
 * In: coordinates, and those of a block of pixels. Out: four channels, 0 .. 1.
 * Always: codes that mean what they say are blended in 8 bits, rounded after each blend, as Mesa's llvmpipe does; others, of
 * sRGB, as numbers. Textures of frames are read otherwise (R30), so the two share no code. */
#include <math.h>

#include "extras/mujoco/shading.h"
#include "extras/mujoco/power.h"

#define FAR_OUT 0x1p40f

typedef struct level_view {
    const e3d_muj_texture *texture;
    const uint8_t *texels;         /* of the first face */
    int32_t number, face, width, height;
} level_view;

static level_view view_level(const e3d_muj_texture *texture, int32_t level, int32_t face)
{
    level_view out = {texture, texture->level[level], level, face, texture->width >> level, texture->height >> level};
    out.width = out.width > 1 ? out.width : 1, out.height = out.height > 1 ? out.height : 1;
    return out;
}

static uint32_t texel_at(const level_view *level, int32_t face, int32_t x, int32_t y)
{
    uint32_t out;
    memcpy(&out, level->texels + (((size_t)face * (size_t)level->height + (size_t)y) * (size_t)level->width + (size_t)x) * 4, sizeof out);
    return out;
}

/* Four texels around a point, and the shares of the right and the lower ones in 1/256. */
typedef struct around {
    uint32_t texel[4];
    int32_t across, down;
} around;

/* A place on a level, 0 .. 1, in 1/256 texel from the first one's centre. */
static int32_t scaled(float place, int32_t size)
{
    float p = rintf(place * (float)size * 256.0f);
    return p > 0 && p < 0x1p30f ? (int32_t)p - 128 : -128;
}

static void find_around(const level_view *level, const float place[2], around *out)
{
    float u = place[0] - floorf(place[0]), v = place[1] - floorf(place[1]);
    int32_t sx = scaled(u, level->width), sy = scaled(v, level->height);
    int32_t x0 = sx >> 8, y0 = sy >> 8, x1 = x0 + 1, y1 = y0 + 1;
    x0 = x0 < 0 ? level->width - 1 : x0 >= level->width ? x0 - level->width
                                                        : x0;
    y0 = y0 < 0 ? level->height - 1 : y0 >= level->height ? y0 - level->height
                                                          : y0;
    x1 = x1 >= level->width ? 0 : x1, y1 = y1 >= level->height ? 0 : y1;
    out->across = sx & 255, out->down = sy & 255;
    out->texel[0] = texel_at(level, 0, x0, y0);
    out->texel[1] = texel_at(level, 0, x1, y0);
    out->texel[2] = texel_at(level, 0, x0, y1);
    out->texel[3] = texel_at(level, 0, x1, y1);
}

/* ---- cubes ---- */

/* Of each face: which axis it faces, and those of its columns and rows, with their signs. */
static const int8_t AXES[6][3] = {{0, 2, 1}, {0, 2, 1}, {1, 0, 2}, {1, 0, 2}, {2, 0, 1}, {2, 0, 1}};
static const int8_t SIGNS[6][3] = {{1, -1, -1}, {-1, 1, -1}, {1, 1, 1}, {-1, 1, -1}, {1, 1, -1}, {-1, -1, -1}};

static int face_of(const float d[3])
{
    float x = fabsf(d[0]), y = fabsf(d[1]), z = fabsf(d[2]);
    if (z >= x && z >= y)
        return d[2] < 0 ? 5 : 4;
    if (y >= x)
        return d[1] < 0 ? 3 : 2;
    return d[0] < 0 ? 1 : 0;
}

/* The place of a direction on a face, 0 .. 1. */
static void place_on(int face, const float d[3], float out[2])
{
    float half = 0.5f / (d[AXES[face][0]] * SIGNS[face][0]);
    for (int c = 0; c < 2; c++)
        out[c] = d[AXES[face][1 + c]] * SIGNS[face][1 + c] * half + 0.5f;
}

static int32_t clamped(int32_t i, int32_t size) { return i < 0 ? 0 : i < size ? i
                                                                              : size - 1; }

/* A texel of a face; one beyond its edge is that of the neighbour. */
static uint32_t cube_texel_at(const level_view *level, int32_t x, int32_t y)
{
    int32_t at[2] = {x, y};
    float d[3], place[2];
    if (x >= 0 && y >= 0 && x < level->width && y < level->height)
        return texel_at(level, level->face, x, y);
    int face = level->face;
    d[AXES[face][0]] = SIGNS[face][0];
    for (int c = 0; c < 2; c++)
        d[AXES[face][1 + c]] = SIGNS[face][1 + c] * (((float)at[c] + 0.5f) / (float)(c ? level->height : level->width) * 2 - 1);
    int next = face_of(d);
    place_on(next, d, place);
    return texel_at(level, next, clamped((int32_t)floorf(place[0] * (float)level->width), level->width),
                    clamped((int32_t)floorf(place[1] * (float)level->height), level->height));
}

static void find_around_on_cube(const level_view *level, const float place[2], around *out)
{
    int32_t sx = scaled(place[0], level->width), sy = scaled(place[1], level->height);
    int32_t x = clamped(sx >> 8, level->width + 1), y = clamped(sy >> 8, level->height + 1);
    x = sx < 0 ? -1 : x, y = sy < 0 ? -1 : y;
    out->across = sx & 255, out->down = sy & 255;
    for (int k = 0; k < 4; k++)
        out->texel[k] = cube_texel_at(level, x + (k & 1), y + (k >> 1));
}

/* ---- blends ---- */

/* Four codes in 16 bits each. */
static uint64_t spread(uint32_t texel)
{
    uint64_t t = texel;
    return (t & 0xFF) | (t & 0xFF00) << 8 | (t & 0xFF0000) << 16 | (t & 0xFF000000) << 24;
}

/* share: 0 .. 255; its upper half counts for one more, so that 255 gives all of b. */
static uint64_t between(uint64_t a, uint64_t b, int32_t share)
{
    uint64_t part = (uint64_t)(share + (share >> 7));
    return ((a * (256 - part) + b * part + 0x0080008000800080u) >> 8) & 0x00FF00FF00FF00FFu;
}

static uint64_t blend_codes(const around *in)
{
    uint64_t upper = between(spread(in->texel[0]), spread(in->texel[1]), in->across);
    return between(upper, between(spread(in->texel[2]), spread(in->texel[3]), in->across), in->down);
}

static void add_values(const e3d_muj_texture *texture, const around *in, float weight, float out[4])
{
    float x = (float)in->across * (1.0f / 256), y = (float)in->down * (1.0f / 256);
    const float share[4] = {(1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y};
    for (int k = 0; k < 4; k++) {
        for (int c = 0; c < 3; c++)
            out[c] += texture->meaning[in->texel[k] >> 8 * c & 255] * (share[k] * weight);
        out[3] += (float)(in->texel[k] >> 24) * (1.0f / 255) * (share[k] * weight);
    }
}

/* ---- levels ---- */

static float4 find_details(const float4 lower, const float4 upper, int32_t size)
{
    float4 even = LANES(lower, lower, 0, 0, 2, 2), across = size_of(LANES(lower, lower, 1, 1, 3, 3) - even);
    return more_of(across, size_of(LANES(upper, upper, 0, 0, 2, 2) - even)) * splat((float)size);
}

/* Where four directions are on the face of one of them. */
static void place_four(int face, const float4 d[3], float4 out[2])
{
    float4 half = splat(0.5f) / (d[AXES[face][0]] * splat(SIGNS[face][0]));
    for (int c = 0; c < 2; c++)
        out[c] = d[AXES[face][1 + c]] * splat(SIGNS[face][1 + c]) * half + splat(0.5f);
}

static muj_level level_of(const e3d_muj_texture *texture, float detail)
{
    if (!(detail > 1))
        return (muj_level){0, 0};
    float lod = muj_log2(detail < FAR_OUT ? detail : FAR_OUT);
    int32_t number = (int32_t)lod;
    if (number >= texture->levels - 1)
        return (muj_level){texture->levels - 1, 0};
    return (muj_level){number, lod - (float)number};
}

void muj_find_levels(const e3d_muj_texture *texture, const float4 lower[3], const float4 upper[3], muj_level out[2])
{
    if (texture->faces == 1) {
        float4 detail = more_of(find_details(lower[0], upper[0], texture->width), find_details(lower[1], upper[1], texture->height));
        out[0] = level_of(texture, detail[0]);
        out[1] = level_of(texture, detail[2]);
        return;
    }
    for (int b = 0; b < 2; b++) {
        int face = face_of((float[3]){lower[0][2 * b], lower[1][2 * b], lower[2][2 * b]});
        float4 low[2], high[2];
        place_four(face, lower, low);
        place_four(face, upper, high);
        float4 detail = more_of(find_details(low[0], high[0], texture->width), find_details(low[1], high[1], texture->height));
        out[b] = level_of(texture, detail[2 * b]);
        if (b == 0 && face == face_of((float[3]){lower[0][2], lower[1][2], lower[2][2]})) {
            out[1] = level_of(texture, detail[2]);
            return;
        }
    }
}

void muj_sample(const e3d_muj_texture *texture, const float at[3], muj_level level, float out[4])
{
    around found[2];
    float place[2] = {at[0], at[1]};
    int32_t face = 0, share = (int32_t)(level.share * 256);
    int count = share > 0 ? 2 : 1;
    if (texture->faces == 6)
        place_on(face = face_of(at), at, place);
    for (int k = 0; k < count; k++) {
        level_view view = view_level(texture, level.number + k, face);
        (texture->faces == 6 ? find_around_on_cube : find_around)(&view, place, &found[k]);
    }
    if (texture->meaning) {
        memset(out, 0, 4 * sizeof *out);
        for (int k = 0; k < count; k++)
            add_values(texture, &found[k], k ? level.share : count == 2 ? 1 - level.share
                                                                        : 1,
                       out);
        return;
    }
    uint64_t codes = blend_codes(&found[0]);
    if (count == 2)
        codes = between(codes, blend_codes(&found[1]), share);
    for (int c = 0; c < 4; c++)
        out[c] = (float)(codes >> 16 * c & 255) * (1.0f / 255);
}
