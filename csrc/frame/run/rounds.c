/* rounds: draws the nearest clusters first, so that clusters behind them can be left out.
 * In: the frame's candidates, from near to far, and what the view's last frames showed.
 * Out: bins, for e3d_tiles(), and tiles that are kept or drawn already, as their state says.
 * Always: the picture does not depend on the rounds. After each round the farthest depths of its tiles are noted (depths.c). */
#include "base/clock.h"
#include "base/limits.h"
#include "frame/cull/cull.h"
#include "frame/cull/history.h"
#include "frame/run/renderer.h"
#include "frame/run/rounds.h"
#include "frame/geometry/bin.h"
#include "frame/geometry/geometry.h"
#include "frame/geometry/records.h"
#include "frame/geometry/round.h"
#include "frame/pass/prepared.h"
#include "frame/pass/view.h"
#include "frame/tile/job.h"
#include "frame/tile/kept.h"
#include "frame/tile/tile.h"

/* ---- a round ---- */

/* Draws the tiles from visible surface to pixels. A tile to which the next round adds something is drawn again, from these bins
 * and the next ones. */
static e3d_status finish_tiles(const e3d_context *context)
{
    e3d_tiles_in in = context->tiles;
    in.finishes = 1;
    e3d_status status = e3d_tiles(&in, &context->renderer->tiles);
    if (status == E3D_OK && !e3d_bins_keep(&context->renderer->bins))
        return E3D_OUT_OF_MEMORY;
    return status;
}

/* Draws one round. `finishes`: the tiles are shaded and resolved although another round follows; else they are kept for it. */
static e3d_status draw_round(const e3d_context *context, e3d_stats *stats, e3d_round round, int finishes)
{
    int64_t start = e3d_now_ns();
    e3d_renderer *renderer = context->renderer;
    e3d_tiles_out *tiles = &renderer->tiles;
    uint8_t *seen = tiles->kept ? context->history->seen.data : NULL;
    const e3d_geometry_in in = {&context->pass, renderer->cull.candidates.data, round, tiles->depths, context->history};
    const e3d_geometry_out out = {&renderer->bins, &renderer->view, &renderer->draws, renderer->marks.data, seen};
    if (!e3d_geometry(&in, &out))
        return E3D_OUT_OF_MEMORY;
    stats->ms_geometry += (double)(e3d_now_ns() - start) * 1e-6;
    stats->rounds++;
    if (finishes)
        return finish_tiles(context);
    if (!round.last) {
        e3d_keep_tiles(&context->tiles, tiles);
        e3d_bins_clear(&renderer->bins);
    }
    return E3D_OK;
}

/* ---- which rounds ---- */

/* Whether rounds may pay: there are many candidates, which cover the picture more than once. */
static int pay(const e3d_context *context)
{
    const e3d_prepared *pass = &context->pass;
    const e3d_cull_memory *cull = &context->renderer->cull;
    int64_t samples = (int64_t)pass->view->viewport.width * pass->view->viewport.height;
    int64_t candidates = (int64_t)cull->candidates.count, covered = 0;
    if (!e3d_plans(pass, E3D_PLAN_ROUNDS))
        return 0;
    if (pass->frame->culling == E3D_CULLING_ALWAYS)
        return candidates > 1;
    if (candidates < 64)
        return 0;
    for (int32_t t = 0; t < pass->threads; t++)
        covered += cull->of[t]->blocks;
    return !e3d_history_backs_off(context->history, covered, candidates) && covered * (E3D_BLOCK * E3D_BLOCK) > 2 * samples;
}

/* Whether most tiles can be finished with what the last frames showed. Shading a tile while it lies in the caches pays if few
 * tiles are drawn twice. */
static int finish_early(const e3d_context *context)
{
    return e3d_plans(&context->pass, E3D_PLAN_FINISHES) && 8 * context->history->tiles_changed <= e3d_tile_count(context->pass.view);
}

/* Counts the tiles that the last round's geometry changed. */
static int64_t count_changed_tiles(const e3d_bins *bins)
{
    int64_t changed = 0;
    for (int64_t tile = 0; tile < bins->tiles; tile++)
        changed += e3d_has_bin(bins, E3D_SET_SCENE, tile);
    return changed;
}

/* Draws what the last frames showed, and then what came into view since. */
static e3d_status draw_remembered(const e3d_context *context, e3d_stats *stats, int64_t count)
{
    e3d_round seen = {.choice = E3D_SEEN_CANDIDATES, .end = count};
    e3d_round unseen = {.choice = E3D_UNSEEN_CANDIDATES, .end = count, .tested = 1, .last = 1};
    e3d_status status = draw_round(context, stats, seen, finish_early(context));
    if (status == E3D_OK)
        status = draw_round(context, stats, unseen, 0);
    if (status == E3D_OK)
        context->history->tiles_changed = count_changed_tiles(&context->renderer->bins);
    return status;
}

/* Draws the nearest candidates, then twice as many, again and again. */
static e3d_status draw_from_near_to_far(const e3d_context *context, e3d_stats *stats, int64_t count)
{
    int64_t done = 0;
    for (int64_t end = count / 32 + 1; 2 * end < count; end *= 2) {
        e3d_status status = draw_round(context, stats, (e3d_round){.first = done, .end = end, .tested = done > 0}, 0);
        if (status != E3D_OK)
            return status;
        done = end;
    }
    return draw_round(context, stats, (e3d_round){.first = done, .end = count, .tested = 1, .last = 1}, 0);
}

e3d_status e3d_rounds(const e3d_context *context, e3d_stats *stats)
{
    e3d_renderer *renderer = context->renderer;
    int64_t count = (int64_t)renderer->cull.candidates.count;
    int32_t planes = context->pass.pattern ? context->pass.pattern->count : 1;
    if (!pay(context) || !e3d_kept_begin(&renderer->kept, e3d_tile_count(context->pass.view), planes, &renderer->tiles))
        return draw_round(context, stats, (e3d_round){.end = count, .last = 1}, 0);
    int remembered = e3d_history_remember(context->history, context->pass.draws);
    if (remembered < 0)
        return E3D_OUT_OF_MEMORY;
    return remembered ? draw_remembered(context, stats, count) : draw_from_near_to_far(context, stats, count);
}
