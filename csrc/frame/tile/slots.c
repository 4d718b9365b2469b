/* raster, record by record: each record has a slot, in the order of the bins, and a sample keeps the slot of the record that
 * shows. This way is taken if the last record in order shows (R16), if records are shaded at once, and for counts and edges. */
#include <math.h>

#include "base/grow.h"
#include "base/limits.h"
#include "frame/geometry/bin.h"
#include "frame/geometry/lines.h"
#include "frame/geometry/records.h"
#include "frame/pass/prepared.h"
#include "frame/shade/shade.h"
#include "frame/store/resolve.h"
#include "frame/tile/alpha_test.h"
#include "frame/tile/piece.h"
#include "frame/tile/slots.h"
#include "frame/tile/visible.h"
#include "kernels/coverage.h"
#include "kernels/types/records.h"
#include "kernels/types/samples.h"
#include "kernels/types/vertices.h"
#include "kernels/types/visible.h"

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

/* ---- what is done with each record ---- */

typedef int (*piece_action)(const e3d_tile_job *job, const e3d_piece *piece);

/* Gives a record the next free slot. */
static int add_slot(e3d_slots_state *slots, uint32_t id, uint32_t order)
{
    size_t n = slots->ids.count;
    if (!e3d_array_reserve(&slots->ids, n + 1, sizeof(uint32_t)) || !e3d_array_reserve(&slots->orders, n + 1, sizeof(uint32_t)))
        return 0;
    ((uint32_t *)slots->ids.data)[n] = id;
    ((uint32_t *)slots->orders.data)[n] = order;
    slots->ids.count++;
    return 1;
}

static const e3d_record *record_of(const e3d_tile_job *job, int which, uint32_t slot)
{
    return e3d_record_at(&job->in->bins->tables[which], ((const uint32_t *)job->memory->slots.ids.data)[slot]);
}

/* Finds the piece in the tile, or in the plane that the job names. */
static int find_piece(const e3d_tile_job *job, const e3d_record *record, uint32_t slot, e3d_piece *piece)
{
    const e3d_prepared *pass = job->in->pass;
    return pass->pattern ? e3d_piece_in_plane(pass, job->plane, record, &job->tile, slot, piece)
                         : e3d_piece_in_tile(&pass->view->viewport, record, &job->tile, slot, piece);
}

static int visit_link(const e3d_tile_job *job, int which, const e3d_bin_link *link, piece_action action)
{
    e3d_slots_state *slots = &job->memory->slots;
    for (uint32_t i = 0; i < link->count; i++) {
        const e3d_record *record = e3d_record_at(&job->in->bins->tables[which], link->id[i]);
        e3d_piece piece;
        if (!find_piece(job, record, (uint32_t)slots->ids.count, &piece))
            continue;
        if (!add_slot(slots, link->id[i], record->order) || !action(job, &piece))
            return 0;
    }
    return 1;
}

static int visit_bins(const e3d_tile_job *job, int which, piece_action action)
{
    const e3d_bins *bins = job->in->bins;
    job->memory->slots.ids.count = 0;
    for (int32_t t = 0; t < bins->threads; t++) {
        const e3d_record_set *set = &bins->of[t]->sets[which];
        const e3d_bin_link *link = e3d_first_records(set, 0, job->number);
        for (; link; link = e3d_bin_link_at(set, link->next))
            if (!visit_link(job, which, link, action))
                return 0;
    }
    return 1;
}

static e3d_tile_buffers buffers_of(const e3d_tile_job *job, float *z, int32_t *slot)
{
    return (e3d_tile_buffers){z, slot, job->memory->slots.orders.data};
}

static int act_visible(const e3d_tile_job *job, const e3d_piece *piece)
{
    e3d_tile_buffers buffers = buffers_of(job, job->visible->z, job->visible->id);
    if (e3d_plans(job->in->pass, E3D_PLAN_SORTS))
        job->in->pass->kernels->raster_overwrite(piece, &buffers);
    else
        job->in->pass->kernels->raster_depth(piece, &buffers);
    return 1;
}

static int act_count(const e3d_tile_job *job, const e3d_piece *piece)
{
    const e3d_record *record = record_of(job, E3D_SET_SCENE, piece->slot);
    e3d_marks_memory *marks = &job->memory->marks;
    e3d_tile_buffers buffers = buffers_of(job, marks->bound, marks->count);
    if (record->meta & E3D_RECORD_FACE)
        job->in->pass->kernels->raster_count(piece, &buffers);
    return 1;
}

/* R36: an edge may lie behind the kept depth by the slope of its piece times the line's reach. */
static void find_edge_limits(const e3d_tile_job *job)
{
    e3d_marks_memory *marks = &job->memory->marks;
    const e3d_visible_tile *visible = job->visible;
    const e3d_record_table *table = &job->in->bins->tables[E3D_SET_SCENE];
    float reach = (float)e3d_line_style_of(job->in->pass->frame).reach * (1.0f / 256.0f) + 0.5f;
    for (int i = 0; i < E3D_TILE_SAMPLES; i++) {
        marks->edge_limit[i] = E3D_BEYOND_FAR;
        if (visible->id[i] < 0)
            continue;
        const e3d_record *kept = e3d_plans(job->in->pass, E3D_PLAN_SLOTS) && !job->in->pass->pattern
                                     ? record_of(job, E3D_SET_SCENE, (uint32_t)visible->id[i])
                                     : e3d_record_at(table, (uint32_t)visible->id[i]);
        float slope = (fabsf(kept->gx) + fabsf(kept->gy)) * reach, range = kept->zmax - kept->zmin;
        float limit = visible->z[i] + (slope < range ? slope : range);
        if (limit < E3D_BEYOND_FAR)
            marks->edge_limit[i] = limit;
    }
}

