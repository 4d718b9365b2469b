/* Which thread draws which tile: a part of the picture is each thread's own, in each frame, so that the textures that show there
 * stay in its core's caches. Who is done draws what others have left. */
#include "pipeline/frame.h"

static int64_t first_of(const e3d_context *context, int worker)
{
    return e3d_tile_count(context) * worker / context->renderer->threads;
}

void e3d_share_tiles(e3d_context *context)
{
    for (int w = 0; w < context->renderer->threads; w++)
        for (int k = 0; k < E3D_TO_DO; k++)
            atomic_store(&context->renderer->workers[w]->next_tile[k], first_of(context, w));
}

int64_t e3d_take_tile(const e3d_context *context, const e3d_worker *worker, e3d_to_do what)
{
    int threads = context->renderer->threads;
    for (int k = 0; k < threads; k++) {
        int owner = ((int)worker->number + k) % threads;
        atomic_llong *next = &context->renderer->workers[owner]->next_tile[what];
        int64_t end = first_of(context, owner + 1), tile = atomic_load(next) < end ? atomic_fetch_add(next, 1) : end;
        if (tile < end)
            return tile;
    }
    return -1;
}
