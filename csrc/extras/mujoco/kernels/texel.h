/* Texels, one at a time: a texture's colour at a point, with linear filters within and muj_between levels (R263).
 * In: coordinates and a level. Out: four channels, 0 .. 1.
 * Always: codes that mean what they say are blended in 8 bits, rounded after each blend, as Mesa's llvmpipe does; others, of
 * sRGB, as numbers. Textures of frames are read otherwise (R30), so the two share no code. */
#pragma once

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "e3d_mujoco.h"

#define MUJ_FAR_OUT 0x1p40f

/* A level of a texture, and the share of the next one. */
typedef struct muj_level {
    int32_t number;
    float share;
} muj_level;

typedef struct muj_level_view {
    const e3d_muj_texture *texture;
    const uint8_t *texels;          /* of the first face */
    int32_t face, width, height;
} muj_level_view;

/* Four texels around a point, and the shares of the right and the lower ones in 1/256. */
typedef struct muj_around {
    uint32_t texel[4];
    int32_t across, down;
} muj_around;

static inline int32_t muj_level_size(int32_t size, int32_t level) { return size >> level > 1 ? size >> level : 1; }

static inline muj_level_view muj_view_level(const e3d_muj_texture *texture, int32_t level, int32_t face)
{
    return (muj_level_view){texture, texture->level[level], face, muj_level_size(texture->width, level), muj_level_size(texture->height, level)};
}

static inline uint32_t muj_texel_at(const muj_level_view *level, int32_t face, int32_t x, int32_t y)
{
    uint32_t out;
    memcpy(&out, level->texels + (((size_t)face * (size_t)level->height + (size_t)y) * (size_t)level->width + (size_t)x) * 4, sizeof out);
    return out;
}

/* A place on a level, 0 .. 1, in 1/256 texel from the first one's centre. */
static inline int32_t muj_scaled(float place, int32_t size)
{
    float p = rintf(place * (float)size * 256.0f);
    return p > 0 && p < 0x1p30f ? (int32_t)p - 128 : -128;
}

static inline void muj_find_on_plane(const muj_level_view *level, const float place[2], muj_around *out)
{
    float u = place[0] - floorf(place[0]), v = place[1] - floorf(place[1]);
    int32_t sx = muj_scaled(u, level->width), sy = muj_scaled(v, level->height);
    int32_t x0 = sx >> 8, y0 = sy >> 8, x1 = x0 + 1, y1 = y0 + 1;
    x0 = x0 < 0 ? level->width - 1 : x0 >= level->width ? x0 - level->width
                                                        : x0;
    y0 = y0 < 0 ? level->height - 1 : y0 >= level->height ? y0 - level->height
                                                          : y0;
    x1 = x1 >= level->width ? 0 : x1, y1 = y1 >= level->height ? 0 : y1;
    out->across = sx & 255, out->down = sy & 255;
    out->texel[0] = muj_texel_at(level, 0, x0, y0);
    out->texel[1] = muj_texel_at(level, 0, x1, y0);
    out->texel[2] = muj_texel_at(level, 0, x0, y1);
    out->texel[3] = muj_texel_at(level, 0, x1, y1);
}

/* ---- cubes ---- */

/* Of each face: which axis it faces, and those of its columns and rows, with their signs. */
static const int8_t MUJ_AXES[6][3] = {{0, 2, 1}, {0, 2, 1}, {1, 0, 2}, {1, 0, 2}, {2, 0, 1}, {2, 0, 1}};
static const int8_t MUJ_SIGNS[6][3] = {{1, -1, -1}, {-1, 1, -1}, {1, 1, 1}, {-1, 1, -1}, {1, 1, -1}, {-1, -1, -1}};

static inline int muj_face_of(const float d[3])
{
    float x = fabsf(d[0]), y = fabsf(d[1]), z = fabsf(d[2]);
    if (z >= x && z >= y)
        return d[2] < 0 ? 5 : 4;
    if (y >= x)
        return d[1] < 0 ? 3 : 2;
    return d[0] < 0 ? 1 : 0;
}

/* The place of a direction on a face, 0 .. 1. */
static inline void muj_place_on(int face, const float d[3], float out[2])
{
    float half = 0.5f / (d[MUJ_AXES[face][0]] * MUJ_SIGNS[face][0]);
    for (int c = 0; c < 2; c++)
        out[c] = d[MUJ_AXES[face][1 + c]] * MUJ_SIGNS[face][1 + c] * half + 0.5f;
}

static inline int32_t muj_clamped(int32_t i, int32_t size) { return i < 0 ? 0 : i < size ? i
                                                                                         : size - 1; }

