/* raster and shade, blended records: an A-buffer of one tile (Carpenter 1984), by groups of records that share no depth (R83, R84).
 *
 * In:  the tile's visible surface and its colours; the records of the blended bins.
 * Out: the colours with these records laid over them, and the nearest fragment of each sample, if that is asked for.
 * Always: groups come from far to near, so that only the fragments of one are sorted, and only where a sample has several.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "core/grow.h"
#include "core/limits.h"
#include "e3d.h"
#include "kernels/kernels.h"
#include "kernels/types/alpha.h"
#include "kernels/types/records.h"
#include "kernels/types/samples.h"
#include "kernels/types/shown.h"
#include "kernels/types/visible.h"
#include "pipeline/geometry/bin.h"
#include "pipeline/geometry/records.h"
#include "pipeline/pass/plan.h"
#include "pipeline/pass/prepared.h"
#include "pipeline/shade/job.h"
#include "pipeline/shade/runs.h"
#include "pipeline/store/outputs.h"
#include "pipeline/tile/alpha.h"
#include "pipeline/tile/blend.h"
#include "pipeline/tile/job.h"
#include "pipeline/tile/memory.h"
#include "pipeline/tile/piece.h"

enum { MOST_FRAGMENTS = 1 << 17 }; /* of rows that are done together, as far as can be foreseen */

/* ---- the records of a tile ---- */

/* The least and the greatest depth of a record in a tile. */
typedef struct depth_range {
    float near, far;
} depth_range;

static int is_tame(float v) { return v < 0x1p100f && v > -0x1p100f; }

/* z is monotone along both axes, so its values at the corners of the box bound it, unless a step overflows. */
static depth_range range_of(const e3d_piece *p)
{
    if (!is_tame(p->z0) || !is_tame(p->gx) || !is_tame(p->gy))
        return (depth_range){p->zmin, p->zmax};
    int32_t x = p->gx > 0 ? p->x0 : p->x1, y = p->gy > 0 ? p->y0 : p->y1;
    return (depth_range){e3d_piece_depth(p, x, y), e3d_piece_depth(p, p->x0 + p->x1 - x, p->y0 + p->y1 - y)};
}

/* Adds a record that shows in the tile, nearer than the far plane. */
static void add_piece(const e3d_tile_job *job, uint32_t id, e3d_alpha_memory *memory)
{
    e3d_piece *piece = (e3d_piece *)memory->pieces.data + memory->pieces.count;
    const e3d_record *record = e3d_record_at(&job->in->bins->tables[E3D_SET_SCENE], id);
    if (!e3d_piece_in_tile(&job->in->pass->view->viewport, record, &job->tile, id, piece))
        return;
    depth_range range = range_of(piece);
    if (range.near > 1.0f)
        return;
    range.far = range.far < 1.0f ? range.far : 1.0f; /* R15 */
    ((depth_range *)memory->ranges.data)[memory->pieces.count++] = range;
}

/* The records of a block; 0 when memory is out. */
static int add_block(const e3d_tile_job *job, const e3d_bin_block *block, e3d_alpha_memory *memory)
{
    const e3d_record_table *table = &job->in->bins->tables[E3D_SET_SCENE];
    size_t room = memory->pieces.count + block->count;
    if (!e3d_array_reserve(&memory->pieces, room, sizeof(e3d_piece)) || !e3d_array_reserve(&memory->ranges, room, sizeof(depth_range)))
        return 0;
    for (uint32_t i = 0; i < block->count; i++)
        __builtin_prefetch(e3d_record_at(table, block->id[i]));
    for (uint32_t i = 0; i < block->count; i++)
        add_piece(job, block->id[i], memory);
    return 1;
}

static int find_pieces(const e3d_tile_job *job)
{
    const e3d_bins *bins = job->in->bins;
    e3d_alpha_memory *memory = &job->memory->alpha;
    memory->pieces.count = 0;
    for (int32_t t = 0; t < bins->threads; t++) {
        const e3d_record_set *set = &bins->of[t]->sets[E3D_SET_SCENE];
        const e3d_bin_block *block = e3d_first_alpha(set, E3D_ALPHA_BLENDED, job->number);
        for (; block; block = e3d_next_alpha(set, E3D_ALPHA_BLENDED, block))
            if (!add_block(job, block, memory))
                return 0;
    }
    return 1;
}

/* ---- groups ---- */

/* The slices that the depths of a tile's records are cut into. */
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

