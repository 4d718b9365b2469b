/* Textures: 8-bit pixels become the texels that filters read, once, and their mip levels with them.
 *
 * Decoding before filtering is what makes averages of sRGB texels right (docs/exactness, R23, R28). Texels are linear
 * light of 15 bits; without sRGB and mip levels they are the 8-bit c, half the memory to fetch.
 * Each level has a border of one texel, by the wrap along each coordinate: the neighbours that a filter blends always
 * stand side by side.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "data/normal_levels.h"
#include "data/srgb_tables.h"
#include "e3d.h"

struct e3d_texture {
    e3d_texture_view view;
    uint8_t *texels; /* of all levels */
};

enum { PAST = 16 }; /* so many bytes past the last texel may be read by kernels */

static size_t texel_bytes(const e3d_texture *texture) { return (size_t)texture->view.channel_bits / 2; }

static size_t bordered(int32_t width, int32_t height) { return ((size_t)width + 2) * ((size_t)height + 2); }

static size_t chain_texels(int32_t width, int32_t height, int levels)
{
    size_t total = 0;
    for (int l = 0; l < levels; l++) {
        total += bordered(width, height);
        width = width > 1 ? width >> 1 : 1;
        height = height > 1 ? height >> 1 : 1;
    }
    return total;
}

static int chain_levels(int32_t width, int32_t height)
{
    int32_t side = width > height ? width : height;
    int levels = 1;
    while (side > 1) {
        side >>= 1;
        levels++;
    }
    return levels;
}

/* The first texel of a row inside the border. */
static uint8_t *row_of(const e3d_texture *texture, const e3d_level *level, int32_t y)
{
    size_t texel = ((size_t)y + 1) * ((size_t)level->width + 2) + 1;
    return (uint8_t *)level->texels + texel * texel_bytes(texture);
}

static uint16_t to_15_bits(uint32_t c16) { return (uint16_t)((c16 * 32767 + 32767) / 65535); }

/* The texels that 8-bit colours and alphas become. */
typedef struct decoding {
    uint16_t color[256], alpha[256];
} decoding;

static decoding find_decoding(int decode_srgb, int has_spread)
{
    decoding out;
    for (uint32_t c = 0; c < 256; c++) {
        out.color[c] = to_15_bits(decode_srgb ? SRGB_TO_LINEAR16[c] : c * 257);
        out.alpha[c] = has_spread ? 0 : to_15_bits(c * 257);
    }
    return out;
}

static void decode_row(const uint8_t *pixels, int32_t width, const decoding *by, uint8_t *out)
{
    for (int32_t x = 0; x < width; x++, pixels += 4, out += 8) {
        const uint16_t texel[4] = {by->color[pixels[0]], by->color[pixels[1]], by->color[pixels[2]], by->alpha[pixels[3]]};
        memcpy(out, texel, sizeof texel);
    }
}

static int is_opaque(const uint8_t *pixels, size_t count)
{
    uint8_t all = 255;
    for (size_t i = 0; i < count; i++)
        all &= pixels[4 * i + 3];
    return all == 255;
}

static void decode(const e3d_texture *texture, const uint8_t *pixels, int decode_srgb)
{
    const e3d_level *level = &texture->view.levels[0];
    size_t row_bytes = 4 * (size_t)level->width;
    const decoding by = find_decoding(decode_srgb, texture->view.has_spread);
    for (int32_t y = 0; y < level->height; y++, pixels += row_bytes) {
        if (texture->view.channel_bits == 8)
            memcpy(row_of(texture, level, y), pixels, row_bytes);
        else
            decode_row(pixels, level->width, &by, row_of(texture, level, y));
    }
}

static uint64_t load_texel(const uint8_t *at)
{
    uint64_t texel;
    memcpy(&texel, at, sizeof texel);
    return texel;
}

/* R28: the mean of four texels; each has 8 bytes, and two of a row are neighbours. Every other channel gets 32 bits to be
 * summed in. */
static uint64_t mean_of_four(const uint8_t *top, const uint8_t *bottom, size_t next)
{
    const uint64_t some = UINT64_C(0x0000FFFF0000FFFF), half = UINT64_C(0x0000000200000002);
    uint64_t a = load_texel(top), b = load_texel(top + next), c = load_texel(bottom), d = load_texel(bottom + next);
    uint64_t low = (a & some) + (b & some) + (c & some) + (d & some) + half;
    uint64_t high = (a >> 16 & some) + (b >> 16 & some) + (c >> 16 & some) + (d >> 16 & some) + half;
    return (low >> 2 & some) | (high >> 2 & some) << 16;
}

static void average_row(const uint8_t *top, const uint8_t *bottom, int32_t width, size_t next, uint8_t *out)
{
    for (int32_t x = 0; x < width; x++, top += 16, bottom += 16, out += 8) {
        uint64_t texel = mean_of_four(top, bottom, next);
        memcpy(out, &texel, sizeof texel);
    }
}

/* Averages a level of 15-bit texels to the next coarser one (R28). A level of one column or row counts that twice. */
static void halve(const e3d_texture *texture, const e3d_level *fine, const e3d_level *coarse)
{
    for (int32_t y = 0; y < coarse->height; y++) {
        int32_t y1 = 2 * y + 1 < fine->height ? 2 * y + 1 : fine->height - 1;
        const uint8_t *top = row_of(texture, fine, 2 * y), *bottom = row_of(texture, fine, y1);
        size_t next = fine->width > 1 ? 8 : 0;
        average_row(top, bottom, coarse->width, next, row_of(texture, coarse, y));
        if (texture->view.has_spread)
            e3d_spread_row(top, bottom, coarse->width, next, row_of(texture, coarse, y));
    }
}

