/* rounds: what the nearest clusters cover is drawn first, so that clusters behind it are left out.
 *
 * In:  the frame's candidates, from near to far, and what the view's last frames showed.
 * Out: bins, for e3d_tiles(); tiles that are kept or drawn already, by their state.
 * Always: the picture does not depend on the rounds. After each of them the farthest depths of its tiles are noted (depths.c).
 */
#include <stdlib.h>
#include <string.h>

#include "core/clock.h"
#include "core/grow.h"
#include "core/large_pages.h"
#include "core/limits.h"
#include "core/pool.h"
#include "e3d.h"
#include "kernels/types/visible.h"
#include "pipeline/cull/depths.h"
#include "pipeline/cull/history.h"
#include "pipeline/frame/rounds.h"
#include "pipeline/geometry/bin.h"
#include "pipeline/geometry/fragments.h"
#include "pipeline/geometry/geometry.h"
#include "pipeline/pass/plan.h"
#include "pipeline/pass/view.h"
#include "pipeline/state/context.h"
#include "pipeline/state/records.h"
#include "pipeline/state/renderer.h"
#include "pipeline/state/tile_state.h"
#include "pipeline/state/worker.h"
#include "pipeline/store/queue.h"
#include "pipeline/tile/tile.h"
#include "pipeline/tile/visible.h"

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

e3d_status e3d_renderer_prepare(e3d_renderer *renderer, int32_t width, int32_t height)
{
    e3d_kept_memory *kept = &renderer->kept;
    int64_t across = ((int64_t)width + E3D_TILE - 1) / E3D_TILE, down = ((int64_t)height + E3D_TILE - 1) / E3D_TILE;
    if (renderer->backend == E3D_BACKEND_SCALAR || (int64_t)width * height > E3D_MOST_KEPT_SAMPLES)
        return E3D_OK;
    if (!reserve_tiles(kept, (size_t)(across * down)))
        return E3D_OUT_OF_MEMORY;
    memset(kept->tiles, 0, kept->room * sizeof *kept->tiles);
    return E3D_OK;
}

static int begin(e3d_context *context)
{
    e3d_kept_memory *kept = &context->renderer->kept;
    size_t tiles = (size_t)e3d_tile_count(context->view);
    if (!reserve_tiles(kept, tiles) || !e3d_array_reserve(&kept->depths, tiles, sizeof(e3d_tile_depths)))
        return 0;
    context->kept = kept->tiles;
    context->depths = kept->depths.data;
    for (size_t t = 0; t < tiles; t++)
        e3d_depths_clear(&context->depths[t]);
    return 1;
}

/* ---- the tiles of a round ---- */

static void keep_tile(e3d_context *context, e3d_worker *worker, int64_t number)
{
    e3d_tile_progress *progress = &context->tiles[number];
    e3d_visible_tile *visible = &context->kept[number];
    if (e3d_tile_state_of(progress) == E3D_TILE_UNTOUCHED) {
        e3d_tile tile = e3d_tile_at(context->view, number);
        e3d_visible_clear(visible, &tile);
    }
    e3d_visible_draw(context, visible, number, 0);
    e3d_note_depths(context, visible, number);
    e3d_tile_set_state(progress, E3D_TILE_KEPT);
    e3d_lap(worker, &worker->counters.ns_raster);
}

static void keep_work(void *argument, int number)
{
    e3d_context *context = argument;
    e3d_worker *worker = context->renderer->workers[number];
    worker->lap = e3d_now_ns();
    for (;;) {
        int64_t tile = e3d_take_tile(context, worker, E3D_TO_DRAW);
        if (tile < 0)
            return;
        if (e3d_has_bin(context, E3D_SET_SCENE, tile))
            keep_tile(context, worker, tile);
    }
}

/* Draws what the round covers, and keeps it for the next one. */
static void keep_tiles(e3d_context *context)
{
    e3d_renderer *renderer = context->renderer;
    int32_t tiles = (int32_t)e3d_tile_count(context->view);
    e3d_tables_set(context);
    e3d_queue_tiles(context);
    e3d_pool_run(renderer->threads, keep_work, context);
    for (int32_t w = 0; w < renderer->threads; w++) {
        e3d_record_set *records = &renderer->workers[w]->sets[E3D_SET_SCENE];
        e3d_fragment_set *fragments = &renderer->workers[w]->fragments;
        e3d_bins_clear(&records->bins, &records->blocks, tiles);
        e3d_bins_clear(&fragments->bins, &fragments->blocks, tiles);
    }
}

