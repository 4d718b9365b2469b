/* A thread of a renderer: the sum of what the stages keep for it. */
#ifndef E3D_WORKER_H
#define E3D_WORKER_H

#include "core/clock.h"
#include "kernels/types/visible.h"
#include "pipeline/cull/cull.h"
#include "pipeline/geometry/fragments.h"
#include "pipeline/geometry/geometry.h"
#include "pipeline/shade/surface.h"
#include "pipeline/state/counts.h"
#include "pipeline/state/records.h"
#include "pipeline/store/blank.h"
#include "pipeline/store/outputs.h"
#include "pipeline/store/queue.h"
#include "pipeline/tile/slots.h"
#include "pipeline/tile/spans.h"

typedef struct e3d_tile_memory e3d_tile_memory;

/* Records are of the scene, or of the edges of a wireframe. */
enum { E3D_SET_SCENE = 0, E3D_SET_EDGES, E3D_SETS };

/* A thread: the memory of each stage, kept from frame to frame. */
typedef struct e3d_worker {
    e3d_record_set sets[E3D_SETS];
    e3d_fragment_set fragments;
    e3d_geometry_state geometry;
    e3d_tile_memory *tile;
    e3d_visible_tile *visible; /* of the tile that is being drawn */
    uint32_t number;           /* of this worker */
    e3d_slots_state slots;
    e3d_cull_state cull;
    e3d_surface_state surface;
    e3d_outputs_state outputs;
    e3d_counters counters;
    e3d_spans_state spans;
    e3d_blank_state blank;
    int64_t lap; /* when the last stage of a tile ended (e3d_lap) */
    int failed;  /* out of memory */
    e3d_queue_state queue;
} e3d_worker;

/* Adds to a stage's time what has passed since the thread's last lap. */
static inline void e3d_lap(e3d_worker *worker, int64_t *stage_ns)
{
    int64_t now = e3d_now_ns();
    *stage_ns += now - worker->lap;
    worker->lap = now;
}

#endif
