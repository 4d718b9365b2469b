/* Records with alpha in a tile: which of their samples show, and what is laid over those behind. */
#ifndef E3D_TILE_ALPHA_H
#define E3D_TILE_ALPHA_H

#include <stdint.h>

#include "core/grow.h"
#include "core/limits.h"
#include "kernels/types/alpha.h"
#include "kernels/types/shown.h"
#include "kernels/types/visible.h"
#include "pipeline/shade/shade.h"
#include "pipeline/tile/a_buffer.h"

typedef struct e3d_tile_job e3d_tile_job;

enum { E3D_ALPHA_SLICES = 512 };

/* A thread's memory, of one tile. */
typedef struct e3d_alpha_memory {
    float z[E3D_SHOWN_ROOM + 2 * E3D_PAD]; /* of each entry of the list (e3d_shade_memory.shown) */
    float alpha[E3D_SHOWN_ROOM];
    e3d_alpha_list list;
    e3d_array pieces, sorted;              /* e3d_piece of the blended records: as they are listed; by group, the farthest first */
    e3d_array ranges, groups;              /* of each piece its depths (float[2]), and its group (int32_t) */
    e3d_a_buffer fragments;
} e3d_alpha_memory;

void e3d_alpha_free(e3d_alpha_memory *memory);

/* These return 0 when memory is out. */

/* Adds what masked records show to the visible surface, whose samples are written. */
int e3d_alpha_cut(const e3d_tile_job *job);
/* Adds the samples that faces with alpha show, hidden or not, to the overdraw counts. */
int e3d_alpha_count(const e3d_tile_job *job);
/* Lays blended records over the tile's samples, which are shaded. */
int e3d_alpha_blend(const e3d_tile_job *job);
/* The depths of the nearest fragments become those of the visible surface. */
void e3d_alpha_front(const e3d_tile_job *job);

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
