/* The samples of a batch in mirrors. */
#pragma once

#include "kernels/types/shading.h"

typedef struct e3d_mirror_batch {
    e3d_lane_array share;     /* of a perfect mirror: m of R210 */
    e3d_lane_array rest;      /* 1 - share */
    e3d_lane_array light[3];  /* what the pictures show */
    e3d_lane_array reflected[3]; /* of physically based materials: the share of that, by channel (R211) */
    e3d_lane_array haze[3];   /* of these: what fog makes of black */
} e3d_mirror_batch;
