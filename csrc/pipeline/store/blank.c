/* resolve: tiles that nothing is drawn in are all background. A few of their rows are written between the batches of other tiles:
 * write-combining buffers drain while the core computes (a head on a background takes 7 % less time with two threads).
 */
#include "pipeline/geometry/bin.h"
#include "pipeline/pass/view.h"
#include "pipeline/state/context.h"
#include "pipeline/state/tile_state.h"
#include "pipeline/state/worker.h"
#include "pipeline/store/blank.h"
#include "pipeline/store/outputs.h"
#include "pipeline/store/picture.h"
#include "pipeline/store/queue.h"

/* Looks at a few tiles for the next blank one; whether there may be more. */
static int find_blank(const e3d_context *context, e3d_worker *worker)
{
    enum { TILES = 8 };
    for (int k = 0; k < TILES; k++) {
        int64_t tile = e3d_take_tile(context, worker, E3D_TO_CLEAR);
        if (tile < 0)
            return 0;
        if (e3d_tile_state_of(&context->tiles[tile]) == E3D_TILE_UNTOUCHED && !e3d_has_bins(context, tile)) {
            e3d_tile_set_state(&context->tiles[tile], E3D_TILE_CLEARED);
            worker->blank.tile = e3d_tile_at(context->view, tile);
            return 1;
        }
    }
    return 1;
}

void e3d_blank_begin(e3d_worker *worker)
{
    worker->blank.tile = (e3d_tile){0};
    worker->blank.more = 1;
}

/* Rows of a tile that are all background. */
static void clear(const e3d_context *context, const e3d_tile *tile)
{
    e3d_outputs_blank(context, tile);
    if (context->targets->color)
        e3d_write_tile(context, tile, context->targets->color, sizeof(uint32_t), context->background.row, 0);
}

void e3d_blank_some(const e3d_context *context, e3d_worker *worker)
{
    enum { SOME_ROWS = 8 };
    e3d_tile *left = &worker->blank.tile, some;
    if (!left->height)
        worker->blank.more = worker->blank.more && find_blank(context, worker);
    some = *left;
    some.height = left->height < SOME_ROWS ? left->height : SOME_ROWS;
    if (some.height)
        clear(context, &some);
    left->y += some.height;
    left->height -= some.height;
}

void e3d_blank_rest(const e3d_context *context, e3d_worker *worker)
{
    while (worker->blank.more || worker->blank.tile.height)
        e3d_blank_some(context, worker);
}
