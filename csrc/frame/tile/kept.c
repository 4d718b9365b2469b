/* raster over several rounds: keeps a tile's visible surface, and notes its farthest depths, which hide clusters of the next
 * round. */
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/large_pages.h"
#include "base/pool.h"
#include "frame/cull/depths.h"
#include "frame/geometry/bin.h"
#include "frame/geometry/records.h"
#include "frame/pass/prepared.h"
#include "frame/pass/view.h"
#include "frame/store/queue.h"
#include "frame/store/tile_state.h"
#include "frame/tile/kept.h"
#include "frame/tile/memory.h"
#include "frame/tile/visible.h"

/* ---- memory ---- */

static int reserve_tiles(e3d_kept_memory *kept, size_t tiles)
{
    if (tiles <= kept->room)
        return 1;
    free(kept->tiles);
    kept->room = 0;
    kept->tiles = e3d_large_memory(tiles * sizeof(e3d_visible_tile));
    if (!kept->tiles)
        return 0;
    kept->room = tiles;
    return 1;
}

void e3d_kept_free(e3d_kept_memory *kept)
{
    free(kept->tiles);
    e3d_array_free(&kept->depths);
}

int e3d_kept_prepare(e3d_kept_memory *kept, int64_t tiles)
{
    if (!reserve_tiles(kept, (size_t)tiles))
        return 0;
    memset(kept->tiles, 0, kept->room * sizeof *kept->tiles);
    return 1;
}

int e3d_kept_begin(e3d_kept_memory *kept, int64_t tiles, int32_t planes, e3d_tiles_out *out)
{
    if (!reserve_tiles(kept, (size_t)tiles * (size_t)planes) || !e3d_array_reserve(&kept->depths, (size_t)tiles, sizeof(e3d_tile_depths)))
        return 0;
    out->kept = kept->tiles;
    out->depths = kept->depths.data;
    for (int64_t t = 0; t < tiles; t++)
        e3d_depths_clear(&out->depths[t]);
    return 1;
}

/* ---- the tiles of a round ---- */

typedef struct keep_job {
    const e3d_tiles_in *in;
    e3d_tiles_out *out;
} keep_job;

static void keep_tile(const e3d_tiles_in *in, e3d_tiles_out *out, int64_t number)
{
    const e3d_prepared *pass = in->pass;
    e3d_visible_tile *visible = e3d_kept_tile(pass, out, number);
    if (e3d_tile_state_of(&out->progress[number]) == E3D_TILE_UNTOUCHED) {
        e3d_tile tile = e3d_tile_at(pass->view, number);
        e3d_visible_clear(visible, &tile);
    }
    e3d_visible_draw(pass, in->bins, number, 0, visible);
    e3d_note_depths(pass->kernels, pass->pattern ? pass->pattern->count : 1, visible, &out->depths[number]);
    e3d_tile_set_state(&out->progress[number], E3D_TILE_KEPT);
}

static void keep_work(void *argument, int thread)
{
    const keep_job *job = argument;
    e3d_tile_memory *memory = job->out->of[thread];
    memory->lap = e3d_now_ns();
    for (;;) {
        int64_t tile = e3d_take_tile(&job->out->queue, thread, E3D_TO_DRAW);
        if (tile < 0)
            return;
        if (!e3d_has_bin(job->in->bins, E3D_SET_SCENE, tile))
            continue;
        keep_tile(job->in, job->out, tile);
        e3d_lap(memory, &memory->ns_raster);
    }
}

void e3d_keep_tiles(const e3d_tiles_in *in, e3d_tiles_out *out)
{
    keep_job job = {in, out};
    e3d_queue_tiles(&out->queue, e3d_tile_count(in->pass->view));
    e3d_pool_run(in->pass->threads, keep_work, &job);
}
