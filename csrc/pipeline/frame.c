/* A frame: prepare -> geometry (cull, transform, clip, setup, bin) -> tiles (raster, shade, resolve). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/clock.h"
#include "core/fpenv.h"
#include "core/grow.h"
#include "core/limits.h"
#include "e3d.h"
#include "kernels/kernels.h"
#include "kernels/types/visible.h"
#include "pipeline/bin.h"
#include "pipeline/counts.h"
#include "pipeline/cull.h"
#include "pipeline/fragments.h"
#include "pipeline/frame.h"
#include "pipeline/geometry.h"
#include "pipeline/occlusion.h"
#include "pipeline/order.h"
#include "pipeline/outputs.h"
#include "pipeline/plan.h"
#include "pipeline/prepare.h"
#include "pipeline/records.h"
#include "pipeline/tile.h"
#include "reference/reference.h"

/* ---- renderers ---- */

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
    worker->tile->rgba = worker->tile->pixels[0];
    for (int i = 0; i < E3D_TILE_SAMPLES + E3D_PAD; i++)
        worker->tile->bound[i] = E3D_BEYOND_FAR;
    return worker;
}

static void destroy_worker(e3d_worker *worker)
{
    if (!worker)
        return;
    for (int p = 0; p < E3D_PASSES; p++) {
        e3d_record_set *set = &worker->pass[p];
        e3d_array *arrays[] = {&set->records, &set->corners, &set->keys, &set->blocks, &set->bins, &set->earlier};
        for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
            e3d_array_free(arrays[i]);
    }
    e3d_array_free(&worker->fragments.blocks);
    e3d_array_free(&worker->fragments.bins);
    e3d_array_free(&worker->fragments.earlier);
    e3d_array_free(&worker->fragments.drawn);
    e3d_array_free(&worker->slots);
    e3d_array_free(&worker->orders);
    e3d_array_free(&worker->items);
    e3d_array_free(&worker->pieces);
    e3d_array_free(&worker->groups);
    e3d_array_free(&worker->outputs);
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
    e3d_array_free(&renderer->draws);
    e3d_array *arrays[] = {&renderer->instances, &renderer->turns, &renderer->marks, &renderer->reach, &renderer->tasks, &renderer->items, &renderer->seen,
                           &renderer->seen_before, &renderer->rows, &renderer->rows_before,
                           &renderer->tile_depths};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
        e3d_array_free(arrays[i]);
    free(renderer->kept);
    free(renderer);
}

void e3d_renderer_set_poll(e3d_renderer *renderer, int (*poll)(void *), void *user)
{
    renderer->poll = poll;
    renderer->poll_user = user;
}

/* ---- arguments ---- */

static int poses_are_valid(const e3d_frame *f, const e3d_draw *draw)
{
    if (draw->pose_kind == E3D_POSE_NONE)
        return draw->instances == 1;
    if (draw->pose_kind == E3D_POSE_NODES)
        return f->order && (!draw->instances || (draw->node_worlds && draw->node_ids));
    return !draw->instances || draw->poses;
}

static int frame_is_valid(const e3d_frame *f)
{
    if (f->width < 1 || f->height < 1 || f->width > E3D_MAX_SIZE || f->height > E3D_MAX_SIZE ||
        (f->samples_axis != 1 && f->samples_axis != 2 && f->samples_axis != 4))
        return 0;
    if (!(f->line_width > 0 && f->line_width <= 256) || !(f->point_size > 0 && f->point_size <= 256))
        return 0;
    if (f->draw_count < 0 || f->material_count < 0 || f->light_count < 0 ||
        (f->order && f->order_count < 0))
        return 0;
    for (int32_t d = 0; d < f->draw_count; d++) {
        const e3d_draw *draw = &f->draws[d];
        if (!draw->mesh || draw->instances < 0 || !poses_are_valid(f, draw) || draw->material_base < 0 ||
            (int64_t)draw->material_base + draw->mesh->material_most >= f->material_count)
            return 0;
    }
    return 1;
}

/* ---- a frame ---- */

static int reset_workers(e3d_context *context)
{
    e3d_renderer *renderer = context->renderer;
    for (int32_t w = 0; w < renderer->threads; w++) {
        e3d_worker *worker = renderer->workers[w];
        memset(&worker->counters, 0, sizeof worker->counters);
        worker->failed = 0;
        if (!e3d_fragments_reset(&worker->fragments, (int32_t)e3d_tile_count(context)))
            return 0;
        for (int p = 0; p < E3D_PASSES; p++)
            if (!e3d_records_reset(&worker->pass[p], (int32_t)e3d_tile_count(context)))
                return 0;
    }
    return 1;
}

