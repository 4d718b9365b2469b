/* Samples on their way to pixels, and pixels on their way to pictures. */
#ifndef E3D_KERNELS_SAMPLES_H
#define E3D_KERNELS_SAMPLES_H

#include <stddef.h>

#include "base/limits.h"

/* A tile's samples, where there are several a pixel, or where blended ones are laid over them. */
typedef struct e3d_samples {
    float color[3][E3D_TILE_SAMPLES + E3D_PAD]; /* clamped, and multiplied by its alpha */
    float counts[E3D_TILE_SAMPLES + E3D_PAD];   /* alpha: 1, or 0 where a transparent background shows, or between */
} e3d_samples;

/* Rows of pixels to copy: `count` rows of `bytes`. `to` moves by `pitch` from one row to the next, `from` by `step`. */
typedef struct e3d_pixel_rows {
    char *to;
    const char *from;
    size_t bytes, pitch, step;
    int count;
} e3d_pixel_rows;

#endif
