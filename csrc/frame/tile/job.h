/* The input of drawing tiles, and the tile that a thread draws. */
#pragma once

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

/* Called between tiles to ask whether to stop; `ask` may be NULL. */
typedef struct e3d_poll {
    int (*ask)(void *user);
    void *user;
} e3d_poll;

typedef struct e3d_tiles_in {
    const e3d_prepared *pass;
    const e3d_bins *bins;
    const e3d_shade_in *shade;
    e3d_poll poll;
    int finishes; /* not 0: another round follows, which needs the tiles' depths */
} e3d_tiles_in;

typedef struct e3d_tiles_out {
    e3d_tile_memory *of[E3D_MAX_THREADS];
    e3d_queue queue;
    e3d_tile_progress *progress; /* of each tile */
    e3d_visible_tile *kept;      /* the kept tiles; NULL: there is one round */
    e3d_tile_depths *depths;
} e3d_tiles_out;

/* A tile that a thread draws. */
typedef struct e3d_tile_job {
    const e3d_tiles_in *in;
    e3d_tiles_out *out;
    e3d_tile_memory *memory; /* the thread's, */
    e3d_shade_out shades;    /* the part of it that shading writes */
    e3d_visible_tile *visible; /* with multisampling one for each sample */
    e3d_tile tile;
    int plane; /* with multisampling: the sample whose plane is drawn */
    int64_t number;
    e3d_tile_state state; /* before this */
    int masked, blended;  /* whether it has masked records, and blended ones */
} e3d_tile_job;

/* A kept tile, or the first of its planes. */
static inline e3d_visible_tile *e3d_kept_tile(const e3d_prepared *pass, const e3d_tiles_out *out, int64_t number)
{
    return &out->kept[pass->pattern ? number * pass->pattern->count : number];
}
