/* Assigns tiles to threads. In each frame a thread has the same part of the picture, so that the textures that show there stay
 * in its core's caches. A thread that is done takes tiles that others have left. */
#include "frame/store/queue.h"

void e3d_queue_tiles(e3d_queue *queue, int64_t tiles)
{
    int threads = queue->threads;
    for (int t = 0; t < threads; t++)
        for (int what = 0; what < E3D_TO_DO; what++) {
            e3d_queue_state *state = queue->of[t];
            atomic_store(&state->ranges[what].next, tiles * t / threads);
            state->ranges[what].end = tiles * (t + 1) / threads;
            state->taken[what] = (e3d_taken_tiles){0, 0};
        }
}

/* Takes a sixteenth of what is left of a share, so that there are few atomic operations: each waits until all earlier
 * non-temporal stores are written. */
static int take_more(e3d_queue *queue, int thread, e3d_to_do what)
{
    enum { PARTS = 16 };
    int threads = queue->threads;
    for (int k = 0, owner = thread; k < threads; k++, owner = owner + 1 < threads ? owner + 1 : 0) {
        e3d_tile_range *from = &queue->of[owner]->ranges[what];
        int64_t left = from->end - atomic_load(&from->next), some = 1 + left / PARTS;
        int64_t first = left > 0 ? atomic_fetch_add(&from->next, some) : from->end;
        if (first < from->end) {
            queue->of[thread]->taken[what] = (e3d_taken_tiles){first, first + some < from->end ? first + some : from->end};
            return 1;
        }
    }
    return 0;
}

int64_t e3d_take_tile(e3d_queue *queue, int thread, e3d_to_do what)
{
    e3d_taken_tiles *taken = &queue->of[thread]->taken[what];
    if (taken->next == taken->end && !take_more(queue, thread, what))
        return -1;
    return taken->next++;
}
