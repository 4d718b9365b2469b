/* bin: lists records in the tiles that they may cover. A record whose box lies in one tile is listed there; a larger one is
 * tested edge by edge against each tile of its box. Each thread has bins of its own; their order does not matter, by the
 * raster's rule R16. */
#include <string.h>

#include "base/grow.h"
#include "kernels/types/fragments.h"
#include "frame/geometry/bin.h"

/* ---- the bins of all threads ---- */

void e3d_bins_init(e3d_bins *bins, int32_t threads)
{
    int bits = 0;
    while ((1 << bits) < threads)
        bits++;
    bins->threads = threads;
    for (int which = 0; which < E3D_SETS; which++)
        bins->tables[which] = (e3d_record_table){bins->records[which], bins->drawn, bits};
    for (int32_t t = 0; t < threads; t++) {
        bins->of[t]->number = (uint32_t)t;
        bins->of[t]->id_bits = bits;
    }
}

static void free_chains(e3d_chains *chains)
{
    e3d_array_free(&chains->links);
    e3d_array_free(&chains->bins);
    e3d_array_free(&chains->earlier);
}

void e3d_geometry_free(e3d_geometry_memory *state)
{
    for (e3d_record_set *set = state->sets; set < state->sets + E3D_SETS; set++) {
        e3d_array_free(&set->records);
        e3d_array_free(&set->corners);
        e3d_array_free(&set->keys);
        free_chains(&set->chains);
        for (int kind = 0; kind < E3D_ALPHA_KINDS; kind++)
            free_chains(&set->alpha[kind]);
    }
    e3d_array_free(&state->fragments.drawn);
    free_chains(&state->fragments.chains);
}

/* Leaves the bins empty; 0 when memory is out. */
static int empty(e3d_array *bins, int32_t tiles)
{
    if (!e3d_array_reserve(bins, (size_t)tiles, sizeof(e3d_bin)))
        return 0;
    for (int32_t t = 0; t < tiles; t++)
        ((e3d_bin *)bins->data)[t] = (e3d_bin){E3D_NO_LINK, E3D_NO_LINK};
    return 1;
}

static int clear(e3d_chains *chains, int32_t tiles)
{
    chains->links.count = 0;
    return empty(&chains->bins, tiles);
}

static int keep(e3d_chains *chains, int32_t tiles)
{
    e3d_array_swap(&chains->bins, &chains->earlier);
    return empty(&chains->bins, tiles);
}

static int reset(e3d_geometry_memory *state, int32_t tiles, int alpha)
{
    memset(&state->counters, 0, sizeof state->counters);
    state->failed = 0;
    state->fragments.drawn.count = 0;
    state->fragments.triangles.count = 0;
    int made = clear(&state->fragments.chains, tiles);
    for (e3d_record_set *set = state->sets; set < state->sets + E3D_SETS; set++) {
        set->records.count = set->corners.count = set->keys.count = 0;
        made = made && clear(&set->chains, tiles);
    }
    for (int kind = 0; kind < E3D_ALPHA_KINDS && alpha; kind++)
        made = made && clear(&state->sets[E3D_SET_SCENE].alpha[kind], tiles);
    return made;
}

int e3d_bins_reset(e3d_bins *bins, int64_t tiles, int alpha)
{
    bins->tiles = (int32_t)tiles;
    bins->alpha = alpha;
    for (int32_t t = 0; t < bins->threads; t++)
        if (!reset(bins->of[t], bins->tiles, alpha))
            return 0;
    return 1;
}

void e3d_bins_clear(e3d_bins *bins)
{
    for (int32_t t = 0; t < bins->threads; t++) {
        clear(&bins->of[t]->sets[E3D_SET_SCENE].chains, bins->tiles);
        clear(&bins->of[t]->fragments.chains, bins->tiles);
    }
}

