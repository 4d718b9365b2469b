/* Which thread does what with which tile. */
#pragma once

#include <stdatomic.h>
#include <stdint.h>

#include "base/limits.h"

/* The work on tiles: those that hold anything are drawn, the others cleared. */
typedef enum e3d_to_do { E3D_TO_DRAW = 0,
                         E3D_TO_CLEAR,
                         E3D_TO_DO } e3d_to_do;

/* A range of tiles, by number. A worker shares its own range with others, but not the tiles that it has taken. */
typedef struct e3d_tile_range {
    atomic_llong next;
    int64_t end;
} e3d_tile_range;

typedef struct e3d_taken_tiles {
    int64_t next, end;
} e3d_taken_tiles;

/* A thread's memory. Other threads take from its shares; the padding keeps them off the cache lines of the rest. */
typedef struct e3d_queue_state {
    e3d_taken_tiles taken[E3D_TO_DO];
    char padding[128];
    e3d_tile_range ranges[E3D_TO_DO];
    char more_padding[128];
} e3d_queue_state;

/* The shares of all threads. */
typedef struct e3d_queue {
    int32_t threads;
    e3d_queue_state *of[E3D_MAX_THREADS];
} e3d_queue;

/* Queues all tiles, each to be done by one thread. */
void e3d_queue_tiles(e3d_queue *queue, int64_t tiles);

/* Takes the thread's next tile for this kind of work; -1 when none is left. */
int64_t e3d_take_tile(e3d_queue *queue, int thread, e3d_to_do what);
