/* What is laid over the samples of a tile: blended records, sorted by depth. */
#ifndef E3D_TILE_BLEND_H
#define E3D_TILE_BLEND_H

#include "frame/tile/job.h"

/* Lays blended records over the tile's samples, which are shaded; 0 when memory is out. */
int e3d_alpha_blend(const e3d_tile_job *job);
/* The depths of the nearest layers become those of the visible surface. */
void e3d_alpha_front(const e3d_tile_job *job);

#endif
