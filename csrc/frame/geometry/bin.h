/* Records to the tiles that they may cover. */
#pragma once

#include "base/limits.h"
#include "kernels/coverage.h"
#include "kernels/types/records.h"
#include "kernels/types/visible.h"
#include "frame/geometry/records.h"
#include "frame/pass/view.h"

/* The output of geometry, for the tiles: each thread's records and fragments, listed by tile, and the tables that find them by
 * ID. */
typedef struct e3d_bins {
    int32_t threads, tiles;
    int alpha; /* whether records may have alpha */
    e3d_geometry_memory *of[E3D_MAX_THREADS];
    const e3d_record *records[E3D_SETS][E3D_MAX_THREADS];
    const e3d_drawn_cluster *drawn[E3D_MAX_THREADS];
    const float *corners[E3D_MAX_THREADS]; /* c[k][j] of the scene's clipped records */
    e3d_record_table tables[E3D_SETS];
} e3d_bins;

/* Sets up the bins of so many threads, each of which has memory already. */
void e3d_bins_init(e3d_bins *bins, int32_t threads);
void e3d_geometry_free(e3d_geometry_memory *state);
/* Empties the bins for a new pass; `alpha`: some of its records have alpha. Returns 0 when memory is out. */
int e3d_bins_reset(e3d_bins *bins, int64_t tiles, int alpha);
/* Empties the bins of the scene. */
void e3d_bins_clear(e3d_bins *bins);
/* Puts aside what the bins hold, as that of an earlier round; 0 when memory is out. */
int e3d_bins_keep(e3d_bins *bins);
/* Builds the tables that find a record by its ID. Called when records no longer move in memory. */
void e3d_bins_index(e3d_bins *bins);

/* Lists `count` records of a set, from `first` on, in the bins `to` of the tiles that they may touch; 0 when memory is out. */
int e3d_bin_records(const e3d_view *view, e3d_geometry_memory *state, const e3d_record_set *set, e3d_chains *to, uint32_t first,
                    const e3d_tile_rect *spans, int count);
static inline e3d_tile_rect e3d_tile_rect_of(const e3d_box *box)
{
    return (e3d_tile_rect){(uint32_t)(box->y0 >> E3D_TILE_SHIFT << 16 | box->x0 >> E3D_TILE_SHIFT),
                           (uint32_t)(box->y1 >> E3D_TILE_SHIFT << 16 | box->x1 >> E3D_TILE_SHIFT)};
}

/* Whether any thread has a record or a fragment for the tile. */
int e3d_has_bin(const e3d_bins *bins, int which, int64_t tile);
/* Whether any thread has a record with alpha for the tile. */
int e3d_has_alpha(const e3d_bins *bins, int kind, int64_t tile);
/* Whether any thread has anything for the tile. */
int e3d_has_bins(const e3d_bins *bins, int64_t tile);
/* How many entries the scene's bins of a tile have. */
typedef struct e3d_entries {
    uint32_t records, fragments;
} e3d_entries;
e3d_entries e3d_count_entries(const e3d_bins *bins, int64_t tile);
