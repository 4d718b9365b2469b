/* Layers: the records of many draws, in the order of drawing, and which of them each band of rows needs.
 * In: draws and a view. Out: a layer. Always: the order is that of the draws, whichever thread set them up. */
#include <stdatomic.h>

#include "base/pool.h"
#include "extras/mujoco/geometry.h"

typedef struct part {
    int32_t worker;
    size_t first, count;            /* of the worker's records */
} part;

typedef struct layer_job {
    muj_layer *layer;
    const muj_picture *picture;
    int32_t first, count;
    atomic_int next;
} layer_job;

static int set_up_shape(const layer_job *job, int32_t number, const muj_draw *draw, int32_t facing, muj_worker *worker)
{
    const muj_view *view = job->layer->view;
    if (muj_is_outside(draw, view))
        return 1;
    if (!muj_choose(job->picture->kernels, draw, view, facing, worker))
        return 0;
    const int32_t *chosen = worker->chosen.data;
    for (size_t i = 0; i < worker->chosen.count; i++)
        muj_set_up(view, number, draw, facing, chosen[i], worker);
    return 1;
}

static int set_up_draw(const layer_job *job, int32_t number, muj_worker *worker)
{
    const muj_view *view = job->layer->view;
    const e3d_muj_frame *frame = job->picture->frame;
    const muj_draw *draw = muj_draw_of(job->picture, number);
    int32_t facing = view->is_mirrored ? -draw->facing : draw->facing;
    if (view->is_mirrored && (draw->is_reflective || !draw->geom))
        return 1;
    if (draw->kind == MUJ_LINES)
        muj_set_up_lines(view, number, draw, &worker->records);
    else if (frame->is_wireframe && draw->geom && !frame->is_segmented)
        muj_set_up_wireframe(view, number, draw, facing, frame->line_width, &worker->records);
    else if (draw->kind == MUJ_GRID)
        muj_set_up_grid(view, number, draw, facing, &worker->records);
    else
        return set_up_shape(job, number, draw, facing, worker);
    return 1;
}

static void set_up_some(void *argument, int number)
{
    layer_job *job = argument;
    muj_worker *worker = &job->layer->workers[number];
    part *parts = job->layer->parts.data;
    for (;;) {
        int32_t i = atomic_fetch_add(&job->next, 1);
        if (i >= job->count)
            return;
        parts[i] = (part){number, worker->records.count, 0};
        if (!set_up_draw(job, job->first + i, worker) || !muj_new_record(&worker->records))
            worker->failed = 1; /* if memory was out for a record, it is still so */
        parts[i].count = worker->records.count - parts[i].first;
    }
}

/* Lists the records in the order of the draws. */
static int list_records(muj_layer *layer, int32_t count)
{
    const part *parts = layer->parts.data;
    size_t total = 0;
    for (int32_t w = 0; w < layer->worker_count; w++)
        total += layer->workers[w].records.count;
    if (total > INT32_MAX || !e3d_array_reserve(&layer->records, total + 1, sizeof(muj_record *)))
        return 0;
    muj_record **out = layer->records.data;
    layer->records.count = total;
    for (int32_t i = 0; i < count; i++) {
        muj_record *from = (muj_record *)layer->workers[parts[i].worker].records.data + parts[i].first;
        for (size_t k = 0; k < parts[i].count; k++)
            *out++ = from + k;
    }
    return 1;
}

/* Lists for each band the records that reach it, in order (a counting sort). */
static int list_bands(muj_layer *layer, int32_t height)
{
    int32_t bands = (height + MUJ_BAND - 1) / MUJ_BAND;
    if (!e3d_array_reserve(&layer->starts, (size_t)bands + 2, sizeof(int32_t)))
        return 0;
    int32_t *starts = layer->starts.data;
    memset(starts, 0, ((size_t)bands + 2) * sizeof *starts);
    muj_record **records = layer->records.data;
    int64_t total = 0;
    for (size_t i = 0; i < layer->records.count; i++)
        for (int32_t b = records[i]->y0 / MUJ_BAND; b <= records[i]->y1 / MUJ_BAND; b++, total++)
            starts[b + 2]++;
    if (total > INT32_MAX || !e3d_array_reserve(&layer->items, (size_t)total + 1, sizeof(int32_t)))
        return 0;
    for (int32_t b = 0; b < bands; b++)
        starts[b + 2] += starts[b + 1];
    int32_t *items = layer->items.data;
    for (size_t i = 0; i < layer->records.count; i++)
        for (int32_t b = records[i]->y0 / MUJ_BAND; b <= records[i]->y1 / MUJ_BAND; b++)
            items[starts[b + 1]++] = (int32_t)i;
    return 1;
}

int muj_set_layer(muj_layer *layer, const muj_picture *picture, const muj_view *view, int32_t first, int32_t count, int32_t threads)
{
    layer_job job = {.layer = layer, .picture = picture, .first = first, .count = count};
    if (layer->worker_count < threads) {
        muj_worker *workers = realloc(layer->workers, (size_t)threads * sizeof *workers);
        if (!workers)
            return 0;
        memset(workers + layer->worker_count, 0, (size_t)(threads - layer->worker_count) * sizeof *workers);
        layer->workers = workers;
        layer->worker_count = threads;
    }
    layer->view = view;
    for (int32_t w = 0; w < layer->worker_count; w++) {
        layer->workers[w].records.count = 0;
        layer->workers[w].failed = 0;
    }
    if (!e3d_array_reserve(&layer->parts, (size_t)count + 1, sizeof(part)))
        return 0;
    e3d_pool_run(threads, set_up_some, &job);
    for (int32_t w = 0; w < layer->worker_count; w++)
        if (layer->workers[w].failed)
            return 0;
    return list_records(layer, count) && list_bands(layer, picture->frame->height);
}

void muj_free_layer(muj_layer *layer)
{
    for (int32_t w = 0; w < layer->worker_count; w++)
        muj_free_worker(&layer->workers[w]);
    free(layer->workers);
    e3d_array_free(&layer->parts);
    e3d_array_free(&layer->records);
    e3d_array_free(&layer->starts);
    e3d_array_free(&layer->items);
}
