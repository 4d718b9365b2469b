/* raster, the visible surface: a tile's records and fragments to the IDs that its samples keep. */
#include "core/limits.h"
#include "e3d.h"
#include "kernels/kernels.h"
#include "kernels/types/shown.h"
#include "kernels/types/visible.h"
#include "pipeline/geometry/fragments.h"
#include "pipeline/state/context.h"
#include "pipeline/state/records.h"
#include "pipeline/state/renderer.h"
#include "pipeline/state/tile_memory.h"
#include "pipeline/state/worker.h"
#include "pipeline/tile/visible.h"

void e3d_visible_clear(e3d_visible_tile *visible, const e3d_tile *tile)
{
    for (int b = 0; b < E3D_TILE_BLOCKS; b++) {
        visible->zmin[b] = visible->zmax[b] = E3D_BEYOND_FAR;
        visible->noted_id[b] = E3D_NO_SLOT;
    }
    visible->noted = ~(uint64_t)0;
    visible->stale = 0;
    visible->x = tile->x;
    visible->y = tile->y;
}

/* The next block of each thread in turn: all of them list records from near to far. */
static void draw_records(const e3d_context *context, e3d_visible_tile *visible, int64_t tile_number, int earlier)
{
    const e3d_renderer *renderer = context->renderer;
    const e3d_bin_block *next[E3D_MAX_THREADS];
    int32_t left = renderer->threads;
    for (int32_t w = 0; w < renderer->threads; w++) {
        const e3d_record_set *set = &renderer->workers[w]->sets[E3D_SET_SCENE];
        next[w] = e3d_first_records(set, earlier ? &set->earlier : &set->bins, tile_number);
    }
    while (left) {
        left = 0;
        for (int32_t w = 0; w < renderer->threads; w++) {
            if (!next[w])
                continue;
            context->kernels->raster_visible(visible, &context->tables[E3D_SET_SCENE], next[w]->id, (int)next[w]->count);
            next[w] = e3d_next_records(&renderer->workers[w]->sets[E3D_SET_SCENE], next[w]);
            left += next[w] != NULL;
        }
    }
}

void e3d_visible_draw(const e3d_context *context, e3d_visible_tile *visible, int64_t tile_number, int earlier)
{
    for (; earlier >= 0; earlier--) {
        draw_records(context, visible, tile_number, earlier);
        for (int32_t w = 0; w < context->renderer->threads; w++)
            e3d_fragments_draw(context, &context->renderer->workers[w]->fragments, visible, tile_number, earlier);
    }
}

static void show_records(const e3d_context *context, const e3d_record_set *set, e3d_worker *worker, int64_t tile_number)
{
    for (const e3d_bin_block *block = e3d_first_records(set, &set->bins, tile_number); block; block = e3d_next_records(set, block))
        context->kernels->show_records(worker->visible, &context->tables[E3D_SET_SCENE], block->id, (int)block->count,
                                       &worker->tile->shown);
}

void e3d_visible_show(const e3d_context *context, e3d_worker *worker, int64_t tile_number)
{
    e3d_shown_begin(&worker->tile->shown, 0);
    for (int32_t w = 0; w < context->renderer->threads; w++) {
        const e3d_worker *from = context->renderer->workers[w];
        show_records(context, &from->sets[E3D_SET_SCENE], worker, tile_number);
        e3d_fragments_show(context, &from->fragments, worker, tile_number);
    }
}
