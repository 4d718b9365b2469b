/* Tiles that nothing is drawn in. */
#ifndef E3D_BLANK_H
#define E3D_BLANK_H

#include "frame/geometry/bin.h"
#include "frame/pass/view.h"
#include "frame/store/queue.h"
#include "frame/store/store.h"
#include "frame/store/tile_state.h"

/* A thread's memory: what is left of the tile that it is clearing, and whether there may be more. */
typedef struct e3d_blank_state {
    e3d_queue *queue;
    e3d_tile_progress *progress; /* of all tiles: some become E3D_TILE_CLEARED */
    int thread;
    e3d_tile tile;
    int more;
} e3d_blank_state;

/* Clears such tiles: a few rows at a time, and at last what is left of all. */
void e3d_blank_some(const e3d_store *store, const e3d_bins *bins, e3d_blank_state *state);
void e3d_blank_rest(const e3d_store *store, const e3d_bins *bins, e3d_blank_state *state);

#endif
