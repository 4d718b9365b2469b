/* A renderer: the memory of its threads, kept from frame to frame. */
#include <stdlib.h>
#include <string.h>

#include "core/grow.h"
#include "core/limits.h"
#include "e3d.h"
#include "kernels/kernels.h"
#include "pipeline/cull/cull.h"
#include "pipeline/cull/history.h"
#include "pipeline/frame/rounds.h"
#include "pipeline/geometry/bin.h"
#include "pipeline/geometry/fragments.h"
#include "pipeline/pass/draws.h"
#include "pipeline/pass/view.h"
#include "pipeline/shade/surface.h"
#include "pipeline/state/renderer.h"
#include "pipeline/state/tile_memory.h"
#include "pipeline/state/worker.h"
#include "pipeline/tile/slots.h"

static e3d_worker *create_worker(uint32_t number)
{
    void *own = NULL, *memory = NULL;
    if (posix_memalign(&own, 64, sizeof(e3d_worker)) || posix_memalign(&memory, 64, sizeof(e3d_tile_memory))) {
        free(own);
        return NULL;
    }
    e3d_worker *worker = memset(own, 0, sizeof *worker);
    worker->number = number;
    worker->tile = memory;
    memset(worker->tile, 0, sizeof *worker->tile); /* padding is read, never used */
    e3d_marks_init(&worker->tile->marks);
    return worker;
}

static void destroy_worker(e3d_worker *worker)
{
    if (!worker)
        return;
    for (int p = 0; p < E3D_SETS; p++)
        e3d_records_free(&worker->sets[p]);
    e3d_fragments_free(&worker->fragments);
    e3d_slots_free(&worker->slots);
    e3d_array_free(&worker->cull.candidates);
    e3d_surface_free(&worker->surface);
    e3d_array_free(&worker->outputs.words);
    free(worker->tile);
    free(worker);
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
    renderer->threads = backend == E3D_BACKEND_SCALAR ? 1 : threads ? threads : e3d_thread_count();
    renderer->workers = calloc((size_t)renderer->threads, sizeof *renderer->workers);
    int made = renderer->workers != NULL;
    for (int32_t w = 0; made && w < renderer->threads && backend != E3D_BACKEND_SCALAR; w++)
        made = (renderer->workers[w] = create_worker((uint32_t)w)) != NULL;
    if (!made) {
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
    e3d_cull_free(&renderer->cull);
    e3d_histories_free(&renderer->histories);
    e3d_kept_free(&renderer->kept);
    e3d_array_free(&renderer->marks);
    e3d_array_free(&renderer->tile_progress);
    free(renderer);
}

void e3d_renderer_set_poll(e3d_renderer *renderer, int (*poll)(void *), void *user)
{
    renderer->poll = poll;
    renderer->poll_user = user;
}
