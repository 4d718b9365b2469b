/* setup, second half: makes records of a cluster's triangles that may show (R9, R10, R12, R13), a vector at a time. Products
 * of snapped coordinates stay below 2^53, so double vectors give the results of 64-bit integers and of scalar doubles. */
#pragma once

#include <string.h>

#include "base/limits.h"
#include "kernels/kernels.h"
#include "kernels/types/records.h"
#include "kernels/types/vertices.h"
#include "kernels/generic/setup.inl"

/* Three corners of each lane's triangle; after R9 their order makes the area positive. */
typedef struct record_corners {
    vi32 x[3], y[3];
    vf32 zn[3], iw[3];
} record_corners;

/* The local indices of corner k of each lane's triangle. */
static inline vi32 record_places(const uint8_t *indices, const uint8_t *triangles, int k)
{
    return v_lookup8(indices + k * E3D_CLUSTER_TRIANGLES, v_loadu8(triangles));
}

static inline void record_find(const void *numbers, int vertices, const vi32 places[3], vi32 out[3])
{
    vtable table;
    v_table(numbers, vertices, &table);
    for (int k = 0; k < 3; k++)
        out[k] = v_lookup(&table, places[k]);
}

static inline record_corners record_fetch(const e3d_vertices *v, const uint8_t *indices, const uint8_t *triangles)
{
    record_corners c;
    vi32 places[3], zn[3], iw[3];
    for (int k = 0; k < 3; k++)
        places[k] = record_places(indices, triangles, k);
    record_find(v->sx, v->count, places, c.x);
    record_find(v->sy, v->count, places, c.y);
    record_find(v->zn, v->count, places, zn);
    record_find(v->iw, v->count, places, iw);
    for (int k = 0; k < 3; k++) {
        c.zn[k] = v_asf(zn[k]);
        c.iw[k] = v_asf(iw[k]);
    }
    return c;
}

/* Twice the area, exact in double. */
static inline void record_area(const record_corners *c, vf64 area[V_HALVES])
{
    vi32 ax = v_subi(c->x[1], c->x[0]), ay = v_subi(c->y[1], c->y[0]);
    vi32 cx = v_subi(c->x[2], c->x[0]), cy = v_subi(c->y[2], c->y[0]);
    for (int h = 0; h < V_HALVES; h++)
        area[h] = v_subd(v_muld(v_wideni(ax, h), v_wideni(cy, h)), v_muld(v_wideni(cx, h), v_wideni(ay, h)));
}

static inline void record_swap(record_corners *c, vmask swapped)
{
    vi32 x = c->x[1], y = c->y[1];
    vf32 zn = c->zn[1], iw = c->iw[1];
    c->x[1] = v_seli(swapped, c->x[2], x);
    c->y[1] = v_seli(swapped, c->y[2], y);
    c->zn[1] = v_self(swapped, c->zn[2], zn);
    c->iw[1] = v_self(swapped, c->iw[2], iw);
    c->x[2] = v_seli(swapped, x, c->x[2]);
    c->y[2] = v_seli(swapped, y, c->y[2]);
    c->zn[2] = v_self(swapped, zn, c->zn[2]);
    c->iw[2] = v_self(swapped, iw, c->iw[2]);
}

typedef struct record_plane {
    vf32 z0, gx, gy, zmin, zmax;
} record_plane;

/* R13 for corners in the order of a positive area; `finite` gets the lanes whose plane is finite. */
static inline record_plane record_plane_of(const record_corners *c, setup_span across, setup_span down,
                                           vmask *finite)
{
    vi32 ax = v_subi(c->x[1], c->x[0]), ay = v_subi(c->y[1], c->y[0]);
    vi32 cx = v_subi(c->x[2], c->x[0]), cy = v_subi(c->y[2], c->y[0]);
    vi32 half = v_seti(128);
    vi32 ex = v_subi(v_addi(v_shl(across.first, 8), half), c->x[0]);
    vi32 ey = v_subi(v_addi(v_shl(down.first, 8), half), c->y[0]);
    vf64 area[V_HALVES], z0[V_HALVES], gx[V_HALVES], gy[V_HALVES];
    record_area(c, area);
    for (int h = 0; h < V_HALVES; h++) {
        vf64 zn0 = v_widenf(c->zn[0], h);
        vf64 d1 = v_subd(v_widenf(c->zn[1], h), zn0), d2 = v_subd(v_widenf(c->zn[2], h), zn0);
        vf64 r = v_divd(v_setd(256.0), area[h]), scale = v_setd(1.0 / 256);
        gx[h] = v_muld(v_subd(v_muld(d1, v_wideni(cy, h)), v_muld(d2, v_wideni(ay, h))), r);
        gy[h] = v_muld(v_subd(v_muld(d2, v_wideni(ax, h)), v_muld(d1, v_wideni(cx, h))), r);
        vf64 x = v_muld(v_wideni(ex, h), scale), y = v_muld(v_wideni(ey, h), scale);
        z0[h] = v_addd(v_addd(zn0, v_muld(x, gx[h])), v_muld(y, gy[h]));
    }
    record_plane p = {v_narrow(z0), v_narrow(gx), v_narrow(gy),
                      v_min(v_min(c->zn[0], c->zn[1]), c->zn[2]),
                      v_max(v_max(c->zn[0], c->zn[1]), c->zn[2])};
    vf32 none = v_add(v_sub(p.z0, p.z0), v_add(v_sub(p.gx, p.gx), v_sub(p.gy, p.gy)));
    *finite = v_eq(none, v_setf(0.0f)); /* v - v is 0 for finite v, and NaN for others */
    return p;
}

