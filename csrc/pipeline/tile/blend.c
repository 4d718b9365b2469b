/* raster and shade, blended records: an A-buffer of one tile (Carpenter 1984), by groups of records that share no depth (R83, R84).
 *
 * In:  the tile's visible surface and its colours; the records of the blended bins.
 * Out: the colours with these records laid over them, and the nearest fragment of each sample, if that is asked for.
 * Always: groups come from far to near, so that only the fragments of one are sorted, and only where a sample has several.
 */
#include <string.h>

#include "core/grow.h"
#include "core/limits.h"
#include "e3d.h"
#include "kernels/kernels.h"
#include "kernels/types/alpha.h"
#include "kernels/types/shown.h"
#include "kernels/types/visible.h"
#include "pipeline/geometry/bin.h"
#include "pipeline/geometry/records.h"
#include "pipeline/pass/plan.h"
#include "pipeline/pass/prepared.h"
#include "pipeline/pass/view.h"
#include "pipeline/shade/shade.h"
#include "pipeline/tile/alpha.h"
#include "pipeline/tile/piece.h"
#include "pipeline/tile/tile.h"

enum { MOST_FRAGMENTS = 1 << 17 }; /* of rows that are done together, as far as can be foreseen: 4 MB */

/* ---- the records of a tile ---- */

/* 0 when memory is out. */
static int add_piece(const e3d_tile_job *job, uint32_t id)
{
    e3d_array *pieces = &job->memory->alpha.pieces;
    const e3d_record *record = e3d_record_at(&job->in->bins->tables[E3D_SET_SCENE], id);
    if (!e3d_array_reserve(pieces, pieces->count + 1, sizeof(e3d_piece)))
        return 0;
    pieces->count += (size_t)e3d_piece_in_tile(&job->in->pass->view->viewport, record, &job->tile, id, (e3d_piece *)pieces->data + pieces->count);
    return 1;
}

static int find_pieces(const e3d_tile_job *job)
{
    const e3d_bins *bins = job->in->bins;
    job->memory->alpha.pieces.count = 0;
    for (int32_t t = 0; t < bins->threads; t++) {
        const e3d_record_set *set = &bins->of[t]->sets[E3D_SET_SCENE];
        const e3d_bin_block *block = e3d_first_alpha(set, E3D_ALPHA_BLENDED, job->number);
        for (; block; block = e3d_next_alpha(set, E3D_ALPHA_BLENDED, block))
            for (uint32_t i = 0; i < block->count; i++)
                if (!add_piece(job, block->id[i]))
                    return 0;
    }
    return 1;
}

/* ---- groups ---- */

typedef struct depth_range {
    float near, far;
} depth_range;

/* R14 at a sample of the tile. */
static float depth_at(const e3d_piece *p, int32_t x, int32_t y)
{
    float z = (p->z0 + (float)(x - p->base_x) * p->gx) + (float)(y - p->base_y) * p->gy;
    z = z > p->zmin ? z : p->zmin;
    return z < p->zmax ? z : p->zmax;
}

static int is_tame(float v) { return v < 0x1p100f && v > -0x1p100f; }

/* z is monotone along both axes, so its values at the corners of the box bound it, unless a step overflows. */
static depth_range range_of(const e3d_piece *p)
{
    depth_range range = {p->zmin, p->zmax};
    if (is_tame(p->z0) && is_tame(p->gx) && is_tame(p->gy)) {
        int32_t near_x = p->gx > 0 ? p->x0 : p->x1, near_y = p->gy > 0 ? p->y0 : p->y1;
        range = (depth_range){depth_at(p, near_x, near_y), depth_at(p, p->x0 + p->x1 - near_x, p->y0 + p->y1 - near_y)};
    }
    if (range.far > 1.0f)
        range.far = 1.0f; /* R15 */
    return range;
}

/* The slices that the depths of a tile's records are cut into. */
typedef struct slicing {
    float near, scale;
} slicing;

static int32_t slice_of(const slicing *s, float z)
{
    float slice = (z - s->near) * s->scale;
    return slice > 0.0f ? slice < E3D_ALPHA_SLICES - 1 ? (int32_t)slice : E3D_ALPHA_SLICES - 1 : 0;
}

