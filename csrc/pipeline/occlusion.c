/* raster, ahead of its time: what the nearest clusters cover is drawn first, so that clusters behind it are left out.
 *
 * Tiles are kept over the rounds of a frame; after each round their farthest depths are noted (depths.c). What the last frames
 * showed goes first; the picture does not depend on it.
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
#include "pipeline/bin.h"
#include "pipeline/depths.h"
#include "pipeline/draws.h"
#include "pipeline/fragments.h"
#include "pipeline/frame.h"
#include "pipeline/occlusion.h"
#include "pipeline/plan.h"
#include "pipeline/records.h"
#include "pipeline/share.h"
#include "pipeline/tile.h"
#include "pipeline/visible.h"

/* Where little is hidden, rounds are tried again about once a second, at 60 frames a second. */
enum { FRAMES_BETWEEN_TRIALS = 64 };

/* ---- memory ---- */

static int reserve_tiles(e3d_renderer *renderer, size_t tiles)
{
    if (tiles <= renderer->kept_room)
        return 1;
    free(renderer->kept);
    renderer->kept = NULL;
    renderer->kept_room = 0;
    renderer->kept = e3d_large_memory(tiles * sizeof(e3d_visible_tile));
    if (!renderer->kept)
        return 0;
    renderer->kept_room = tiles;
    return 1;
}

e3d_status e3d_renderer_prepare(e3d_renderer *renderer, int32_t width, int32_t height)
{
    int64_t across = ((int64_t)width + E3D_TILE - 1) / E3D_TILE, down = ((int64_t)height + E3D_TILE - 1) / E3D_TILE;
    if (renderer->backend == E3D_BACKEND_SCALAR || (int64_t)width * height > E3D_MOST_KEPT_SAMPLES)
        return E3D_OK;
    if (!reserve_tiles(renderer, (size_t)(across * down)))
        return E3D_OUT_OF_MEMORY;
    memset(renderer->kept, 0, renderer->kept_room * sizeof *renderer->kept);
    return E3D_OK;
}

int e3d_occlusion_begin(e3d_context *context)
{
    e3d_renderer *renderer = context->renderer;
    size_t tiles = (size_t)e3d_tile_count(context);
    context->kept = NULL;
    if (!reserve_tiles(renderer, tiles) ||
        !e3d_array_reserve(&renderer->tile_depths, tiles, sizeof(e3d_tile_depths)))
        return 0;
    context->kept = renderer->kept;
    context->depths = renderer->tile_depths.data;
    for (size_t t = 0; t < tiles; t++) {
        context->depths[t].most = E3D_NOTHING_KEPT;
        context->depths[t].shaded = 0;
    }
    return 1;
}

/* Whether rounds may pay: many items, which cover the picture more than once. */
int e3d_occlusion_pays(const e3d_context *context)
{
    const e3d_frame *frame = context->frame;
    int64_t samples = (int64_t)context->viewport.width * context->viewport.height, covered = 0;
    if (!e3d_plans(context, E3D_PLAN_ROUNDS))
        return 0;
    if (frame->culling == E3D_CULLING_ALWAYS)
        return context->item_count > 1;
    if (context->item_count < 64)
        return 0;
    e3d_renderer *renderer = context->renderer;
    for (int32_t w = 0; w < renderer->threads; w++)
        covered += renderer->workers[w]->counters.blocks;
    if (renderer->frames_without_rounds > 0 && 2 * covered <= 3 * renderer->covered_at_trial &&
        2 * context->item_count <= 3 * renderer->items_at_trial) {
        renderer->frames_without_rounds--;
        renderer->rows.count = 0; /* what was seen is of another view when the next trial comes */
        return 0;
    }
    renderer->covered_at_trial = covered;
    renderer->items_at_trial = context->item_count;
    return covered * (E3D_BLOCK * E3D_BLOCK) > 2 * samples;
}

