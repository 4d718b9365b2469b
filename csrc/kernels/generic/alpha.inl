/* alpha: lists the samples that records with alpha cover in front of the visible surface (R83; R104 with multisampling), finds
 * their alphas (R80), and blends their colours over a tile's (R84). */
#pragma once

#include "base/always_inline.h"
#include "base/limits.h"
#include "data/sample_patterns.h"
#include "e3d.h"
#include "kernels/types/alpha.h"
#include "kernels/types/texture_slots.h"
#include "kernels/types/samples.h"
#include "kernels/types/shading.h"
#include "kernels/types/shown.h"
#include "kernels/types/visible.h"
#include "kernels/generic/setup.inl"
#include "kernels/generic/raster.inl"
#include "kernels/generic/visible.inl"
#include "kernels/generic/surface.inl"
#include "kernels/generic/interpolate.inl"
#include "kernels/generic/shade/texture.inl"
#include "kernels/generic/shade/texel_alpha.inl"
#include "kernels/generic/shade/anisotropic.inl"
#include "kernels/generic/shade/texture_slots.inl"
#include "kernels/generic/encode.inl"
#include "kernels/generic/samples.inl"

/* ---- samples ---- */

/* Of lanes with equal depth, those in which a piece comes before the visible record. */
static uint32_t __attribute__((noinline, cold)) alpha_ties(uint32_t equal, const int32_t *kept, const e3d_piece *p, const e3d_record_table *table)
{
    uint32_t won = 0;
    for (; equal; equal &= equal - 1) {
        int32_t id = kept[__builtin_ctz(equal)];
        uint32_t order = id < 0 ? 0 : e3d_order_at(table, (uint32_t)id);
        if (id >= 0 && (p->order < order || (p->order == order && (int32_t)p->slot < id)))
            won |= equal & -equal;
    }
    return won;
}

/* The end of a list, where it goes on. */
typedef struct alpha_end {
    const e3d_record_table *table;
    e3d_alpha_list *list;
    int32_t *sample;
    float *z;
} alpha_end;

/* Lists the samples of one vector from (x, y) on; `inside` are the covered lanes, with these depths. */
static ALWAYS_INLINE void alpha_vector(const e3d_piece *p, int32_t x, int32_t y, vmask inside, vf32 z, alpha_end *end)
{
    int32_t at = y * E3D_TILE + x;
    vf32 limit = v_loadf(end->list->limit + at);
    uint32_t shown = v_bits(v_lt_in(inside, z, limit)), equal = v_bits(v_eq_in(inside, z, limit));
    if (__builtin_expect(equal != 0, 0))
        shown |= alpha_ties(equal, end->list->kept + at, p, end->table);
    uint64_t row = (uint64_t)shown << x;
    end->list->met |= end->list->once[y] & row;
    end->list->once[y] |= row;
    v_pack(end->z, v_asi(z), shown);
    int count = v_pack(end->sample, v_addi(v_iota(), v_seti(at)), shown);
    end->z += count;
    end->sample += count;
}

/* The parts of R12 and R14 for a column of vectors that its rows share. */
typedef struct alpha_column {
    vi32 e[3]; /* at row 0 of the tile */
    vmask own; /* lanes in the box */
    vf32 z;
} alpha_column;

static ALWAYS_INLINE alpha_column alpha_column_of(const e3d_piece *p, const raster_constants *c, int32_t x)
{
    vi32 column = v_addi(v_iota(), v_seti(x));
    alpha_column out = {.own = v_gti(v_seti(p->x1 + 1), column), .z = raster_column(c, x - p->base_x)};
    for (int k = 0; k < 3; k++)
        out.e[k] = v_addi(v_seti(p->e[k]), v_muli(column, v_seti(p->a[k])));
    return out;
}

static ALWAYS_INLINE vmask alpha_inside(const e3d_piece *p, const alpha_column *column, int32_t y)
{
    vi32 e = v_seti(0);
    for (int k = 0; k < 3; k++)
        e = v_ori(e, v_addi(column->e[k], v_seti(p->b[k] * y)));
    return v_mand(v_gti(e, v_seti(-1)), column->own);
}

