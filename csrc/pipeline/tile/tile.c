/* raster, shade and resolve: one tile after another, each by one thread from first to last. */
#include "core/clock.h"
#include "core/limits.h"
#include "core/pool.h"
#include "core/stream.h"
#include "e3d.h"
#include "kernels/kernels.h"
#include "kernels/types/shown.h"
#include "kernels/types/visible.h"
#include "pipeline/cull/depths.h"
#include "pipeline/geometry/bin.h"
#include "pipeline/pass/plan.h"
#include "pipeline/pass/view.h"
#include "pipeline/shade/shade.h"
#include "pipeline/state/context.h"
#include "pipeline/state/renderer.h"
#include "pipeline/state/tile_memory.h"
#include "pipeline/state/tile_state.h"
#include "pipeline/state/worker.h"
#include "pipeline/store/blank.h"
#include "pipeline/store/queue.h"
#include "pipeline/store/resolve.h"
#include "pipeline/tile/slots.h"
#include "pipeline/tile/spans.h"
#include "pipeline/tile/tile.h"
#include "pipeline/tile/visible.h"

/* Whether the tile's pixels are written, but for what the last round added. Those of several samples are averages by now, and so all of
 * them are shaded once more. */
static int is_again(const e3d_tile_job *job) { return job->state == E3D_TILE_DRAWN && job->context->frame->samples_axis == 1; }

/* ---- stages of a tile ---- */

/* The runs of what shows in the tile, and whether there are gaps between them; how many. */
static int32_t find_runs(const e3d_tile_job *job, int *gaps)
{
    return job->context->kernels->find_runs(job->worker->visible, job->tile.width, job->tile.height,
                                            job->worker->tile->runs.rows, gaps);
}

/* Fills the tile with what its samples are before they are shaded; nothing is filled where all of them will be. */
static void begin(const e3d_tile_job *job, int all)
{
    const e3d_context *context = job->context;
    int counted = context->targets->color && !e3d_plans(context, E3D_PLAN_COLORS); /* instead of shaded */
    if (is_again(job))
        e3d_resolve_again(context, job->worker, &job->tile);
    else if (counted || !all)
        e3d_resolve_begin(context, job->worker);
}

/* Piece after piece, each with a slot of its own: forward shading, and where the last in order wins. */
static int draw_pieces(e3d_tile_job *job)
{
    e3d_context *context = job->context;
    e3d_worker *worker = job->worker;
    int forward = e3d_plans(context, E3D_PLAN_AT_ONCE);
    begin(job, 0);
    if (!e3d_slots_draw(job))
        return 0;
    e3d_lap(worker, &worker->counters.ns_raster);
    if (e3d_plans(context, E3D_PLAN_SHADES) && !forward) {
        int gaps;
        int32_t count = find_runs(job, &gaps);
        e3d_slots_to_ids(worker, count);
        if (!e3d_shade_runs(context, worker, &job->tile, count))
            return 0;
    }
    e3d_lap(worker, &worker->counters.ns_shade);
    return 1;
}

/* Whether the last round drew what owns a run, a record or a cluster of fragments. */
static int is_from_last_round(const e3d_context *context, uint32_t id)
{
    int bits = context->tables[E3D_SET_SCENE].bits;
    const e3d_worker *worker = context->renderer->workers[id & ((1u << bits) - 1)];
    uint32_t number = (id & (E3D_FRAGMENT_ID - 1)) >> bits;
    return id & E3D_FRAGMENT_ID ? number / E3D_CLUSTER_TRIANGLES >= worker->fragments.earlier_drawn
                                : number >= worker->sets[E3D_SET_SCENE].earlier_records;
}

/* Only the runs that are not shaded yet; the others' samples are counted. */
static int32_t leave_out_shaded(const e3d_tile_job *job, int32_t count)
{
    e3d_run *runs = job->worker->tile->runs.rows;
    int32_t left = 0;
    for (int32_t i = 0; i < count; i++)
        if (is_from_last_round(job->context, (uint32_t)runs[i].owner))
            runs[left++] = runs[i];
        else
            job->worker->counters.shaded += runs[i].length;
    return left;
}

enum { FEW_PIECES = 64, MANY_RECORDS = 768, MOSTLY = 4 }; /* in a tile */

/* Whether samples are found where pieces lie: the bins must hold all of them, and few records be wide or hidden. */
static int shows_pieces(const e3d_tile_job *job)
{
    const e3d_context *context = job->context;
    if (!e3d_plans(context, E3D_PLAN_LISTS) || job->state == E3D_TILE_KEPT || job->state == E3D_TILE_DRAWN)
        return 0;
    e3d_entries in = e3d_count_entries(context, job->number);
    uint32_t most = context->kept ? in.fragments / MOSTLY : MANY_RECORDS; /* kept: where things hide each other */
    return in.records <= most && in.records + in.fragments >= FEW_PIECES;
}

/* No ID beyond the viewport, where whole blocks and vectors are written, too. */
static void clear_outside(const e3d_tile_job *job)
{
    int32_t *id = job->worker->visible->id;
    for (int y = 0; y < E3D_TILE; y++)
        for (int x = y < job->tile.height ? job->tile.width : 0; x < E3D_TILE; x++)
            id[y * E3D_TILE + x] = E3D_NO_SLOT;
}

