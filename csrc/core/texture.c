/* Textures: 8-bit pixels become 16-bit linear texels once, and their mip levels with them.
 *
 * Decoding before filtering is what makes averages of sRGB texels right (docs/exactness.md, R23, R28).
 */
#include <stdlib.h>

#include "core/srgb_tables.h"
#include "e3d.h"

struct e3d_texture {
    e3d_texture_view view;
    uint16_t *texels; /* of all levels */
};

static size_t chain_texels(int32_t width, int32_t height, int levels)
{
    size_t total = 0;
    for (int l = 0; l < levels; l++) {
        total += (size_t)width * height;
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

static void decode(const uint8_t *pixels, size_t count, int decode_srgb, uint16_t *out)
{
    uint16_t table[256];
    for (int c = 0; c < 256; c++)
        table[c] = decode_srgb ? SRGB_TO_LINEAR16[c] : (uint16_t)(c * 257);
    for (size_t i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++)
            out[4 * i + k] = table[pixels[4 * i + k]];
        out[4 * i + 3] = (uint16_t)(pixels[4 * i + 3] * 257);
    }
}

static void halve(const e3d_level *fine, uint16_t *out, int32_t width, int32_t height)
{
    for (int32_t y = 0; y < height; y++) {
        int32_t y0 = 2 * y, y1 = 2 * y + 1 < fine->height ? 2 * y + 1 : fine->height - 1;
        const uint16_t *top = fine->texels + (size_t)y0 * fine->width * 4;
        const uint16_t *bottom = fine->texels + (size_t)y1 * fine->width * 4;
        for (int32_t x = 0; x < width; x++) {
            int32_t x0 = 2 * x, x1 = 2 * x + 1 < fine->width ? 2 * x + 1 : fine->width - 1;
            for (int k = 0; k < 4; k++)
                *out++ = (uint16_t)((top[4 * (size_t)x0 + k] + top[4 * (size_t)x1 + k] +
                                     bottom[4 * (size_t)x0 + k] + bottom[4 * (size_t)x1 + k] + 2) >>
                                    2);
        }
    }
}

static void build_levels(e3d_texture *texture, int32_t width, int32_t height)
{
    uint16_t *texels = texture->texels;
    for (int l = 0; l < texture->view.level_count; l++) {
        texture->view.levels[l] = (e3d_level){texels, width, height};
        if (l)
            halve(&texture->view.levels[l - 1], texels, width, height);
        texels += (size_t)width * height * 4;
        width = width > 1 ? width >> 1 : 1;
        height = height > 1 ? height >> 1 : 1;
    }
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
    texture->view.filter = filter;
    texture->view.wrap = wrap;
    texture->texels = malloc(chain_texels(width, height, levels) * 4 * sizeof(uint16_t));
    if (!texture->texels) {
        free(texture);
        return E3D_OUT_OF_MEMORY;
    }
    decode(pixels, (size_t)width * height, decode_srgb, texture->texels);
    build_levels(texture, width, height);
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
