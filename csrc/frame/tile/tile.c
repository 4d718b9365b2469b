/* raster, shade and resolve: draws one tile after another; one thread does all stages of a tile. */
#include <stdatomic.h>

#include "base/clock.h"
#include "base/limits.h"
#include "base/machine.h"
#include "base/pool.h"
#include "frame/cull/depths.h"
#include "frame/geometry/bin.h"
#include "frame/geometry/records.h"
#include "frame/pass/prepared.h"
#include "frame/pass/view.h"
#include "frame/shade/identities.h"
#include "frame/shade/shade.h"
#include "frame/store/blank.h"
#include "frame/store/queue.h"
#include "frame/store/resolve.h"
#include "frame/store/store.h"
#include "frame/store/tile_state.h"
#include "frame/tile/alpha_test.h"
#include "frame/tile/blend.h"
#include "frame/tile/memory.h"
#include "frame/tile/multisample.h"
#include "frame/tile/slots.h"
#include "frame/tile/spans.h"
#include "frame/tile/tile.h"
#include "frame/tile/visible.h"
#include "kernels/kernels.h"
#include "kernels/types/shown.h"
#include "kernels/types/visible.h"

/* Whether an earlier round drew this tile, and only the last round's primitives are new. With several samples a pixel, the
 * pixels are averages already, so that all of them are shaded again. */
static int is_again(const e3d_tile_job *job) { return job->state == E3D_TILE_DRAWN && job->in->pass->frame->samples_axis == 1; }

/* ---- stages of a tile ---- */

/* Finds the runs of what shows in the tile, and whether there are gaps between them; returns how many. */
static int32_t find_runs(const e3d_tile_job *job, int *gaps)
{
    return job->in->pass->kernels->find_runs(job->visible, job->tile.width, job->tile.height, job->memory->shade.runs.rows, gaps);
}

/* Whether shading writes no colours and no radiance, since layers are counted. */
static int leaves_outputs(const e3d_prepared *pass)
{
    return (pass->targets->color || pass->targets->radiance) && !e3d_plans(pass, E3D_PLAN_COLORS);
}

/* Fills the tile with its background before it is shaded; `all`: every sample will be shaded, so nothing is filled. */
static void begin(const e3d_tile_job *job, int all)
{
    const e3d_store *store = job->in->shade->store;
    if (is_again(job))
        e3d_resolve_again(store, &job->tile, &job->memory->pixels);
    else if (!all || leaves_outputs(store->pass))
        e3d_resolve_begin(store, &job->memory->pixels);
}

static int shade_runs(const e3d_tile_job *job, int32_t count)
{
    return e3d_shade_runs(job->in->shade, &job->tile, count, &job->shades);
}

/* Whether the tile has records with alpha; they need depths and IDs of all samples, and colours to be blended over. */
static int has_alpha(const e3d_tile_job *job) { return job->masked || job->blended; }

/* Replaces slots by IDs, which samples of records with alpha keep. */
static void name_samples(const e3d_tile_job *job)
{
    int32_t *id = job->visible->id;
    for (int i = 0; i < E3D_TILE_SAMPLES; i++)
        if (id[i] >= 0)
            id[i] = ((const int32_t *)job->memory->slots.ids.data)[id[i]];
}

/* Draws piece after piece, each with a slot: for forward shading, and if the last one in order wins. */
static int draw_pieces(const e3d_tile_job *job)
{
    e3d_tile_memory *memory = job->memory;
    int forward = e3d_plans(job->in->pass, E3D_PLAN_AT_ONCE);
    begin(job, 0);
    if (!e3d_slots_draw(job))
        return 0;
    if (has_alpha(job))
        name_samples(job);
    if (!e3d_alpha_cut(job))
        return 0;
    e3d_lap(memory, &memory->ns_raster);
    if (e3d_plans(job->in->pass, E3D_PLAN_SHADES) && !forward) {
        int gaps;
        int32_t count = find_runs(job, &gaps);
        if (!has_alpha(job))
            e3d_slots_to_ids(&memory->slots, memory->shade.runs.rows, count);
        if (!shade_runs(job, count))
            return 0;
    }
    if (!e3d_alpha_blend(job))
        return 0;
    e3d_lap(memory, &memory->ns_shade);
    return 1;
}

/* Whether the last round drew the owner of a run: a record, or a cluster of fragments. */
static int is_from_last_round(const e3d_bins *bins, uint32_t id)
{
    int bits = bins->tables[E3D_SET_SCENE].bits;
    const e3d_geometry_memory *state = bins->of[id & ((1u << bits) - 1)];
    uint32_t number = (id & (E3D_FRAGMENT_ID - 1)) >> bits;
    return id & E3D_FRAGMENT_ID ? number / E3D_CLUSTER_TRIANGLES >= state->fragments.earlier_drawn
                                : number >= state->sets[E3D_SET_SCENE].earlier_records;
}

