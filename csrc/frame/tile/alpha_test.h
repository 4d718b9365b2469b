/* Records with alpha in a tile: which of their samples show, and what is laid over those behind. */
#ifndef E3D_ALPHA_TEST_H
#define E3D_ALPHA_TEST_H

#include "kernels/types/visible.h"
#include "frame/shade/job.h"
#include "frame/tile/job.h"
#include "frame/tile/memory.h"

void e3d_alpha_free(e3d_alpha_memory *memory);

/* These return 0 when memory is out. */

/* Adds what masked records show to the visible surface, whose samples are written. */
int e3d_alpha_cut(const e3d_tile_job *job);
/* Adds the samples that faces with alpha show, hidden or not, to the overdraw counts. */
int e3d_alpha_count(const e3d_tile_job *job);

/* What is done with a list when it is full, or done. */
typedef int (*e3d_alpha_action)(const e3d_tile_job *job);

/* Lists the samples of a record's rows y0 .. y1; whenever the list is full, it is acted on, and begun again. */
int e3d_alpha_add(const e3d_tile_job *job, const e3d_piece *piece, e3d_alpha_action action);
/* A record as it lies in the tile, or 0 where it doesn't. With multisampling, its box. */
int e3d_alpha_piece(const e3d_tile_job *job, uint32_t id, e3d_piece *piece);
/* Begins a list of what is in front of the visible surface; `all`: of everything that is no farther than the far plane. */
int e3d_alpha_begin(const e3d_tile_job *job, int all);
/* Shades the list; `to`: where what is kept of each entry goes, but for alphas that are tested. */
int e3d_alpha_shade(const e3d_tile_job *job, e3d_sink sink, e3d_shaded_list to);

#endif