/* Lists rows y to last - 1 of a box that is one vector wide; what its rows share is found once. */
static ALWAYS_INLINE void alpha_narrow(const e3d_piece *p, const raster_constants *c, int32_t y, int32_t last, alpha_end *end)
{
    alpha_column column = alpha_column_of(p, c, p->x0);
    for (; y < last; y++)
        alpha_vector(p, p->x0, y, alpha_inside(p, &column, y), raster_z(c, column.z, y - p->base_y), end);
}

static ALWAYS_INLINE void alpha_row(const e3d_piece *p, const raster_constants *c, int32_t y, alpha_end *end)
{
    for (int32_t x = p->x0; x <= p->x1; x += V_LANES) {
        alpha_column column = alpha_column_of(p, c, x);
        alpha_vector(p, x, y, alpha_inside(p, &column, y), raster_z(c, column.z, y - p->base_y), end);
    }
}

/* How many rows of a piece, from y on, surely fit the list. */
static ALWAYS_INLINE int32_t alpha_rows(const e3d_piece *p, int32_t y, int32_t room)
{
    int32_t rows = p->y1 - y + 1, width = p->x1 - p->x0 + 1;
    return rows * width <= room ? rows : room / width;
}

/* Lists the rows of a piece that fit, as a primitive of the list; returns the next row. */
static int32_t kernel_raster_alpha(const e3d_piece *piece, const e3d_record_table *table, e3d_alpha_list *out)
{
    const e3d_piece own = *piece, *p = &own; /* a copy, which no store can change */
    e3d_shown *shown = out->shown;
    const int32_t first = shown->count;
    const raster_constants c = {v_setf(p->z0), v_setf(p->gx), v_setf(p->gy),
                                v_setf(p->zmin), v_setf(p->zmax), v_seti((int32_t)p->slot)};
    alpha_end end = {table, out, shown->sample + first, out->z + first};
    int32_t y = p->y0, next;
    for (int32_t count = first; y <= p->y1; y = next, count = (int32_t)(end.sample - shown->sample)) {
        next = y + alpha_rows(p, y, E3D_SHOWN_ROOM - count);
        if (next == y)
            break;
        if (p->x1 - p->x0 < V_LANES)
            alpha_narrow(p, &c, y, next, &end);
        for (; y < next && p->x1 - p->x0 >= V_LANES; y++)
            alpha_row(p, &c, y, &end);
    }
    int32_t count = (int32_t)(end.sample - shown->sample);
    for (int32_t i = first; i < count; i += V_LANES)
        v_storei(shown->of + i, v_seti(shown->primitives));
    shown->primitive[shown->primitives] = (e3d_shown_primitive){p->slot, first};
    shown->primitives += count > first;
    shown->count = count;
    return y;
}

/* ---- pixels and their samples, with multisampling ---- */

/* Of one vector of pixels, from (x, y) on, the lanes whose sample in a plane is covered and in front. */
static ALWAYS_INLINE uint32_t cover_plane(const e3d_piece *p, const float *limits, const int32_t *kept, int32_t x, int32_t y,
                                          const e3d_record_table *table)
{
    const raster_constants c = {v_setf(p->z0), v_setf(p->gx), v_setf(p->gy),
                                v_setf(p->zmin), v_setf(p->zmax), v_seti((int32_t)p->slot)};
    int32_t at = y * E3D_TILE + x;
    alpha_column column = alpha_column_of(p, &c, x);
    vmask inside = alpha_inside(p, &column, y);
    vf32 z = raster_z(&c, column.z, y - p->base_y), limit = v_loadf(limits + at);
    uint32_t shown = v_bits(v_lt_in(inside, z, limit)), equal = v_bits(v_eq_in(inside, z, limit));
    return equal ? shown | alpha_ties(equal, kept + at, p, table) : shown;
}

/* Lists the samples of one vector of pixels, each alone. */
static ALWAYS_INLINE int32_t cover_alone(const e3d_piece *pieces, uint32_t live, int32_t x, int32_t y, const e3d_record_table *table,
                                         int32_t count, e3d_msaa_list *out)
{
    vi32 pixel = v_addi(v_iota(), v_seti(y * E3D_TILE + x));
    for (int s = 0; s < out->pattern->count; s++) {
        uint32_t shown = live >> s & 1 ? cover_plane(&pieces[s], out->limit[s], out->kept[s], x, y, table) & setup_tail(V_LANES) : 0;
        v_pack(out->cover + count, v_seti(1 << s), shown);
        count += v_pack(out->shown->sample + count, v_ori(pixel, v_seti(s << E3D_SHOWN_NUMBER)), shown);
    }
    return count;
}

