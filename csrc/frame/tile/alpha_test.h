/* Records with alpha in a tile: which of their samples show, and which are blended over those behind. */
#pragma once

#include "kernels/types/visible.h"
#include "frame/shade/job.h"
#include "frame/tile/job.h"
#include "frame/tile/memory.h"

void e3d_alpha_free(e3d_alpha_memory *memory);

/* These functions return 0 when memory is out. */

/* Adds what masked records show to the visible surface, in which no block is noted. */
int e3d_alpha_cut(const e3d_tile_job *job);
/* Adds the samples that faces with alpha show, hidden or not, to the overdraw counts. */
int e3d_alpha_count(const e3d_tile_job *job);

/* An action on a list that is full or complete. */
typedef int (*e3d_alpha_action)(const e3d_tile_job *job);

/* Lists the samples of a record's rows y0 .. y1. Whenever the list is full, `action` is called, and the list begins again. */
int e3d_alpha_add(const e3d_tile_job *job, const e3d_piece *piece, e3d_alpha_action action);
/* Finds a record's place in the tile; with multisampling, its box. Returns 0 if it misses the tile. */
int e3d_alpha_piece(const e3d_tile_job *job, uint32_t id, e3d_piece *piece);
/* Begins a list of samples in front of the visible surface; `all`: of all samples up to the far plane. */
int e3d_alpha_begin(const e3d_tile_job *job, int all);
/* Shades the list. `to` is where the colours of its entries go; alphas for the test have a place already. */
int e3d_alpha_shade(const e3d_tile_job *job, e3d_sink sink, e3d_shaded_list to);
