/* resolve: clears the tiles in which nothing is drawn. A few of their rows are written between the batches of other tiles, so
 * that the write-combining buffers drain while the core computes (a head on a background takes 7 % less time with two threads). */
#include "base/limits.h"
#include "frame/pass/plan.h"
#include "frame/pass/prepared.h"
#include "frame/store/backdrop.h"
#include "frame/store/blank.h"
#include "frame/store/outputs.h"
#include "frame/store/picture.h"

enum { SOME_ROWS = 8 }; /* of samples */

/* Looks at a few tiles for the next blank one; returns whether there may be more. */
static int find_blank(const e3d_view *view, const e3d_bins *bins, e3d_blank_state *state)
{
    enum { TILES = 8 };
    for (int k = 0; k < TILES; k++) {
        int64_t tile = e3d_take_tile(state->queue, state->thread, E3D_TO_CLEAR);
        if (tile < 0)
            return 0;
        if (e3d_tile_state_of(&state->progress[tile]) == E3D_TILE_UNTOUCHED && !e3d_has_bins(bins, tile)) {
            e3d_tile_set_state(&state->progress[tile], E3D_TILE_CLEARED);
            state->tile = e3d_tile_at(view, tile);
            return 1;
        }
    }
    return 1;
}

/* Clears at most SOME_ROWS rows of a tile that is all background. */
static void clear(const e3d_store *store, const e3d_tile *tile)
{
    uint8_t *color = store->pass->targets->color;
    e3d_outputs_blank(store, tile);
    if (color && e3d_plans(store->pass, E3D_PLAN_BACKDROP)) {
        uint32_t rgba[SOME_ROWS * E3D_TILE + E3D_PAD];
        e3d_backdrop_pixels(store, tile, rgba);
        e3d_write_tile(store->pass, tile, color, sizeof(uint32_t), rgba, E3D_TILE * sizeof(uint32_t));
    } else if (color)
        e3d_write_tile(store->pass, tile, color, sizeof(uint32_t), store->background.row, 0);
}

void e3d_blank_some(const e3d_store *store, const e3d_bins *bins, e3d_blank_state *state)
{
    e3d_tile *left = &state->tile, some;
    if (!left->height)
        state->more = state->more && find_blank(store->pass->view, bins, state);
    some = *left;
    some.height = left->height < SOME_ROWS ? left->height : SOME_ROWS;
    if (some.height)
        clear(store, &some);
    left->y += some.height;
    left->height -= some.height;
}

void e3d_blank_rest(const e3d_store *store, const e3d_bins *bins, e3d_blank_state *state)
{
    while (state->more || state->tile.height)
        e3d_blank_some(store, bins, state);
}