/* Numbers groups from near to far: a slice begins one where no record reaches over from the slice before. Returns how many there are;
 * of each record its group, of each group how many records it has. */
static int32_t find_groups(const depth_range *ranges, size_t count, int32_t *group, int32_t records[E3D_ALPHA_SLICES])
{
    const slicing s = slicing_of(ranges, count);
    int32_t begun[E3D_ALPHA_SLICES] = {0}, done[E3D_ALPHA_SLICES] = {0}, of[E3D_ALPHA_SLICES], groups = 0, open = 0;
    for (size_t i = 0; i < count; i++) {
        group[i] = slice_of(&s, ranges[i].near);
        begun[group[i]]++;
        done[slice_of(&s, ranges[i].far)]++;
    }
    for (int32_t k = 0; k < E3D_ALPHA_SLICES; k++) {
        if (!open && begun[k])
            records[groups++] = 0;
        of[k] = groups - 1;
        open += begun[k] - done[k];
    }
    for (size_t i = 0; i < count; i++) {
        group[i] = of[group[i]];
        records[group[i]]++;
    }
    return groups;
}

/* Sorts the records by their groups, the farthest first; returns how many groups there are, or -1 when memory is out. */
static int32_t sort_pieces(e3d_alpha_memory *memory, int32_t records[E3D_ALPHA_SLICES])
{
    size_t count = memory->pieces.count;
    int32_t next[E3D_ALPHA_SLICES];
    if (!e3d_array_reserve(&memory->sorted, count, sizeof(e3d_piece)) || !e3d_array_reserve(&memory->groups, count, sizeof(int32_t)))
        return -1;
    const e3d_piece *pieces = memory->pieces.data;
    int32_t *group = memory->groups.data, groups = find_groups(memory->ranges.data, count, group, records), at = 0;
    for (int32_t g = groups - 1; g >= 0; g--) {
        next[g] = at;
        at += records[g];
    }
    for (size_t i = 0; i < count && groups > 1; i++)
        ((e3d_piece *)memory->sorted.data)[next[group[i]]++] = pieces[i];
    return groups;
}

/* ---- fragments ---- */

int e3d_alpha_reserve_fragments(e3d_alpha_fragments *f, size_t count, size_t ids, int transmits)
{
    return (!transmits || e3d_array_reserve(&f->through, count, sizeof(float[4]))) && e3d_array_reserve(&f->z, count, sizeof(float)) &&
           e3d_array_reserve(&f->sample, count, sizeof(int32_t)) &&
           e3d_array_reserve(&f->of, count, sizeof(int32_t)) && e3d_array_reserve(&f->color, count, sizeof(float[4])) &&
           e3d_array_reserve(&f->ids, ids, sizeof(int32_t));
}

void e3d_alpha_clear_fragments(e3d_alpha_fragments *f) { f->z.count = f->ids.count = 0; }

/* Where the radiance of the tile's pixels is gathered, over which that of fragments is laid; NULL where it isn't asked for. */
static void *radiance_of(const e3d_tile_job *job)
{
    return e3d_outputs_gathered(job->in->shade->store, &job->memory->pixels, E3D_OUTPUT_RADIANCE);
}

/* Shades what is listed, and keeps it to be sorted. */
static int keep_list(const e3d_tile_job *job)
{
    const e3d_alpha_memory *memory = &job->memory->alpha;
    const e3d_shown *shown = &job->memory->shade.shown;
    e3d_alpha_fragments *f = &job->memory->alpha.fragments;
    size_t first = f->z.count, count = (size_t)shown->count, ids = f->ids.count;
    int transmits = job->in->pass->draws->any_transmits, lights = radiance_of(job) != NULL;
    if (!count)
        return 1;
    if (!e3d_alpha_reserve_fragments(f, first + count, ids + (size_t)shown->pieces, transmits) ||
        (lights && !e3d_array_reserve(&f->light, first + count, sizeof(float[4]))) ||
        !e3d_alpha_shade(job, E3D_ALPHA_KEEP, (float (*)[4])f->color.data + first, transmits ? (float (*)[4])f->through.data + first : NULL,
                         lights ? (float (*)[4])f->light.data + first : NULL))
        return 0;
    memcpy((float *)f->z.data + first, memory->z, count * sizeof(float));
    memcpy((int32_t *)f->sample.data + first, shown->sample, count * sizeof(int32_t));
    for (size_t n = 0; n < count; n++)
        ((int32_t *)f->of.data)[first + n] = shown->of[n] + (int32_t)ids;
    for (int32_t p = 0; p < shown->pieces; p++)
        ((int32_t *)f->ids.data)[ids + (size_t)p] = (int32_t)shown->piece[p].id;
    f->z.count = first + count;
    f->ids.count = ids + (size_t)shown->pieces;
    return 1;
}