/* Lists the pixels of one vector. */
static ALWAYS_INLINE int32_t cover_vector(const e3d_piece *pieces, uint32_t live, int32_t x, int32_t y, const e3d_record_table *table,
                                          int32_t count, e3d_msaa_list *out)
{
    uint32_t any = 0;
    vi32 cover = v_seti(0), number = v_seti(0);
    for (int s = out->pattern->count - 1; s >= 0; s--) {
        uint32_t shown = live >> s & 1 ? cover_plane(&pieces[s], out->limit[s], out->kept[s], x, y, table) & setup_tail(V_LANES) : 0;
        vmask lanes = visible_lanes(shown);
        any |= shown;
        cover = v_ori(cover, v_seli(lanes, v_seti(1 << s), v_seti(0)));
        number = v_seli(lanes, v_seti(s), number); /* ends as the first sample's number */
    }
    vi32 pixel = v_addi(v_iota(), v_seti(y * E3D_TILE + x));
    v_pack(out->cover + count, cover, any);
    return count + v_pack(out->shown->sample + count, v_ori(pixel, v_shl(number, E3D_SHOWN_NUMBER)), any);
}

static int32_t kernel_cover_msaa(const e3d_piece *pieces, uint32_t live, int32_t y, int32_t last, const e3d_record_table *table,
                                 e3d_msaa_list *out)
{
    e3d_shown *shown = out->shown;
    const int32_t first = shown->count, x0 = pieces->x0, x1 = pieces->x1;
    int32_t count = first;
    int32_t row = (x1 - x0 + 1) * (out->alone ? out->pattern->count : 1);
    for (; y <= last && count + row <= E3D_SHOWN_ROOM; y++)
        for (int32_t x = x0; x <= x1; x += V_LANES)
            count = out->alone ? cover_alone(pieces, live, x, y, table, count, out)
                               : cover_vector(pieces, live, x, y, table, count, out);
    for (int32_t i = first; i < count; i += V_LANES)
        v_storei(shown->of + i, v_seti(shown->primitives));
    shown->primitive[shown->primitives] = (e3d_shown_primitive){pieces->slot, first};
    shown->primitives += count > first;
    shown->count = count;
    return y;
}

/* ---- alphas ---- */

static ALWAYS_INLINE void alpha_filter(texture_plan *plan, int filter, int bits, e3d_batch *batch, float scale)
{
    const texture_source from = {batch->uv[0], batch->uv[1], batch->lod, batch->count};
    texture_find_all(plan, filter, bits, &from);
    for (int i = 0; i < batch->count; i += V_LANES)
        v_storef(batch->alpha + i, v_mul(alpha_read(plan, filter, bits, i), v_setf(scale)));
}

/* The result of a filter if all alphas are 255, whose weights add up to a constant. */
static inline float alpha_of_opaque(const e3d_texture_view *view)
{
    if (view->channel_bits == 16)
        return view->filter == E3D_NEAREST ? 32767.0f : 32767.0f * 256.0f;
    return view->filter == E3D_NEAREST ? 255.0f : 255.0f * 255.0f * 255.0f;
}

static void alpha_texture(e3d_batch *batch, const e3d_surfaces *surfaces, const e3d_texture_view *view, float base)
{
    texture_plan plan;
    const float bases[3] = {base, base, base};
    texture_begin(&plan, view, bases);
    if (view->anisotropy > 1 && !batch->finest) {
        const probe_source from = probes_from(batch, surfaces, surfaces->slope, batch->uv[0], batch->uv[1], view);
        const probe_target to = {plan.scale, NULL, batch->alpha};
        anisotropic_read(&plan, &from, &to);
    } else if (view->channel_bits == 8) {
        alpha_filter(&plan, view->filter, 8, batch, plan.scale[0]);
    } else {
        alpha_filter(&plan, view->filter, 16, batch, plan.scale[0]);
    }
}

