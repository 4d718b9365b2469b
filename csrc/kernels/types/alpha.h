/* What records with alpha cover in a tile, before anything is known of their alpha. */
#ifndef E3D_KERNELS_ALPHA_H
#define E3D_KERNELS_ALPHA_H

#include <stdint.h>

#include "core/limits.h"
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

/* What blended records add to the samples of a tile, sample after sample: to sample s those from first[s] to first[s + 1] - 1. */
typedef struct e3d_alpha_layers {
    const uint32_t *first;
    const int32_t *depth;  /* greater is farther; E3D_PAD more are read */
    const uint32_t *which; /* the number of a colour */
    const float (*color)[4]; /* clamped, and alpha */
} e3d_alpha_layers;

#endif