/* The bits of a depth as an integer that is greater the farther it is; -0 is 0. */
static int32_t depth_key(float z)
{
    float positive = z + 0.0f;
    int32_t bits;
    memcpy(&bits, &positive, sizeof bits);
    return bits < 0 ? bits ^ 0x7FFFFFFF : bits;
}

/* Lists the fragments by sample: the last ones first, since they come roughly from near to far. */
static int list_by_sample(e3d_alpha_fragments *f)
{
    size_t count = f->z.count;
    uint32_t *first = f->first, at = 0;
    if (!e3d_array_reserve(&f->depth, count + E3D_PAD, sizeof(int32_t)) || !e3d_array_reserve(&f->which, count, sizeof(uint32_t)))
        return 0;
    const int32_t *sample = f->sample.data;
    const float *z = f->z.data;
    int32_t *depth = f->depth.data;
    uint32_t *which = f->which.data;
    memset(first, 0, sizeof f->first);
    for (size_t n = 0; n < count; n++)
        first[sample[n]]++;
    for (int s = 0; s < E3D_TILE_SAMPLES; s++)
        first[s] = at += first[s]; /* so far where those of the next one begin */
    for (size_t n = 0; n < count; n++) {
        uint32_t place = --first[sample[n]];
        depth[place] = depth_key(z[n]);
        which[place] = (uint32_t)n;
    }
    first[E3D_TILE_SAMPLES] = at;
    memset(depth + count, 0, E3D_PAD * sizeof *depth);
    return 1;
}

/* Whether fragment a is laid before b: it is farther, or later in order (R83). */
static int is_before(const e3d_record_table *table, const e3d_alpha_fragments *f, uint32_t a, uint32_t b)
{
    const float *z = f->z.data;
    const int32_t *of = f->of.data, *ids = f->ids.data;
    if (z[a] != z[b])
        return z[a] > z[b];
    return e3d_id_comes_first(table, ids[of[b]], ids[of[a]]);
}

/* Lets an element sink to its place in a heap, whose first is laid last. */
static void sink(const e3d_record_table *table, const e3d_alpha_fragments *f, uint32_t *heap, uint32_t at, uint32_t count)
{
    uint32_t sinking = heap[at];
    for (uint32_t child; (child = 2 * at + 1) < count; at = child) {
        if (child + 1 < count && is_before(table, f, heap[child], heap[child + 1]))
            child++;
        if (!is_before(table, f, sinking, heap[child]))
            break;
        heap[at] = heap[child];
    }
    heap[at] = sinking;
}

/* Sorts the fragments of a sample in the order in which they are laid: a heap, since a sample may have any number of them. */
static void sort_sample(const e3d_record_table *table, const e3d_alpha_fragments *f, uint32_t *which, uint32_t count)
{
    for (uint32_t at = count / 2; at-- > 0;)
        sink(table, f, which, at, count);
    for (uint32_t end = count; end-- > 1;) {
        uint32_t last = which[0];
        which[0] = which[end];
        which[end] = last;
        sink(table, f, which, 0, end);
    }
}

/* Lays the fragments of one sample, which are sorted, over its colour (R84). */
static void blend_sample(const e3d_alpha_layers *layers, int32_t sample, const uint32_t *which, uint32_t count, e3d_samples *samples)
{
    float over[4] = {samples->color[0][sample], samples->color[1][sample], samples->color[2][sample], samples->counts[sample]};
    for (uint32_t i = 0; i < count; i++)
        e3d_lay_any(layers->color[which[i]], layers->through ? layers->through[which[i]] : NULL, over);
    for (int k = 0; k < 3; k++)
        samples->color[k][sample] = over[k];
    samples->counts[sample] = over[3];
    if (layers->light)
        e3d_lay_light(layers, which, (int)count, sample);
}

