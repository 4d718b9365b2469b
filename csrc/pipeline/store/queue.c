/* Which thread draws which tile: a part of the picture is each thread's own, in each frame, so that the textures that show there
 * stay in its core's caches. Who is done draws what others have left. */
#include "e3d.h"
#include "pipeline/pass/view.h"
#include "pipeline/state/context.h"
#include "pipeline/state/renderer.h"
#include "pipeline/state/worker.h"
#include "pipeline/store/queue.h"

void e3d_queue_tiles(e3d_context *context)
{
    int64_t tiles = e3d_tile_count(context->view);
    int threads = context->renderer->threads;
    for (int w = 0; w < threads; w++)
        for (int what = 0; what < E3D_TO_DO; what++) {
            e3d_worker *worker = context->renderer->workers[w];
            atomic_store(&worker->queue.ranges[what].next, tiles * w / threads);
            worker->queue.ranges[what].end = tiles * (w + 1) / threads;
            worker->queue.taken[what] = (e3d_taken_tiles){0, 0};
        }
}

/* Takes a sixteenth of what a share has left at a time: an atomic operation waits until all non-temporal stores before it are
 * written. */
static int take_more(const e3d_renderer *renderer, e3d_worker *worker, e3d_to_do what)
{
    enum { PARTS = 16 };
    int threads = renderer->threads;
    for (int k = 0, owner = (int)worker->number; k < threads; k++, owner = owner + 1 < threads ? owner + 1 : 0) {
        e3d_tile_range *from = &renderer->workers[owner]->queue.ranges[what];
        int64_t left = from->end - atomic_load(&from->next), some = 1 + left / PARTS;
        int64_t first = left > 0 ? atomic_fetch_add(&from->next, some) : from->end;
        if (first < from->end) {
            worker->queue.taken[what] = (e3d_taken_tiles){first, first + some < from->end ? first + some : from->end};
            return 1;
        }
    }
    return 0;
}

int64_t e3d_take_tile(const e3d_context *context, e3d_worker *worker, e3d_to_do what)
{
    e3d_taken_tiles *taken = &worker->queue.taken[what];
    if (taken->next == taken->end && !take_more(context->renderer, worker, what))
        return -1;
    return taken->next++;
}
