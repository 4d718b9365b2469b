/* Lists of the samples that records with alpha cover in a tile, to be tested or blended. */
#pragma once

#include <stdint.h>

#include "base/limits.h"
#include "data/sample_patterns.h"
#include "kernels/types/visible.h"
#include "frame/shade/job.h"
#include "frame/tile/job.h"
#include "frame/tile/memory.h"

void e3d_alpha_free(e3d_alpha_memory *memory);

/* A record in the planes of a tile, with multisampling. */
typedef struct e3d_plane_pieces {
    e3d_piece of[E3D_MOST_MSAA_SAMPLES];
    uint32_t live; /* the planes in which it may show: a bit each */
} e3d_plane_pieces;

void e3d_alpha_planes(const e3d_tile_job *job, uint32_t id, e3d_plane_pieces *out);

/* These functions return 0 when memory is out. */

/* An action on a list that is full or complete. */
typedef int (*e3d_alpha_action)(const e3d_tile_job *job);

/* Lists the samples of a record's rows y0 .. y1. Whenever the list is full, `action` is called, and the list begins again. */
int e3d_alpha_add(const e3d_tile_job *job, const e3d_piece *piece, e3d_alpha_action action);
/* Finds a record's place in the tile; with multisampling, its box. Returns 0 if it misses the tile. */
int e3d_alpha_piece(const e3d_tile_job *job, uint32_t id, e3d_piece *piece);
/* Begins a list of samples in front of the visible surface; `all`: of all samples up to the far plane. */
int e3d_alpha_begin(const e3d_tile_job *job, int all);
/* Shades the list. `to` is where the colours of its entries go; alphas for the test have a place, if `to` names none. */
int e3d_alpha_shade(const e3d_tile_job *job, e3d_sink sink, e3d_shaded_list to);
