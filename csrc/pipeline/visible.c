/* raster, the visible surface: a tile's records to the IDs that its samples keep, and those to runs of slots.
 *
 * Slots are numbered as runs need them, so that what is hidden costs shading nothing.
 */
#include <string.h>

#include "pipeline/frame.h"

void e3d_visible_clear(e3d_visible_tile *visible, const e3d_tile *tile)
{
    for (int b = 0; b < E3D_TILE_BLOCKS; b++) {
        visible->zmin[b] = visible->zmax[b] = E3D_BEYOND_FAR;
        visible->noted_id[b] = E3D_NO_SLOT;
    }
    visible->noted = ~(uint64_t)0;
    visible->stale = 0;
    visible->x = tile->x;
    visible->y = tile->y;
}

void e3d_visible_draw(const e3d_context *context, e3d_visible_tile *visible, int64_t tile_number)
{
    const e3d_renderer *renderer = context->renderer;
    for (int32_t w = 0; w < renderer->threads; w++) {
        const e3d_record_set *set = &renderer->workers[w]->pass[E3D_PASS_SCENE];
        const e3d_bin_block *blocks = set->blocks.data;
        uint32_t next = ((const e3d_bin *)set->bins.data)[tile_number].first;
        for (; next != E3D_NO_BLOCK; next = blocks[next].next)
            context->kernels->raster_visible(visible, &context->tables[E3D_PASS_SCENE], blocks[next].id,
                                             (int)blocks[next].count);
        e3d_fragments_draw(context, renderer->workers[w], visible, tile_number);
    }
}

/* ---- slots ---- */

static const float *corners_of(const e3d_context *context, int pass, uint32_t id, const e3d_record *record)
{
    const e3d_worker *owner = context->renderer->workers[id & ((1u << context->tables[pass].bits) - 1)];
    return record->meta & E3D_RECORD_CUT
               ? (const float *)owner->pass[pass].corners.data + 9 * (size_t)(record->meta >> E3D_RECORD_SHIFT)
               : NULL;
}

int e3d_add_slot(const e3d_context *context, e3d_worker *worker, int pass, uint32_t id)
{
    if (!e3d_array_reserve(&worker->slots, worker->slots.count + 1, sizeof(e3d_slot)))
        return 0;
    e3d_slot *slot = (e3d_slot *)worker->slots.data + worker->slots.count++;
    *slot = (e3d_slot){NULL, NULL, id, -1};
    if (id & E3D_FRAGMENT_ID) {
        int32_t triangle;
        __builtin_prefetch(e3d_drawn_at(&context->tables[pass], id, &triangle)->faces + triangle);
        return 1;
    }
    slot->record = e3d_record_at(&context->tables[pass], id);
    slot->corners = corners_of(context, pass, id, slot->record);
    return 1;
}

/* A table of at least twice as many places as there are runs, all free; its size less one, or 0. */
static uint32_t clear_names(e3d_worker *worker, int32_t runs)
{
    uint32_t size = 16;
    while (size < 2 * (uint32_t)runs)
        size *= 2;
    if (!e3d_array_reserve(&worker->named, size, sizeof(e3d_named)))
        return 0;
    memset(worker->named.data, 0xFF, size * sizeof(e3d_named));
    return size - 1;
}

/* The slot of a record ID, made when it is met first; -1 when memory is out. */
static int32_t slot_of(const e3d_context *context, e3d_worker *worker, int32_t id, uint32_t mask)
{
    e3d_named *names = worker->named.data;
    uint32_t at = ((uint32_t)id * 0x9E3779B1u >> 7) & mask;
    while (names[at].id != id) {
        if (names[at].id == E3D_NO_SLOT) {
            names[at] = (e3d_named){id, (int32_t)worker->slots.count};
            return e3d_add_slot(context, worker, E3D_PASS_SCENE, (uint32_t)id) ? names[at].slot : -1;
        }
        at = (at + 1) & mask;
    }
    return names[at].slot;
}

/* What an ID stands for may be anywhere in memory. */
static void fetch_ahead(const e3d_record_table *table, uint32_t id)
{
    int32_t triangle;
    __builtin_prefetch(id & E3D_FRAGMENT_ID ? (const void *)e3d_drawn_at(table, id, &triangle)
                                            : (const void *)e3d_record_at(table, id));
}

int32_t e3d_visible_runs(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile)
{
    enum { AHEAD = 16 };
    e3d_run *runs = worker->tile->runs;
    int32_t count = context->kernels->find_runs(worker->visible->id, tile->width, tile->height, runs);
    uint32_t mask = clear_names(worker, count);
    worker->slots.count = 0;
    if (!mask)
        return -1;
    for (int32_t i = 0; i < count; i++) {
        if (i + AHEAD < count)
            fetch_ahead(&context->tables[E3D_PASS_SCENE], (uint32_t)runs[i + AHEAD].owner);
        runs[i].owner = slot_of(context, worker, runs[i].owner, mask);
        if (runs[i].owner < 0)
            return -1;
    }
    return count;
}
