/* alpha with multisampling: lists the samples of a tile's pixels that a record with alpha covers in front of the visible
 * surface (R83, R104). */
#pragma once

#include "base/always_inline.h"
#include "base/limits.h"
#include "data/sample_patterns.h"
#include "kernels/types/alpha.h"
#include "kernels/types/shown.h"
#include "kernels/types/visible.h"
#include "kernels/generic/setup.inl"
#include "kernels/generic/raster.inl"
#include "kernels/generic/visible.inl"
#include "kernels/generic/alpha.inl"

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
    for (; y <= last && count + (x1 - x0 + 1) <= E3D_SHOWN_ROOM; y++)
        for (int32_t x = x0; x <= x1; x += V_LANES)
            count = cover_vector(pieces, live, x, y, table, count, out);
    for (int32_t i = first; i < count; i += V_LANES)
        v_storei(shown->of + i, v_seti(shown->primitives));
    shown->primitive[shown->primitives] = (e3d_shown_primitive){pieces->slot, first};
    shown->primitives += count > first;
    shown->count = count;
    return y;
}
