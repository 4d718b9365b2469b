/* raster and shade, blended records: a tile's records overlap by overlap (R83, R84). An overlap is a set of
 * records whose depths may interleave; no two overlaps share a depth.
 *
 * In:  the tile's visible surface and its colours; the records of the blended bins.
 * Out: the colours with these records laid over them, and the nearest layer of each sample, if that is asked for.
 * Always: overlaps come from far to near, so that only the layers of one are sorted, and only where a sample has several.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/grow.h"
#include "base/limits.h"
#include "data/sample_patterns.h"
#include "e3d.h"
#include "kernels/types/shown.h"
#include "kernels/types/visible.h"
#include "frame/geometry/bin.h"
#include "frame/geometry/records.h"
#include "frame/pass/plan.h"
#include "frame/pass/prepared.h"
#include "frame/shade/job.h"
#include "frame/shade/runs.h"
#include "frame/shade/shade.h"
#include "frame/tile/a_buffer.h"
#include "frame/tile/alpha_list.h"
#include "frame/tile/blend.h"
#include "frame/tile/memory.h"
#include "frame/tile/piece.h"

enum { MOST_LAYERS = 1 << 17 }; /* roughly the most layers of the rows that are done together */

void e3d_alpha_free(e3d_alpha_memory *memory)
{
    e3d_array_free(&memory->pieces);
    e3d_array_free(&memory->sorted);
    e3d_array_free(&memory->ranges);
    e3d_array_free(&memory->overlaps);
    e3d_array_free(&memory->begun);
    e3d_a_buffer_free(&memory->a_buffer);
}

/* ---- the records of a tile ---- */

/* The least and the greatest depth of a record in a tile. */
typedef struct depth_range {
    float near, far;
} depth_range;

static int is_tame(float v) { return v < 0x1p100f && v > -0x1p100f; }

/* Depth is monotone along both axes, so that its values at the corners of the box bound it, unless a step overflows. */
static depth_range range_of(const e3d_piece *p)
{
    if (!is_tame(p->z0) || !is_tame(p->gx) || !is_tame(p->gy))
        return (depth_range){p->zmin, p->zmax};
    int32_t x = p->gx > 0 ? p->x0 : p->x1, y = p->gy > 0 ? p->y0 : p->y1;
    return (depth_range){e3d_piece_depth(p, x, y), e3d_piece_depth(p, p->x0 + p->x1 - x, p->y0 + p->y1 - y)};
}

/* Adds a record if it shows in the tile, nearer than the far plane. */
static void add_piece(const e3d_tile_job *job, uint32_t id, e3d_alpha_memory *memory)
{
    e3d_piece *piece = (e3d_piece *)memory->pieces.data + memory->pieces.count;
    if (!e3d_alpha_piece(job, id, piece))
        return;
    /* With multisampling, and if layers bend, all records are one overlap */
    int at_once = job->in->pass->pattern || e3d_plans(job->in->pass, E3D_PLAN_BENDS);
    depth_range range = at_once ? (depth_range){0.0f, 0.0f} : range_of(piece);
    if (range.near > 1.0f)
        return;
    range.far = range.far < 1.0f ? range.far : 1.0f; /* R15 */
    ((depth_range *)memory->ranges.data)[memory->pieces.count++] = range;
}

/* Adds the records of a link; 0 when memory is out. */
static int add_link(const e3d_tile_job *job, const e3d_bin_link *link, e3d_alpha_memory *memory)
{
    const e3d_record_table *table = &job->in->bins->tables[E3D_SET_SCENE];
    size_t room = memory->pieces.count + link->count;
    if (!e3d_array_reserve(&memory->pieces, room, sizeof(e3d_piece)) || !e3d_array_reserve(&memory->ranges, room, sizeof(depth_range)))
        return 0;
    for (uint32_t i = 0; i < link->count; i++)
        __builtin_prefetch(e3d_record_at(table, link->id[i]));
    for (uint32_t i = 0; i < link->count; i++)
        add_piece(job, link->id[i], memory);
    return 1;
}

