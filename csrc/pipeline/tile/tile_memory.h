/* What a thread has at hand while it draws a tile: the sum of what the stages keep for that long. */
#ifndef E3D_TILE_MEMORY_H
#define E3D_TILE_MEMORY_H

#include <stdint.h>

#include "core/clock.h"
#include "kernels/types/visible.h"
#include "pipeline/shade/shade.h"
#include "pipeline/store/blank.h"
#include "pipeline/store/store.h"
#include "pipeline/tile/slots.h"
#include "pipeline/tile/spans.h"

typedef struct e3d_tile_memory {
    e3d_visible_tile visible; /* where tiles aren't kept over several rounds */
    e3d_marks_memory marks;
    e3d_store_memory pixels;
    e3d_shade_memory shade;
    e3d_spans_memory spans;
    e3d_slots_state slots;
    e3d_blank_state blank;
    int64_t ns_raster, ns_shade, ns_resolve; /* of all tiles */
    int64_t lap;                             /* when the last stage of a tile ended (e3d_lap) */
} e3d_tile_memory;

/* Adds to a stage's time what has passed since the thread's last lap. */
static inline void e3d_lap(e3d_tile_memory *memory, int64_t *stage_ns)
{
    int64_t now = e3d_now_ns();
    *stage_ns += now - memory->lap;
    memory->lap = now;
}

#endif
