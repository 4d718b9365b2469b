/* raster, record by record: each record has a slot, in the order of the bins, and samples keep the slot of the one that shows.
 *
 * Where the last record in order shows (R16), where records are shaded at once, and where they are counted or are edges.
 */
#include <math.h>

#include "core/grow.h"
#include "core/limits.h"
#include "e3d.h"
#include "kernels/coverage.h"
#include "kernels/kernels.h"
#include "kernels/types/records.h"
#include "kernels/types/shown.h"
#include "kernels/types/visible.h"
#include "pipeline/pass/plan.h"
#include "pipeline/shade/shade.h"
#include "pipeline/state/context.h"
#include "pipeline/state/records.h"
#include "pipeline/state/renderer.h"
#include "pipeline/state/tile_memory.h"
#include "pipeline/state/worker.h"
#include "pipeline/store/resolve.h"
#include "pipeline/tile/slots.h"

void e3d_marks_init(e3d_marks_memory *marks)
{
    for (int i = 0; i < E3D_TILE_SAMPLES + E3D_PAD; i++)
        marks->bound[i] = E3D_BEYOND_FAR;
}

void e3d_slots_free(e3d_slots_state *slots)
{
    e3d_array_free(&slots->ids);
    e3d_array_free(&slots->orders);
}

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

/* ---- what is done with each record ---- */

typedef int (*piece_action)(e3d_tile_job *job, const e3d_piece *piece);

/* The next free slot is this record's. */
static int add_slot(e3d_worker *worker, uint32_t id, uint32_t order)
{
    size_t n = worker->slots.ids.count;
    if (!e3d_array_reserve(&worker->slots.ids, n + 1, sizeof(uint32_t)) ||
        !e3d_array_reserve(&worker->slots.orders, n + 1, sizeof(uint32_t)))
        return 0;
    ((uint32_t *)worker->slots.ids.data)[n] = id;
    ((uint32_t *)worker->slots.orders.data)[n] = order;
    worker->slots.ids.count++;
    return 1;
}

static const e3d_record *record_of(const e3d_tile_job *job, int which, uint32_t slot)
{
    return e3d_record_at(&job->context->tables[which], ((const uint32_t *)job->worker->slots.ids.data)[slot]);
}

static int visit_block(e3d_tile_job *job, int which, const e3d_bin_block *block, piece_action action)
{
    e3d_worker *worker = job->worker;
    for (uint32_t i = 0; i < block->count; i++) {
        const e3d_record *record = e3d_record_at(&job->context->tables[which], block->id[i]);
        e3d_piece piece;
        if (!prepare_piece(job->context, record, &job->tile, (uint32_t)worker->slots.ids.count, &piece))
            continue;
        if (!add_slot(worker, block->id[i], record->order) || !action(job, &piece))
            return 0;
    }
    return 1;
}

static int visit_bins(e3d_tile_job *job, int which, piece_action action)
{
    e3d_renderer *renderer = job->context->renderer;
    job->worker->slots.ids.count = 0;
    for (int32_t w = 0; w < renderer->threads; w++) {
        const e3d_record_set *set = &renderer->workers[w]->sets[which];
        const e3d_bin_block *block = e3d_first_records(set, &set->bins, job->number);
        for (; block; block = e3d_next_records(set, block))
            if (!visit_block(job, which, block, action))
                return 0;
    }
    return 1;
}

static e3d_tile_buffers buffers_of(const e3d_tile_job *job, float *z, int32_t *slot)
{
    return (e3d_tile_buffers){z, slot, job->worker->slots.orders.data};
}

static int act_visible(e3d_tile_job *job, const e3d_piece *piece)
{
    e3d_visible_tile *visible = job->worker->visible;
    e3d_tile_buffers buffers = buffers_of(job, visible->z, visible->id);
    if (e3d_plans(job->context, E3D_PLAN_SORTS))
        job->context->kernels->raster_overwrite(piece, &buffers);
    else
        job->context->kernels->raster_depth(piece, &buffers);
    return 1;
}

static int act_count(e3d_tile_job *job, const e3d_piece *piece)
{
    const e3d_record *record = record_of(job, E3D_SET_SCENE, piece->slot);
    e3d_tile_memory *memory = job->worker->tile;
    e3d_tile_buffers buffers = buffers_of(job, memory->marks.bound, memory->marks.count);
    if (record->meta & E3D_RECORD_FACE)
        job->context->kernels->raster_count(piece, &buffers);
    return 1;
}

