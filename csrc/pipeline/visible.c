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

void e3d_visible_draw(const e3d_context *context, e3d_visible_tile *visible, int64_t tile_number)
{
    const e3d_renderer *renderer = context->renderer;
    for (int32_t w = 0; w < renderer->threads; w++) {
        const e3d_record_set *set = &renderer->workers[w]->pass[E3D_PASS_SCENE];
        const e3d_bin_block *blocks = set->blocks.data;
        uint32_t next = ((const e3d_bin *)set->bins.data)[tile_number].first;
        for (; next != E3D_NO_BLOCK; next = blocks[next].next)
            context->kernels->raster_visible(visible, &context->tables[E3D_PASS_SCENE], blocks[next].id,
                                             (int)blocks[next].count);
        e3d_fragments_draw(context, renderer->workers[w], visible, tile_number);
    }
}
