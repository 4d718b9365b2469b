/* raster, the visible surface: a tile's records and fragments to the IDs that its samples keep. */
#include "pipeline/frame.h"

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
    uint32_t next[E3D_MAX_THREADS];
    int32_t left = renderer->threads;
    for (int32_t w = 0; w < renderer->threads; w++) {
        const e3d_record_set *set = &renderer->workers[w]->pass[E3D_PASS_SCENE];
        next[w] = e3d_first_block(earlier ? &set->earlier : &set->bins, tile_number);
    }
    while (left) {
        left = 0;
        for (int32_t w = 0; w < renderer->threads; w++) {
            if (next[w] == E3D_NO_BLOCK)
                continue;
            const e3d_bin_block *block = (const e3d_bin_block *)renderer->workers[w]->pass[E3D_PASS_SCENE].blocks.data + next[w];
            context->kernels->raster_visible(visible, &context->tables[E3D_PASS_SCENE], block->id, (int)block->count);
            next[w] = block->next;
            left += next[w] != E3D_NO_BLOCK;
        }
    }
}

void e3d_visible_draw(const e3d_context *context, e3d_visible_tile *visible, int64_t tile_number)
{
    for (int earlier = context->finished; earlier >= 0; earlier--) {
        draw_records(context, visible, tile_number, earlier);
        for (int32_t w = 0; w < context->renderer->threads; w++)
            e3d_fragments_draw(context, &context->renderer->workers[w]->fragments, visible, tile_number, earlier);
    }
}

static void show_records(const e3d_context *context, const e3d_record_set *set, e3d_worker *worker, int64_t tile_number)
{
    const e3d_bin_block *blocks = set->blocks.data;
    for (uint32_t next = e3d_first_block(&set->bins, tile_number); next != E3D_NO_BLOCK; next = blocks[next].next)
        context->kernels->show_records(worker->visible, &context->tables[E3D_PASS_SCENE], blocks[next].id, (int)blocks[next].count,
                                       &worker->tile->shown);
}

void e3d_visible_show(const e3d_context *context, e3d_worker *worker, int64_t tile_number)
{
    e3d_shown_begin(&worker->tile->shown, 0);
    for (int32_t w = 0; w < context->renderer->threads; w++) {
        const e3d_worker *from = context->renderer->workers[w];
        show_records(context, &from->pass[E3D_PASS_SCENE], worker, tile_number);
        e3d_fragments_show(context, &from->fragments, worker, tile_number);
    }
}
