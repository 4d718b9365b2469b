/* The data of refraction: what a fragment shifts and blurs, and the picture behind it. */
#pragma once

#include <stdint.h>

#include "base/limits.h"
#include "data/behind_levels.h"

/* How far a fragment shifts what is behind it, in 1/256 pixel: [channel], across and down; and how much it blurs it (R164, R165). */
typedef struct e3d_bend {
    int32_t shift[3][2], blur;
    float depth; /* the fragment's metric depth */
} e3d_bend;

/* The picture behind, level by level. */
typedef struct e3d_behind_view {
    const float *texels, *depth;
    e3d_behind_level level[E3D_BEHIND_LEVELS];
    int count;
    int whole_count;   /* levels that the whole picture would have (R273), */
    float whole_share; /* and how many of its pixels lie on one of the frame's */
} e3d_behind_view;

/* What a pixel began with in an earlier plane: the sum of its bends, its colour and alpha. Without a sum it began with nothing. */
typedef struct e3d_begun {
    e3d_bend sum;
    float color[4];
} e3d_begun;

enum { E3D_BEHIND_BATCH = 256 };
typedef float e3d_behind_lanes[E3D_BEHIND_BATCH + E3D_PAD];

/* Samples that show it, and where. */
typedef struct e3d_behind_batch {
    int32_t sample[E3D_BEHIND_BATCH + E3D_PAD], blur[E3D_BEHIND_BATCH + E3D_PAD];
    e3d_behind_lanes x[3], y[3]; /* by channel, in pixels: the middle of the first one is 0 */
    e3d_behind_lanes level, whole_level; /* by the levels of the frame, and of the whole picture */
    e3d_behind_lanes light[4];   /* red, green, blue, and the share */
    int count, is_dispersive;
} e3d_behind_batch;