static int any_failed(const e3d_renderer *renderer)
{
    for (int32_t w = 0; w < renderer->threads; w++)
        if (renderer->workers[w]->failed)
            return 1;
    return 0;
}

/* Draws some of the items, and keeps what they cover for the rounds to come. */
static int draw_round(e3d_context *context, e3d_stats *stats, e3d_round round)
{
    int64_t start = e3d_now_ns();
    context->round = round;
    e3d_geometry(context);
    stats->ms_geometry += (double)(e3d_now_ns() - start) * 1e-6;
    stats->rounds++;
    return (round.last || e3d_draw_kept_tiles(context)) && !any_failed(context->renderer);
}

/* What the last frames showed, then what came into view since. */
static int draw_remembered(e3d_context *context, e3d_stats *stats)
{
    int64_t end = context->item_count;
    e3d_round seen = {.choice = E3D_SEEN_ITEMS, .end = end, .finished = e3d_finishes_early(context)};
    e3d_round unseen = {.choice = E3D_UNSEEN_ITEMS, .end = end, .tested = 1, .last = 1};
    if (!draw_round(context, stats, seen) || !draw_round(context, stats, unseen))
        return 0;
    e3d_count_changed_tiles(context);
    return 1;
}

/* Geometry, in as many rounds as pay; the bins of the last are drawn with the tiles. */
static int draw_rounds(e3d_context *context, e3d_stats *stats)
{
    int64_t count = context->item_count, done = 0;
    if (!e3d_occlusion_pays(context) || !e3d_occlusion_begin(context))
        return draw_round(context, stats, (e3d_round){.end = count, .last = 1});
    int remembered = e3d_remember(context);
    if (remembered < 0)
        return 0;
    if (remembered)
        return draw_remembered(context, stats);
    for (int64_t end = count / 32 + 1; 2 * end < count; end *= 2) {
        if (!draw_round(context, stats, (e3d_round){.first = done, .end = end, .tested = done > 0}))
            return 0;
        done = end;
    }
    return draw_round(context, stats, (e3d_round){.first = done, .end = count, .tested = 1, .last = 1});
}

static e3d_status run(e3d_context *context, e3d_stats *stats)
{
    int64_t start = e3d_now_ns();
    e3d_status status = e3d_prepare(context);
    if (status != E3D_OK)
        return status;
    if (!reset_workers(context) || !e3d_outputs_prepare(context))
        return E3D_OUT_OF_MEMORY;
    if (!e3d_find_items(context))
        return E3D_OUT_OF_MEMORY;
    stats->ms_geometry = (double)(e3d_now_ns() - start) * 1e-6;
    if (!draw_rounds(context, stats) || (e3d_plans(context, E3D_PLAN_SORTS) && !e3d_sort_records(context)))
        return E3D_OUT_OF_MEMORY;
    e3d_tiles(context);
    if (any_failed(context->renderer))
        return E3D_OUT_OF_MEMORY;
    e3d_count(context, stats);
    if (stats->rounds > 1)
        e3d_occlusion_judge(context, stats);
    stats->ms_total = (double)(e3d_now_ns() - start) * 1e-6;
    return context->cancelled ? E3D_CANCELLED : E3D_OK;
}

e3d_status e3d_render(e3d_renderer *renderer, const e3d_frame *frame, const e3d_targets *targets,
                      e3d_stats *stats)
{
    e3d_stats unused;
    if (!stats)
        stats = &unused;
    memset(stats, 0, sizeof *stats);
    if (!frame_is_valid(frame))
        return E3D_INVALID_ARGUMENT;
    if (renderer->backend == E3D_BACKEND_SCALAR) {
        e3d_status done = e3d_reference_render(frame, targets, stats);
        e3d_count_submitted(frame, stats);
        return done;
    }
    e3d_context context = {.renderer = renderer,
                           .kernels = renderer->kernels,
                           .frame = frame,
                           .targets = targets};
    e3d_fpenv saved = e3d_fpenv_enter();
    e3d_status status = run(&context, stats);
    e3d_fpenv_leave(saved);
    return status;
}
