/* Textures: handles that hold linear texels with their mip levels. */
#pragma once

#include <stdint.h>

#include "e3d_options.h"
#include "e3d_status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct e3d_texture e3d_texture;

#define E3D_EACH_FILTER(X) X(E3D_NEAREST, nearest) X(E3D_BILINEAR, bilinear) X(E3D_TRILINEAR, trilinear)
typedef enum e3d_filter { E3D_EACH_FILTER(E3D_ENUMERATOR) } e3d_filter;

#define E3D_EACH_WRAP(X) X(E3D_REPEAT, repeat) X(E3D_CLAMP, clamp) X(E3D_MIRROR, mirror)
typedef enum e3d_wrap { E3D_EACH_WRAP(E3D_ENUMERATOR) } e3d_wrap;

/* One mip level: linear RGBA texels, top row first. A border of one texel around it repeats the opposite side where the wrap
 * along that coordinate is E3D_REPEAT, and else the nearest texel. */
typedef struct e3d_level {
    const void *texels; /* (height + 2, width + 2, 4); int16 from 0 up with channel_bits 16; int8, c - 128, with 8 */
    int32_t width, height;
} e3d_level;

enum { E3D_MAX_LEVELS = 16,
       E3D_MAX_TEXTURE_SIZE = 16384,
       E3D_MAX_ANISOTROPY = 16,
       E3D_MAX_LOD_BIAS = 16 };

/* How a texture is read. */
typedef struct e3d_sampling {
    e3d_filter filter;
    e3d_wrap wrap[2];   /* along u and along v */
    int32_t anisotropy; /* E3D_TRILINEAR: how many places a sample may read, at most; 0 counts as 1 */
    float lod_bias;     /* E3D_TRILINEAR: added to the level; -E3D_MAX_LOD_BIAS .. E3D_MAX_LOD_BIAS */
    /* Not 0: red, green and blue are directions; with E3D_TRILINEAR the fourth channel becomes how far these spread in a texel */
    int32_t holds_normals;
} e3d_sampling;

typedef struct e3d_texture_view {
    e3d_level levels[E3D_MAX_LEVELS];
    int32_t level_count; /* 1 unless the filter is E3D_TRILINEAR */
    int32_t channel_bits;
    int32_t is_opaque;   /* every alpha is 255 */
    int32_t has_spread;  /* the fourth channel is how far normals spread in a texel (R192) */
    e3d_filter filter;
    e3d_wrap wrap[2]; /* along u and along v */
    int32_t anisotropy; /* at least 1; 1 unless the filter is E3D_TRILINEAR */
    float level_scale;  /* 2 to the power of the bias (R110) */
} e3d_texture_view;

/* pixels: (height, width, 4) uint8, top row first, copied. decode_srgb: 0 keeps the 8-bit values as linear ones. */
e3d_status e3d_texture_create(const uint8_t *pixels, int32_t width, int32_t height, int decode_srgb,
                              const e3d_sampling *sampling, e3d_texture **out);
void e3d_texture_destroy(e3d_texture *texture);
const e3d_texture_view *e3d_texture_get_view(const e3d_texture *texture);

#ifdef __cplusplus
}
#endif