static slicing slicing_of(const e3d_piece *pieces, size_t count)
{
    float near = 1.0f, far = -1.0f;
    for (size_t i = 0; i < count; i++) {
        depth_range range = range_of(&pieces[i]);
        near = range.near < near ? range.near : near;
        far = range.far > far ? range.far : far;
    }
    return (slicing){near, far - near > 0x1p-60f ? (float)E3D_ALPHA_SLICES / (far - near) : 0.0f};
}

/* Numbers groups from near to far: a slice begins one where no record reaches over from the slice before. Returns how many there are;
 * of each record its group, of each group how many records it has. */
static int32_t find_groups(const e3d_piece *pieces, size_t count, int32_t *group, int32_t records[E3D_ALPHA_SLICES])
{
    const slicing s = slicing_of(pieces, count);
    int32_t begun[E3D_ALPHA_SLICES] = {0}, done[E3D_ALPHA_SLICES] = {0}, of[E3D_ALPHA_SLICES], groups = 0, open = 0;
    for (size_t i = 0; i < count; i++) {
        depth_range range = range_of(&pieces[i]);
        group[i] = slice_of(&s, range.near);
        begun[group[i]]++;
        done[slice_of(&s, range.far)]++;
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
    int32_t *group = memory->groups.data, groups = find_groups(pieces, count, group, records), at = 0;
    for (int32_t g = groups - 1; g >= 0; g--) {
        next[g] = at;
        at += records[g];
    }
    for (size_t i = 0; i < count; i++)
        ((e3d_piece *)memory->sorted.data)[next[group[i]]++] = pieces[i];
    return groups;
}

/* ---- fragments ---- */

/* Turned round, the bits of a depth are an integer that is less the farther it is; -0 is 0. */
static uint32_t depth_key(float z)
{
    float positive = z + 0.0f;
    uint32_t bits;
    memcpy(&bits, &positive, sizeof bits);
    return bits >> 31 ? bits : ~bits & 0x7FFFFFFF;
}

/* Shades what is listed, and keeps it to be sorted. */
static int keep_list(const e3d_tile_job *job)
{
    e3d_alpha_memory *memory = &job->memory->alpha;
    const e3d_shown *shown = &job->memory->shade.shown;
    e3d_array *fragments = &memory->fragments;
    size_t count = (size_t)shown->count;
    if (!count)
        return 1;
    if (!e3d_array_reserve(fragments, fragments->count + count, sizeof(e3d_alpha_fragment)) || !e3d_alpha_shade(job, E3D_ALPHA_KEEP))
        return 0;
    e3d_alpha_fragment *out = (e3d_alpha_fragment *)fragments->data + fragments->count;
    for (size_t n = 0; n < count; n++) {
        memcpy(out[n].color, memory->color[n], sizeof out[n].color);
        out[n].depth = depth_key(memory->z[n]);
        out[n].id = (int32_t)shown->piece[shown->of[n]].id;
        out[n].sample = shown->sample[n];
        out[n].z = memory->z[n];
    }
    fragments->count += count;
    return 1;
}

/* Lists the fragments' keys by sample, in no order. */
static int find_keys(e3d_alpha_memory *memory)
{
    const e3d_alpha_fragment *fragments = memory->fragments.data;
    uint32_t *first = memory->first;
    if (!e3d_array_reserve(&memory->keys, memory->fragments.count, sizeof(uint64_t)))
        return 0;
    uint64_t *keys = memory->keys.data;
    memset(first, 0, sizeof memory->first);
    for (size_t n = 0; n < memory->fragments.count; n++)
        first[fragments[n].sample + 1]++;
    for (int s = 0; s < E3D_TILE_SAMPLES; s++)
        first[s + 1] += first[s];
    for (size_t n = memory->fragments.count; n-- > 0;) /* first[s] is moved on to first[s + 1] */
        keys[--first[fragments[n].sample + 1]] = (uint64_t)fragments[n].depth << 32 | n;
    memmove(first, first + 1, E3D_TILE_SAMPLES * sizeof *first);
    first[E3D_TILE_SAMPLES] = (uint32_t)memory->fragments.count;
    return 1;
}

/* Whether fragment a is laid before b: it is farther, or later in order (R83). */
static int is_before(const e3d_record_table *table, const e3d_alpha_fragment *fragments, uint64_t a, uint64_t b)
{
    if ((a ^ b) >> 32)
        return a < b;
    int32_t id = fragments[(uint32_t)a].id, other = fragments[(uint32_t)b].id;
    uint32_t order = e3d_order_at(table, (uint32_t)id), other_order = e3d_order_at(table, (uint32_t)other);
    return order > other_order || (order == other_order && id > other);
}

/* A sample has few of them, mostly in the order of their records. */
static void sort_keys(const e3d_record_table *table, const e3d_alpha_fragment *fragments, uint64_t *keys, uint32_t count)
{
    for (uint32_t i = 1; i < count; i++) {
        uint64_t key = keys[i];
        uint32_t at = i;
        for (; at > 0 && is_before(table, fragments, key, keys[at - 1]); at--)
            keys[at] = keys[at - 1];
        keys[at] = key;
    }
}

/* R84 */
static void lay(const float color[4], float over[4])
{
    float a = color[3], rest = 1.0f - a;
    for (int k = 0; k < 3; k++)
        over[k] = color[k] * a + over[k] * rest;
    over[3] = over[3] + a * (1.0f - over[3]);
}

/* Lays the fragments of one sample, which are sorted, over its colour. */
static void blend_sample(e3d_alpha_memory *memory, int32_t sample, const uint64_t *keys, uint32_t count, e3d_samples *samples)
{
    const e3d_alpha_fragment *fragments = memory->fragments.data;
    float over[4] = {samples->color[0][sample], samples->color[1][sample], samples->color[2][sample], samples->counts[sample]};
    for (uint32_t i = 0; i < count; i++) {
        const e3d_alpha_fragment *f = &fragments[(uint32_t)keys[i]];
        if (f->color[3] >= E3D_LEAST_ALPHA)
            lay(f->color, over);
        if (f->color[3] >= E3D_LEAST_ALPHA || -f->color[3] >= E3D_LEAST_ALPHA) {
            memory->front_z[sample] = f->z;
            memory->front_id[sample] = f->id;
        }
    }
    for (int k = 0; k < 3; k++)
        samples->color[k][sample] = over[k];
    samples->counts[sample] = over[3];
}

static int blend_fragments(const e3d_tile_job *job)
{
    e3d_alpha_memory *memory = &job->memory->alpha;
    if (!memory->fragments.count)
        return 1;
    if (!find_keys(memory))
        return 0;
    uint64_t *keys = memory->keys.data;
    for (int32_t s = 0; s < E3D_TILE_SAMPLES; s++) {
        uint32_t first = memory->first[s], count = memory->first[s + 1] - first;
        if (!count)
            continue;
        sort_keys(&job->in->bins->tables[E3D_SET_SCENE], memory->fragments.data, keys + first, count);
        blend_sample(memory, s, keys + first, count, &job->memory->pixels.samples);
    }
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

/* Rows y .. end - 1 of records whose depths may interleave. Where no sample is met twice, there is nothing to sort. */
static int blend_rows(const e3d_tile_job *job, const e3d_piece *pieces, int32_t count, int32_t y, int32_t end)
{
    e3d_alpha_memory *memory = &job->memory->alpha;
    e3d_alpha_begin(job, 0);
    memory->fragments.count = 0;
    for (int32_t i = 0; i < count; i++) {
        e3d_piece rows = pieces[i];
        rows.y0 = rows.y0 > y ? rows.y0 : y;
        rows.y1 = rows.y1 < end - 1 ? rows.y1 : end - 1;
        if (rows.y0 <= rows.y1 && !e3d_alpha_add(job, &rows, keep_list))
            return 0;
    }
    if (!memory->fragments.count && !memory->list.met && !e3d_plans(job->in->pass, E3D_PLAN_FRONT))
        return !job->memory->shade.shown.count || e3d_alpha_shade(job, E3D_ALPHA_LAY);
    return keep_list(job) && blend_fragments(job);
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
    const e3d_piece *pieces = memory->sorted.data;
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
    if (!e3d_plans(job->in->pass, E3D_PLAN_FRONT))
        return e3d_alpha_shade(job, E3D_ALPHA_LAY);
    memory->fragments.count = 0;
    return keep_list(job) && blend_fragments(job);
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
    return !count || e3d_alpha_shade(job, E3D_ALPHA_OUTPUTS);
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
    return done && (!e3d_plans(job->in->pass, E3D_PLAN_FRONT) || shade_front(job));
}
