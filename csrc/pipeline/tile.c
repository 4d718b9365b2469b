/* raster, shade and resolve: one tile after another, each by one thread from first to last. */
#include <math.h>

#include "core/clock.h"
#include "core/grow.h"
#include "core/limits.h"
#include "core/pool.h"
#include "core/stream.h"
#include "e3d.h"
#include "kernels/coverage.h"
#include "kernels/kernels.h"
#include "kernels/types/records.h"
#include "kernels/types/shown.h"
#include "kernels/types/visible.h"
#include "pipeline/bin.h"
#include "pipeline/blank.h"
#include "pipeline/depths.h"
#include "pipeline/frame.h"
#include "pipeline/late.h"
#include "pipeline/plan.h"
#include "pipeline/records.h"
#include "pipeline/resolve.h"
#include "pipeline/shade.h"
#include "pipeline/share.h"
#include "pipeline/spans.h"
#include "pipeline/tile.h"
#include "pipeline/tile_state.h"
#include "pipeline/view.h"
#include "pipeline/visible.h"

/* ---- a record in a tile ---- */

/* 0 if an edge rejects the whole tile. */
static int prepare_piece(const e3d_context *context, const e3d_record *record, const e3d_tile *tile,
                         uint32_t slot, e3d_piece *piece)
{
    for (int k = 0; k < 3; k++)
        if (!e3d_piece_edge(record, k, tile->x, tile->y, piece))
            return 0;
    e3d_box box = e3d_sample_box(record->x, record->y, &context->view->viewport);
    piece->base_x = box.x0 - tile->x;
    piece->base_y = box.y0 - tile->y;
    piece->x0 = e3d_in_tile(box.x0 - tile->x);
    piece->y0 = e3d_in_tile(box.y0 - tile->y);
    piece->x1 = e3d_in_tile(box.x1 - tile->x);
    piece->y1 = e3d_in_tile(box.y1 - tile->y);
    piece->z0 = record->z0;
    piece->gx = record->gx;
    piece->gy = record->gy;
    piece->zmin = record->zmin;
    piece->zmax = record->zmax;
    piece->slot = slot;
    piece->order = record->order;
    return 1;
}

/* ---- what is done with each piece of a tile ---- */

typedef struct tile_job {
    e3d_context *context;
    e3d_worker *worker;
    e3d_tile tile;
    int64_t number;
    e3d_tile_state state; /* before this */
} tile_job;

/* Whether the tile's pixels are written, but for what the last round added. Those of several samples are averages by now, and so all of
 * them are shaded once more. */
static int is_again(const tile_job *job) { return job->state == E3D_TILE_DRAWN && job->context->frame->samples_axis == 1; }

typedef int (*piece_action)(tile_job *job, const e3d_piece *piece);

/* The next free slot is this record's. */
static int add_slot(e3d_worker *worker, uint32_t id, uint32_t order)
{
    size_t n = worker->slots.count;
    if (!e3d_array_reserve(&worker->slots, n + 1, sizeof(uint32_t)) ||
        !e3d_array_reserve(&worker->orders, n + 1, sizeof(uint32_t)))
        return 0;
    ((uint32_t *)worker->slots.data)[n] = id;
    ((uint32_t *)worker->orders.data)[n] = order;
    worker->slots.count++;
    return 1;
}

static const e3d_record *record_of(const tile_job *job, int pass, uint32_t slot)
{
    return e3d_record_at(&job->context->tables[pass], ((const uint32_t *)job->worker->slots.data)[slot]);
}

static int run_block(tile_job *job, int pass, const e3d_bin_block *block, piece_action action)
{
    e3d_worker *worker = job->worker;
    for (uint32_t i = 0; i < block->count; i++) {
        const e3d_record *record = e3d_record_at(&job->context->tables[pass], block->id[i]);
        e3d_piece piece;
        if (!prepare_piece(job->context, record, &job->tile, (uint32_t)worker->slots.count, &piece))
            continue;
        if (!add_slot(worker, block->id[i], record->order) || !action(job, &piece))
            return 0;
    }
    return 1;
}

