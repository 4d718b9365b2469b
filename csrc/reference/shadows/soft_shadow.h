/* The share of a soft light that reaches a sample. */
#pragma once

#include "e3d.h"

/* A place in a map of a soft light: column and row in texels, the depth to compare; k of R225, and rise of R229. */
typedef struct ref_soft_place {
    float x, y, depth, spread, rise;
} ref_soft_place;

/* R227-R229 */
float ref_soft_share(const e3d_light_maps *shadow, const float *map, const ref_soft_place *at);
