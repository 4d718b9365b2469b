/* Mixed pixels: with multisampling, those whose samples don't all show the same. */
#pragma once

#include <stdint.h>

#include "base/limits.h"
#include "data/sample_patterns.h"

/* The numbers of colours of a list of pixels: those that are shaded, the background's, and a backdrop's, one for each pixel. */
enum { E3D_MIXED_BACKGROUND = E3D_TILE_SAMPLES,
       E3D_MIXED_BACKDROP,
       E3D_MIXED_COLORS = E3D_MIXED_BACKDROP + E3D_TILE_SAMPLES };

typedef struct e3d_mixed_list {
    int32_t pixels, colors;                      /* pixels: how many; colors: how many are shaded for all of them */
    int32_t pixel[E3D_TILE_SAMPLES + E3D_PAD];   /* E3D_PAD more are read, but never used */
    uint16_t of[E3D_MOST_MSAA_SAMPLES][E3D_TILE_SAMPLES + E3D_PAD]; /* the number of the colour of each sample of each pixel, */
    uint16_t place[E3D_MIXED_COLORS];            /* and for each number its place in `color` */
    float color[E3D_MIXED_COLORS][4];            /* clamped, and multiplied by its alpha */
} e3d_mixed_list;
