/* The tiles of a picture, one after the other. */
#ifndef E3D_TILE_H
#define E3D_TILE_H

#include <stdint.h>

#include "core/clock.h"
#include "core/limits.h"
#include "e3d.h"
#include "kernels/types/visible.h"
#include "pipeline/cull/depths.h"
#include "pipeline/geometry/bin.h"
#include "pipeline/pass/prepared.h"
#include "pipeline/pass/view.h"
#include "pipeline/shade/shade.h"
#include "pipeline/store/blank.h"
#include "pipeline/store/queue.h"
#include "pipeline/store/store.h"
#include "pipeline/store/tile_state.h"
#include "pipeline/tile/alpha.h"
#include "pipeline/tile/multisample.h"
#include "pipeline/tile/slots.h"
#include "pipeline/tile/spans.h"

/* A thread's memory, of one tile: the sum of what the stages keep for that long. */
typedef struct e3d_tile_memory {
    e3d_visible_tile visible; /* where tiles aren't kept over several rounds */
    e3d_marks_memory marks;
    e3d_store_memory pixels;
    e3d_shade_memory shade;
    e3d_spans_memory spans;
    e3d_slots_state slots;
    e3d_alpha_memory alpha;
    e3d_multisample_memory *multisample; /* or NULL: it hasn't been asked for */
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

/* What is asked between tiles whether to stop; `ask` may be NULL. */
typedef struct e3d_poll {
    int (*ask)(void *user);
    void *user;
} e3d_poll;

typedef struct e3d_tiles_in {
    const e3d_prepared *pass;
    const e3d_bins *bins;
    const e3d_shade_in *shade;
    e3d_poll poll;
    int finishes; /* another round follows, which asks for the tiles' depths */
} e3d_tiles_in;

typedef struct e3d_tiles_out {
    e3d_tile_memory *of[E3D_MAX_THREADS];
    e3d_queue queue;
    e3d_tile_progress *progress; /* of each tile */
    e3d_visible_tile *kept;      /* NULL: there is one round */
    e3d_tile_depths *depths;
} e3d_tiles_out;

/* A tile that a thread draws. */
typedef struct e3d_tile_job {
    const e3d_tiles_in *in;
    e3d_tiles_out *out;
    e3d_tile_memory *memory; /* the thread's, */
    e3d_shade_out shades;    /* and what of it shading writes */
    e3d_visible_tile *visible; /* with multisampling one for each sample */
    e3d_tile tile;
    int plane; /* with multisampling: the sample whose plane is meant, where one is */
    int64_t number;
    e3d_tile_state state; /* before this */
    int masked, blended;  /* whether it has such records */
} e3d_tile_job;

/* A tile that is kept, or the first of its planes. */
static inline e3d_visible_tile *e3d_kept_tile(const e3d_prepared *pass, const e3d_tiles_out *out, int64_t number)
{
    return &out->kept[pass->pattern ? number * pass->pattern->count : number];
}

/* Draws all tiles that something is in, and clears the others, until memory is out or the poll says stop. */
e3d_status e3d_tiles(const e3d_tiles_in *in, e3d_tiles_out *out);

#endif
