/* Which thread does what with which tile. */
#ifndef E3D_QUEUE_H
#define E3D_QUEUE_H

#include <stdatomic.h>
#include <stdint.h>

#include "base/limits.h"

/* What is done with tiles: those that something is in are drawn, the others cleared. */
typedef enum e3d_to_do { E3D_TO_DRAW = 0, E3D_TO_CLEAR, E3D_TO_DO } e3d_to_do;

/* Tiles are known by their numbers. A worker's own range is shared with others; what it has taken is its alone. */
typedef struct e3d_tile_range {
    atomic_llong next;
    int64_t end;
} e3d_tile_range;

typedef struct e3d_taken_tiles {
    int64_t next, end;
} e3d_taken_tiles;

/* A thread's memory. Others take from its shares, too: the padding keeps them off the cache lines of the rest. */
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

/* All of so many tiles are to be done, each by one thread. */
void e3d_queue_tiles(e3d_queue *queue, int64_t tiles);

/* The next tile that a thread may do this with; -1 when none is left. */
int64_t e3d_take_tile(e3d_queue *queue, int thread, e3d_to_do what);

#endif