/* Removes the runs that are shaded already, and counts their samples. */
static int32_t leave_out_shaded(const e3d_tile_job *job, int32_t count)
{
    e3d_run *runs = job->memory->shade.runs.rows;
    int32_t left = 0;
    for (int32_t i = 0; i < count; i++)
        if (is_from_last_round(job->in->bins, (uint32_t)runs[i].owner))
            runs[left++] = runs[i];
        else
            job->memory->shade.shaded += runs[i].length;
    return left;
}

enum { FEW_PRIMITIVES = 64,
       MANY_RECORDS = 768,
       MOSTLY = 4 }; /* in a tile */

/* Whether samples are listed primitive by primitive: the bins must hold all of the tile, and few records may be wide or
 * hidden. */
static int shows_primitives(const e3d_tile_job *job)
{
    if (!e3d_plans(job->in->pass, E3D_PLAN_LISTS) || job->state == E3D_TILE_KEPT || job->state == E3D_TILE_DRAWN ||
        has_alpha(job))
        return 0;
    e3d_entries in = e3d_count_entries(job->in->bins, job->number);
    uint32_t most = job->out->kept ? in.fragments / MOSTLY : MANY_RECORDS; /* tiles are kept where much is hidden */
    return in.records <= most && in.records + in.fragments >= FEW_PRIMITIVES;
}

/* Removes IDs beyond the viewport, where whole blocks and vectors are written, too. */
static void clear_outside(const e3d_tile_job *job)
{
    int32_t *id = job->visible->id;
    for (int y = 0; y < E3D_TILE; y++)
        for (int x = y < job->tile.height ? job->tile.width : 0; x < E3D_TILE; x++)
            id[y * E3D_TILE + x] = E3D_NO_SLOT;
}

/* Shades what shows: listed record by record, or as runs that are found row by row and sorted. */
static int shade_visible(const e3d_tile_job *job)
{
    const e3d_kernels *kernels = job->in->pass->kernels;
    const e3d_bins *bins = job->in->bins;
    e3d_shown *shown = &job->memory->shade.shown;
    if (shows_primitives(job)) {
        kernels->raster_settle(job->visible, &bins->tables[E3D_SET_SCENE], 0);
        clear_outside(job);
        e3d_visible_show(kernels, bins, job->number, job->visible, shown);
        begin(job, shown->count == job->tile.width * job->tile.height);
        return e3d_shade_shown(job->in->shade, &job->tile, &job->shades);
    }
    int gaps;
    int32_t count = find_runs(job, &gaps);
    begin(job, !gaps);
    return shade_runs(job, is_again(job) ? leave_out_shaded(job, count) : count);
}

/* Tries to find what shows of few records without depths. */
static int shows_spans(const e3d_tile_job *job)
{
    const e3d_prepared *pass = job->in->pass;
    return e3d_plans(pass, E3D_PLAN_SPANS) && !job->out->kept &&
           e3d_show_spans(pass->kernels, job->in->bins, &job->tile, job->number, job->memory);
}

static int shade_spans(const e3d_tile_job *job)
{
    begin(job, e3d_spans_cover_all(&job->memory->spans.cover));
    return e3d_shade_shown(job->in->shade, &job->tile, &job->shades);
}

static void raster_visible(const e3d_tile_job *job)
{
    const e3d_kernels *kernels = job->in->pass->kernels;
    const e3d_bins *bins = job->in->bins;
    if (job->state != E3D_TILE_KEPT)
        e3d_visible_clear(job->visible, &job->tile);
    e3d_visible_draw(job->in->pass, bins, job->number, job->state == E3D_TILE_DRAWN, job->visible);
    if (job->in->finishes)
        e3d_note_depths(kernels, 1, job->visible, &job->out->depths[job->number]);
    if (e3d_plans(job->in->pass, E3D_PLAN_DEPTHS) || has_alpha(job))
        kernels->raster_settle(job->visible, &bins->tables[E3D_SET_SCENE], 1);
}

static void identify(const e3d_tile_job *job, int spans)
{
    if (spans) {
        begin(job, e3d_spans_cover_all(&job->memory->spans.cover));
        e3d_identify_shown(job->in->shade, &job->shades);
        return;
    }
    int gaps;
    int32_t count = find_runs(job, &gaps);
    e3d_identify_runs(job->in->shade, &job->tile, count, &job->shades);
}

/* Finds what is asked for of the samples that show; 0 when memory is out. */
static int find_outputs(const e3d_tile_job *job, int spans)
{
    if (e3d_plans(job->in->pass, E3D_PLAN_SHADES))
        return spans ? shade_spans(job) : shade_visible(job);
    if (e3d_plans(job->in->pass, E3D_PLAN_IDENTIFIES))
        identify(job, spans);
    else
        begin(job, 0);
    return 1;
}

static int draw_visible(const e3d_tile_job *job)
{
    e3d_tile_memory *memory = job->memory;
    int spans = !has_alpha(job) && shows_spans(job);
    if (!spans)
        raster_visible(job);
    if (!e3d_alpha_cut(job))
        return 0;
    e3d_lap(memory, &memory->ns_raster);
    int found = find_outputs(job, spans) && e3d_alpha_blend(job);
    e3d_lap(memory, &memory->ns_shade);
    return found;
}

