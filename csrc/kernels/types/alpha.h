/* What records with alpha cover in a tile, before anything is known of their alpha. */
#ifndef E3D_KERNELS_ALPHA_H
#define E3D_KERNELS_ALPHA_H

#include <stdint.h>

#include "core/limits.h"
#include "core/sample_patterns.h"
#include "kernels/types/shown.h"

/* The list of their samples, and beside it their depths. A sample may be in it several times. */
typedef struct e3d_alpha_list {
    const float *limit;  /* of each sample of the tile: they must be nearer, */
    const int32_t *kept; /* or as near and come before what has this ID (R16) */
    e3d_shown *shown;
    float *z; /* of each entry; E3D_PAD more are written */
    uint64_t once[E3D_TILE]; /* row by row a bit a sample: it is in the list */
    uint64_t met;            /* not 0: a sample came again */
} e3d_alpha_list;

/* The same with multisampling: an entry is a pixel (e3d_shown.pattern), and what it covers of its samples: a bit each. */
typedef struct e3d_planes_list {
    const e3d_sample_pattern *pattern;
    const float *limit[E3D_MOST_MSAA_SAMPLES]; /* as above, of each plane */
    const int32_t *kept[E3D_MOST_MSAA_SAMPLES];
    e3d_shown *shown;
    int32_t *cover; /* of each entry; E3D_PAD more are written */
} e3d_planes_list;

/* What blended records add to the samples of a tile, sample after sample: to sample s those from first[s] to first[s + 1] - 1. */
typedef struct e3d_alpha_layers {
    const uint32_t *first;
    const int32_t *depth;  /* greater is farther; E3D_PAD more are read */
    const uint32_t *which; /* the number of a colour */
    const float (*color)[4]; /* clamped, and alpha */
} e3d_alpha_layers;

#endif