/* The clusters that showed when they were last tried. */
static int64_t count_seen(const e3d_context *context)
{
    int64_t seen = 0;
    for (int64_t unit = 0; unit < context->groups; unit++)
        seen += __builtin_popcount(context->seen[unit]);
    return seen;
}

/* Whether few of the clusters that were tried are hidden. Trying boxes costs about what drawing a third of the clusters does, and
 * keeping a tile what drawing one does (measured). A frame that remembers nothing draws much before it knows what hides
 * it: the next one tries all of that, and tells. */
static int hides_little(const e3d_context *context, const e3d_stats *stats)
{
    if (!context->renderer->remembers)
        return 0;
    int64_t tried = stats->clusters_drawn + stats->clusters_occluded, hidden = tried - count_seen(context);
    return 10 * (hidden - e3d_tile_count(context)) < 3 * tried;
}

void e3d_occlusion_judge(e3d_context *context, const e3d_stats *stats)
{
    context->renderer->frames_without_rounds = hides_little(context, stats) ? FRAMES_BETWEEN_TRIALS : 0;
}

/* ---- a round's tiles ---- */

static void draw_kept(e3d_context *context, e3d_worker *worker, int64_t number)
{
    e3d_tile_depths *depths = &context->depths[number];
    e3d_visible_tile *visible = &context->kept[number];
    if (depths->most == E3D_NOTHING_KEPT) {
        e3d_tile tile = e3d_tile_at(context, number);
        e3d_visible_clear(visible, &tile);
    }
    e3d_visible_draw(context, visible, number);
    e3d_note_depths(context, visible, number);
    e3d_lap(worker, &worker->counters.ns_raster);
}

static void kept_work(void *argument, int number)
{
    e3d_context *context = argument;
    e3d_worker *worker = context->renderer->workers[number];
    worker->lap = e3d_now_ns();
    for (;;) {
        int64_t tile = e3d_take_tile(context, worker, E3D_TO_DRAW);
        if (tile < 0)
            return;
        if (e3d_has_bin(context, E3D_PASS_SCENE, tile))
            draw_kept(context, worker, tile);
    }
}

/* The tiles are done, but those to which the next round adds something are drawn anew. */
static int finish_tiles(e3d_context *context)
{
    e3d_renderer *renderer = context->renderer;
    int32_t tiles = (int32_t)e3d_tile_count(context);
    e3d_tiles(context);
    context->finished = 1;
    for (int32_t w = 0; w < renderer->threads; w++) {
        e3d_record_set *records = &renderer->workers[w]->pass[E3D_PASS_SCENE];
        e3d_fragment_set *fragments = &renderer->workers[w]->fragments;
        records->earlier_records = records->records.count;
        fragments->earlier_drawn = fragments->drawn.count;
        if (!e3d_bins_keep(&records->bins, &records->earlier, tiles) || !e3d_bins_keep(&fragments->bins, &fragments->earlier, tiles))
            return 0;
    }
    return 1;
}

int e3d_draw_kept_tiles(e3d_context *context)
{
    e3d_renderer *renderer = context->renderer;
    if (context->round.finished)
        return finish_tiles(context);
    e3d_tables_set(context);
    e3d_share_tiles(context);
    e3d_pool_run(renderer->threads, kept_work, context);
    int32_t tiles = (int32_t)e3d_tile_count(context);
    for (int32_t w = 0; w < renderer->threads; w++) {
        e3d_record_set *records = &renderer->workers[w]->pass[E3D_PASS_SCENE];
        e3d_fragment_set *fragments = &renderer->workers[w]->fragments;
        e3d_bins_clear(&records->bins, &records->blocks, tiles);
        e3d_bins_clear(&fragments->bins, &fragments->blocks, tiles);
    }
    return 1;
}

/* Shading a tile while it lies in the caches pays where few are drawn twice. */
int e3d_finishes_early(const e3d_context *context)
{
    return e3d_plans(context, E3D_PLAN_FINISHES) && 8 * context->renderer->tiles_changed <= e3d_tile_count(context);
}

