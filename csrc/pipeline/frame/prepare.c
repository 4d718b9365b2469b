/* prepare: what a frame needs before anything is drawn: its plan, its draws, its view and its constants. */
#include <string.h>

#include "core/grow.h"
#include "core/limits.h"
#include "core/srgb_tables.h"
#include "e3d.h"
#include "kernels/types/visible.h"
#include "pipeline/cull/history.h"
#include "pipeline/frame/prepare.h"
#include "pipeline/geometry/lines.h"
#include "pipeline/pass/draws.h"
#include "pipeline/pass/plan.h"
#include "pipeline/pass/view.h"
#include "pipeline/state/context.h"
#include "pipeline/state/renderer.h"
#include "pipeline/state/tile_state.h"
#include "pipeline/state/worker.h"
#include "pipeline/store/resolve.h"

/* Before a frame, no tile is drawn and no instance shows. */
static int clear_marks(e3d_context *context)
{
    e3d_renderer *renderer = context->renderer;
    size_t tiles = (size_t)e3d_tile_count(context->view), instances = (size_t)context->draws->instance_count;
    if (!e3d_array_reserve(&renderer->tile_progress, tiles, sizeof(e3d_tile_progress)) ||
        !e3d_array_reserve(&renderer->marks, instances + 1, 1))
        return 0;
    context->tiles = memset(renderer->tile_progress.data, 0, tiles * sizeof(e3d_tile_progress));
    context->marks = memset(renderer->marks.data, 0, instances);
    return 1;
}

static void prepare_tables(e3d_context *context)
{
    int bits = 0;
    while ((1 << bits) < context->renderer->threads)
        bits++;
    for (int which = 0; which < E3D_SETS; which++)
        context->tables[which] = (e3d_record_table){context->records[which], context->drawn, bits};
    for (int c = 0; c < 256; c++)
        context->unorm8[c] = (float)(context->frame->decode_srgb ? SRGB_TO_LINEAR16[c] : c * 257) * E3D_UNORM16;
}

e3d_status e3d_prepare(e3d_context *context)
{
    e3d_renderer *renderer = context->renderer;
    const e3d_frame *frame = context->frame;
    context->plan = e3d_plan_of(frame, context->targets);
    context->lines = e3d_line_style_of(frame);
    context->view->history = e3d_history_of(&renderer->histories, frame->view);
    prepare_tables(context);
    e3d_resolve_prepare(context);
    e3d_status status = e3d_draws_prepare(context->draws, frame, e3d_plans(context, E3D_PLAN_EDGES));
    if (status != E3D_OK)
        return status;
    if (!e3d_view_prepare(context->view, frame) || !clear_marks(context) ||
        !e3d_view_find_instances(context->view, context->draws, frame, renderer->threads))
        return E3D_OUT_OF_MEMORY;
    return E3D_OK;
}
