/* Blends records, sorted by depth, over the samples of a tile. */
#pragma once

#include "frame/tile/job.h"

/* Blends records over the tile's shaded samples; 0 when memory is out. */
int e3d_alpha_blend(const e3d_tile_job *job);
/* Replaces the visible surface's depths and IDs by those of the nearest layers. */
void e3d_alpha_front(const e3d_tile_job *job);