int e3d_bins_keep(e3d_bins *bins)
{
    for (int32_t t = 0; t < bins->threads; t++) {
        e3d_record_set *records = &bins->of[t]->sets[E3D_SET_SCENE];
        e3d_fragment_set *fragments = &bins->of[t]->fragments;
        records->earlier_records = records->records.count;
        fragments->earlier_drawn = fragments->drawn.count;
        if (!keep(&records->chains, bins->tiles) || !keep(&fragments->chains, bins->tiles))
            return 0;
    }
    return 1;
}

void e3d_bins_index(e3d_bins *bins)
{
    for (int32_t t = 0; t < bins->threads; t++) {
        for (int which = 0; which < E3D_SETS; which++)
            bins->records[which][t] = bins->of[t]->sets[which].records.data;
        bins->drawn[t] = bins->of[t]->fragments.drawn.data;
        bins->corners[t] = bins->of[t]->sets[E3D_SET_SCENE].corners.data;
    }
}

/* ---- records to bins ---- */

/* An empty link at a chain's end; 0 when memory is out. */
static int __attribute__((noinline)) add_link(e3d_array *array, e3d_bin *bin)
{
    if (!e3d_array_reserve(array, array->count + 1, sizeof(e3d_bin_link)))
        return 0;
    e3d_bin_link *links = array->data;
    uint32_t fresh = (uint32_t)array->count++;
    links[fresh].next = E3D_NO_LINK;
    links[fresh].count = 0;
    *(bin->last == E3D_NO_LINK ? &bin->first : &links[bin->last].next) = fresh;
    bin->last = fresh;
    return 1;
}

static inline int push(e3d_chains *chains, e3d_bin *bin, uint32_t id)
{
    const e3d_bin_link *links = chains->links.data;
    if ((bin->last == E3D_NO_LINK || links[bin->last].count == 30) && !add_link(&chains->links, bin))
        return 0;
    e3d_bin_link *link = (e3d_bin_link *)chains->links.data + bin->last;
    link->id[link->count++] = id;
    return 1;
}

/* The edge functions where they are greatest in a tile, and their steps from tile to tile. A negative one rejects the tile. */
typedef struct tile_edges {
    int64_t most[3], across[3], down[3];
} tile_edges;

static void find_tile_edges(const e3d_record *record, int32_t x, int32_t y, int32_t reach, tile_edges *out)
{
    for (int k = 0; k < 3; k++) {
        e3d_edge edge = e3d_edge_at(record, k, x, y);
        int64_t a = edge.a, b = edge.b;
        out->most[k] = edge.e + (a > 0 ? a * (E3D_TILE - 1) : 0) + (b > 0 ? b * (E3D_TILE - 1) : 0);
        if (reach) /* no sample lies farther inside */
            out->most[k] += (((a < 0 ? -a : a) + (b < 0 ? -b : b)) * reach) / E3D_SUBPIXEL + 1;
        out->across[k] = a * E3D_TILE;
        out->down[k] = b * E3D_TILE;
    }
}

/* Lists a record in those tiles of a rectangle that it does not miss; a single row or column of tiles is met whole. This is a
 * function of its own, since its registers would spill those of the common case. */
static int __attribute__((noinline)) bin_wide(const e3d_view *view, e3d_geometry_memory *state, const e3d_record *record, e3d_chains *to,
                                              e3d_tile_rect span, uint32_t id)
{
    e3d_bin *bins = to->bins.data;
    int32_t x0 = (int32_t)(span.first & 0xFFFF), y0 = (int32_t)(span.first >> 16);
    int32_t x1 = (int32_t)(span.last & 0xFFFF), y1 = (int32_t)(span.last >> 16);
    tile_edges edges = {{0}, {0}, {0}};
    if (x0 < x1 && y0 < y1)
        find_tile_edges(record, x0 * E3D_TILE, y0 * E3D_TILE, view->viewport.reach, &edges);
    for (int32_t ty = y0; ty <= y1; ty++) {
        int64_t most[3] = {edges.most[0], edges.most[1], edges.most[2]};
        for (int32_t tx = x0; tx <= x1; tx++) {
            int misses = (most[0] | most[1] | most[2]) < 0;
            for (int k = 0; k < 3; k++)
                most[k] += edges.across[k];
            if (misses)
                continue;
            if (!push(to, &bins[(int64_t)ty * view->tiles_x + tx], id))
                return 0;
            state->counters.bin_entries++;
        }
        for (int k = 0; k < 3; k++)
            edges.most[k] += edges.down[k];
    }
    return 1;
}

