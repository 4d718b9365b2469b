/* What threads draw tiles of, and the tile that one of them draws. */
#ifndef E3D_TILE_JOB_H
#define E3D_TILE_JOB_H

#include <stdint.h>

#include "base/limits.h"
#include "kernels/types/visible.h"
#include "frame/cull/depths.h"
#include "frame/geometry/bin.h"
#include "frame/pass/prepared.h"
#include "frame/pass/view.h"
#include "frame/shade/job.h"
#include "frame/store/queue.h"
#include "frame/store/tile_state.h"
#include "frame/tile/memory.h"

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

#endif