static void fill_border(const e3d_texture *texture, const e3d_level *level)
{
    size_t texel = texel_bytes(texture), row_bytes = ((size_t)level->width + 2) * texel;
    int32_t last = level->height - 1;
    int across = texture->view.wrap[0] == E3D_REPEAT, down = texture->view.wrap[1] == E3D_REPEAT;
    for (int32_t y = 0; y <= last; y++) {
        uint8_t *first = row_of(texture, level, y), *end = first + (size_t)level->width * texel;
        memcpy(first - texel, across ? end - texel : first, texel);
        memcpy(end, across ? first : end - texel, texel);
    }
    memcpy(row_of(texture, level, -1) - texel, row_of(texture, level, down ? last : 0) - texel, row_bytes);
    memcpy(row_of(texture, level, last + 1) - texel, row_of(texture, level, down ? 0 : last) - texel,
           row_bytes);
}

static void build_levels(e3d_texture *texture, const uint8_t *pixels, int32_t width, int32_t height,
                         int decode_srgb)
{
    uint8_t *texels = texture->texels;
    for (int l = 0; l < texture->view.level_count; l++) {
        e3d_level *level = &texture->view.levels[l];
        *level = (e3d_level){texels, width, height};
        if (l)
            halve(texture, level - 1, level);
        else
            decode(texture, pixels, decode_srgb);
        fill_border(texture, level);
        texels += bordered(width, height) * texel_bytes(texture);
        width = width > 1 ? width >> 1 : 1;
        height = height > 1 ? height >> 1 : 1;
    }
}

/* Makes 8-bit texels signed, since the kernels multiply them so. */
static void make_signed(e3d_texture *texture, size_t bytes)
{
    for (size_t i = 0; i < bytes; i++)
        texture->texels[i] ^= 0x80;
}

static int is_valid(const e3d_sampling *sampling)
{
    float bias = sampling->lod_bias;
    return (unsigned)sampling->filter <= E3D_TRILINEAR && (unsigned)sampling->wrap[0] <= E3D_MIRROR &&
           (unsigned)sampling->wrap[1] <= E3D_MIRROR && (unsigned)sampling->anisotropy <= E3D_MAX_ANISOTROPY &&
           bias >= -E3D_MAX_LOD_BIAS && bias <= E3D_MAX_LOD_BIAS;
}

/* 2 to the power of y, by R27. */
static float power_of_two(float y)
{
    static const float c[5] = {0x1.3a37acp-2f, 0x1.10e326p-4f, 0x1.6d1682p-7f, 0x1.7e244cp-10f, 0x1.cb1d4cp-13f};
    float whole = floorf(y), f = y - whole, sum = c[4];
    for (int k = 3; k >= 0; k--)
        sum = sum * f + c[k];
    return ldexpf((1.0f + f) + (f * (f - 1.0f)) * sum, (int)whole);
}

/* Only a chain of levels uses anisotropy, bias and the spread of normals. */
static void keep_sampling(const e3d_sampling *sampling, e3d_texture_view *view)
{
    int has_levels = sampling->filter == E3D_TRILINEAR;
    view->filter = sampling->filter;
    memcpy(view->wrap, sampling->wrap, sizeof view->wrap);
    view->anisotropy = has_levels && sampling->anisotropy > 1 ? sampling->anisotropy : 1;
    view->has_spread = has_levels && sampling->holds_normals;
    view->level_scale = has_levels ? power_of_two(sampling->lod_bias) : 1.0f;
}

e3d_status e3d_texture_create(const uint8_t *pixels, int32_t width, int32_t height, int decode_srgb,
                              const e3d_sampling *sampling, e3d_texture **out)
{
    *out = NULL;
    if (!pixels || width < 1 || height < 1 || width > E3D_MAX_TEXTURE_SIZE ||
        height > E3D_MAX_TEXTURE_SIZE || !is_valid(sampling))
        return E3D_INVALID_ARGUMENT;
    int levels = sampling->filter == E3D_TRILINEAR ? chain_levels(width, height) : 1;
    e3d_texture *texture = calloc(1, sizeof *texture);
    if (!texture)
        return E3D_OUT_OF_MEMORY;
    texture->view.level_count = levels;
    texture->view.channel_bits = decode_srgb || sampling->filter == E3D_TRILINEAR ? 16 : 8;
    keep_sampling(sampling, &texture->view);
    texture->view.is_opaque = is_opaque(pixels, (size_t)width * (size_t)height);
    size_t bytes = chain_texels(width, height, levels) * texel_bytes(texture);
    texture->texels = malloc(bytes + PAST);
    if (!texture->texels) {
        free(texture);
        return E3D_OUT_OF_MEMORY;
    }
    build_levels(texture, pixels, width, height, decode_srgb);
    if (texture->view.channel_bits == 8)
        make_signed(texture, bytes);
    *out = texture;
    return E3D_OK;
}

void e3d_texture_destroy(e3d_texture *texture)
{
    if (!texture)
        return;
    free(texture->texels);
    free(texture);
}

const e3d_texture_view *e3d_texture_get_view(const e3d_texture *texture) { return &texture->view; }