static int run_bins(tile_job *job, int pass, piece_action action)
{
    e3d_renderer *renderer = job->context->renderer;
    job->worker->slots.count = 0;
    for (int32_t w = 0; w < renderer->threads; w++) {
        const e3d_record_set *set = &renderer->workers[w]->pass[pass];
        const e3d_bin_block *block = e3d_first_records(set, &set->bins, job->number);
        for (; block; block = e3d_next_records(set, block))
            if (!run_block(job, pass, block, action))
                return 0;
    }
    return 1;
}

static e3d_tile_buffers buffers_of(const tile_job *job, float *z, int32_t *slot)
{
    return (e3d_tile_buffers){z, slot, job->worker->orders.data};
}

static int act_visible(tile_job *job, const e3d_piece *piece)
{
    e3d_visible_tile *visible = job->worker->visible;
    e3d_tile_buffers buffers = buffers_of(job, visible->z, visible->id);
    if (e3d_plans(job->context, E3D_PLAN_SORTS))
        job->context->kernels->raster_overwrite(piece, &buffers);
    else
        job->context->kernels->raster_depth(piece, &buffers);
    return 1;
}

static int act_count(tile_job *job, const e3d_piece *piece)
{
    const e3d_record *record = record_of(job, E3D_PASS_SCENE, piece->slot);
    e3d_tile_memory *memory = job->worker->tile;
    e3d_tile_buffers buffers = buffers_of(job, memory->bound, memory->mark);
    if (record->meta & E3D_RECORD_FACE)
        job->context->kernels->raster_count(piece, &buffers);
    return 1;
}

/* R36: an edge may lie behind the kept depth by the slope of that piece over the line's reach. */
static void find_edge_limits(tile_job *job)
{
    e3d_tile_memory *memory = job->worker->tile;
    const e3d_visible_tile *visible = job->worker->visible;
    float reach = (float)job->context->lines.reach * (1.0f / 256.0f) + 0.5f;
    for (int i = 0; i < E3D_TILE_SAMPLES; i++) {
        memory->edge_limit[i] = E3D_BEYOND_FAR;
        if (visible->id[i] < 0)
            continue;
        const e3d_record *kept = e3d_plans(job->context, E3D_PLAN_SLOTS)
                                     ? record_of(job, E3D_PASS_SCENE, (uint32_t)visible->id[i])
                                     : e3d_record_at(&job->context->tables[E3D_PASS_SCENE], (uint32_t)visible->id[i]);
        float slope = (fabsf(kept->gx) + fabsf(kept->gy)) * reach, range = kept->zmax - kept->zmin;
        float limit = visible->z[i] + (slope < range ? slope : range);
        if (limit < E3D_BEYOND_FAR)
            memory->edge_limit[i] = limit;
    }
}

static int act_mark(tile_job *job, const e3d_piece *piece)
{
    e3d_tile_memory *memory = job->worker->tile;
    float *limit = e3d_plans(job->context, E3D_PLAN_EDGE_DEPTHS) ? memory->edge_limit : memory->bound;
    e3d_tile_buffers buffers = buffers_of(job, limit, memory->mark);
    e3d_piece marked = *piece;
    marked.slot = 1;
    job->context->kernels->raster_mark(&marked, &buffers);
    return 1;
}

/* The runs of one slot in a box, owned by its record. */
static int32_t runs_of_slot(const e3d_worker *worker, int32_t slot, const e3d_box *box)
{
    e3d_tile_memory *memory = worker->tile;
    int32_t count = 0, id = ((const int32_t *)worker->slots.data)[slot];
    for (int32_t y = box->y0; y <= box->y1; y++)
        for (int32_t x = box->x0, first = x; x <= box->x1; x++, first = x) {
            while (x <= box->x1 && worker->visible->id[y * E3D_TILE + x] == slot)
                x++;
            if (x > first)
                memory->runs[count++] = (e3d_run){id, (uint16_t)(y * E3D_TILE + first),
                                                  (uint16_t)(x - first)};
        }
    return count;
}

/* Forward shading: whatever the piece just won is shaded at once. */
static int act_forward(tile_job *job, const e3d_piece *piece)
{
    act_visible(job, piece);
    e3d_box box = {piece->x0, piece->y0, piece->x1, piece->y1};
    box.x1 = box.x1 < job->tile.width - 1 ? box.x1 : job->tile.width - 1;
    box.y1 = box.y1 < job->tile.height - 1 ? box.y1 : job->tile.height - 1;
    int32_t count = runs_of_slot(job->worker, (int32_t)piece->slot, &box);
    return e3d_shade_runs(job->context, job->worker, &job->tile, count);
}

