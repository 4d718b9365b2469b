/* What blending begins with behind glass that bends. */
#pragma once

#include "kernels/types/bending.h"
#include "kernels/types/samples.h"
#include "frame/tile/job.h"

/* The layers of a tile's samples: which ones each sample has, their bends, and their colours with alpha. */
typedef struct e3d_bent_layers {
    const uint32_t *first, *which; /* as in e3d_alpha_layers */
    const float (*color)[4];
    const e3d_bend *bend;
} e3d_bent_layers;

/* Where layers bend, replaces the samples' colours by those of the picture behind. `lit`: the radiance of the tile's pixels, or NULL.
 * Planes of a tile come in order, the first one being 0. Returns 0 when memory is out. */
int e3d_begin_behind(const e3d_tile_job *job, const e3d_bent_layers *layers, int plane, float (*lit)[3], e3d_samples *samples);