/* Draws a tile to pixels, or to samples that become pixels. */
static int draw_samples(const e3d_tile_job *job)
{
    int drawn = e3d_plans(job->in->pass, E3D_PLAN_SLOTS) ? draw_pieces(job) : draw_visible(job);
    if (!drawn || !e3d_slots_mark(job))
        return 0;
    e3d_alpha_front(job);
    return 1;
}

static int draw_job(const e3d_tile_job *job)
{
    e3d_tile_memory *memory = job->memory;
    if (!(job->in->pass->pattern ? e3d_multisample_draw(job) : draw_samples(job)))
        return 0;
    e3d_resolve(job->in->shade->store, job->visible, &job->tile, &memory->pixels);
    e3d_lap(memory, &memory->ns_resolve);
    return 1;
}

/* ---- all tiles ---- */

/* The tile's visible surface; with multisampling, that of the first plane. */
static e3d_visible_tile *visible_of(const e3d_prepared *pass, const e3d_tiles_out *out, e3d_tile_memory *memory, int64_t number, e3d_tile_state state)
{
    if (state == E3D_TILE_KEPT)
        return e3d_kept_tile(pass, out, number);
    return pass->pattern ? memory->multisample->planes : &memory->visible;
}

/* Draws a tile; 0 when memory is out. */
static int draw_tile(const e3d_tiles_in *in, e3d_tiles_out *out, e3d_tile_memory *memory, int64_t number)
{
    e3d_tile_progress *progress = &out->progress[number];
    const e3d_tile_state state = e3d_tile_state_of(progress);
    if (state != E3D_TILE_KEPT && !e3d_has_bins(in->bins, number))
        return 1; /* it is cleared, or fully drawn already */
    const int blended = e3d_has_alpha(in->bins, E3D_ALPHA_BLENDED, number);
    const e3d_tile_job job = {.in = in,
                              .out = out,
                              .memory = memory,
                              .shades = {.memory = &memory->shade, .pixels = &memory->pixels, .blank = &memory->blank},
                              .visible = visible_of(in->pass, out, memory, number, state),
                              .tile = e3d_tile_at(in->pass->view, number),
                              .number = number,
                              .state = state,
                              .masked = e3d_has_alpha(in->bins, E3D_ALPHA_MASKED, number),
                              .blended = blended};
    memory->pixels.sampled = !in->pass->pattern && (in->pass->frame->samples_axis > 1 || blended);
    int64_t before = memory->shade.shaded;
    memory->pixels.tile = job.tile;
    if (!draw_job(&job))
        return 0;
    int64_t shaded = memory->shade.shaded - before;
    memory->shade.shaded -= progress->shaded; /* if a tile is drawn twice, only the second time counts */
    progress->shaded = (int32_t)shaded;
    e3d_tile_set_state(progress, E3D_TILE_DRAWN);
    return 1;
}

/* What all threads do with the tiles. */
typedef struct tiles_job {
    const e3d_tiles_in *in;
    e3d_tiles_out *out;
    int64_t last_poll;
    atomic_int status; /* e3d_status: the first one that isn't E3D_OK stops all threads */
} tiles_job;

/* Stops all threads; the first reason stays. */
static void stop(tiles_job *job, e3d_status reason)
{
    int none = E3D_OK;
    atomic_compare_exchange_strong(&job->status, &none, (int)reason);
}

/* The calling thread polls at most every 20 ms; the callback itself may look less often. */
static void poll(tiles_job *job, int64_t now)
{
    const e3d_poll *poll = &job->in->poll;
    if (!poll->ask || now - job->last_poll < 20000000)
        return;
    job->last_poll = now;
    if (poll->ask(poll->user))
        stop(job, E3D_CANCELLED);
}

static void tiles_work(void *argument, int thread)
{
    tiles_job *job = argument;
    e3d_tile_memory *memory = job->out->of[thread];
    memory->lap = e3d_now_ns();
    memory->blank = (e3d_blank_state){.queue = &job->out->queue, .progress = job->out->progress, .thread = thread, .more = 1};
    while (atomic_load(&job->status) == E3D_OK) {
        int64_t tile = e3d_take_tile(&job->out->queue, thread, E3D_TO_DRAW);
        if (tile < 0)
            break;
        if (!draw_tile(job->in, job->out, memory, tile))
            stop(job, E3D_OUT_OF_MEMORY);
        if (thread == 0)
            poll(job, memory->lap);
    }
    if (atomic_load(&job->status) == E3D_OK)
        e3d_blank_rest(job->in->shade->store, job->in->bins, &memory->blank);
    e3d_lap(memory, &memory->ns_resolve);
    e3d_stream_end();
}

e3d_status e3d_tiles(const e3d_tiles_in *in, e3d_tiles_out *out)
{
    int64_t tiles = e3d_tile_count(in->pass->view);
    tiles_job job = {.in = in, .out = out};
    e3d_queue_tiles(&out->queue, tiles);
    e3d_pool_run(tiles > 2 ? in->pass->threads : 1, tiles_work, &job);
    return (e3d_status)atomic_load(&job.status);
}
