/* Which thread draws which tile: a part of the picture is each thread's own, in each frame, so that the textures that show there
 * stay in its core's caches. Who is done draws what others have left. */
#include "pipeline/frame.h"

void e3d_share_tiles(e3d_context *context)
{
    int threads = context->renderer->threads;
    for (int w = 0; w < threads; w++) {
        e3d_worker *worker = context->renderer->workers[w];
        for (int k = 0; k < E3D_TO_DO; k++)
            atomic_store(&worker->next_tile[k], e3d_tile_count(context) * w / threads);
        worker->tiles_end = e3d_tile_count(context) * (w + 1) / threads;
    }
}

int64_t e3d_take_tile(const e3d_context *context, const e3d_worker *worker, e3d_to_do what)
{
    int threads = context->renderer->threads;
    for (int k = 0, owner = (int)worker->number; k < threads; k++, owner = owner + 1 < threads ? owner + 1 : 0) {
        e3d_worker *of = context->renderer->workers[owner];
        int64_t tile = atomic_load(&of->next_tile[what]);
        if (tile < of->tiles_end && (tile = atomic_fetch_add(&of->next_tile[what], 1)) < of->tiles_end)
            return tile;
    }
    return -1;
}