static int find_pieces(const e3d_tile_job *job)
{
    const e3d_bins *bins = job->in->bins;
    e3d_alpha_memory *memory = &job->memory->alpha;
    memory->pieces.count = 0;
    for (int32_t t = 0; t < bins->threads; t++) {
        const e3d_record_set *set = &bins->of[t]->sets[E3D_SET_SCENE];
        const e3d_bin_link *link = e3d_first_alpha(set, E3D_ALPHA_BLENDED, job->number);
        for (; link; link = e3d_next_alpha(set, E3D_ALPHA_BLENDED, link))
            if (!add_link(job, link, memory))
                return 0;
    }
    return 1;
}

/* ---- overlaps ---- */

/* The depths of a tile's records, cut into slices. */
typedef struct slicing {
    float near, scale;
} slicing;

static int32_t slice_of(const slicing *s, float z)
{
    float slice = (z - s->near) * s->scale;
    return slice > 0.0f ? slice < E3D_ALPHA_SLICES - 1 ? (int32_t)slice : E3D_ALPHA_SLICES - 1 : 0;
}

static slicing slicing_of(const depth_range *ranges, size_t count)
{
    float near = 1.0f, far = -1.0f;
    for (size_t i = 0; i < count; i++) {
        near = ranges[i].near < near ? ranges[i].near : near;
        far = ranges[i].far > far ? ranges[i].far : far;
    }
    return (slicing){near, far - near > 0x1p-60f ? (float)E3D_ALPHA_SLICES / (far - near) : 0.0f};
}

/* Numbers overlaps from near to far: a slice begins one if no record reaches into it from the slice before. Returns how many
 * there are, the overlap of each record, and the number of records in each overlap. */
static int32_t find_overlaps(const depth_range *ranges, size_t count, int32_t *overlap, int32_t records[E3D_ALPHA_SLICES])
{
    const slicing s = slicing_of(ranges, count);
    int32_t begun[E3D_ALPHA_SLICES] = {0}, done[E3D_ALPHA_SLICES] = {0}, of[E3D_ALPHA_SLICES], overlaps = 0, open = 0;
    for (size_t i = 0; i < count; i++) {
        overlap[i] = slice_of(&s, ranges[i].near);
        begun[overlap[i]]++;
        done[slice_of(&s, ranges[i].far)]++;
    }
    for (int32_t k = 0; k < E3D_ALPHA_SLICES; k++) {
        if (!open && begun[k])
            records[overlaps++] = 0;
        of[k] = overlaps - 1;
        open += begun[k] - done[k];
    }
    for (size_t i = 0; i < count; i++) {
        overlap[i] = of[overlap[i]];
        records[overlap[i]]++;
    }
    return overlaps;
}

/* Sorts the records by overlap, the farthest first; returns how many overlaps there are, or -1 when memory is out. */
static int32_t sort_pieces(e3d_alpha_memory *memory, int32_t records[E3D_ALPHA_SLICES])
{
    size_t count = memory->pieces.count;
    int32_t next[E3D_ALPHA_SLICES];
    if (!e3d_array_reserve(&memory->sorted, count, sizeof(e3d_piece)) || !e3d_array_reserve(&memory->overlaps, count, sizeof(int32_t)))
        return -1;
    const e3d_piece *pieces = memory->pieces.data;
    int32_t *overlap = memory->overlaps.data, overlaps = find_overlaps(memory->ranges.data, count, overlap, records), at = 0;
    for (int32_t g = overlaps - 1; g >= 0; g--) {
        next[g] = at;
        at += records[g];
    }
    for (size_t i = 0; i < count && overlaps > 1; i++)
        ((e3d_piece *)memory->sorted.data)[next[overlap[i]]++] = pieces[i];
    return overlaps;
}

/* ---- an overlap ---- */

/* How many rows are done together, so that they don't have too many layers. */
static int32_t rows_of(const e3d_piece *pieces, int32_t count)
{
    int64_t most = 0;
    for (int32_t i = 0; i < count; i++)
        most += (int64_t)(pieces[i].x1 - pieces[i].x0 + 1) * (pieces[i].y1 - pieces[i].y0 + 1);
    int64_t rows = most <= MOST_LAYERS ? E3D_TILE : (int64_t)E3D_TILE * MOST_LAYERS / most;
    return rows < 1 ? 1 : (int32_t)rows;
}

