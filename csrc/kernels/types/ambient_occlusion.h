/* What the kernels of ambient occlusion work on: rows of pixels. */
#ifndef E3D_KERNELS_AMBIENT_OCCLUSION_H
#define E3D_KERNELS_AMBIENT_OCCLUSION_H

#include <stdint.h>

#include "base/limits.h"
#include "data/occlusion_pattern.h"
#include "e3d_occlusion.h"

/* Of the pixels of a row from a multiple of the cell's side on, over and over. */
typedef float e3d_occlusion_lanes[E3D_OCCLUSION_CELL + E3D_PAD];

/* The pattern of one row of a cell. */
typedef struct e3d_occlusion_pattern {
    e3d_occlusion_lanes step[2];                   /* pixels, by how far away a place is */
    e3d_occlusion_lanes side[2];                   /* the same direction in view space: of unit length */
    e3d_occlusion_lanes share[E3D_OCCLUSION_TAPS]; /* of the reach */
} e3d_occlusion_pattern;

typedef struct e3d_occlusion_plan {
    const e3d_depth_picture *picture;
    e3d_occlusion_pattern rows[E3D_OCCLUSION_CELL];
    float over_across, over_down; /* what a change of nearness from pixel to pixel is multiplied by to be a slope */
    float fall;                   /* how fast what is farther away counts less: E3D_OCCLUSION_FALL over the square of the radius */
    float reach;                  /* pixels, at a nearness of 1, or without perspective at any */
    float over_step;              /* 1 over E3D_OCCLUSION_STEP pixels, likewise */
} e3d_occlusion_plan;

/* Of nine rows, the middle one being y, nearness and the shares of light that are hidden: each has E3D_PAD zeros before its first pixel
 * and nothing but zeros of nearness after its last; rows outside of the picture are 0. */
typedef struct e3d_occlusion_rows {
    int32_t y;
    const float *depth; /* of the middle one */
    const float *nearness[E3D_OCCLUSION_SPAN];
    const float *share[E3D_OCCLUSION_SPAN];
} e3d_occlusion_rows;

#endif
