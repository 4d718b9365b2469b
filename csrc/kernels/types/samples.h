/* Samples that become pixels, and pixels that go to pictures. */
#pragma once

#include <stddef.h>

#include "base/limits.h"

/* A tile's samples, if there are several a pixel, or if something is blended over them. */
typedef struct e3d_samples {
    float color[3][E3D_TILE_SAMPLES + E3D_PAD]; /* clamped, and multiplied by its alpha */
    float counts[E3D_TILE_SAMPLES + E3D_PAD];   /* alpha: 1; 0 if a transparent background shows; or between */
} e3d_samples;

/* Rows of pixels to copy: `count` rows of `bytes`. From one row to the next, `to` moves by `pitch` and `from` by `step`. */
typedef struct e3d_pixel_rows {
    char *to;
    const char *from;
    size_t bytes, pitch, step;
    int count;
} e3d_pixel_rows;