/* ---- stages of a tile ---- */

static void clear_samples(e3d_visible_tile *visible)
{
    for (int i = 0; i < E3D_TILE_SAMPLES; i++) {
        visible->z[i] = E3D_BEYOND_FAR;
        visible->id[i] = E3D_NO_SLOT;
    }
    visible->noted = 0;
}

static void clear_marks(e3d_tile_memory *memory)
{
    for (int i = 0; i < E3D_TILE_SAMPLES; i++)
        memory->mark[i] = 0;
}

/* The runs of what shows in the tile, and whether there are gaps between them; how many. */
static int32_t find_runs(const tile_job *job, int *gaps)
{
    return job->context->kernels->find_runs(job->worker->visible, job->tile.width, job->tile.height,
                                            job->worker->tile->runs, gaps);
}

/* What the tile's samples are before they are shaded: anything, where all of them will be. */
static void begin(const tile_job *job, int all)
{
    const e3d_context *context = job->context;
    int counted = context->targets->color && !e3d_plans(context, E3D_PLAN_COLORS); /* instead of shaded */
    if (is_again(job))
        e3d_resolve_again(context, job->worker, &job->tile);
    else if (counted || !all)
        e3d_resolve_begin(context, job->worker);
}

static void slots_to_ids(const e3d_worker *worker, int32_t count)
{
    e3d_run *runs = worker->tile->runs;
    for (int32_t i = 0; i < count; i++)
        runs[i].owner = ((const int32_t *)worker->slots.data)[runs[i].owner];
}

/* Piece after piece, each with a slot of its own: forward shading, and where the last in order wins. */
static int draw_pieces(tile_job *job)
{
    e3d_context *context = job->context;
    e3d_worker *worker = job->worker;
    int forward = e3d_plans(context, E3D_PLAN_AT_ONCE);
    begin(job, 0);
    clear_samples(worker->visible);
    if (!run_bins(job, E3D_PASS_SCENE, forward ? act_forward : act_visible))
        return 0;
    e3d_lap(worker, &worker->counters.ns_raster);
    if (e3d_plans(context, E3D_PLAN_SHADES) && !forward) {
        int gaps;
        int32_t count = find_runs(job, &gaps);
        slots_to_ids(worker, count);
        if (!e3d_shade_runs(context, worker, &job->tile, count))
            return 0;
    }
    e3d_lap(worker, &worker->counters.ns_shade);
    return 1;
}

/* Whether the last round drew what owns a run, a record or a cluster of fragments. */
static int is_late(const e3d_context *context, uint32_t id)
{
    int bits = context->tables[E3D_PASS_SCENE].bits;
    const e3d_worker *worker = context->renderer->workers[id & ((1u << bits) - 1)];
    uint32_t number = (id & (E3D_FRAGMENT_ID - 1)) >> bits;
    return id & E3D_FRAGMENT_ID ? number / E3D_CLUSTER_TRIANGLES >= worker->fragments.earlier_drawn
                                : number >= worker->pass[E3D_PASS_SCENE].earlier_records;
}

/* Only the runs that are not shaded yet; the others' samples are counted. */
static int32_t leave_out_shaded(const tile_job *job, int32_t count)
{
    e3d_run *runs = job->worker->tile->runs;
    int32_t left = 0;
    for (int32_t i = 0; i < count; i++)
        if (is_late(job->context, (uint32_t)runs[i].owner))
            runs[left++] = runs[i];
        else
            job->worker->counters.shaded += runs[i].length;
    return left;
}

enum { FEW_PIECES = 64, MANY_RECORDS = 768, MOSTLY = 4 }; /* in a tile */

/* Whether samples are found where pieces lie: the bins must hold all of them, and few records be wide or hidden. */
static int shows_pieces(const tile_job *job)
{
    const e3d_context *context = job->context;
    if (!e3d_plans(context, E3D_PLAN_LISTS) || job->state == E3D_TILE_KEPT || job->state == E3D_TILE_DRAWN)
        return 0;
    e3d_entries in = e3d_count_entries(context, job->number);
    uint32_t most = context->kept ? in.fragments / MOSTLY : MANY_RECORDS; /* kept: where things hide each other */
    return in.records <= most && in.records + in.fragments >= FEW_PIECES;
}

