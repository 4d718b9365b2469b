/* Textures: 8-bit pixels become the texels that filters read, once, and their mip levels with them.
 *
 * Decoding before filtering is what makes averages of sRGB texels right (docs/exactness.md, R23, R28). Texels have 16 bits a
 * channel, of linear light; without sRGB and mip levels 8, and then the texel below stands beside each.
 * Each level has a border of one texel, by its wrap: the neighbours that a filter blends always stand side by side.
 */
#include <stdlib.h>
#include <string.h>

#include "core/srgb_tables.h"
#include "e3d.h"

struct e3d_texture {
    e3d_texture_view view;
    uint8_t *texels; /* of all levels */
};

enum { TEXEL = 8 }; /* bytes: four of 16 bits, or four of 8 and those below */

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
static uint8_t *row_of(const e3d_level *level, int32_t y)
{
    size_t texel = ((size_t)y + 1) * ((size_t)level->width + 2) + 1;
    return (uint8_t *)level->texels + TEXEL * texel;
}

static void decode_row(const uint8_t *pixels, int32_t width, const uint16_t table[256], uint16_t *out)
{
    for (int32_t x = 0; x < width; x++, pixels += 4, out += 4) {
        for (int k = 0; k < 3; k++)
            out[k] = table[pixels[k]];
        out[3] = (uint16_t)(pixels[3] * 257);
    }
}

/* Signed: what blends them multiplies signed bytes. */
static void shift_row(const uint8_t *pixels, int32_t width, uint8_t *out)
{
    for (int32_t x = 0; x < width; x++, pixels += 4, out += TEXEL)
        for (int k = 0; k < 4; k++)
            out[k] = pixels[k] ^ 0x80;
}

static void decode(const e3d_texture *texture, const uint8_t *pixels, int decode_srgb)
{
    const e3d_level *level = &texture->view.levels[0];
    size_t row_bytes = 4 * (size_t)level->width;
    uint16_t table[256];
    for (int c = 0; c < 256; c++)
        table[c] = decode_srgb ? SRGB_TO_LINEAR16[c] : (uint16_t)(c * 257);
    for (int32_t y = 0; y < level->height; y++, pixels += row_bytes) {
        if (texture->view.channel_bits == 8)
            shift_row(pixels, level->width, row_of(level, y));
        else
            decode_row(pixels, level->width, table, (uint16_t *)row_of(level, y));
    }
}

/* 16-bit texels only. */
static void halve(const e3d_level *fine, const e3d_level *coarse)
{
    for (int32_t y = 0; y < coarse->height; y++) {
        int32_t y1 = 2 * y + 1 < fine->height ? 2 * y + 1 : fine->height - 1;
        const uint16_t *top = (const uint16_t *)row_of(fine, 2 * y);
        const uint16_t *bottom = (const uint16_t *)row_of(fine, y1);
        uint16_t *out = (uint16_t *)row_of(coarse, y);
        for (int32_t x = 0; x < coarse->width; x++) {
            size_t x0 = 8 * (size_t)x, x1 = 2 * x + 1 < fine->width ? x0 + 4 : 4 * (size_t)fine->width - 4;
            for (int k = 0; k < 4; k++)
                *out++ = (uint16_t)((top[x0 + k] + top[x1 + k] + bottom[x0 + k] + bottom[x1 + k] + 2) >> 2);
        }
    }
}

static void fill_border(const e3d_level *level, int repeat)
{
    size_t row_bytes = TEXEL * ((size_t)level->width + 2);
    int32_t last = level->height - 1;
    for (int32_t y = 0; y <= last; y++) {
        uint8_t *first = row_of(level, y), *end = first + TEXEL * (size_t)level->width;
        memcpy(first - TEXEL, repeat ? end - TEXEL : first, TEXEL);
        memcpy(end, repeat ? first : end - TEXEL, TEXEL);
    }
    memcpy(row_of(level, -1) - TEXEL, row_of(level, repeat ? last : 0) - TEXEL, row_bytes);
    memcpy(row_of(level, last + 1) - TEXEL, row_of(level, repeat ? 0 : last) - TEXEL, row_bytes);
}

/* 8-bit texels only: to each, the one below it; to the last row's, itself. */
static void pair_rows(const e3d_level *level)
{
    size_t across = (size_t)level->width + 2, count = across * ((size_t)level->height + 2);
    uint8_t *texel = (uint8_t *)level->texels;
    for (size_t i = 0; i < count; i++, texel += TEXEL)
        memcpy(texel + 4, i + across < count ? texel + TEXEL * across : texel, 4);
}

static void build_levels(e3d_texture *texture, const uint8_t *pixels, int32_t width, int32_t height,
                         int decode_srgb)
{
    uint8_t *texels = texture->texels;
    size_t total = 4 * chain_texels(width, height, texture->view.level_count);
    for (int l = 0; l < texture->view.level_count; l++) {
        e3d_level *level = &texture->view.levels[l];
        *level = (e3d_level){texels, width, height};
        if (l)
            halve(level - 1, level);
        else
            decode(texture, pixels, decode_srgb);
        fill_border(level, texture->view.wrap == E3D_REPEAT);
        if (texture->view.channel_bits == 8)
            pair_rows(level);
        texels += TEXEL * bordered(width, height);
        width = width > 1 ? width >> 1 : 1;
        height = height > 1 ? height >> 1 : 1;
    }
    uint16_t *channels = (uint16_t *)texture->texels;
    for (size_t i = 0; i < total && texture->view.channel_bits == 16; i++)
        channels[i] ^= 0x8000; /* levels were averaged unsigned */
}

e3d_status e3d_texture_create(const uint8_t *pixels, int32_t width, int32_t height, int decode_srgb,
                              e3d_filter filter, e3d_wrap wrap, e3d_texture **out)
{
    *out = NULL;
    if (!pixels || width < 1 || height < 1 || width > E3D_MAX_TEXTURE_SIZE ||
        height > E3D_MAX_TEXTURE_SIZE || (unsigned)filter > E3D_TRILINEAR ||
        (unsigned)wrap > E3D_MIRROR)
        return E3D_INVALID_ARGUMENT;
    int levels = filter == E3D_TRILINEAR ? chain_levels(width, height) : 1;
    e3d_texture *texture = calloc(1, sizeof *texture);
    if (!texture)
        return E3D_OUT_OF_MEMORY;
    texture->view.level_count = levels;
    texture->view.channel_bits = decode_srgb || levels > 1 ? 16 : 8;
    texture->view.filter = filter;
    texture->view.wrap = wrap;
    texture->texels = malloc(TEXEL * chain_texels(width, height, levels));
    if (!texture->texels) {
        free(texture);
        return E3D_OUT_OF_MEMORY;
    }
    build_levels(texture, pixels, width, height, decode_srgb);
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
