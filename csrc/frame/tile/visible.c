/* raster, the visible surface: draws a tile's records and fragments; each sample keeps an ID. */
#include "base/always_inline.h"
#include "base/limits.h"
#include "kernels/types/fragments.h"
#include "frame/geometry/records.h"
#include "frame/tile/visible.h"

enum { FETCHED = 16 };

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

void e3d_visible_empty(e3d_visible_tile *visible)
{
    for (int i = 0; i < E3D_TILE_SAMPLES; i++) {
        visible->z[i] = E3D_BEYOND_FAR;
        visible->id[i] = E3D_NO_SLOT;
    }
    visible->noted = 0;
}

/* Prefetches the first records of a link, which are in no near cache. */
static ALWAYS_INLINE void fetch_records(const e3d_record_table *table, const e3d_bin_link *link)
{
    for (uint32_t i = 0; i < FETCHED && i < link->count; i++)
        __builtin_prefetch(e3d_record_at(table, link->id[i]));
}

/* Draws the next link of each thread in turn: all threads list records from near to far. */
static void draw_records(const e3d_prepared *pass, const e3d_bins *bins, int64_t tile_number, int earlier, e3d_visible_tile *out)
{
    const e3d_record_table *table = &bins->tables[E3D_SET_SCENE];
    const e3d_bin_link *next[E3D_MAX_THREADS];
    int32_t left = bins->threads;
    for (int32_t t = 0; t < bins->threads; t++) {
        const e3d_record_set *set = &bins->of[t]->sets[E3D_SET_SCENE];
        next[t] = e3d_first_records(set, earlier, tile_number);
    }
    while (left) {
        left = 0;
        for (int32_t t = 0; t < bins->threads; t++) {
            if (!next[t])
                continue;
            const e3d_bin_link *link = next[t];
            next[t] = e3d_bin_link_at(&bins->of[t]->sets[E3D_SET_SCENE], link->next);
            if (next[t])
                fetch_records(table, next[t]);
            if (pass->pattern)
                pass->kernels->raster_msaa(out, pass->pattern, table, link->id, (int)link->count);
            else
                pass->kernels->raster_visible(out, table, link->id, (int)link->count);
            left += next[t] != NULL;
        }
    }
}

/* Prefetches a link, which is in no cache. */
static ALWAYS_INLINE void fetch_link(const e3d_fragment_link *link)
{
    enum { LINE = 64 };
    for (size_t at = 0; at < sizeof *link; at += LINE)
        __builtin_prefetch((const char *)link + at);
}

static void draw_fragments(const e3d_kernels *kernels, const e3d_bins *bins, int64_t tile_number, int earlier, e3d_visible_tile *out)
{
    for (int32_t t = 0; t < bins->threads; t++) {
        const e3d_fragment_set *set = &bins->of[t]->fragments;
        const e3d_fragment_link *link = e3d_first_fragments(set, earlier, tile_number), *next;
        for (; link; link = next) {
            next = e3d_fragment_link_at(set, link->next);
            if (next)
                fetch_link(next);
            kernels->raster_fragments(out, &bins->tables[E3D_SET_SCENE], link);
        }
    }
}

void e3d_visible_draw(const e3d_prepared *pass, const e3d_bins *bins, int64_t tile_number, int earlier, e3d_visible_tile *out)
{
    for (; earlier >= 0; earlier--) {
        draw_records(pass, bins, tile_number, earlier, out);
        draw_fragments(pass->kernels, bins, tile_number, earlier, out);
    }
}

void e3d_visible_show(const e3d_kernels *kernels, const e3d_bins *bins, int64_t tile_number, const e3d_visible_tile *visible,
                      e3d_shown *out)
{
    e3d_shown_begin(out, 0);
    for (int32_t t = 0; t < bins->threads; t++) {
        const e3d_record_set *records = &bins->of[t]->sets[E3D_SET_SCENE];
        const e3d_fragment_set *fragments = &bins->of[t]->fragments;
        const e3d_bin_link *link = e3d_first_records(records, 0, tile_number);
        for (; link; link = e3d_bin_link_at(records, link->next))
            kernels->show_records(visible, &bins->tables[E3D_SET_SCENE], link->id, (int)link->count, out);
        const e3d_fragment_link *small = e3d_first_fragments(fragments, 0, tile_number);
        for (; small; small = e3d_fragment_link_at(fragments, small->next))
            kernels->show_fragments(visible, small, out);
    }
}
