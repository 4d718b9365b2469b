/* alpha: what records with alpha cover in front of what shows (R83), their alphas (R80), and their colours over a tile's (R84). */
#ifndef E3D_KERNELS_ALPHA_INL
#define E3D_KERNELS_ALPHA_INL

#include "core/always_inline.h"
#include "core/limits.h"
#include "kernels/types/alpha.h"
#include "kernels/types/shading.h"
#include "kernels/types/visible.h"
#include "kernels/generic/raster.inl"
#include "kernels/generic/interpolate.inl"
#include "kernels/generic/texture.inl"
#include "kernels/generic/texel_alpha.inl"
#include "kernels/generic/maps.inl"
#include "kernels/generic/samples.inl"

/* ---- samples ---- */

/* The lanes of equal depth in which a piece comes before what is kept. */
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

/* Lists one row of a piece from `at` in the list on; returns how many samples. */
static ALWAYS_INLINE int32_t alpha_row(const e3d_piece *p, const raster_constants *c, int32_t y, const e3d_record_table *table,
                                       e3d_alpha_list *out, int32_t at)
{
    int32_t count = 0;
    uint64_t row = 0;
    vf32 down = v_mul(v_setf((float)(y - p->base_y)), c->gy);
    for (int32_t x = p->x0; x <= p->x1; x += V_LANES) {
        vi32 column = v_addi(v_iota(), v_seti(x)), e = v_seti(0);
        for (int k = 0; k < 3; k++)
            e = v_ori(e, v_addi(v_seti(p->e[k] + p->b[k] * y), v_muli(column, v_seti(p->a[k]))));
        vmask inside = v_mand(v_gti(e, v_seti(-1)), v_gti(v_seti(p->x1 + 1), column));
        vf32 dx = v_float(v_subi(column, v_seti(p->base_x)));
        vf32 z = v_min(v_max(v_add(v_add(c->z0, v_mul(dx, c->gx)), down), c->zmin), c->zmax);
        vf32 limit = v_loadf(out->limit + y * E3D_TILE + x);
        uint32_t shown = v_bits(v_mand(inside, v_lt(z, limit))), equal = v_bits(v_mand(inside, v_eq(z, limit)));
        if (__builtin_expect(equal != 0, 0))
            shown |= alpha_ties(equal, out->kept + y * E3D_TILE + x, p, table);
        row |= (uint64_t)shown << x;
        v_pack(out->z + at + count, v_asi(z), shown);
        count += v_pack(out->shown->sample + at + count, v_addi(column, v_seti(y * E3D_TILE)), shown);
    }
    out->met |= out->once[y] & row;
    out->once[y] |= row;
    return count;
}

/* Lists the rows of a piece for which there is room, as a piece of the list; returns the row that comes next. */
static int32_t kernel_raster_alpha(const e3d_piece *p, const e3d_record_table *table, e3d_alpha_list *out)
{
    e3d_shown *shown = out->shown;
    raster_constants c = {v_setf(p->z0),   v_setf(p->gx),   v_setf(p->gy),
                          v_setf(p->zmin), v_setf(p->zmax), v_seti((int32_t)p->slot)};
    int32_t first = shown->count, width = p->x1 - p->x0 + 1, y = p->y0, end = first;
    for (; y <= p->y1 && end + width <= E3D_SHOWN_ROOM; y++)
        end += alpha_row(p, &c, y, table, out, end);
    for (int32_t i = first; i < end; i += V_LANES)
        v_storei(shown->of + i, v_seti(shown->pieces));
    shown->piece[shown->pieces] = (e3d_shown_piece){p->slot, first};
    shown->pieces += end > first;
    shown->count = end;
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

static void alpha_texture(e3d_batch *batch, const e3d_texture_view *view, float base)
{
    texture_plan plan;
    const float bases[3] = {base, base, base};
    texture_begin(&plan, view, bases);
    if (view->channel_bits == 8)
        alpha_filter(&plan, view->filter, 8, batch, plan.scale[0]);
    else
        alpha_filter(&plan, view->filter, 16, batch, plan.scale[0]);
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
    if (view)
        alpha_texture(batch, view, base->factor);
    else
        kernel_varying(base, batch->count, batch->alpha);
    if (by_vertex)
        each_vector(batch, surfaces, stage_vertex_alpha, NULL);
    if (by_instance)
        each_vector(batch, surfaces, stage_instance_alpha, NULL);
    for (int i = 0; i < batch->count; i += V_LANES)
        v_storef(batch->alpha + i, encode_clamp(v_loadf(batch->alpha + i)));
}

/* ---- composition ---- */

/* R84, of one vector: over[3] is the sum of alphas. */
static ALWAYS_INLINE void alpha_over(const vf32 color[3], vf32 alpha, vf32 over[4])
{
    vf32 rest = v_sub(v_setf(1.0f), alpha);
    for (int k = 0; k < 3; k++)
        over[k] = v_add(v_mul(color[k], alpha), v_mul(over[k], rest));
    over[3] = v_add(over[3], v_mul(alpha, v_sub(v_setf(1.0f), over[3])));
}

static void kernel_lay(const e3d_batch *batch, e3d_samples *samples)
{
    float *const planes[4] = {samples->color[0], samples->color[1], samples->color[2], samples->counts};
    for (int i = 0; i < batch->count; i += V_LANES) {
        const int32_t *sample = batch->sample + i;
        int lanes = batch->count - i < V_LANES ? batch->count - i : V_LANES;
        int neighbours = lanes == V_LANES && samples_are_neighbours(sample);
        float room[4][V_LANES];
        vf32 color[3], over[4], alpha = v_loadf(batch->alpha + i);
        for (int k = 0; k < 3; k++)
            color[k] = encode_clamp(v_loadf(batch->color[k] + i));
        for (int k = 0; k < 4 && !neighbours; k++)
            for (int lane = 0; lane < V_LANES; lane++)
                room[k][lane] = planes[k][sample[lane]];
        for (int k = 0; k < 4; k++)
            over[k] = v_loadf(neighbours ? planes[k] + sample[0] : room[k]);
        alpha_over(color, v_self(v_ge(alpha, v_setf(E3D_LEAST_ALPHA)), alpha, v_setf(0.0f)), over);
        for (int k = 0; k < 4; k++)
            v_storef(neighbours ? planes[k] + sample[0] : room[k], over[k]);
        for (int k = 0; k < 4 && !neighbours; k++)
            for (int lane = 0; lane < lanes; lane++)
                planes[k][sample[lane]] = room[k][lane];
    }
}

#endif