/* The tiles are drawn from visible surface to pixels; those to which the next round adds something will be drawn anew, from these
 * bins and the next ones. */
static int finish_tiles(e3d_context *context)
{
    e3d_renderer *renderer = context->renderer;
    int32_t tiles = (int32_t)e3d_tile_count(context->view);
    e3d_tiles(context);
    for (int32_t w = 0; w < renderer->threads; w++) {
        e3d_record_set *records = &renderer->workers[w]->sets[E3D_SET_SCENE];
        e3d_fragment_set *fragments = &renderer->workers[w]->fragments;
        records->earlier_records = records->records.count;
        fragments->earlier_drawn = fragments->drawn.count;
        if (!e3d_bins_keep(&records->bins, &records->earlier, tiles) || !e3d_bins_keep(&fragments->bins, &fragments->earlier, tiles))
            return 0;
    }
    return 1;
}

/* Draws some of the candidates; 0 when memory is out. */
static int draw_round(e3d_context *context, e3d_stats *stats, e3d_round round)
{
    int64_t start = e3d_now_ns();
    context->round = round;
    e3d_geometry(context);
    stats->ms_geometry += (double)(e3d_now_ns() - start) * 1e-6;
    stats->rounds++;
    if (round.finishes && !finish_tiles(context))
        return 0;
    if (!round.finishes && !round.last)
        keep_tiles(context);
    return !e3d_any_failed(context->renderer);
}

/* ---- which rounds ---- */

/* Whether rounds may pay: many candidates, which cover the picture more than once. */
static int pay(const e3d_context *context)
{
    int64_t samples = (int64_t)context->view->viewport.width * context->view->viewport.height, covered = 0;
    if (!e3d_plans(context, E3D_PLAN_ROUNDS))
        return 0;
    if (context->frame->culling == E3D_CULLING_ALWAYS)
        return context->candidate_count > 1;
    if (context->candidate_count < 64)
        return 0;
    for (int32_t w = 0; w < context->renderer->threads; w++)
        covered += context->renderer->workers[w]->counters.blocks;
    return !e3d_history_backs_off(context->view->history, covered, context->candidate_count) &&
           covered * (E3D_BLOCK * E3D_BLOCK) > 2 * samples;
}

/* Whether most tiles can be drawn to their end with what the last frames showed: shading a tile while it lies in the caches pays
 * where few are drawn twice. */
static int finish_early(const e3d_context *context)
{
    return e3d_plans(context, E3D_PLAN_FINISHES) && 8 * context->view->history->tiles_changed <= e3d_tile_count(context->view);
}

/* After the last round's geometry. */
static int64_t count_changed_tiles(const e3d_context *context)
{
    int64_t changed = 0;
    for (int64_t tile = 0; tile < e3d_tile_count(context->view); tile++)
        changed += e3d_has_bin(context, E3D_SET_SCENE, tile);
    return changed;
}

/* What the last frames showed, then what came into view since. */
static int draw_remembered(e3d_context *context, e3d_stats *stats)
{
    int64_t end = context->candidate_count;
    e3d_round seen = {.choice = E3D_SEEN_CANDIDATES, .end = end, .finishes = finish_early(context)};
    e3d_round unseen = {.choice = E3D_UNSEEN_CANDIDATES, .end = end, .tested = 1, .last = 1};
    if (!draw_round(context, stats, seen) || !draw_round(context, stats, unseen))
        return 0;
    context->view->history->tiles_changed = count_changed_tiles(context);
    return 1;
}

/* The nearest part of the candidates, then twice as many again and again. */
static int draw_from_near_to_far(e3d_context *context, e3d_stats *stats)
{
    int64_t count = context->candidate_count, done = 0;
    for (int64_t end = count / 32 + 1; 2 * end < count; end *= 2) {
        if (!draw_round(context, stats, (e3d_round){.first = done, .end = end, .tested = done > 0}))
            return 0;
        done = end;
    }
    return draw_round(context, stats, (e3d_round){.first = done, .end = count, .tested = 1, .last = 1});
}

int e3d_rounds(e3d_context *context, e3d_stats *stats)
{
    if (!pay(context) || !begin(context))
        return draw_round(context, stats, (e3d_round){.end = context->candidate_count, .last = 1});
    int remembered = e3d_history_remember(context);
    if (remembered < 0)
        return 0;
    return remembered ? draw_remembered(context, stats) : draw_from_near_to_far(context, stats);
}