/* Edge function k (R12) at a sample, not negative inside; `sign` is all ones in lanes whose corners were exchanged. */
typedef struct record_edge {
    vi32 a, b, c;
} record_edge;

static inline record_edge record_edge_of(const vi32 x[3], const vi32 y[3], int k, vi32 sign, vi32 x0, vi32 y0)
{
    int i = (k + 1) % 3, j = (k + 2) % 3;
    vi32 zero = v_seti(0), one = v_seti(1);
    record_edge e = {v_subi(y[i], y[j]), v_subi(x[j], x[i]), zero};
    e.a = v_subi(v_xori(e.a, sign), sign);
    e.b = v_subi(v_xori(e.b, sign), sign);
    vmask top_left = v_mor(v_gti(e.a, zero), v_mand(v_eqi(e.a, zero), v_gti(e.b, zero)));
    vi32 value = v_addi(v_muli(e.a, v_subi(x0, x[i])), v_muli(e.b, v_subi(y0, y[i])));
    e.c = v_subi(value, v_seli(top_left, zero, one));
    return e;
}

/* The samples of a box of at most 2 x 2 that are covered: bit 2 * row + column. */
static inline vi32 record_cover(const vi32 x[3], const vi32 y[3], setup_span across, setup_span down)
{
    vi32 half = v_seti(128), outside[4], sign = v_sra(setup_area(x, y), 31);
    vi32 x0 = v_addi(v_shl(across.first, 8), half), y0 = v_addi(v_shl(down.first, 8), half);
    for (int k = 0; k < 3; k++) {
        record_edge e = record_edge_of(x, y, k, sign, x0, y0);
        vi32 right = v_addi(e.c, v_shl(e.a, 8)), step = v_shl(e.b, 8);
        const vi32 at[4] = {e.c, right, v_addi(e.c, step), v_addi(right, step)};
        for (int s = 0; s < 4; s++)
            outside[s] = k ? v_ori(outside[s], at[s]) : at[s];
    }
    vi32 cover = v_seti(0), one = v_seti(1);
    for (int s = 3; s >= 0; s--)
        cover = v_ori(v_shl(cover, 1), v_subi(one, v_shr(outside[s], 31)));
    /* A box of one column or row has no second one. */
    cover = v_andi(cover, v_seli(v_eqi(across.first, across.last), v_seti(5), v_seti(15)));
    return v_andi(cover, v_seli(v_eqi(down.first, down.last), v_seti(3), v_seti(15)));
}

/* The triangles that get a record. Tiny ones that cover nothing are left out. */
typedef struct record_list {
    uint8_t triangles[E3D_CLUSTER_TRIANGLES + E3D_PAD];
    uint8_t cover[E3D_CLUSTER_TRIANGLES + E3D_PAD]; /* covers of tiny triangles; 0 for others */
    int count;
} record_list;

/* Lists all triangles, if tiny ones are not treated apart. */
static inline void record_list_all(const e3d_record_request *q, record_list *list)
{
    memcpy(list->triangles, q->triangles, (size_t)q->count + E3D_PAD);
    memset(list->cover, 0, sizeof list->cover);
    list->count = q->count;
}

/* Lists a vector's triangles, without tiny ones that cover nothing. */
static inline void record_try(const e3d_record_request *q, int first, record_list *list)
{
    vi32 x[3], y[3];
    const uint8_t *triangles = q->triangles + first;
    for (int k = 0; k < 3; k++) {
        vi32 i = record_places(q->indices, triangles, k);
        x[k] = v_gatheri(q->vertices->sx, i);
        y[k] = v_gatheri(q->vertices->sy, i);
    }
    vi32 xlo = setup_least(x), xhi = setup_most(x), ylo = setup_least(y), yhi = setup_most(y);
    setup_span across = setup_samples(xlo, xhi, q->viewport->width, q->viewport->reach);
    setup_span down = setup_samples(ylo, yhi, q->viewport->height, q->viewport->reach);
    vmask large = v_gti(v_maxi(v_subi(xhi, xlo), v_subi(yhi, ylo)), v_seti(32767)); /* 32 bits don't hold their products */
    vmask tiny = v_mandnot(v_mand(setup_narrow(across, 2), setup_narrow(down, 2)), large);
    uint32_t tinies = v_bits(tiny), keep = setup_tail(q->count - first);
    vi32 cover = v_seti(0);
    if (tinies) {
        cover = v_seli(tiny, record_cover(x, y, across, down), cover);
        keep &= ~(tinies & v_bits(v_eqi(cover, v_seti(0))));
    }
    v_pack8(list->cover + list->count, cover, keep);
    list->count += v_pack8(list->triangles + list->count, v_loadu8(triangles), keep);
}

