/* What is laid over the samples of a tile: blended records, sorted by depth. */
#ifndef E3D_TILE_BLEND_H
#define E3D_TILE_BLEND_H

#include "kernels/types/samples.h"
#include "pipeline/tile/job.h"
#include "pipeline/tile/memory.h"

/* Room for so many fragments of so many IDs, some of which light may pass through; 0 when memory is out. */
int e3d_alpha_reserve_fragments(e3d_alpha_fragments *f, size_t count, size_t ids, int transmits);
void e3d_alpha_clear_fragments(e3d_alpha_fragments *f);
/* Sorts the fragments of the memory, and lays them over samples; 0 when memory is out. */
int e3d_alpha_blend_fragments(const e3d_tile_job *job, e3d_samples *samples);
/* Lays blended records over the tile's samples, which are shaded. */
int e3d_alpha_blend(const e3d_tile_job *job);
/* The depths of the nearest fragments become those of the visible surface. */
void e3d_alpha_front(const e3d_tile_job *job);

#endif
