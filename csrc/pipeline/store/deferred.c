/* resolve: rows of the picture that are written while samples are shaded. Memory takes in a line now and then for nothing, but
 * many at once hold up the core. A tile's rows wait until the next one is shaded; after them come those of blank tiles.
 */
#include "core/limits.h"
#include "e3d.h"
#include "kernels/kernels.h"
#include "kernels/types/shading.h"
#include "pipeline/state/context.h"
#include "pipeline/state/tile_memory.h"
#include "pipeline/state/worker.h"
#include "pipeline/store/blank.h"
#include "pipeline/store/deferred.h"
#include "pipeline/store/outputs.h"
#include "pipeline/store/picture.h"

static int rows_of(const e3d_context *context, const e3d_tile *tile, const uint32_t *from, size_t step, e3d_pixel_rows *out)
{
    return e3d_tile_rows(context, tile, context->targets->color, sizeof(uint32_t), from, step, out);
}

static void write_some(const e3d_context *context, e3d_pixel_rows *rows, int some)
{
    e3d_pixel_rows now = *rows;
    if (!rows->count)
        return;
    now.count = some < rows->count ? some : rows->count;
    context->kernels->stream(&now);
    rows->to += (size_t)now.count * rows->pitch;
    rows->from += (size_t)now.count * rows->step;
    rows->count -= now.count;
}

void e3d_deferred_add(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile)
{
    e3d_tile_memory *memory = worker->tile;
    write_some(context, &worker->deferred.drawn, E3D_TILE);
    if (rows_of(context, tile, memory->pixels.rgba, E3D_TILE * sizeof(uint32_t), &worker->deferred.drawn)) {
        memory->pixels.rgba = memory->pixels.of[memory->pixels.rgba == memory->pixels.of[0]];
    } else {
        worker->deferred.drawn.count = 0;
        e3d_write_tile(context, tile, context->targets->color, sizeof(uint32_t), memory->pixels.rgba, E3D_TILE * sizeof(uint32_t));
    }
}

/* Of the next blank tile, if colour is all that is written there. */
static void add_blank(const e3d_context *context, e3d_worker *worker)
{
    e3d_tile *blank = e3d_blank_now(context, worker);
    for (int k = 0; k < E3D_OUTPUTS; k++)
        if (context->outputs[k].target)
            return;
    if (blank->height && rows_of(context, blank, context->background.row, 0, &worker->deferred.blank))
        blank->height = 0;
    else
        worker->deferred.blank.count = 0;
}

e3d_pixel_rows *e3d_deferred_rows(const e3d_context *context, e3d_worker *worker)
{
    if (worker->deferred.drawn.count)
        return &worker->deferred.drawn;
    if (!worker->deferred.blank.count)
        add_blank(context, worker);
    return worker->deferred.blank.count ? &worker->deferred.blank : NULL;
}

void e3d_deferred_some(const e3d_context *context, e3d_pixel_rows *rows)
{
    write_some(context, rows, E3D_SOME_ROWS);
}

void e3d_deferred_rest(const e3d_context *context, e3d_worker *worker)
{
    write_some(context, &worker->deferred.drawn, E3D_TILE);
    write_some(context, &worker->deferred.blank, E3D_TILE);
}
