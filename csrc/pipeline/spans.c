/* raster without depths: few records of a tile are mostly neighbours that don't meet, and all that they cover shows. */
#include <string.h>

#include "pipeline/frame.h"

/* The records of a tile's bins; how many, or -1 where there are too many, or fragments. */
static int list_records(const e3d_context *context, int64_t tile, uint32_t ids[E3D_MOST_SPANS])
{
    uint32_t count = 0;
    for (int32_t w = 0; w < context->renderer->threads; w++) {
        const e3d_worker *worker = context->renderer->workers[w];
        const e3d_record_set *set = &worker->pass[E3D_PASS_SCENE];
        const e3d_bin_block *blocks = set->blocks.data;
        if (e3d_first_block(&worker->fragments.bins, tile) != E3D_NO_BLOCK)
            return -1;
        for (uint32_t next = e3d_first_block(&set->bins, tile); next != E3D_NO_BLOCK; next = blocks[next].next) {
            if (count + blocks[next].count > E3D_MOST_SPANS)
                return -1;
            memcpy(ids + count, blocks[next].id, blocks[next].count * sizeof *ids);
            count += blocks[next].count;
        }
    }
    return (int)count;
}

static void begin(e3d_tile_memory *memory, const e3d_tile *tile)
{
    memset(&memory->cover, 0, sizeof memory->cover);
    memory->cover.x = tile->x;
    memory->cover.y = tile->y;
    memory->cover.width = tile->width;
    memory->cover.height = tile->height;
}

static int64_t samples_of(const uint64_t rows[E3D_TILE])
{
    int64_t count = 0;
    for (int y = 0; y < E3D_TILE; y++)
        count += __builtin_popcountll(rows[y]);
    return count;
}

/* What shows of records that others meet, by their depths. */
static void show_rest(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile, int count)
{
    int gaps;
    e3d_tile_memory *memory = worker->tile;
    e3d_visible_clear(worker->visible, tile);
    context->kernels->raster_visible(worker->visible, &context->tables[E3D_PASS_SCENE], memory->rest, count);
    int32_t runs = context->kernels->find_runs(worker->visible, tile->width, tile->height, memory->runs, &gaps);
    e3d_show_runs(e3d_sort_runs(memory->runs, memory->spare, runs), runs, &memory->shown);
}

/* Makes the list of what shows of records; how many of them others meet, or -1 where spans will not do. */
static int show(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile, int count)
{
    const e3d_kernels *kernels = context->kernels;
    const e3d_record_table *table = &context->tables[E3D_PASS_SCENE];
    e3d_tile_memory *memory = worker->tile;
    begin(memory, tile);
    e3d_shown_begin(&memory->shown, 1);
    if (!kernels->cover_records(&memory->cover, table, memory->ids, count, &memory->shown))
        return -1;
    int64_t twice = samples_of(memory->cover.twice);
    if (!twice)
        return 0;
    if (2 * twice > samples_of(memory->cover.once))
        return -1;
    e3d_shown_begin(&memory->shown, 1);
    int rest = kernels->show_alone(&memory->cover, table, memory->ids, count, &memory->shown, memory->rest);
    show_rest(context, worker, tile, rest);
    return rest;
}

/* Tiles that follow each other are alike: where spans did not pay, more and more of them go without. */
static void judge(e3d_spans_trial *trial, int pays)
{
    enum { MOST = 15 };
    trial->without = pays ? 0 : 2 * trial->without + 1 < MOST ? 2 * trial->without + 1 : MOST;
    trial->left = trial->without;
}

int e3d_show_spans(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile, int64_t number)
{
    if (worker->trial.left > 0) {
        worker->trial.left--;
        return 0;
    }
    int count = list_records(context, number, worker->tile->ids);
    if (count <= 0)
        return 0;
    int rest = show(context, worker, tile, count);
    judge(&worker->trial, rest >= 0 && 2 * rest <= count);
    return rest >= 0;
}

int e3d_spans_cover_all(const e3d_cover *cover)
{
    uint64_t row = ~(uint64_t)0 >> (E3D_TILE - cover->width), all = row;
    for (int32_t y = 0; y < cover->height; y++)
        all &= cover->once[y];
    return all == row;
}
