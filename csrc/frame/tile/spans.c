/* raster without depths, for tiles of few records: these are mostly neighbours that don't meet, and show in full. Where some
 * meet, most lie clearly behind others. */
#include <string.h>

#include "base/limits.h"
#include "frame/geometry/records.h"
#include "frame/shade/runs.h"
#include "frame/tile/spans.h"
#include "kernels/types/fragments.h"
#include "kernels/types/visible.h"

/* Whether a tile has few records, and no fragments. It stops as soon as there are too many. */
static int are_few(const e3d_bins *bins, int64_t tile)
{
    uint32_t count = 0;
    for (int32_t t = 0; t < bins->threads; t++) {
        const e3d_record_set *set = &bins->of[t]->sets[E3D_SET_SCENE];
        if (e3d_first_link(&bins->of[t]->fragments.chains, 0, tile) != E3D_NO_LINK)
            return 0;
        for (const e3d_bin_link *link = e3d_first_records(set, 0, tile); link; link = e3d_bin_link_at(set, link->next))
            if ((count += link->count) > E3D_MOST_COVERING)
                return 0;
    }
    return 1;
}

/* Finds the samples that the records of a tile's bins cover, and lists all of them; 0 if there are too many. */
static int cover_records(const e3d_kernels *kernels, const e3d_bins *bins, int64_t tile, e3d_tile_memory *memory)
{
    for (int32_t t = 0; t < bins->threads; t++) {
        const e3d_record_set *set = &bins->of[t]->sets[E3D_SET_SCENE];
        for (const e3d_bin_link *link = e3d_first_records(set, 0, tile); link; link = e3d_bin_link_at(set, link->next))
            if (!kernels->cover_records(&memory->spans.cover, &bins->tables[E3D_SET_SCENE], link->id, (int)link->count,
                                        &memory->shade.shown))
                return 0;
    }
    return 1;
}

static void begin(e3d_tile_memory *memory, const e3d_tile *tile)
{
    e3d_cover *cover = &memory->spans.cover;
    cover->x = tile->x;
    cover->y = tile->y;
    cover->width = tile->width;
    cover->height = tile->height;
    cover->count = cover->used = 0;
    memset(cover->once, 0, sizeof cover->once);
    memset(cover->twice, 0, sizeof cover->twice);
    e3d_shown_begin(&memory->shade.shown, 1);
}

static int meet(const e3d_cover *cover)
{
    uint64_t twice = 0;
    for (int y = 0; y < E3D_TILE; y++)
        twice |= cover->twice[y];
    return twice != 0;
}

/* Sorts records by their nearest depths. None is negative, so that their bits sort in the same order. */
static void sort_by_depth(e3d_tile_memory *memory, const uint16_t *numbers, int count, uint16_t *sorted)
{
    for (int i = 0; i < count; i++) {
        memory->shade.runs.rows[i].sample = numbers[i];
        memcpy(&memory->shade.runs.rows[i].owner, &memory->spans.cover.record[numbers[i]].record->zmin, sizeof(float));
    }
    const e3d_run *runs = e3d_sort_runs(memory->shade.runs.rows, memory->shade.runs.spare, count);
    for (int i = 0; i < count; i++)
        sorted[i] = runs[i].sample;
}

/* Lists what shows where records meet; 0 if a depth buffer would be faster. */
static int show_met(const e3d_kernels *kernels, const e3d_record_table *table, e3d_tile_memory *memory)
{
    uint16_t numbers[E3D_MOST_COVERING];
    e3d_shown_begin(&memory->shade.shown, 1);
    int count = kernels->show_alone(&memory->spans.cover, &memory->shade.shown, numbers);
    sort_by_depth(memory, numbers, count, numbers);
    return kernels->show_layers(&memory->spans.cover, table, numbers, count, &memory->spans.layers, &memory->shade.shown);
}

/* Neighbouring tiles are alike: each time that spans don't pay, more tiles go without them. */
static void judge(e3d_spans_memory *trial, int pays)
{
    enum { MOST = 15 };
    int more = 2 * trial->without + 1 < MOST ? 2 * trial->without + 1 : MOST;
    trial->without = pays ? 0 : more;
    trial->left = trial->without;
}

int e3d_show_spans(const e3d_kernels *kernels, const e3d_bins *bins, const e3d_tile *tile, int64_t number, e3d_tile_memory *out)
{
    e3d_spans_memory *spans = &out->spans;
    if (spans->left > 0) {
        spans->left--;
        return 0;
    }
    if (!are_few(bins, number))
        return 0;
    begin(out, tile);
    int shows = cover_records(kernels, bins, number, out) && (!meet(&spans->cover) || show_met(kernels, &bins->tables[E3D_SET_SCENE], out));
    judge(spans, shows);
    return shows;
}

int e3d_spans_cover_all(const e3d_cover *cover)
{
    uint64_t row = ~(uint64_t)0 >> (E3D_TILE - cover->width), all = row;
    for (int32_t y = 0; y < cover->height; y++)
        all &= cover->once[y];
    return all == row;
}