/* A texel of a face; one beyond its edge is that of the neighbour. */
static inline uint32_t muj_cube_texel_at(const muj_level_view *level, int32_t x, int32_t y)
{
    int32_t at[2] = {x, y};
    float d[3], place[2];
    if (x >= 0 && y >= 0 && x < level->width && y < level->height)
        return muj_texel_at(level, level->face, x, y);
    int face = level->face;
    d[MUJ_AXES[face][0]] = MUJ_SIGNS[face][0];
    for (int c = 0; c < 2; c++)
        d[MUJ_AXES[face][1 + c]] = MUJ_SIGNS[face][1 + c] * (((float)at[c] + 0.5f) / (float)(c ? level->height : level->width) * 2 - 1);
    int next = muj_face_of(d);
    muj_place_on(next, d, place);
    return muj_texel_at(level, next, muj_clamped((int32_t)floorf(place[0] * (float)level->width), level->width),
                        muj_clamped((int32_t)floorf(place[1] * (float)level->height), level->height));
}

/* sx, sy: a place on a face, in 1/256 texel from the first one's centre. */
static inline void muj_cube_around(const e3d_muj_texture *texture, int32_t number, int32_t face, int32_t sx, int32_t sy, muj_around *out)
{
    muj_level_view view = muj_view_level(texture, number, face), *level = &view;
    int32_t x = muj_clamped(sx >> 8, level->width + 1), y = muj_clamped(sy >> 8, level->height + 1);
    x = sx < 0 ? -1 : x, y = sy < 0 ? -1 : y;
    out->across = sx & 255, out->down = sy & 255;
    for (int k = 0; k < 4; k++)
        out->texel[k] = muj_cube_texel_at(level, x + (k & 1), y + (k >> 1));
}

/* ---- blends ---- */

/* Four codes in 16 bits each. */
static inline uint64_t muj_spread(uint32_t texel)
{
    uint64_t t = texel;
    return (t & 0xFF) | (t & 0xFF00) << 8 | (t & 0xFF0000) << 16 | (t & 0xFF000000) << 24;
}

/* share: 0 .. 255; its upper half counts for one more, so that 255 gives all of b. */
static inline uint64_t muj_between(uint64_t a, uint64_t b, int32_t share)
{
    uint64_t part = (uint64_t)(share + (share >> 7));
    return ((a * (256 - part) + b * part + 0x0080008000800080u) >> 8) & 0x00FF00FF00FF00FFu;
}

static inline uint64_t muj_blend_codes(const muj_around *in)
{
    uint64_t upper = muj_between(muj_spread(in->texel[0]), muj_spread(in->texel[1]), in->across);
    return muj_between(upper, muj_between(muj_spread(in->texel[2]), muj_spread(in->texel[3]), in->across), in->down);
}

static inline void muj_add_values(const e3d_muj_texture *texture, const muj_around *in, float weight, float out[4])
{
    float x = (float)in->across * (1.0f / 256), y = (float)in->down * (1.0f / 256);
    const float share[4] = {(1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y};
    for (int k = 0; k < 4; k++) {
        for (int c = 0; c < 3; c++)
            out[c] += texture->meaning[in->texel[k] >> 8 * c & 255] * (share[k] * weight);
        out[3] += (float)(in->texel[k] >> 24) * (1.0f / 255) * (share[k] * weight);
    }
}

static inline void muj_sample(const e3d_muj_texture *texture, const float at[3], muj_level level, float out[4])
{
    muj_around found[2];
    float place[2] = {at[0], at[1]};
    int32_t face = 0, share = (int32_t)(level.share * 256);
    int count = share > 0 ? 2 : 1;
    if (texture->faces == 6)
        muj_place_on(face = muj_face_of(at), at, place);
    for (int k = 0; k < count; k++) {
        muj_level_view view = muj_view_level(texture, level.number + k, face);
        if (texture->faces == 6)
            muj_cube_around(texture, level.number + k, face, muj_scaled(place[0], view.width), muj_scaled(place[1], view.height), &found[k]);
        else
            muj_find_on_plane(&view, place, &found[k]);
    }
    if (texture->meaning) {
        memset(out, 0, 4 * sizeof *out);
        for (int k = 0; k < count; k++)
            muj_add_values(texture, &found[k], k ? level.share : count == 2 ? 1 - level.share
                                                                            : 1,
                           out);
        return;
    }
    uint64_t codes = muj_blend_codes(&found[0]);
    if (count == 2)
        codes = muj_between(codes, muj_blend_codes(&found[1]), share);
    for (int c = 0; c < 4; c++)
        out[c] = (float)(codes >> 16 * c & 255) * (1.0f / 255);
}
