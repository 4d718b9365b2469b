/* Tiles in which nothing is drawn. */
#pragma once

#include "frame/geometry/bin.h"
#include "frame/pass/view.h"
#include "frame/store/queue.h"
#include "frame/store/store.h"
#include "frame/store/tile_state.h"

/* A thread's memory: the rows that are left of the tile that it is clearing, and whether there may be more tiles. */
typedef struct e3d_blank_state {
    e3d_queue *queue;
    e3d_tile_progress *progress; /* the state of all tiles: some become E3D_TILE_CLEARED */
    int thread;
    e3d_tile tile;
    int more;
} e3d_blank_state;

/* These clear blank tiles: a few rows at a time; finally all that is left. */
void e3d_blank_some(const e3d_store *store, const e3d_bins *bins, e3d_blank_state *state);
void e3d_blank_rest(const e3d_store *store, const e3d_bins *bins, e3d_blank_state *state);
