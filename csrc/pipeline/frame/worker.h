/* A thread of a renderer: the sum of what the stages keep for it. */
#ifndef E3D_WORKER_H
#define E3D_WORKER_H

#include "pipeline/cull/cull.h"
#include "pipeline/geometry/state.h"
#include "pipeline/store/queue.h"
#include "pipeline/tile/tile_memory.h"

typedef struct e3d_worker {
    e3d_cull_state cull;
    e3d_geometry_state geometry;
    e3d_queue_state queue;
    e3d_tile_memory tile;
} e3d_worker;

#endif
