/* A frame: prepare -> geometry (cull, transform, clip, setup, bin) -> tiles (raster, shade, resolve). */
#include <string.h>

#include "base/clock.h"
#include "base/fpenv.h"
#include "base/pool.h"
#include "data/views/mirrors.h"
#include "data/views/whole_picture.h"
#include "data/shadow_maps/shadows.h"
#include "data/sample_patterns.h"
#include "e3d.h"
#include "frame/cull/cull.h"
#include "frame/cull/history.h"
#include "frame/run/counts.h"
#include "frame/run/prepare.h"
#include "frame/run/renderer.h"
#include "frame/run/rounds.h"
#include "frame/geometry/order.h"
#include "frame/pass/prepared.h"
#include "frame/tile/tile.h"
#include "reference/reference.h"

/* ---- arguments ---- */

static int poses_are_valid(const e3d_frame *f, const e3d_draw *draw)
{
    if (draw->pose_kind == E3D_POSE_NONE)
        return draw->instances == 1;
    if (draw->pose_kind == E3D_POSE_NODES)
        return f->order && (!draw->instances || (draw->node_worlds && draw->node_ids));
    return !draw->instances || draw->poses;
}

static int frame_is_valid(const e3d_frame *f)
{
    if (f->width < 1 || f->height < 1 || f->width > E3D_MAX_SIZE || f->height > E3D_MAX_SIZE ||
        (f->samples_axis != 1 && f->samples_axis != 2 && f->samples_axis != 4))
        return 0;
    if (f->msaa_samples && (f->samples_axis != 1 || !e3d_sample_pattern_of(f->msaa_samples)))
        return 0;
    if (!(f->line_width > 0 && f->line_width <= 256) || !(f->point_size > 0 && f->point_size <= 256))
        return 0;
    if ((unsigned)f->line_shape > E3D_LINES_ROUND || (unsigned)f->point_shape > E3D_POINTS_ROUND)
        return 0;
    if ((f->behind && !f->behind_depth) || !e3d_whole_is_valid(f))
        return 0;
    if (f->draw_count < 0 || f->material_count < 0 || f->light_count < 0 ||
        (f->order && f->order_count < 0) || !e3d_shadows_are_valid(f) || !e3d_mirrors_are_valid(f))
        return 0;
    for (int32_t d = 0; d < f->draw_count; d++) {
        const e3d_draw *draw = &f->draws[d];
        if (!draw->mesh || draw->instances < 0 || !poses_are_valid(f, draw) || draw->material_base < 0 ||
            (int64_t)draw->material_base + draw->mesh->material_most >= f->material_count)
            return 0;
    }
    return 1;
}

/* ---- a frame ---- */

/* Runs the stages from the candidates to the last tile. */
static e3d_status draw(const e3d_context *context, e3d_stats *stats)
{
    e3d_renderer *renderer = context->renderer;
    e3d_status status = e3d_rounds(context, stats);
    if (status != E3D_OK)
        return status;
    if (e3d_plans(&context->pass, E3D_PLAN_SORTS) && !e3d_sort_records(&context->pass, &renderer->bins))
        return E3D_OUT_OF_MEMORY;
    return e3d_tiles(&context->tiles, &renderer->tiles);
}

static e3d_status run(e3d_renderer *renderer, const e3d_pass *asked, e3d_stats *stats)
{
    int64_t start = e3d_now_ns(), together = e3d_pool_together_ns();
    e3d_context context;
    e3d_status status = e3d_prepare(renderer, asked, &context);
    if (status != E3D_OK)
        return status;
    if (!e3d_find_candidates(&context.pass, &renderer->cull))
        return E3D_OUT_OF_MEMORY;
    stats->ms_geometry = (double)(e3d_now_ns() - start) * 1e-6;
    status = draw(&context, stats);
    if (status == E3D_OUT_OF_MEMORY)
        return status;
    e3d_count(&context.pass, renderer, stats);
    if (stats->rounds > 1)
        e3d_history_judge(context.history, stats);
    stats->ms_total = (double)(e3d_now_ns() - start) * 1e-6;
    stats->ms_alone = stats->ms_total - (double)(e3d_pool_together_ns() - together) * 1e-6;
    return status;
}

static e3d_status run_pass(e3d_renderer *renderer, const e3d_pass *pass)
{
    e3d_stats unused, *stats = pass->stats ? pass->stats : &unused;
    memset(stats, 0, sizeof *stats);
    if (renderer->backend == E3D_BACKEND_SCALAR) {
        e3d_status done = e3d_reference_render(pass->frame, pass->targets, stats);
        e3d_count_submitted(pass->frame, stats);
        return done;
    }
    e3d_fpenv saved = e3d_fpenv_enter();
    e3d_status status = run(renderer, pass, stats);
    e3d_fpenv_leave(saved);
    return status;
}

/* R107: with multisampling, the mode overdraw and the outputs other than colour have one sample a pixel. */
static e3d_status run_outputs(e3d_renderer *renderer, const e3d_pass *asked, e3d_stats *stats)
{
    e3d_frame frame = *asked->frame;
    e3d_targets targets = *asked->targets;
    int some = 0;
    if (frame.mode != E3D_MODE_OVERDRAW)
        targets.color = NULL;
    for (int output = 0; output < E3D_OUTPUTS; output++)
        some |= e3d_targets_get(&targets, (e3d_output_kind)output) != NULL;
    frame.msaa_samples = 0;
    const e3d_pass pass = {&frame, &targets, stats};
    return some ? run_pass(renderer, &pass) : E3D_OK;
}

static void add_times(const e3d_stats *of, e3d_stats *to)
{
    to->ms_total += of->ms_total;
    to->ms_alone += of->ms_alone;
    to->ms_geometry += of->ms_geometry;
    to->ms_raster += of->ms_raster;
    to->ms_shade += of->ms_shade;
    to->ms_resolve += of->ms_resolve;
}

static e3d_status run_multisampled(e3d_renderer *renderer, const e3d_pass *asked)
{
    e3d_stats stats[2] = {{0}, {0}};
    e3d_targets targets = {.color = asked->targets->color};
    const e3d_pass pass = {asked->frame, &targets, &stats[0]};
    int colored = targets.color && asked->frame->mode != E3D_MODE_OVERDRAW;
    e3d_status status = colored ? run_pass(renderer, &pass) : E3D_OK;
    if (status == E3D_OK)
        status = run_outputs(renderer, asked, &stats[1]);
    if (asked->stats) {
        *asked->stats = stats[!colored];
        add_times(&stats[colored], asked->stats);
    }
    return status;
}

e3d_status e3d_render_passes(e3d_renderer *renderer, const e3d_pass *passes, int32_t count)
{
    e3d_status status = E3D_OK;
    for (int32_t p = 0; p < count; p++)
        if (!frame_is_valid(passes[p].frame))
            return E3D_INVALID_ARGUMENT;
    for (int32_t p = 0; p < count && status == E3D_OK; p++)
        status = passes[p].frame->msaa_samples ? run_multisampled(renderer, &passes[p]) : run_pass(renderer, &passes[p]);
    return status;
}

e3d_status e3d_render(e3d_renderer *renderer, const e3d_frame *frame, const e3d_targets *targets,
                      e3d_stats *stats)
{
    const e3d_pass pass = {frame, targets, stats};
    return e3d_render_passes(renderer, &pass, 1);
}
