/* Pictures lit as PyBullet's TinyRenderer lights them (docs/exactness, section 30).
 * In: what shows at each pixel, as e3d_render wrote it; a light; for shadows, depths from the light.
 * Out: colours, depths and masks as PyBullet returns them.
 * Always: the same bytes for any number of threads, since no pixel depends on another. */
#pragma once

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A directional light. The direction is unit, and towards the light. */
typedef struct e3d_tiny_light {
    float direction[3], color[3];
    float ambient, diffuse, specular;
} e3d_tiny_light;

/* The map of shadows, from the light through the picture's own lens; without depths there are no shadows. */
typedef struct e3d_tiny_shadows {
    const float *positions; /* (height, width, 3), in the world */
    const float *depths;    /* (height, width), z / w from the light; infinite where nothing is */
    float clip[16];         /* clip_from_world of the light, row by row */
} e3d_tiny_shadows;

/* How a lens makes depths: for perspectives (w is the distance) z / w = -scale / distance - offset, of others z itself. */
typedef struct e3d_tiny_lens {
    int32_t is_parallel;
    float scale, offset;    /* projection[2][3] and projection[2][2] */
} e3d_tiny_lens;

/* Rows begin at the top. */
typedef struct e3d_tiny_picture {
    int32_t width, height;
    const uint8_t *own;     /* (height, width, 4): the surface's colour */
    const float *normals;   /* (height, width, 3), unit, in the world */
    const float *depths;    /* (height, width), z / w; infinite where nothing is */
    const int32_t *shown;   /* (height, width): a number of masks; negative where nothing is */
    const int32_t *masks;   /* (mask_count,), the last one for nothing */
    int32_t mask_count;
    e3d_tiny_light light;
    e3d_tiny_lens lens;
    e3d_tiny_shadows shadows;
    uint8_t *colors;        /* (height, width, 4) */
    float *window_depths;   /* (height, width) */
    int32_t *shown_masks;   /* (height, width) */
} e3d_tiny_picture;

/* Fills in the last three arrays. threads: 0 is e3d_thread_count(). */
void e3d_tiny_shade(const e3d_tiny_picture *picture, int32_t threads);

#ifdef __cplusplus
}
#endif