static ALWAYS_INLINE void stage_vertex_alpha(e3d_batch *batch, const sample_vector *v, const void *unused)
{
    (void)unused;
    vf32 w[3];
    for (int k = 0; k < 3; k++)
        w[k] = v_loadf(batch->weight[k] + v->i);
    vf32 tint = v_mul(weighted_sum(v->s->alpha, &v->elements, v->same, w), v_loadf(batch->r + v->i));
    v_storef(batch->alpha + v->i, v_mul(v_loadf(batch->alpha + v->i), tint));
}

static ALWAYS_INLINE void stage_instance_alpha(e3d_batch *batch, const sample_vector *v, const void *unused)
{
    (void)unused;
    v_storef(batch->alpha + v->i, v_mul(v_loadf(batch->alpha + v->i), take(v->s->instance_alpha, &v->elements, v->same)));
}

static void kernel_alpha(e3d_batch *batch, const e3d_surfaces *surfaces, const e3d_texture_view *view, const e3d_varying *base, int by_vertex,
                         int by_instance)
{
    int varies = view && !view->is_opaque;
    const e3d_varying opaque = {NULL, view ? alpha_of_opaque(view) * (base->factor * e3d_texture_unit(view)) : 0.0f};
    if (varies)
        alpha_texture(batch, surfaces, view, base->factor);
    else
        kernel_varying(view ? &opaque : base, batch->count, batch->alpha);
    if (by_vertex)
        each_vector(batch, surfaces, stage_vertex_alpha, NULL);
    if (by_instance)
        each_vector(batch, surfaces, stage_instance_alpha, NULL);
    for (int i = 0; i < batch->count; i += V_LANES)
        v_storef(batch->alpha + i, encode_clamp(v_loadf(batch->alpha + i)));
}

/* ---- composition ---- */

/* R84 for one vector: over[3] is the sum of alphas. */
static ALWAYS_INLINE void alpha_over(const vf32 color[3], vf32 alpha, vf32 over[4])
{
    vf32 rest = v_sub(v_setf(1.0f), alpha);
    for (int k = 0; k < 3; k++)
        over[k] = v_add(v_mul(color[k], alpha), v_mul(over[k], rest));
    over[3] = v_add(alpha, v_mul(over[3], rest));
}

/* R135 for one vector. */
static ALWAYS_INLINE void alpha_over_through(const vf32 color[3], vf32 alpha, const vf32 through[3], vf32 over[4])
{
    vf32 one = v_setf(1.0f), whole = v_sub(one, alpha), rest[3];
    for (int k = 0; k < 3; k++) {
        rest[k] = v_add(whole, v_mul(alpha, through[k]));
        over[k] = v_min(v_add(v_mul(color[k], alpha), v_mul(over[k], rest[k])), one);
    }
    vf32 mean = v_mul(v_add(v_add(rest[0], rest[1]), rest[2]), v_setf(E3D_THIRD)), most = v_max(v_max(over[0], over[1]), over[2]);
    over[3] = v_add(v_sub(one, mean), v_mul(over[3], mean));
    over[3] = v_self(v_ge(most, v_setf(E3D_LEAST_ALPHA)), v_max(over[3], most), over[3]);
}

