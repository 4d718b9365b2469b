/* Masked records in a tile: which of their samples show. */
#pragma once

#include "kernels/types/visible.h"
#include "frame/shade/job.h"
#include "frame/tile/job.h"
#include "frame/tile/memory.h"

/* These functions return 0 when memory is out. */

/* Adds what masked records show to the visible surface, in which no block is noted. */
int e3d_alpha_cut(const e3d_tile_job *job);
/* Adds the samples that faces with alpha show, hidden or not, to the overdraw counts. */
int e3d_alpha_count(const e3d_tile_job *job);