/* R36: an edge may lie behind the kept depth by the slope of that piece over the line's reach. */
static void find_edge_limits(e3d_tile_job *job)
{
    e3d_tile_memory *memory = job->worker->tile;
    const e3d_visible_tile *visible = job->worker->visible;
    float reach = (float)job->context->lines.reach * (1.0f / 256.0f) + 0.5f;
    for (int i = 0; i < E3D_TILE_SAMPLES; i++) {
        memory->marks.edge_limit[i] = E3D_BEYOND_FAR;
        if (visible->id[i] < 0)
            continue;
        const e3d_record *kept = e3d_plans(job->context, E3D_PLAN_SLOTS)
                                     ? record_of(job, E3D_SET_SCENE, (uint32_t)visible->id[i])
                                     : e3d_record_at(&job->context->tables[E3D_SET_SCENE], (uint32_t)visible->id[i]);
        float slope = (fabsf(kept->gx) + fabsf(kept->gy)) * reach, range = kept->zmax - kept->zmin;
        float limit = visible->z[i] + (slope < range ? slope : range);
        if (limit < E3D_BEYOND_FAR)
            memory->marks.edge_limit[i] = limit;
    }
}

static int act_mark(e3d_tile_job *job, const e3d_piece *piece)
{
    e3d_tile_memory *memory = job->worker->tile;
    float *limit = e3d_plans(job->context, E3D_PLAN_EDGE_DEPTHS) ? memory->marks.edge_limit : memory->marks.bound;
    e3d_tile_buffers buffers = buffers_of(job, limit, memory->marks.count);
    e3d_piece marked = *piece;
    marked.slot = 1;
    job->context->kernels->raster_mark(&marked, &buffers);
    return 1;
}

/* The runs of one slot in a box, owned by its record. */
static int32_t runs_of_slot(const e3d_worker *worker, int32_t slot, const e3d_box *box)
{
    e3d_tile_memory *memory = worker->tile;
    int32_t count = 0, id = ((const int32_t *)worker->slots.ids.data)[slot];
    for (int32_t y = box->y0; y <= box->y1; y++)
        for (int32_t x = box->x0, first = x; x <= box->x1; x++, first = x) {
            while (x <= box->x1 && worker->visible->id[y * E3D_TILE + x] == slot)
                x++;
            if (x > first)
                memory->runs.rows[count++] = (e3d_run){id, (uint16_t)(y * E3D_TILE + first),
                                                  (uint16_t)(x - first)};
        }
    return count;
}

/* Forward shading: whatever the piece just won is shaded at once. */
static int act_forward(e3d_tile_job *job, const e3d_piece *piece)
{
    act_visible(job, piece);
    e3d_box box = {piece->x0, piece->y0, piece->x1, piece->y1};
    box.x1 = box.x1 < job->tile.width - 1 ? box.x1 : job->tile.width - 1;
    box.y1 = box.y1 < job->tile.height - 1 ? box.y1 : job->tile.height - 1;
    int32_t count = runs_of_slot(job->worker, (int32_t)piece->slot, &box);
    return e3d_shade_runs(job->context, job->worker, &job->tile, count);
}

/* ---- a tile ---- */

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
        memory->marks.count[i] = 0;
}

int e3d_slots_draw(e3d_tile_job *job)
{
    clear_samples(job->worker->visible);
    return visit_bins(job, E3D_SET_SCENE, e3d_plans(job->context, E3D_PLAN_AT_ONCE) ? act_forward : act_visible);
}

void e3d_slots_to_ids(const e3d_worker *worker, int32_t count)
{
    e3d_run *runs = worker->tile->runs.rows;
    for (int32_t i = 0; i < count; i++)
        runs[i].owner = ((const int32_t *)worker->slots.ids.data)[runs[i].owner];
}

int e3d_slots_mark(e3d_tile_job *job)
{
    const e3d_context *context = job->context;
    int counts = e3d_plans(context, E3D_PLAN_COUNTS_OVERDRAW), edges = e3d_plans(context, E3D_PLAN_EDGES);
    if (!counts && !edges)
        return 1;
    if (e3d_plans(context, E3D_PLAN_EDGE_DEPTHS))
        find_edge_limits(job); /* while the slots are the scene's */
    if (counts) {
        clear_marks(job->worker->tile);
        if (!visit_bins(job, E3D_SET_SCENE, act_count))
            return 0;
        e3d_resolve_overdraw(job->context, job->worker, &job->tile);
    }
    if (edges) {
        clear_marks(job->worker->tile);
        if (!visit_bins(job, E3D_SET_EDGES, act_mark))
            return 0;
        e3d_resolve_wire(job->context, job->worker, &job->tile);
    }
    e3d_lap(job->worker, &job->worker->counters.ns_raster);
    return 1;
}