/* The nearest fragment of a sample that shows (a face that a wireframe leaves out does), of those that are sorted. */
static void find_front(e3d_alpha_memory *memory, int32_t sample, const uint32_t *which, uint32_t count)
{
    const e3d_alpha_fragments *f = &memory->fragments;
    const float (*colors)[4] = (const float (*)[4])f->color.data;
    for (uint32_t i = count; i-- > 0;) {
        float alpha = colors[which[i]][3];
        if (alpha >= E3D_LEAST_ALPHA || -alpha >= E3D_LEAST_ALPHA) {
            memory->front_z[sample] = ((const float *)f->z.data)[which[i]];
            memory->front_id[sample] = ((const int32_t *)f->ids.data)[((const int32_t *)f->of.data)[which[i]]];
            return;
        }
    }
}

/* Blends samples one by one: those that the kernel leaves, or, where the nearest fragments are asked for, all. */
static void blend_slowly(const e3d_tile_job *job, const e3d_alpha_layers *layers, int32_t sample, e3d_samples *samples)
{
    e3d_alpha_memory *memory = &job->memory->alpha;
    e3d_alpha_fragments *f = &memory->fragments;
    uint32_t *which = (uint32_t *)f->which.data + f->first[sample], count = f->first[sample + 1] - f->first[sample];
    if (!count)
        return;
    sort_sample(&job->in->bins->tables[E3D_SET_SCENE], f, which, count);
    blend_sample(layers, sample, which, count, samples);
    if (e3d_plans(job->in->pass, E3D_PLAN_FRONT))
        find_front(memory, sample, which, count);
}

int e3d_alpha_blend_fragments(const e3d_tile_job *job, e3d_samples *samples)
{
    e3d_alpha_memory *memory = &job->memory->alpha;
    e3d_alpha_fragments *f = &memory->fragments;
    if (!f->z.count)
        return 1;
    if (!list_by_sample(f))
        return 0;
    float (*lit)[3] = radiance_of(job);
    const e3d_alpha_layers layers = {.first = f->first,
                                     .depth = f->depth.data,
                                     .which = f->which.data,
                                     .color = (const float (*)[4])f->color.data,
                                     .through = job->in->pass->draws->any_transmits ? (const float (*)[4])f->through.data : NULL,
                                     .light = lit ? (const float (*)[4])f->light.data : NULL,
                                     .lit = lit,
                                     .axis = job->in->pass->frame->samples_axis};
    if (e3d_plans(job->in->pass, E3D_PLAN_FRONT)) {
        for (int32_t s = 0; s < E3D_TILE_SAMPLES; s++)
            blend_slowly(job, &layers, s, samples);
        return 1;
    }
    int left = job->in->pass->kernels->blend(&layers, samples, memory->left);
    for (int i = 0; i < left; i++)
        blend_slowly(job, &layers, memory->left[i], samples);
    return 1;
}

/* ---- a group ---- */

/* How many rows are done together, so that their fragments are not too many. */
static int32_t rows_of(const e3d_piece *pieces, int32_t count)
{
    int64_t most = 0;
    for (int32_t i = 0; i < count; i++)
        most += (int64_t)(pieces[i].x1 - pieces[i].x0 + 1) * (pieces[i].y1 - pieces[i].y0 + 1);
    int64_t rows = most <= MOST_FRAGMENTS ? E3D_TILE : (int64_t)E3D_TILE * MOST_FRAGMENTS / most;
    return rows < 1 ? 1 : (int32_t)rows;
}

/* Whether fragments must be kept even where each sample has one. */
static int keeps_all(const e3d_tile_job *job) { return e3d_plans(job->in->pass, E3D_PLAN_FRONT) || radiance_of(job); }

/* Rows y .. end - 1 of records whose depths may interleave. Where no sample is met twice, there is nothing to sort. */
static int blend_rows(const e3d_tile_job *job, const e3d_piece *pieces, int32_t count, int32_t y, int32_t end)
{
    e3d_alpha_memory *memory = &job->memory->alpha;
    e3d_alpha_begin(job, 0);
    e3d_alpha_clear_fragments(&memory->fragments);
    for (int32_t i = 0; i < count; i++) {
        e3d_piece rows = pieces[i];
        rows.y0 = rows.y0 > y ? rows.y0 : y;
        rows.y1 = rows.y1 < end - 1 ? rows.y1 : end - 1;
        if (rows.y0 <= rows.y1 && !e3d_alpha_add(job, &rows, keep_list))
            return 0;
    }
    if (!memory->fragments.z.count && !memory->list.met && !keeps_all(job))
        return !job->memory->shade.shown.count || e3d_alpha_shade(job, E3D_ALPHA_LAY, NULL, NULL, NULL);
    return keep_list(job) && e3d_alpha_blend_fragments(job, &job->memory->pixels.samples);
}