static inline void record_list_some(const e3d_record_request *q, record_list *list)
{
    list->count = 0;
    for (int i = 0; i < q->count; i += V_LANES)
        record_try(q, i, list);
    memset(list->triangles + list->count, 0, E3D_PAD); /* padding, since whole vectors are read */
    memset(list->cover + list->count, 0, E3D_PAD);
}

/* The flags of records, with the covers of tiny ones. */
static inline vi32 record_meta(vi32 cover, vmask back, vmask swapped)
{
    vi32 zero = v_seti(0), meta = v_seti(E3D_RECORD_FACE);
    meta = v_ori(meta, v_seli(back, v_seti(E3D_RECORD_BACK), zero));
    meta = v_ori(meta, v_seli(swapped, v_seti(E3D_RECORD_SWAPPED), zero));
    meta = v_ori(meta, v_seli(v_eqi(cover, zero), zero, v_seti(E3D_RECORD_TINY)));
    return v_ori(meta, v_shl(cover, E3D_RECORD_SHIFT));
}

/* The tiles of the boxes: row << 16 | column, of the first tile and of the last. */
static inline void record_spans(setup_span across, setup_span down, e3d_tile_rect *out)
{
    int32_t first[V_LANES], last[V_LANES];
    v_storei(first, v_ori(v_sra(across.first, E3D_TILE_SHIFT), v_shl(v_sra(down.first, E3D_TILE_SHIFT), 16)));
    v_storei(last, v_ori(v_sra(across.last, E3D_TILE_SHIFT), v_shl(v_sra(down.last, E3D_TILE_SHIFT), 16)));
    for (int lane = 0; lane < V_LANES; lane++)
        out[lane] = (e3d_tile_rect){(uint32_t)first[lane], (uint32_t)last[lane]};
}

/* Moves the records to keep to the front, in place; mostly these are all. Returns how many. */
static inline int record_keep(uint32_t keep, e3d_record *records, e3d_tile_rect *spans)
{
    int made = 0, all = v_count(keep);
    for (uint32_t left = keep >> all ? keep : 0; left; left &= left - 1, made++) {
        int lane = __builtin_ctz(left);
        records[made] = records[lane];
        spans[made] = spans[lane];
    }
    return all;
}

/* Makes the records of one vector of triangles; returns how many. */
static inline int record_vector(const e3d_record_request *q, const record_list *list, int first, e3d_record *out,
                                e3d_tile_rect *spans)
{
    const uint8_t *triangles = list->triangles + first;
    int count = list->count - first;
    record_corners c = record_fetch(q->vertices, q->indices, triangles);
    int32_t order[V_LANES];
    for (int l = 0; l < V_LANES; l++)
        order[l] = (int32_t)(q->order + (uint32_t)q->faces[triangles[l]]);
    vf64 area[V_HALVES];
    record_area(&c, area);
    vf32 sign = v_narrow(area), none = v_setf(0.0f);
    vmask swapped = v_lt(sign, none), drop = v_eq(sign, none);
    if (q->cull < 0)
        drop = v_mor(drop, swapped);
    if (q->cull > 0)
        drop = v_mor(drop, v_gt(sign, none));
    record_swap(&c, swapped);
    int32_t reach = q->viewport->reach;
    setup_span across = setup_box(c.x, q->viewport->width, reach), down = setup_box(c.y, q->viewport->height, reach);
    drop = v_mor(drop, v_mor(v_gti(across.first, across.last), v_gti(down.first, down.last)));
    vmask finite;
    record_plane p = record_plane_of(&c, across, down, &finite);
    vmask back = q->mirrored ? swapped : v_mnot(swapped); /* front faces have the other sign, since Y points down */
    vi32 meta = record_meta(v_loadu8(list->cover + first), back, swapped);
    uint32_t keep = v_bits(v_mandnot(finite, drop)) & setup_tail(count);
    const vi32 words[16] = {c.x[0], c.x[1], c.x[2], c.y[0], c.y[1], c.y[2], v_asi(p.z0), v_asi(p.gx),
                            v_asi(p.gy), v_asi(p.zmin), v_asi(p.zmax), v_asi(c.iw[0]), v_asi(c.iw[1]),
                            v_asi(c.iw[2]), v_loadi(order), meta};
    v_store_rows(words, (int32_t *)out);
    record_spans(across, down, spans);
    return record_keep(keep, out, spans);
}

static int kernel_record(const e3d_record_request *q, e3d_record *out, e3d_tile_rect *spans)
{
#ifdef E3D_NARROW_TABLE
    if (q->count <= V_LANES / 2)
        return E3D_NARROW_TABLE.record(q, out, spans);
#endif
    record_list list;
    int made = 0;
    if (q->tiny)
        record_list_some(q, &list);
    else
        record_list_all(q, &list);
    for (int i = 0; i < list.count; i += V_LANES)
        made += record_vector(q, &list, i, out + made, spans + made);
    return made;
}