/* Blends a batch over samples; `through`: NULL, or the shares of light that pass. */
static ALWAYS_INLINE void alpha_lay_batch(const e3d_batch *batch, const e3d_lane_array *through, e3d_samples *samples)
{
    float *const planes[4] = {samples->color[0], samples->color[1], samples->color[2], samples->counts};
    for (int i = 0; i < batch->count; i += V_LANES) {
        const int32_t *sample = batch->sample + i;
        int lanes = batch->count - i < V_LANES ? batch->count - i : V_LANES;
        int neighbours = lanes == V_LANES && samples_are_neighbours(sample);
        float room[4][V_LANES];
        vf32 color[3], shares[3], over[4], alpha = v_loadf(batch->alpha + i);
        alpha = v_self(v_ge(alpha, v_setf(E3D_LEAST_ALPHA)), alpha, v_setf(0.0f));
        for (int k = 0; k < 3; k++)
            color[k] = encode_clamp(v_loadf(batch->color[k] + i));
        for (int k = 0; k < 3 && through; k++)
            shares[k] = v_loadf(through[k] + i);
        for (int k = 0; k < 4 && !neighbours; k++)
            for (int lane = 0; lane < V_LANES; lane++)
                room[k][lane] = planes[k][sample[lane]];
        for (int k = 0; k < 4; k++)
            over[k] = v_loadf(neighbours ? planes[k] + sample[0] : room[k]);
        if (through)
            alpha_over_through(color, alpha, shares, over);
        else
            alpha_over(color, alpha, over);
        for (int k = 0; k < 4; k++)
            v_storef(neighbours ? planes[k] + sample[0] : room[k], over[k]);
        for (int k = 0; k < 4 && !neighbours; k++)
            for (int lane = 0; lane < lanes; lane++)
                planes[k][sample[lane]] = room[k][lane];
    }
}

static void kernel_lay(const e3d_batch *batch, e3d_samples *samples) { alpha_lay_batch(batch, NULL, samples); }

static void kernel_lay_through(const e3d_batch *batch, const e3d_texture_batch *maps, e3d_samples *samples)
{
    alpha_lay_batch(batch, maps->through, samples);
}

/* ---- sorting ---- */

enum { ALPHA_MOST = 64 }; /* samples with more layers are sorted elsewhere */

/* Sorts the numbers of a sample's layers, the farthest first. A layer's rank is the number of farther ones, which is found
 * without branches. Returns 0 if two are equally far. */
static ALWAYS_INLINE int alpha_sort(const e3d_alpha_layers *layers, uint32_t first, int count, uint32_t order[ALPHA_MOST])
{
    const int32_t *depth = layers->depth + first;
    int sum = 0;
    for (int i = 0; i < count; i++) {
        vi32 own = v_seti(depth[i]);
        int rank = 0;
        for (int j = 0; j < count; j += V_LANES)
            rank += v_count(v_bits(v_gti(v_loadi(depth + j), own)) & setup_tail(count - j));
        order[rank] = layers->which[first + (uint32_t)i];
        sum += rank;
    }
    return 2 * sum == count * (count - 1);
}

static ALWAYS_INLINE void alpha_lay_all(const e3d_alpha_layers *layers, const uint32_t *order, int count, int sample, e3d_samples *samples)
{
    float *const planes[4] = {samples->color[0] + sample, samples->color[1] + sample, samples->color[2] + sample, samples->counts + sample};
    float over[4] = {*planes[0], *planes[1], *planes[2], *planes[3]};
    for (int i = 0; i < count && !layers->through; i++)
        e3d_lay_layer(layers->color[order[i]], over);
    for (int i = 0; i < count && layers->through; i++)
        e3d_lay_any(layers->color[order[i]], layers->through[order[i]], over);
    for (int k = 0; k < 4; k++)
        *planes[k] = over[k];
    if (layers->light)
        e3d_lay_light(layers, order, count, sample);
}

/* Prefetches the colours of layers that follow a little later: they lie by record, not by sample. */
static ALWAYS_INLINE void alpha_ask(const e3d_alpha_layers *layers, uint32_t first, uint32_t end)
{
    enum { AHEAD = 64 };
    uint32_t all = layers->first[E3D_TILE_SAMPLES], last = end + AHEAD < all ? end + AHEAD : all;
    for (uint32_t n = first + AHEAD; n < last; n++)
        __builtin_prefetch(layers->color[layers->which[n]]);
}

static int kernel_blend(const e3d_alpha_layers *layers, e3d_samples *samples, uint16_t *left)
{
    int listed = 0;
    for (int s = 0; s < E3D_TILE_SAMPLES; s++) {
        uint32_t first = layers->first[s], count = layers->first[s + 1] - first, order[ALPHA_MOST];
        if (!count)
            continue;
        alpha_ask(layers, first, first + count);
        if (count > ALPHA_MOST || !alpha_sort(layers, first, (int)count, order))
            left[listed++] = (uint16_t)s;
        else
            alpha_lay_all(layers, order, (int)count, s, samples);
    }
    return listed;
}
