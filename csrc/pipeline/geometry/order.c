/* order: for painter's algorithm (Newell, Newell and Sancha 1972, without splitting) and for no hidden-surface
 * removal at all, the frame's pieces are sorted before they are binned (R16), so that the last one wins.
 */
#include <stdlib.h>
#include <string.h>

#include "core/grow.h"
#include "e3d.h"
#include "kernels/coverage.h"
#include "kernels/types/records.h"
#include "pipeline/geometry/bin.h"
#include "pipeline/geometry/order.h"
#include "pipeline/state/context.h"
#include "pipeline/state/records.h"
#include "pipeline/state/renderer.h"
#include "pipeline/state/worker.h"

typedef struct entry {
    float key; /* 0 where only the order counts */
    uint32_t order, sequence;
    uint32_t worker, record;
} entry;

static int compare(const void *left, const void *right)
{
    const entry *a = left, *b = right;
    if (a->key != b->key)
        return a->key > b->key ? -1 : 1;
    if (a->order != b->order)
        return a->order < b->order ? -1 : 1;
    return a->sequence < b->sequence ? -1 : 1;
}

static size_t count_records(const e3d_renderer *renderer)
{
    size_t count = 0;
    for (int32_t w = 0; w < renderer->threads; w++)
        count += renderer->workers[w]->sets[E3D_SET_SCENE].records.count;
    return count;
}

static void list_records(const e3d_context *context, entry *entries)
{
    size_t n = 0;
    for (int32_t w = 0; w < context->renderer->threads; w++) {
        const e3d_record_set *set = &context->renderer->workers[w]->sets[E3D_SET_SCENE];
        const e3d_record *records = set->records.data;
        for (size_t r = 0; r < set->records.count; r++, n++)
            entries[n] = (entry){
                context->frame->hidden == E3D_HIDDEN_PAINTER ? ((float *)set->keys.data)[r] : 0.0f,
                records[r].order, (uint32_t)r, (uint32_t)w, (uint32_t)r};
    }
}

/* Copies the records, and the corners they refer to, in sorted order. */
static int gather(const e3d_context *context, const entry *entries, size_t count, e3d_record_set *sorted)
{
    e3d_worker **workers = context->renderer->workers;
    if (!e3d_array_reserve(&sorted->records, count, sizeof(e3d_record)) ||
        !e3d_array_reserve(&sorted->corners, count, 9 * sizeof(float)))
        return 0;
    e3d_record *records = sorted->records.data;
    float *corners = sorted->corners.data;
    for (size_t i = 0; i < count; i++) {
        const e3d_record_set *set = &workers[entries[i].worker]->sets[E3D_SET_SCENE];
        records[i] = ((const e3d_record *)set->records.data)[entries[i].record];
        if (records[i].meta & E3D_RECORD_CUT) {
            memcpy(corners + 9 * sorted->corners.count,
                   (const float *)set->corners.data + 9 * (size_t)(records[i].meta >> E3D_RECORD_SHIFT),
                   9 * sizeof(float));
            const uint32_t flags = (1u << E3D_RECORD_SHIFT) - 1;
            records[i].meta = (records[i].meta & flags) | (uint32_t)sorted->corners.count++ << E3D_RECORD_SHIFT;
        }
    }
    sorted->records.count = count;
    return 1;
}

/* Worker 0's set becomes the sorted one; the others keep nothing of this pass. */
static void install(e3d_context *context, e3d_record_set *sorted)
{
    e3d_record_set *set = &context->renderer->workers[0]->sets[E3D_SET_SCENE];
    e3d_array_free(&set->records);
    e3d_array_free(&set->corners);
    set->records = sorted->records;
    set->corners = sorted->corners;
    for (int32_t w = 1; w < context->renderer->threads; w++)
        context->renderer->workers[w]->sets[E3D_SET_SCENE].records.count = 0;
}

int e3d_sort_records(e3d_context *context)
{
    size_t count = count_records(context->renderer);
    entry *entries = malloc((count + 1) * sizeof *entries);
    e3d_record_set sorted = {0};
    if (!entries)
        return 0;
    list_records(context, entries);
    qsort(entries, count, sizeof *entries, compare);
    int done = gather(context, entries, count, &sorted);
    free(entries);
    if (!done) {
        e3d_array_free(&sorted.records);
        e3d_array_free(&sorted.corners);
        return 0;
    }
    install(context, &sorted);
    e3d_worker *worker = context->renderer->workers[0];
    e3d_record_set *set = &worker->sets[E3D_SET_SCENE];
    for (size_t r = 0; r < count; r++) {
        const e3d_record *record = (const e3d_record *)set->records.data + r;
        e3d_box box = e3d_sample_box(record->x, record->y, &context->view->viewport);
        const e3d_tile_span span = e3d_span_of(&box);
        if (!e3d_bin_records(context, worker, set, (uint32_t)r, &span, 1))
            return 0;
    }
    return 1;
}