static int blend_group(const e3d_tile_job *job, const e3d_piece *pieces, int32_t count)
{
    int32_t rows = rows_of(pieces, count);
    for (int32_t y = 0; y < E3D_TILE; y += rows)
        if (!blend_rows(job, pieces, count, y, y + rows < E3D_TILE ? y + rows : E3D_TILE))
            return 0;
    return 1;
}

/* From far to near. */
static int blend_groups(const e3d_tile_job *job)
{
    e3d_alpha_memory *memory = &job->memory->alpha;
    int32_t records[E3D_ALPHA_SLICES], groups = sort_pieces(memory, records);
    const e3d_piece *pieces = groups > 1 ? memory->sorted.data : memory->pieces.data;
    if (groups < 0)
        return 0;
    for (int32_t g = groups - 1; g >= 0; g--) {
        if (!blend_group(job, pieces, records[g]))
            return 0;
        pieces += records[g];
    }
    return 1;
}

/* ---- records that are sorted already ---- */

/* The list is of one record: what comes before the record that is kept lies behind it. */
static int lay_later(const e3d_tile_job *job)
{
    e3d_alpha_memory *memory = &job->memory->alpha;
    e3d_shown *shown = &job->memory->shade.shown;
    int32_t left = 0, id = shown->pieces ? (int32_t)shown->piece[0].id : 0;
    for (int32_t n = 0; n < shown->count; n++) {
        int32_t sample = shown->sample[n];
        shown->sample[left] = sample;
        memory->z[left] = memory->z[n];
        left += memory->z[n] < E3D_BEYOND_FAR && id > job->visible->id[sample];
    }
    shown->count = left;
    if (!left)
        return 1;
    if (!keeps_all(job))
        return e3d_alpha_shade(job, E3D_ALPHA_LAY, NULL, NULL, NULL);
    e3d_alpha_clear_fragments(&memory->fragments);
    return keep_list(job) && e3d_alpha_blend_fragments(job, &job->memory->pixels.samples);
}

static int blend_sequence(const e3d_tile_job *job)
{
    const e3d_piece *pieces = job->memory->alpha.pieces.data;
    for (size_t i = 0; i < job->memory->alpha.pieces.count; i++) {
        e3d_alpha_begin(job, 0);
        if (!e3d_alpha_add(job, &pieces[i], lay_later) || !lay_later(job))
            return 0;
    }
    return 1;
}

/* ---- the nearest fragments ---- */

/* Shades the outputs of the samples that a fragment is in front of. */
static int shade_front(const e3d_tile_job *job)
{
    const int32_t *front = job->memory->alpha.front_id;
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
    return !count || e3d_alpha_shade(job, E3D_ALPHA_OUTPUTS, NULL, NULL, NULL);
}

void e3d_alpha_front(const e3d_tile_job *job)
{
    const e3d_alpha_memory *memory = &job->memory->alpha;
    if (!job->blended || !e3d_plans(job->in->pass, E3D_PLAN_FRONT))
        return;
    for (int32_t s = 0; s < E3D_TILE_SAMPLES; s++)
        if (memory->front_id[s] >= 0) {
            job->visible->z[s] = memory->front_z[s];
            job->visible->id[s] = memory->front_id[s];
        }
}

/* R123: where sums are too great for a number. Beyond the picture nothing may have been written. */
static void leave_finite(const e3d_tile_job *job, float *radiance)
{
    int axis = job->in->pass->frame->samples_axis;
    for (int y = 0; y < job->tile.height / axis; y++, radiance += 3 * E3D_TILE)
        for (int i = 0; i < 3 * (job->tile.width / axis); i++)
            radiance[i] = fabsf(radiance[i]) <= FLT_MAX ? radiance[i] : 0.0f;
}

int e3d_alpha_blend(const e3d_tile_job *job)
{
    e3d_alpha_memory *memory = &job->memory->alpha;
    if (!job->blended)
        return 1;
    if (e3d_plans(job->in->pass, E3D_PLAN_FRONT))
        memset(memory->front_id, 0xFF, sizeof memory->front_id); /* E3D_NO_SLOT */
    if (!find_pieces(job))
        return 0;
    int done = e3d_plans(job->in->pass, E3D_PLAN_SORTS) ? blend_sequence(job) : blend_groups(job);
    if (radiance_of(job))
        leave_finite(job, radiance_of(job));
    return done && (!e3d_plans(job->in->pass, E3D_PLAN_FRONT) || shade_front(job));
}