/* Shades what shows: listed record by record, or as runs that are found row by row and sorted. */
static int shade_visible(e3d_tile_job *job)
{
    e3d_context *context = job->context;
    e3d_worker *worker = job->worker;
    if (shows_pieces(job)) {
        context->kernels->raster_settle(worker->visible, &context->tables[E3D_SET_SCENE], 0);
        clear_outside(job);
        e3d_visible_show(context, worker, job->number);
        begin(job, worker->tile->shown.count == job->tile.width * job->tile.height);
        return e3d_shade_shown(context, worker, &job->tile);
    }
    int gaps;
    int32_t count = find_runs(job, &gaps);
    begin(job, !gaps);
    count = is_again(job) ? leave_out_shaded(job, count) : count;
    return e3d_shade_runs(context, worker, &job->tile, count);
}

/* Tries to find without depths what shows of few records. */
static int shows_spans(const e3d_tile_job *job)
{
    const e3d_context *context = job->context;
    return e3d_plans(context, E3D_PLAN_SPANS) && !context->kept &&
           e3d_show_spans(context, job->worker, &job->tile, job->number);
}

static int shade_spans(e3d_tile_job *job)
{
    begin(job, e3d_spans_cover_all(&job->worker->tile->spans.cover));
    return e3d_shade_shown(job->context, job->worker, &job->tile);
}

static void raster_visible(e3d_tile_job *job)
{
    e3d_context *context = job->context;
    e3d_visible_tile *visible = job->worker->visible;
    if (job->state != E3D_TILE_KEPT)
        e3d_visible_clear(visible, &job->tile);
    e3d_visible_draw(context, visible, job->number, job->state == E3D_TILE_DRAWN);
    if (context->round.finishes)
        e3d_note_depths(context, visible, job->number);
    if (e3d_plans(context, E3D_PLAN_DEPTHS))
        context->kernels->raster_settle(visible, &context->tables[E3D_SET_SCENE], 1);
}

static int draw_visible(e3d_tile_job *job)
{
    e3d_worker *worker = job->worker;
    int spans = shows_spans(job), shaded = 1;
    if (!spans)
        raster_visible(job);
    e3d_lap(worker, &worker->counters.ns_raster);
    if (!e3d_plans(job->context, E3D_PLAN_SHADES))
        begin(job, 0);
    else
        shaded = spans ? shade_spans(job) : shade_visible(job);
    e3d_lap(worker, &worker->counters.ns_shade);
    return shaded;
}

static int draw_scene(e3d_tile_job *job)
{
    return e3d_plans(job->context, E3D_PLAN_SLOTS) ? draw_pieces(job) : draw_visible(job);
}

static int draw_job(e3d_tile_job *job)
{
    e3d_worker *worker = job->worker;
    if (!draw_scene(job) || !e3d_slots_mark(job))
        return 0;
    e3d_resolve(job->context, worker, &job->tile);
    e3d_lap(worker, &worker->counters.ns_resolve);
    return 1;
}

static int draw_tile(e3d_context *context, e3d_worker *worker, int64_t number)
{
    e3d_tile_progress *progress = &context->tiles[number];
    e3d_tile_job job = {.context = context,
                    .worker = worker,
                    .number = number,
                    .tile = e3d_tile_at(context->view, number),
                    .state = e3d_tile_state_of(progress)};
    if (job.state != E3D_TILE_KEPT && !e3d_has_bins(context, number))
        return 1; /* it is cleared, or drawn as it should be */
    worker->visible = job.state == E3D_TILE_KEPT ? &context->kept[number] : &worker->tile->visible;
    int64_t before = worker->counters.shaded;
    if (!draw_job(&job))
        return 0;
    int64_t shaded = worker->counters.shaded - before;
    worker->counters.shaded -= progress->shaded; /* of a tile that is drawn twice, the second time counts */
    progress->shaded = (int32_t)shaded;
    e3d_tile_set_state(progress, E3D_TILE_DRAWN);
    return 1;
}

/* The calling thread asks at most every 20 ms; who is asked may look less often. */
static void poll(e3d_context *context, int64_t now)
{
    e3d_renderer *renderer = context->renderer;
    if (!renderer->poll || now - context->last_poll < 20000000)
        return;
    context->last_poll = now;
    if (renderer->poll(renderer->poll_user)) {
        context->cancelled = 1;
        atomic_store(&context->stop, 1);
    }
}

static void tiles_work(void *argument, int number)
{
    e3d_context *context = argument;
    e3d_worker *worker = context->renderer->workers[number];
    worker->lap = e3d_now_ns();
    e3d_blank_begin(worker);
    while (!atomic_load(&context->stop)) {
        int64_t tile = e3d_take_tile(context, worker, E3D_TO_DRAW);
        if (tile < 0)
            break;
        if (!draw_tile(context, worker, tile)) {
            worker->failed = 1;
            atomic_store(&context->stop, 1);
        }
        if (number == 0)
            poll(context, worker->lap);
    }
    if (!atomic_load(&context->stop))
        e3d_blank_rest(context, worker);
    e3d_lap(worker, &worker->counters.ns_resolve);
    e3d_stream_end();
}

void e3d_tiles(e3d_context *context)
{
    e3d_tables_set(context);
    e3d_queue_tiles(context);
    e3d_pool_run(e3d_tile_count(context->view) > 2 ? context->renderer->threads : 1, tiles_work, context);
}
