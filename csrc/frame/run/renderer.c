/* A renderer: the memory of its threads, kept from frame to frame. */
#include <stdlib.h>
#include <string.h>

#include "base/limits.h"
#include "frame/pass/plan.h"
#include "frame/run/renderer.h"
#include "frame/shade/shade.h"
#include "frame/tile/alpha_list.h"
#include "frame/tile/multisample.h"
#include "frame/tile/slots.h"

static e3d_worker *create_worker(void)
{
    void *own = NULL;
    if (posix_memalign(&own, 64, sizeof(e3d_worker)))
        return NULL;
    e3d_worker *worker = memset(own, 0, sizeof *worker); /* padding is read, but never used */
    e3d_marks_init(&worker->tile.marks);
    return worker;
}

static void destroy_worker(e3d_worker *worker)
{
    if (!worker)
        return;
    e3d_array_free(&worker->cull.candidates);
    e3d_geometry_free(&worker->geometry);
    e3d_slots_free(&worker->tile.slots);
    e3d_alpha_free(&worker->tile.alpha);
    e3d_shade_free(&worker->tile.shade);
    e3d_multisample_free(worker->tile.multisample);
    e3d_array_free(&worker->tile.pixels.words);
    free(worker);
}

/* Creates the workers. Each stage gets a pointer to its own part of each of them. */
static int create_workers(e3d_renderer *renderer)
{
    renderer->workers = calloc((size_t)renderer->threads, sizeof *renderer->workers);
    if (!renderer->workers)
        return 0;
    for (int32_t t = 0; t < renderer->threads; t++) {
        e3d_worker *worker = renderer->workers[t] = create_worker();
        if (!worker)
            return 0;
        renderer->cull.of[t] = &worker->cull;
        renderer->bins.of[t] = &worker->geometry;
        renderer->tiles.queue.of[t] = &worker->queue;
        renderer->tiles.of[t] = &worker->tile;
    }
    renderer->tiles.queue.threads = renderer->threads;
    e3d_bins_init(&renderer->bins, renderer->threads);
    return 1;
}

e3d_status e3d_renderer_create(e3d_backend backend, int32_t threads, e3d_renderer **out)
{
    *out = NULL;
    if (threads < 0 || threads > E3D_MAX_THREADS)
        return E3D_INVALID_ARGUMENT;
    if (!e3d_backend_available(backend))
        return E3D_UNSUPPORTED_BACKEND;
    e3d_renderer *renderer = calloc(1, sizeof *renderer);
    if (!renderer)
        return E3D_OUT_OF_MEMORY;
    renderer->backend = backend;
    renderer->kernels = e3d_kernels_for(backend);
    if (backend == E3D_BACKEND_SCALAR)
        threads = 1;
    renderer->threads = threads ? threads : e3d_thread_count();
    if (backend != E3D_BACKEND_SCALAR && !create_workers(renderer)) {
        e3d_renderer_destroy(renderer);
        return E3D_OUT_OF_MEMORY;
    }
    *out = renderer;
    return E3D_OK;
}

void e3d_renderer_destroy(e3d_renderer *renderer)
{
    if (!renderer)
        return;
    for (int32_t w = 0; renderer->workers && w < renderer->threads; w++)
        destroy_worker(renderer->workers[w]);
    free(renderer->workers);
    e3d_draws_free(&renderer->draws);
    e3d_view_free(&renderer->view);
    e3d_view_free(&renderer->frozen);
    e3d_cull_free(&renderer->cull);
    e3d_histories_free(&renderer->histories);
    e3d_kept_free(&renderer->kept);
    e3d_casters_free(&renderer->casters);
    e3d_array_free(&renderer->marks);
    e3d_array_free(&renderer->tile_progress);
    e3d_array_free(&renderer->gradient);
    free(renderer);
}

e3d_status e3d_renderer_prepare(e3d_renderer *renderer, int32_t width, int32_t height, int32_t planes)
{
    int64_t across = ((int64_t)width + E3D_TILE - 1) / E3D_TILE, down = ((int64_t)height + E3D_TILE - 1) / E3D_TILE;
    if (renderer->backend == E3D_BACKEND_SCALAR || (int64_t)width * height * planes > E3D_MOST_KEPT_SAMPLES)
        return E3D_OK;
    return e3d_kept_prepare(&renderer->kept, across * down * planes) ? E3D_OK : E3D_OUT_OF_MEMORY;
}

void e3d_renderer_set_poll(e3d_renderer *renderer, int (*poll)(void *), void *user)
{
    renderer->poll = (e3d_poll){poll, user};
}