/* Whether layers must be kept even if no sample has two. */
static int keeps_all(const e3d_tile_job *job)
{
    return job->in->pass->pattern || e3d_plans(job->in->pass, E3D_PLAN_FRONT) || e3d_plans(job->in->pass, E3D_PLAN_BENDS) || e3d_radiance_of(job);
}

/* Blends rows y .. end - 1 of an overlap's records. If no sample is met twice, there is nothing to sort. */
static int blend_rows(const e3d_tile_job *job, const e3d_piece *pieces, int32_t count, int32_t y, int32_t end)
{
    e3d_alpha_memory *memory = &job->memory->alpha;
    e3d_a_buffer_clear(&memory->a_buffer);
    if (!e3d_alpha_begin(job, 0))
        return 0;
    for (int32_t i = 0; i < count; i++) {
        e3d_piece rows = pieces[i];
        rows.y0 = rows.y0 > y ? rows.y0 : y;
        rows.y1 = rows.y1 < end - 1 ? rows.y1 : end - 1;
        if (rows.y0 <= rows.y1 && !e3d_alpha_add(job, &rows, e3d_a_buffer_keep))
            return 0;
    }
    if (!memory->a_buffer.z.count && !memory->list.met && !keeps_all(job))
        return !job->memory->shade.shown.count || e3d_alpha_shade(job, E3D_SINK_SAMPLES, (e3d_shaded_list){0});
    return e3d_a_buffer_keep(job) && e3d_a_buffer_blend(job);
}

static int blend_overlap(const e3d_tile_job *job, const e3d_piece *pieces, int32_t count)
{
    int32_t rows = rows_of(pieces, count);
    for (int32_t y = 0; y < E3D_TILE; y += rows)
        if (!blend_rows(job, pieces, count, y, y + rows < E3D_TILE ? y + rows : E3D_TILE))
            return 0;
    return 1;
}

/* From far to near. */
static int blend_overlaps(const e3d_tile_job *job)
{
    e3d_alpha_memory *memory = &job->memory->alpha;
    int32_t records[E3D_ALPHA_SLICES], overlaps = sort_pieces(memory, records);
    const e3d_piece *pieces = overlaps > 1 ? memory->sorted.data : memory->pieces.data;
    if (overlaps < 0)
        return 0;
    for (int32_t g = overlaps - 1; g >= 0; g--) {
        if (!blend_overlap(job, pieces, records[g]))
            return 0;
        pieces += records[g];
    }
    return 1;
}

/* ---- records that are sorted already ---- */

/* The list holds one record's samples. Removes those where the visible record comes later in order; returns how many are left. */
static int32_t leave_later(const e3d_tile_job *job)
{
    float *z = job->memory->alpha.z;
    e3d_shown *shown = &job->memory->shade.shown;
    int32_t left = 0, id = (int32_t)shown->primitive[0].id;
    for (int32_t n = 0; n < shown->count; n++) {
        int32_t sample = shown->sample[n];
        shown->sample[left] = sample;
        z[left] = z[n];
        left += z[n] < E3D_BEYOND_FAR && id > job->visible->id[sample];
    }
    return shown->count = left;
}

/* The same with multisampling, for each sample of each pixel. */
static int32_t leave_later_in_planes(const e3d_tile_job *job)
{
    int32_t *covers = job->memory->multisample->alpha.cover;
    e3d_shown *shown = &job->memory->shade.shown;
    int32_t left = 0, id = (int32_t)shown->primitive[0].id;
    for (int32_t n = 0; n < shown->count; n++) {
        int32_t pixel = shown->sample[n] & (E3D_TILE_SAMPLES - 1);
        uint32_t cover = 0;
        for (uint32_t some = (uint32_t)covers[n]; some; some &= some - 1)
            cover |= id > job->visible[__builtin_ctz(some)].id[pixel] ? some & -some : 0;
        if (!cover)
            continue;
        covers[left] = (int32_t)cover;
        shown->sample[left++] = pixel | __builtin_ctz(cover) << E3D_SHOWN_NUMBER;
    }
    return shown->count = left;
}