static inline e3d_bin *bin_at(const e3d_view *view, e3d_chains *chains, uint32_t tile)
{
    return (e3d_bin *)chains->bins.data + (int64_t)(tile >> 16) * view->tiles_x + (tile & 0xFFFF);
}

/* Most records lie in one tile, or in two side by side. */
int e3d_bin_records(const e3d_view *view, e3d_geometry_memory *state, const e3d_record_set *set, e3d_chains *to, uint32_t first,
                    const e3d_tile_rect *spans, int count)
{
    int bits = state->id_bits, entries = 0;
    for (int i = 0; i < count; i++) {
        uint32_t number = first + (uint32_t)i, id = number << bits | state->number, apart = spans[i].last - spans[i].first;
        if (apart > 1 && apart != 1 << 16) {
            if (!bin_wide(view, state, (const e3d_record *)set->records.data + number, to, spans[i], id))
                return 0;
            continue;
        }
        if (!push(to, bin_at(view, to, spans[i].first), id) || (apart && !push(to, bin_at(view, to, spans[i].last), id)))
            return 0;
        entries += apart ? 2 : 1;
    }
    state->counters.bin_entries += entries;
    return 1;
}

/* ---- what a tile's bins hold ---- */

int e3d_has_bin(const e3d_bins *bins, int which, int64_t tile)
{
    for (int32_t t = 0; t < bins->threads; t++)
        if (e3d_first_link(&bins->of[t]->sets[which].chains, 0, tile) != E3D_NO_LINK ||
            (which == E3D_SET_SCENE && e3d_first_link(&bins->of[t]->fragments.chains, 0, tile) != E3D_NO_LINK))
            return 1;
    return 0;
}

int e3d_has_alpha(const e3d_bins *bins, int kind, int64_t tile)
{
    for (int32_t t = 0; t < bins->threads && bins->alpha; t++)
        if (e3d_first_alpha(&bins->of[t]->sets[E3D_SET_SCENE], kind, tile))
            return 1;
    return 0;
}

int e3d_has_bins(const e3d_bins *bins, int64_t tile)
{
    return e3d_has_bin(bins, E3D_SET_SCENE, tile) || e3d_has_bin(bins, E3D_SET_EDGES, tile) ||
           e3d_has_alpha(bins, E3D_ALPHA_MASKED, tile) || e3d_has_alpha(bins, E3D_ALPHA_BLENDED, tile);
}

static uint32_t count_records(const e3d_record_set *set, int64_t tile)
{
    uint32_t count = 0;
    for (const e3d_bin_link *link = e3d_first_records(set, 0, tile); link; link = e3d_bin_link_at(set, link->next))
        count += link->count;
    return count;
}

static uint32_t count_fragments(const e3d_fragment_set *set, int64_t tile)
{
    uint32_t count = 0;
    for (const e3d_fragment_link *link = e3d_first_fragments(set, 0, tile); link; link = e3d_fragment_link_at(set, link->next))
        count += link->count;
    return count;
}

e3d_entries e3d_count_entries(const e3d_bins *bins, int64_t tile)
{
    e3d_entries entries = {0, 0};
    for (int32_t t = 0; t < bins->threads; t++) {
        entries.records += count_records(&bins->of[t]->sets[E3D_SET_SCENE], tile);
        entries.fragments += count_fragments(&bins->of[t]->fragments, tile);
    }
    return entries;
}
