/* prepare: finds everything that a frame needs before it is drawn: its plan, its draws, its view and its constants. */
#include <string.h>

#include "base/grow.h"
#include "data/behind_levels.h"
#include "data/views/whole_picture.h"
#include "data/sample_patterns.h"
#include "data/tone_tables.h"
#include "kernels/types/bending.h"
#include "frame/cast/casters.h"
#include "frame/run/prepare.h"
#include "frame/geometry/bin.h"
#include "frame/geometry/records.h"
#include "frame/pass/draws.h"
#include "frame/pass/plan.h"
#include "frame/pass/view.h"
#include "frame/shade/shade.h"
#include "frame/store/backdrop.h"
#include "frame/store/resolve.h"
#include "frame/store/tile_state.h"
#include "frame/tile/memory.h"
#include "frame/tile/multisample.h"

/* Before a pass, no tile is drawn and no instance shows. */
static int clear_marks(e3d_renderer *renderer)
{
    size_t tiles = (size_t)e3d_tile_count(&renderer->view), instances = (size_t)renderer->draws.instance_count;
    if (!e3d_array_reserve(&renderer->tile_progress, tiles, sizeof(e3d_tile_progress)) ||
        !e3d_array_reserve(&renderer->marks, instances + 1, 1))
        return 0;
    memset(renderer->marks.data, 0, instances);
    renderer->tiles.progress = memset(renderer->tile_progress.data, 0, tiles * sizeof(e3d_tile_progress));
    renderer->tiles.kept = NULL;
    return 1;
}

static int reset_workers(e3d_renderer *renderer, const e3d_store *store)
{
    for (int32_t t = 0; t < renderer->threads; t++) {
        e3d_tile_memory *memory = renderer->tiles.of[t];
        memory->ns_raster = memory->ns_shade = memory->ns_resolve = memory->shade.shaded = 0;
        if (!e3d_array_reserve(&memory->pixels.words, store->words, sizeof(int32_t)))
            return 0;
        if (store->pass->pattern && !e3d_multisample_reserve(&memory->multisample, store->pass->pattern->count))
            return 0;
    }
    return e3d_bins_reset(&renderer->bins, e3d_tile_count(&renderer->view), e3d_plans(store->pass, E3D_PLAN_ALPHA_BINS));
}

/* Prepares what the stages read that shade and store. */
static void prepare_shading(e3d_renderer *renderer, e3d_context *out)
{
    const e3d_bins *bins = &renderer->bins;
    e3d_resolve_prepare(&out->pass, &out->store);
    out->shade.pass = &out->pass;
    out->shade.table = &bins->tables[E3D_SET_SCENE];
    out->shade.corners = bins->corners;
    out->shade.store = &out->store;
    out->shade.bins = bins;
    e3d_shade_prepare(&out->shade);
    out->tiles = (e3d_tiles_in){.pass = &out->pass, .bins = bins, .shade = &out->shade, .poll = renderer->poll};
}

/* Finds the gradient, if it is the background; 0 when memory is out. */
static int prepare_gradient(e3d_renderer *renderer, const e3d_frame *frame, e3d_store *out)
{
    out->gradient = NULL;
    if (!frame->gradient.shows || e3d_shows_environment(frame))
        return 1;
    if (!e3d_array_reserve(&renderer->gradient, (size_t)frame->height, sizeof(uint32_t[E3D_DITHER])))
        return 0;
    e3d_backdrop_prepare(frame, renderer->gradient.data);
    out->gradient = renderer->gradient.data;
    return 1;
}

/* Finds the view, and the frozen view whose frustum decides what is drawn; 0 when memory is out. */
static int prepare_views(e3d_renderer *renderer, const e3d_frame *frame, const e3d_view *frustum)
{
    e3d_view *view = &renderer->view, *frozen = &renderer->frozen;
    e3d_draws *draws = &renderer->draws;
    int threads = renderer->threads;
    if (frustum == frozen && !e3d_view_prepare(frozen, frozen, frame->frozen_clip_from_world, draws, frame, threads))
        return 0;
    return e3d_view_prepare(view, frustum, frame->clip_from_world, draws, frame, threads);
}

/* Finds the levels of the picture behind glass, if there is one. */
static void prepare_behind(const e3d_frame *frame, e3d_behind_view *out)
{
    const e3d_whole whole = e3d_whole_of(frame);
    out->texels = frame->behind;
    out->depth = frame->behind_depth;
    if (!frame->behind)
        return;
    out->whole_count = e3d_behind_levels(whole.width, whole.height, out->level); /* its levels aren't kept */
    out->count = e3d_behind_levels(frame->width, frame->height, out->level);
    out->whole_share = 1.0f / (whole.fineness * whole.fineness);
}

e3d_status e3d_prepare(e3d_renderer *renderer, const e3d_pass *asked, e3d_context *out)
{
    const e3d_frame *frame = asked->frame;
    out->renderer = renderer;
    out->pass = (e3d_prepared){.kernels = renderer->kernels,
                               .threads = renderer->threads,
                               .frame = frame,
                               .targets = asked->targets,
                               .plan = e3d_plan_of(frame, asked->targets),
                               .draws = &renderer->draws,
                               .view = &renderer->view,
                               .casters = &renderer->casters.index,
                               .pattern = e3d_sample_pattern_of(frame->msaa_samples),
                               .frustum = frame->frozen_clip_from_world ? &renderer->frozen : &renderer->view};
    prepare_behind(frame, &out->pass.behind);
    out->history = e3d_history_of(&renderer->histories, frame);
    e3d_status status = e3d_draws_prepare(&renderer->draws, frame, e3d_plans(&out->pass, E3D_PLAN_EDGES), e3d_plans(&out->pass, E3D_PLAN_ALPHA_BINS));
    if (status != E3D_OK)
        return status;
    if (e3d_plans(&out->pass, E3D_PLAN_FINDS_EXACT_SHADOWS) &&
        (status = e3d_casters_prepare(&renderer->casters, frame, renderer->threads)) != E3D_OK)
        return status;
    if (!prepare_views(renderer, frame, out->pass.frustum) || !prepare_gradient(renderer, frame, &out->store) || !clear_marks(renderer))
        return E3D_OUT_OF_MEMORY;
    prepare_shading(renderer, out);
    return reset_workers(renderer, &out->store) ? E3D_OK : E3D_OUT_OF_MEMORY;
}