/* Blends the listed record over the samples that it is later than. */
static int lay_later(const e3d_tile_job *job)
{
    const e3d_sample_pattern *pattern = job->in->pass->pattern;
    if (!job->memory->shade.shown.count || !(pattern ? leave_later_in_planes(job) : leave_later(job)))
        return 1;
    if (!keeps_all(job))
        return e3d_alpha_shade(job, E3D_SINK_SAMPLES, (e3d_shaded_list){0});
    e3d_a_buffer_clear(&job->memory->alpha.a_buffer);
    if (!e3d_a_buffer_keep(job))
        return 0;
    if (!pattern)
        return e3d_a_buffer_blend(job);
    e3d_a_buffer_lay(job);
    return 1;
}

static int blend_sequence(const e3d_tile_job *job)
{
    const e3d_piece *pieces = job->memory->alpha.pieces.data;
    for (size_t i = 0; i < job->memory->alpha.pieces.count; i++) {
        if (!e3d_alpha_begin(job, 0) || !e3d_alpha_add(job, &pieces[i], lay_later) || !lay_later(job))
            return 0;
    }
    return 1;
}

/* ---- the nearest layers ---- */

/* Shades the outputs of the samples whose nearest surface is a layer. */
static int shade_front(const e3d_tile_job *job)
{
    const int32_t *front = job->memory->alpha.a_buffer.front_id;
    e3d_runs_memory *runs = &job->memory->shade.runs;
    int32_t count = 0;
    if (!e3d_plans(job->in->pass, E3D_PLAN_OUTPUTS))
        return 1;
    for (int32_t s = 0; s < E3D_TILE_SAMPLES; s++) {
        if (front[s] < 0)
            continue;
        if (s % E3D_TILE && front[s - 1] == front[s])
            runs->rows[count - 1].length++;
        else
            runs->rows[count++] = (e3d_run){front[s], (uint16_t)s, 1};
    }
    e3d_show_runs(e3d_sort_runs(runs->rows, runs->spare, count), count, &job->memory->shade.shown);
    return !count || e3d_alpha_shade(job, E3D_SINK_OUTPUTS, (e3d_shaded_list){0});
}

void e3d_alpha_front(const e3d_tile_job *job)
{
    const e3d_a_buffer *buffer = &job->memory->alpha.a_buffer;
    if (!job->blended || !e3d_plans(job->in->pass, E3D_PLAN_FRONT))
        return;
    for (int32_t s = 0; s < E3D_TILE_SAMPLES; s++)
        if (buffer->front_id[s] >= 0) {
            job->visible->z[s] = buffer->front_z[s];
            job->visible->id[s] = buffer->front_id[s];
        }
}

/* R123: replaces sums that overflowed. Beyond the picture nothing may have been written. */
static void leave_finite(const e3d_tile_job *job, float *radiance)
{
    int axis = job->in->pass->frame->samples_axis;
    for (int y = 0; y < job->tile.height / axis; y++, radiance += 3 * E3D_TILE)
        for (int i = 0; i < 3 * (job->tile.width / axis); i++)
            radiance[i] = fabsf(radiance[i]) <= FLT_MAX ? radiance[i] : 0.0f;
}

int e3d_alpha_blend(const e3d_tile_job *job)
{
    e3d_a_buffer *buffer = &job->memory->alpha.a_buffer;
    if (!job->blended)
        return 1;
    if (e3d_plans(job->in->pass, E3D_PLAN_FRONT))
        memset(buffer->front_id, 0xFF, sizeof buffer->front_id); /* E3D_NO_SLOT */
    if (!find_pieces(job))
        return 0;
    int done = e3d_plans(job->in->pass, E3D_PLAN_SORTS) ? blend_sequence(job) : blend_overlaps(job);
    if (e3d_radiance_of(job))
        leave_finite(job, e3d_radiance_of(job));
    return done && (!e3d_plans(job->in->pass, E3D_PLAN_FRONT) || shade_front(job));
}
