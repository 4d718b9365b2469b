/* bin and raster of small triangles: fragments to the tiles that they lie in, and from there to the visible surface.
 *
 * A triangle of a few samples is cheaper as these than as a record: 10 bytes a sample, written and read one after the other. What
 * shading needs of the triangle it finds again by its ID.
 */
#include "core/always_inline.h"
#include "core/grow.h"
#include "core/limits.h"
#include "kernels/kernels.h"
#include "kernels/types/fragments.h"
#include "kernels/types/vertices.h"
#include "kernels/types/visible.h"
#include "pipeline/geometry/bin.h"
#include "pipeline/geometry/fragments.h"
#include "pipeline/pass/view.h"
#include "pipeline/state/context.h"
#include "pipeline/state/tile_memory.h"
#include "pipeline/state/worker.h"

void e3d_fragments_free(e3d_fragment_set *set)
{
    e3d_array *arrays[] = {&set->blocks, &set->bins, &set->earlier, &set->drawn};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
        e3d_array_free(arrays[i]);
}

int e3d_fragments_reset(e3d_fragment_set *set, int32_t tiles)
{
    set->drawn.count = 0;
    set->triangles.count = 0;
    if (!e3d_array_reserve(&set->bins, (size_t)tiles, sizeof(e3d_bin)))
        return 0;
    e3d_bins_clear(&set->bins, &set->blocks, tiles);
    return 1;
}

/* ---- triangles of clusters ---- */

int e3d_fragments_fit(const e3d_context *context, const e3d_worker *worker)
{
    return worker->fragments.drawn.count < (size_t)E3D_FRAGMENT_ID / E3D_CLUSTER_TRIANGLES >> context->tables[E3D_SET_SCENE].bits;
}

e3d_drawn_cluster *e3d_fragments_cluster(e3d_worker *worker)
{
    e3d_array *drawn = &worker->fragments.drawn;
    if (e3d_array_reserve(drawn, drawn->count + 1, sizeof(e3d_drawn_cluster)))
        return (e3d_drawn_cluster *)drawn->data + drawn->count++;
    worker->failed = 1;
    return NULL;
}

/* The IDs of triangle t of the last cluster are first + (t << bits). */
static int32_t first_id(const e3d_context *context, const e3d_worker *worker)
{
    int32_t number = (int32_t)(worker->fragments.drawn.count - 1) * E3D_CLUSTER_TRIANGLES;
    return E3D_FRAGMENT_ID | number << context->tables[E3D_SET_SCENE].bits | (int32_t)worker->number;
}

void e3d_fragments_add(const e3d_context *context, e3d_worker *worker, const e3d_vertices *vertices, const uint8_t *indices,
                       uint64_t triangles)
{
    e3d_fragment_set *set = &worker->fragments;
    if (set->triangles.count > E3D_SMALLS - E3D_CLUSTER_TRIANGLES)
        e3d_fragments_flush(context, worker);
    context->kernels->add_small(vertices, indices, triangles, first_id(context, worker), context->tables[E3D_SET_SCENE].bits,
                                &set->triangles);
}

/* ---- fragments to tiles ---- */

void e3d_fragments_flush(const e3d_context *context, e3d_worker *worker)
{
    e3d_fragment_set *set = &worker->fragments;
    size_t most = e3d_fragment_blocks_most((size_t)e3d_tile_count(context->view));
    if (!set->triangles.count)
        return;
    if (!e3d_array_reserve(&set->blocks, set->blocks.count + most, sizeof(e3d_fragment_block))) {
        set->triangles.count = 0;
        worker->failed = 1;
        return;
    }
    e3d_fragment_bins out = {.blocks = set->blocks.data, .bins = set->bins.data, .count = (uint32_t)set->blocks.count};
    context->kernels->fragments(&set->triangles, &context->view->viewport, context->view->tiles_x, &out);
    set->blocks.count = out.count;
    worker->counters.records += out.triangles;
    worker->counters.triangles_drawn += out.triangles;
    worker->counters.bin_entries += out.fragments;
}

/* ---- to the visible surface ---- */

/* Blocks are in no cache when they are read first. */
static ALWAYS_INLINE void fetch_block(const e3d_fragment_block *block)
{
    enum { LINE = 64 };
    for (size_t at = 0; at < sizeof *block; at += LINE)
        __builtin_prefetch((const char *)block + at);
}

void e3d_fragments_draw(const e3d_context *context, const e3d_fragment_set *set, e3d_visible_tile *visible, int64_t tile_number,
                        int earlier)
{
    const e3d_fragment_block *block = e3d_first_fragments(set, earlier ? &set->earlier : &set->bins, tile_number), *next;
    for (; block; block = next) {
        next = e3d_next_fragments(set, block);
        if (next)
            fetch_block(next);
        context->kernels->raster_fragments(visible, &context->tables[E3D_SET_SCENE], block);
    }
}

void e3d_fragments_show(const e3d_context *context, const e3d_fragment_set *set, e3d_worker *worker, int64_t tile_number)
{
    const e3d_fragment_block *block = e3d_first_fragments(set, &set->bins, tile_number);
    for (; block; block = e3d_next_fragments(set, block))
        context->kernels->show_fragments(worker->visible, block, &worker->tile->shown);
}