/* No ID beyond the viewport, where whole blocks and vectors are written, too. */
static void clear_outside(const tile_job *job)
{
    int32_t *id = job->worker->visible->id;
    for (int y = 0; y < E3D_TILE; y++)
        for (int x = y < job->tile.height ? job->tile.width : 0; x < E3D_TILE; x++)
            id[y * E3D_TILE + x] = E3D_NO_SLOT;
}

/* Of pieces where they lie, one after the other; or runs are found in rows and sorted. */
static int shade_visible(tile_job *job)
{
    e3d_context *context = job->context;
    e3d_worker *worker = job->worker;
    if (shows_pieces(job)) {
        context->kernels->raster_settle(worker->visible, &context->tables[E3D_PASS_SCENE], 0);
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

/* What shows of few records is found without depths, where these are not needed for anything else. */
static int shows_spans(const tile_job *job)
{
    const e3d_context *context = job->context;
    return e3d_plans(context, E3D_PLAN_SPANS) && !context->kept &&
           e3d_show_spans(context, job->worker, &job->tile, job->number);
}

static int shade_spans(tile_job *job)
{
    begin(job, e3d_spans_cover_all(&job->worker->tile->cover));
    return e3d_shade_shown(job->context, job->worker, &job->tile);
}

static void raster_visible(tile_job *job)
{
    e3d_context *context = job->context;
    e3d_visible_tile *visible = job->worker->visible;
    if (job->state != E3D_TILE_KEPT)
        e3d_visible_clear(visible, &job->tile);
    e3d_visible_draw(context, visible, job->number, job->state == E3D_TILE_DRAWN);
    if (context->round.finishes)
        e3d_note_depths(context, visible, job->number);
    if (e3d_plans(context, E3D_PLAN_DEPTHS))
        context->kernels->raster_settle(visible, &context->tables[E3D_PASS_SCENE], 1);
}

static int draw_visible(tile_job *job)
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

static int draw_scene(tile_job *job)
{
    return e3d_plans(job->context, E3D_PLAN_SLOTS) ? draw_pieces(job) : draw_visible(job);
}

/* What is drawn beside the visible surfaces: overdraw counts, or wireframe edges. */
static int draw_marks(tile_job *job)
{
    const e3d_context *context = job->context;
    int counts = e3d_plans(context, E3D_PLAN_COUNTS_OVERDRAW), edges = e3d_plans(context, E3D_PLAN_EDGES);
    if (!counts && !edges)
        return 1;
    if (e3d_plans(context, E3D_PLAN_EDGE_DEPTHS))
        find_edge_limits(job); /* while the slots are the scene's */
    if (counts) {
        clear_marks(job->worker->tile);
        if (!run_bins(job, E3D_PASS_SCENE, act_count))
            return 0;
        e3d_resolve_overdraw(job->context, job->worker, &job->tile);
    }
    if (edges) {
        clear_marks(job->worker->tile);
        if (!run_bins(job, E3D_PASS_WIRE, act_mark))
            return 0;
        e3d_resolve_wire(job->context, job->worker, &job->tile);
    }
    e3d_lap(job->worker, &job->worker->counters.ns_raster);
    return 1;
}

static int draw_job(tile_job *job)
{
    e3d_worker *worker = job->worker;
    if (!draw_scene(job) || !draw_marks(job))
        return 0;
    e3d_resolve(job->context, worker, &job->tile);
    e3d_lap(worker, &worker->counters.ns_resolve);
    return 1;
}

static int draw_tile(e3d_context *context, e3d_worker *worker, int64_t number)
{
    e3d_tile_progress *progress = &context->tiles[number];
    tile_job job = {.context = context,
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
    e3d_late_rest(context, worker);
    if (!atomic_load(&context->stop))
        e3d_blank_rest(context, worker);
    e3d_lap(worker, &worker->counters.ns_resolve);
    e3d_stream_end();
}

void e3d_tiles(e3d_context *context)
{
    e3d_tables_set(context);
    e3d_share_tiles(context);
    e3d_pool_run(e3d_tile_count(context->view) > 2 ? context->renderer->threads : 1, tiles_work, context);
}
