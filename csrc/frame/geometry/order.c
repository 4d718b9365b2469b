/* order: sorts the frame's records before they are binned (R16), so that the last one wins. This is for the painter's algorithm
 * (Newell, Newell and Sancha 1972, without splitting) and for no hidden-surface removal. */
#include <stdlib.h>
#include <string.h>

#include "base/grow.h"
#include "e3d.h"
#include "kernels/coverage.h"
#include "kernels/types/records.h"
#include "frame/geometry/order.h"
#include "frame/geometry/records.h"
#include "frame/geometry/setup.h"
#include "frame/pass/draws.h"
#include "frame/pass/plan.h"

typedef struct entry {
    float key; /* 0 if only the order counts */
    uint32_t order, worker, record;
} entry;

static int compare(const void *left, const void *right)
{
    const entry *a = left, *b = right;
    if (a->key != b->key)
        return a->key > b->key ? -1 : 1;
    if (a->order != b->order)
        return a->order < b->order ? -1 : 1;
    return a->record < b->record ? -1 : 1;
}

static size_t count_records(const e3d_bins *bins)
{
    size_t count = 0;
    for (int32_t t = 0; t < bins->threads; t++)
        count += bins->of[t]->sets[E3D_SET_SCENE].records.count;
    return count;
}

/* Lists the records to be sorted. `keyed`: depth comes before order. */
static void list_records(const e3d_bins *bins, int keyed, entry *entries)
{
    size_t n = 0;
    for (int32_t t = 0; t < bins->threads; t++) {
        const e3d_record_set *set = &bins->of[t]->sets[E3D_SET_SCENE];
        const e3d_record *records = set->records.data;
        for (size_t r = 0; r < set->records.count; r++, n++)
            entries[n] = (entry){keyed ? ((float *)set->keys.data)[r] : 0.0f, records[r].order, (uint32_t)t, (uint32_t)r};
    }
}

/* Copies the records and their corners in sorted order. */
static int gather(const e3d_bins *bins, const entry *entries, size_t count, e3d_record_set *sorted)
{
    if (!e3d_array_reserve(&sorted->records, count, sizeof(e3d_record)) ||
        !e3d_array_reserve(&sorted->corners, count, 9 * sizeof(float)))
        return 0;
    e3d_record *records = sorted->records.data;
    float *corners = sorted->corners.data;
    for (size_t i = 0; i < count; i++) {
        const e3d_record_set *set = &bins->of[entries[i].worker]->sets[E3D_SET_SCENE];
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

/* Worker 0 gets the sorted set; the other workers' sets are emptied. */
static void install(e3d_bins *bins, e3d_record_set *sorted)
{
    e3d_record_set *set = &bins->of[0]->sets[E3D_SET_SCENE];
    e3d_array_free(&set->records);
    e3d_array_free(&set->corners);
    set->records = sorted->records;
    set->corners = sorted->corners;
    for (int32_t t = 1; t < bins->threads; t++)
        bins->of[t]->sets[E3D_SET_SCENE].records.count = 0;
}

/* The alpha list of a record. */
static int alpha_of(const e3d_prepared *pass, const e3d_record *record, e3d_instance_finder *finder)
{
    if (!e3d_plans(pass, E3D_PLAN_ALPHA_BINS))
        return E3D_ALPHA_NONE;
    int32_t primitive = e3d_find_primitive(pass->draws, record->order, finder);
    return e3d_alpha_kind_of(pass, finder->draw, primitive);
}

/* Bins the records of worker 0, in their order. */
static int bin_sorted(const e3d_prepared *pass, e3d_bins *bins, size_t count)
{
    e3d_record_set *set = &bins->of[0]->sets[E3D_SET_SCENE];
    e3d_instance_finder finder = {0};
    for (size_t r = 0; r < count; r++) {
        const e3d_record *record = (const e3d_record *)set->records.data + r;
        e3d_box box = e3d_sample_box(record->x, record->y, &pass->view->viewport);
        const e3d_tile_rect span = e3d_tile_rect_of(&box);
        e3d_chains *chains = e3d_chains_of(set, alpha_of(pass, record, &finder));
        if (!e3d_bin_records(pass->view, bins->of[0], set, chains, (uint32_t)r, &span, 1))
            return 0;
    }
    e3d_bins_index(bins);
    return 1;
}

int e3d_sort_records(const e3d_prepared *pass, e3d_bins *bins)
{
    size_t count = count_records(bins);
    entry *entries = malloc((count + 1) * sizeof *entries);
    e3d_record_set sorted = {0};
    if (!entries)
        return 0;
    list_records(bins, pass->frame->hidden == E3D_HIDDEN_PAINTER, entries);
    qsort(entries, count, sizeof *entries, compare);
    int done = gather(bins, entries, count, &sorted);
    free(entries);
    if (!done) {
        e3d_array_free(&sorted.records);
        e3d_array_free(&sorted.corners);
        return 0;
    }
    install(bins, &sorted);
    return bin_sorted(pass, bins, count);
}
