/* bin: records to the tiles that they may cover.
 *
 * A record in one tile goes there; a larger one is tried edge by edge against each tile of its box. Bins are
 * each thread's own; the raster's rule (R16) makes their order irrelevant.
 */
#include "pipeline/frame.h"

e3d_box e3d_sample_box(const int32_t x[3], const int32_t y[3], const e3d_viewport *viewport)
{
    int32_t xlo = x[0], xhi = x[0], ylo = y[0], yhi = y[0];
    for (int k = 1; k < 3; k++) {
        xlo = xlo < x[k] ? xlo : x[k];
        xhi = xhi > x[k] ? xhi : x[k];
        ylo = ylo < y[k] ? ylo : y[k];
        yhi = yhi > y[k] ? yhi : y[k];
    }
    e3d_box box = {(xlo + 127) >> 8, (ylo + 127) >> 8, (xhi - 128) >> 8, (yhi - 128) >> 8};
    box.x0 = box.x0 > 0 ? box.x0 : 0;
    box.y0 = box.y0 > 0 ? box.y0 : 0;
    box.x1 = box.x1 < viewport->width - 1 ? box.x1 : viewport->width - 1;
    box.y1 = box.y1 < viewport->height - 1 ? box.y1 : viewport->height - 1;
    return box;
}

e3d_edge e3d_edge_at(const e3d_record *r, int k, int32_t x, int32_t y)
{
    int i = (k + 1) % 3, j = (k + 2) % 3;
    e3d_edge edge = {0, r->y[i] - r->y[j], r->x[j] - r->x[i]};
    int64_t value = (int64_t)edge.a * (256 * (int64_t)x + 128 - r->x[i]) +
                    (int64_t)edge.b * (256 * (int64_t)y + 128 - r->y[i]);
    int top_left = edge.a > 0 || (edge.a == 0 && edge.b > 0);
    edge.e = (value - !top_left) >> 8;
    return edge;
}

int e3d_bins_reset(e3d_record_set *set, int32_t tiles)
{
    set->records.count = set->corners.count = set->keys.count = set->blocks.count = 0;
    if (!e3d_array_reserve(&set->bins, (size_t)tiles, sizeof(e3d_bin)))
        return 0;
    e3d_bin *bins = set->bins.data;
    for (int32_t t = 0; t < tiles; t++)
        bins[t].first = bins[t].last = E3D_NO_BLOCK;
    return 1;
}

static int push(e3d_record_set *set, e3d_bin *bin, uint32_t record)
{
    e3d_bin_block *blocks = set->blocks.data;
    if (bin->last == E3D_NO_BLOCK || blocks[bin->last].count == 30) {
        if (!e3d_array_reserve(&set->blocks, set->blocks.count + 1, sizeof(e3d_bin_block)))
            return 0;
        blocks = set->blocks.data;
        uint32_t fresh = (uint32_t)set->blocks.count++;
        blocks[fresh].next = E3D_NO_BLOCK;
        blocks[fresh].count = 0;
        if (bin->last == E3D_NO_BLOCK)
            bin->first = fresh;
        else
            blocks[bin->last].next = fresh;
        bin->last = fresh;
    }
    e3d_bin_block *block = &blocks[bin->last];
    block->record[block->count++] = record;
    return 1;
}

static int misses_tile(const e3d_record *record, int32_t x, int32_t y)
{
    for (int k = 0; k < 3; k++) {
        e3d_edge edge = e3d_edge_at(record, k, x, y);
        int64_t most = edge.e + (edge.a > 0 ? (int64_t)edge.a * (E3D_TILE - 1) : 0) +
                       (edge.b > 0 ? (int64_t)edge.b * (E3D_TILE - 1) : 0);
        if (most < 0)
            return 1;
    }
    return 0;
}

int e3d_bin_record(const e3d_context *context, e3d_worker *worker, e3d_record_set *set, uint32_t number)
{
    const e3d_record record = ((e3d_record *)set->records.data)[number];
    e3d_box box = e3d_sample_box(record.x, record.y, &context->viewport);
    int32_t tx0 = box.x0 / E3D_TILE, tx1 = box.x1 / E3D_TILE;
    int32_t ty0 = box.y0 / E3D_TILE, ty1 = box.y1 / E3D_TILE;
    int single = tx0 == tx1 && ty0 == ty1;
    e3d_bin *bins = set->bins.data;
    for (int32_t ty = ty0; ty <= ty1; ty++)
        for (int32_t tx = tx0; tx <= tx1; tx++) {
            if (!single && misses_tile(&record, tx * E3D_TILE, ty * E3D_TILE))
                continue;
            if (!push(set, &bins[(int64_t)ty * context->tiles_x + tx], number))
                return 0;
            worker->counters.bin_entries++;
        }
    return 1;
}