static int act_mark(const e3d_tile_job *job, const e3d_piece *piece)
{
    e3d_marks_memory *marks = &job->memory->marks;
    float *limit = e3d_plans(job->in->pass, E3D_PLAN_EDGE_DEPTHS) ? marks->edge_limit : marks->bound;
    e3d_tile_buffers buffers = buffers_of(job, limit, marks->count);
    e3d_piece marked = *piece;
    marked.slot = 1;
    job->in->pass->kernels->raster_mark(&marked, &buffers);
    return 1;
}

/* Finds the runs of one slot in a box; their owner is the slot's record. */
static int32_t runs_of_slot(const e3d_tile_job *job, int32_t slot, const e3d_box *box)
{
    e3d_run *runs = job->memory->shade.runs.rows;
    const int32_t *shows = job->visible->id;
    int32_t count = 0, id = ((const int32_t *)job->memory->slots.ids.data)[slot];
    for (int32_t y = box->y0; y <= box->y1; y++)
        for (int32_t x = box->x0, first = x; x <= box->x1; x++, first = x) {
            while (x <= box->x1 && shows[y * E3D_TILE + x] == slot)
                x++;
            if (x > first)
                runs[count++] = (e3d_run){id, (uint16_t)(y * E3D_TILE + first), (uint16_t)(x - first)};
        }
    return count;
}

/* Forward shading: shades at once the samples that a piece has just won. */
static int act_forward(const e3d_tile_job *job, const e3d_piece *piece)
{
    act_visible(job, piece);
    e3d_box box = {piece->x0, piece->y0, piece->x1, piece->y1};
    box.x1 = box.x1 < job->tile.width - 1 ? box.x1 : job->tile.width - 1;
    box.y1 = box.y1 < job->tile.height - 1 ? box.y1 : job->tile.height - 1;
    int32_t count = runs_of_slot(job, (int32_t)piece->slot, &box);
    return e3d_shade_runs(job->in->shade, &job->tile, count, &job->shades);
}

/* ---- a tile ---- */

static void clear_marks(e3d_marks_memory *marks)
{
    for (int i = 0; i < E3D_TILE_SAMPLES; i++)
        marks->count[i] = 0;
}

int e3d_slots_draw(const e3d_tile_job *job)
{
    e3d_visible_empty(job->visible);
    return visit_bins(job, E3D_SET_SCENE, e3d_plans(job->in->pass, E3D_PLAN_AT_ONCE) ? act_forward : act_visible);
}

void e3d_slots_to_ids(const e3d_slots_state *slots, e3d_run *runs, int32_t count)
{
    for (int32_t i = 0; i < count; i++)
        runs[i].owner = ((const int32_t *)slots->ids.data)[runs[i].owner];
}

int e3d_slots_mark_planes(const e3d_tile_job *job)
{
    const e3d_prepared *pass = job->in->pass;
    e3d_marks_memory *marks = &job->memory->marks;
    e3d_tile_job plane = *job;
    for (plane.plane = 0; plane.plane < pass->pattern->count; plane.plane++, plane.visible++) {
        e3d_samples *samples = &job->memory->multisample->samples[plane.plane];
        if (e3d_plans(pass, E3D_PLAN_EDGE_DEPTHS))
            find_edge_limits(&plane);
        clear_marks(marks);
        if (!visit_bins(&plane, E3D_SET_EDGES, act_mark))
            return 0;
        e3d_resolve_wire_samples(job->in->shade->store, marks->count, &job->tile, samples);
    }
    e3d_lap(job->memory, &job->memory->ns_raster);
    return 1;
}

int e3d_slots_mark(const e3d_tile_job *job)
{
    const e3d_prepared *pass = job->in->pass;
    e3d_marks_memory *marks = &job->memory->marks;
    int counts = e3d_plans(pass, E3D_PLAN_COUNTS_OVERDRAW), edges = e3d_plans(pass, E3D_PLAN_EDGES);
    if (!counts && !edges)
        return 1;
    if (e3d_plans(pass, E3D_PLAN_EDGE_DEPTHS))
        find_edge_limits(job); /* while the slots are still the scene's */
    if (counts) {
        clear_marks(marks);
        if (!visit_bins(job, E3D_SET_SCENE, act_count) || !e3d_alpha_count(job))
            return 0;
        e3d_resolve_overdraw(marks->count, &job->tile, &job->memory->pixels);
    }
    if (edges) {
        clear_marks(marks);
        if (!visit_bins(job, E3D_SET_EDGES, act_mark))
            return 0;
        e3d_resolve_wire(job->in->shade->store, marks->count, &job->tile, &job->memory->pixels);
    }
    e3d_lap(job->memory, &job->memory->ns_raster);
    return 1;
}
