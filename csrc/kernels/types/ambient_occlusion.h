/* The rows of pixels on which the kernels of ambient occlusion work. */
#pragma once

#include <stdint.h>

#include "base/limits.h"
#include "data/occlusion_pattern.h"
#include "e3d_occlusion.h"

/* Numbers for the pixels of a row, repeated from a multiple of the cell's side on. */
typedef float e3d_occlusion_lanes[E3D_OCCLUSION_CELL + E3D_PAD];

/* The pattern of one row of a cell. */
typedef struct e3d_occlusion_pattern {
    e3d_occlusion_lanes step[2];                   /* in pixels, times the distance of a place */
    e3d_occlusion_lanes side[2];                   /* the same direction in view space, of unit length */
    e3d_occlusion_lanes share[E3D_OCCLUSION_TAPS]; /* of the reach */
} e3d_occlusion_pattern;

typedef struct e3d_occlusion_plan {
    const e3d_depth_picture *picture;
    e3d_occlusion_pattern rows[E3D_OCCLUSION_CELL];
    float over_across, over_down; /* factors that turn a change of nearness from pixel to pixel into a slope */
    float fall;                   /* how fast farther places lose weight: E3D_OCCLUSION_FALL over the square of the radius */
    float reach;                  /* pixels at a nearness of 1; without perspective, at any nearness */
    float over_step;              /* 1 over E3D_OCCLUSION_STEP pixels, likewise */
} e3d_occlusion_plan;

/* Nine rows, with y in the middle: nearness, and the shares of light that are hidden. A row has E3D_PAD zeros before its
 * first pixel, and nearness only zeros after its last; rows outside the picture are 0. */
typedef struct e3d_occlusion_rows {
    int32_t y;
    const float *depth; /* of the middle one */
    const float *nearness[E3D_OCCLUSION_SPAN];
    const float *share[E3D_OCCLUSION_SPAN];
} e3d_occlusion_rows;
