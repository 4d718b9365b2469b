/* The data of lenses: pixels that look into pinhole pictures, and the light that they get there. */
#pragma once

#include <stdint.h>

#include "base/limits.h"

enum { E3D_LENS_BATCH = 64 };

typedef int32_t e3d_lens_lanes[E3D_LENS_BATCH + E3D_PAD];

/* Pixels; those beyond `count`, up to a vector, are like others. */
typedef struct e3d_lens_batch {
    e3d_lens_lanes x, y, across, down;    /* as in e3d_lens_pixel */
    e3d_lens_lanes start, width, height;  /* of their face */
    float light[4][E3D_LENS_BATCH + E3D_PAD]; /* out: red, green, blue times alpha, and alpha */
    int count;
} e3d_lens_batch;