void e3d_count_changed_tiles(e3d_context *context)
{
    int64_t changed = 0;
    for (int64_t tile = 0; tile < e3d_tile_count(context); tile++)
        changed += e3d_has_bin(context, E3D_PASS_SCENE, tile);
    context->renderer->tiles_changed = changed;
}

/* ---- what the last frame showed ---- */

static e3d_memory_row row_of(const e3d_context *context, const e3d_turn *turn)
{
    const e3d_draw_state *state = &context->draws[turn->draw];
    const e3d_draw *draw = state->draw;
    int32_t groups = state->mesh->group_count, node = e3d_object_id(draw, turn->instance);
    int64_t base = state->group_base + (int64_t)turn->instance * groups;
    if (draw->pose_kind == E3D_POSE_NODES)
        return (e3d_memory_row){state->mesh, base, node, 0, 1, groups};
    return (e3d_memory_row){state->mesh, base, node, draw->first_instance, draw->instances, groups};
}

/* Takes over what both frames know of the instances of one draw; how many groups that is. */
static int64_t take_over(const e3d_memory_row *from, const uint8_t *old, const e3d_memory_row *to, uint8_t *seen)
{
    int32_t first = from->first > to->first ? from->first : to->first;
    int32_t from_end = from->first + from->instances, to_end = to->first + to->instances;
    int32_t end = from_end < to_end ? from_end : to_end;
    if (from->mesh != to->mesh || from->groups != to->groups || first >= end)
        return 0;
    int64_t count = (int64_t)(end - first) * to->groups;
    memcpy(seen + to->base + (int64_t)(first - to->first) * to->groups,
           old + from->base + (int64_t)(first - from->first) * to->groups, (size_t)count);
    return count;
}

/* Both lists rise by node, and in a node by instance, as far as they can be matched. */
static int64_t match_rows(e3d_renderer *renderer, size_t old_count, const e3d_memory_row *rows, size_t count)
{
    const e3d_memory_row *old = renderer->rows_before.data;
    int64_t known = 0;
    size_t at = 0;
    for (size_t d = 0; d < count; d++) {
        while (at < old_count && (old[at].node < rows[d].node ||
                                  (old[at].node == rows[d].node && old[at].first + old[at].instances <= rows[d].first)))
            at++;
        for (size_t j = at; j < old_count && old[j].node == rows[d].node &&
                            old[j].first < rows[d].first + rows[d].instances; j++)
            known += take_over(&old[j], renderer->seen_before.data, &rows[d], renderer->seen.data);
    }
    return known;
}

static void exchange(e3d_array *a, e3d_array *b)
{
    e3d_array kept = *a;
    *a = *b;
    *b = kept;
}

int e3d_remember(e3d_context *context)
{
    e3d_renderer *renderer = context->renderer;
    size_t count = (size_t)context->turn_count, groups = (size_t)context->groups;
    exchange(&renderer->rows, &renderer->rows_before);
    exchange(&renderer->seen, &renderer->seen_before);
    size_t old_count = renderer->rows_before.count;
    renderer->trials++;
    renderer->rows.count = 0; /* until it is whole */
    if (!e3d_array_reserve(&renderer->rows, count + 1, sizeof(e3d_memory_row)) ||
        !e3d_array_reserve(&renderer->seen, groups + 1, 1))
        return -1;
    e3d_memory_row *rows = renderer->rows.data;
    for (size_t d = 0; d < count; d++)
        rows[d] = row_of(context, &context->turns[d]);
    memset(renderer->seen.data, 0, groups);
    renderer->rows.count = count;
    context->seen = renderer->seen.data;
    renderer->doubts = !renderer->remembers;
    renderer->remembers = 2 * match_rows(renderer, old_count, rows, count) > context->groups;
    return renderer->remembers;
}
