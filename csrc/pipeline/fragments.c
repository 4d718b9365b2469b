/* bin and raster of small triangles: fragments to the tiles that they lie in, and from there to the visible surface.
 *
 * A triangle of a few samples is cheaper as these than as a record: 10 bytes a sample, written and read one after the other. What
 * shading needs of the triangle it finds again by its ID.
 */
#include <string.h>

#include "pipeline/frame.h"

int e3d_fragments_reset(e3d_fragment_set *set, int32_t tiles)
{
    set->drawn.count = 0;
    if (!e3d_array_reserve(&set->bins, (size_t)tiles, sizeof(e3d_bin)))
        return 0;
    e3d_bins_clear(&set->bins, &set->blocks, tiles);
    return 1;
}

int e3d_fragments_number(const e3d_context *context, const e3d_worker *worker, e3d_fragment_ids *out)
{
    size_t number = worker->fragments.drawn.count;
    int bits = context->tables[E3D_PASS_SCENE].bits;
    if (number >= (size_t)E3D_FRAGMENT_ID / E3D_CLUSTER_TRIANGLES >> bits)
        return 0;
    int32_t first = (int32_t)(number * E3D_CLUSTER_TRIANGLES) << bits;
    *out = (e3d_fragment_ids){E3D_FRAGMENT_ID | first | (int32_t)worker->number, 1 << bits, context->tiles_x};
    return 1;
}

/* The tile's last block, with room; NULL when memory is out. */
static inline e3d_fragment_block *open_block(e3d_fragment_set *set, e3d_bin *bin)
{
    e3d_fragment_block *blocks = set->blocks.data;
    if (bin->last != E3D_NO_BLOCK && blocks[bin->last].count < E3D_BLOCK_FRAGMENTS)
        return &blocks[bin->last];
    if (!e3d_array_reserve(&set->blocks, set->blocks.count + 1, sizeof *blocks))
        return NULL;
    blocks = set->blocks.data;
    uint32_t fresh = (uint32_t)set->blocks.count++;
    blocks[fresh].next = E3D_NO_BLOCK;
    blocks[fresh].count = 0;
    *(bin->last == E3D_NO_BLOCK ? &bin->first : &blocks[bin->last].next) = fresh;
    bin->last = fresh;
    return &blocks[fresh];
}

/* All fragments of the cluster to one tile. */
static int append_all(e3d_fragment_set *set, e3d_bin *bin)
{
    const e3d_fragments *from = &set->of_cluster;
    for (uint32_t first = 0, all = (uint32_t)from->count; first < all;) {
        e3d_fragment_block *block = open_block(set, bin);
        if (!block)
            return 0;
        uint32_t at = block->count, room = E3D_BLOCK_FRAGMENTS - at, count = all - first < room ? all - first : room;
        memcpy(block->z + at, from->z + first, count * sizeof *block->z);
        memcpy(block->id + at, from->id + first, count * sizeof *block->id);
        for (uint32_t i = 0; i < count; i++)
            block->sample[at + i] = (uint16_t)(from->place[first + i] % E3D_TILE_SAMPLES);
        block->count += count;
        first += count;
    }
    return 1;
}

/* Each to the tile that it lies in. */
static int append_each(e3d_fragment_set *set)
{
    const e3d_fragments *from = &set->of_cluster;
    for (int32_t i = 0; i < from->count; i++) {
        e3d_fragment_block *block = open_block(set, (e3d_bin *)set->bins.data + (from->place[i] >> E3D_PLACE_BITS));
        if (!block)
            return 0;
        block->z[block->count] = from->z[i];
        block->id[block->count] = from->id[i];
        block->sample[block->count++] = (uint16_t)(from->place[i] % E3D_TILE_SAMPLES);
    }
    return 1;
}

int e3d_fragments_bin(e3d_worker *worker, const e3d_drawn_cluster *drawn)
{
    e3d_fragment_set *set = &worker->fragments;
    const uint32_t *place = set->of_cluster.place;
    uint32_t differ = 0;
    int32_t count = set->of_cluster.count;
    if (!count)
        return 1;
    if (!e3d_array_reserve(&set->drawn, set->drawn.count + 1, sizeof *drawn))
        return 0;
    ((e3d_drawn_cluster *)set->drawn.data)[set->drawn.count++] = *drawn;
    worker->counters.bin_entries += count;
    for (int32_t i = 1; i < count; i++)
        differ |= place[i] ^ place[0];
    return differ >> E3D_PLACE_BITS ? append_each(set)
                                    : append_all(set, (e3d_bin *)set->bins.data + (place[0] >> E3D_PLACE_BITS));
}

void e3d_fragments_draw(const e3d_context *context, const e3d_worker *worker, e3d_visible_tile *visible, int64_t tile_number)
{
    enum { LINE = 64 }; /* of a cache */
    const e3d_fragment_block *blocks = worker->fragments.blocks.data;
    uint32_t next = ((const e3d_bin *)worker->fragments.bins.data)[tile_number].first;
    for (; next != E3D_NO_BLOCK; next = blocks[next].next) {
        if (blocks[next].next != E3D_NO_BLOCK)
            for (size_t at = 0; at < sizeof *blocks; at += LINE)
                __builtin_prefetch((const char *)&blocks[blocks[next].next] + at);
        context->kernels->raster_fragments(visible, &context->tables[E3D_PASS_SCENE], &blocks[next]);
    }
}
