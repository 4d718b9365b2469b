/* raster: finds the samples of a tile that a piece covers, and its depths there (R12, R14-R17). One loop has four uses: depth
 * test, overwrite, count, mark. A piece is drawn in strips, which are columns of unaligned vectors. */
#pragma once

#include "base/limits.h"
#include "kernels/kernels.h"
#include "kernels/types/visible.h"

enum { RASTER_DEPTH,
       RASTER_OVERWRITE,
       RASTER_COUNT,
       RASTER_MARK };
enum { RASTER_BLOCK = 8 };

typedef struct raster_constants {
    vf32 z0, gx, gy, zmin, zmax;
    vi32 slot;
} raster_constants;

/* The part of R14 that a column of vectors shares. */
static inline vf32 raster_column(const raster_constants *c, int32_t from)
{
    vf32 dx = v_float(v_addi(v_iota(), v_seti(from)));
    return v_add(c->z0, v_mul(dx, c->gx));
}

static inline vf32 raster_z(const raster_constants *c, vf32 column, int32_t dy)
{
    vf32 z = v_add(column, v_mul(v_setf((float)dy), c->gy));
    return v_min(v_max(z, c->zmin), c->zmax);
}

/* Of lanes with equal depth, those in which this piece comes first (R16). */
static inline uint32_t raster_ties(uint32_t equal, const int32_t *slot, const e3d_piece *piece,
                                   const e3d_tile_buffers *tile)
{
    uint32_t won = 0;
    for (; equal; equal &= equal - 1) {
        int lane = __builtin_ctz(equal);
        if (slot[lane] >= 0 && piece->order < tile->orders[slot[lane]])
            won |= 1u << lane;
    }
    return won;
}

static inline void raster_take_ties(uint32_t won, vf32 z, float *depth, int32_t *slot, const e3d_piece *piece)
{
    float lanes[V_LANES];
    v_storef(lanes, z);
    for (; won; won &= won - 1) { /* of 0 and -0, the depth takes the winner's sign */
        int lane = __builtin_ctz(won);
        depth[lane] = lanes[lane];
        slot[lane] = (int32_t)piece->slot;
    }
}

/* Writes one vector of samples, `inside` of which are covered. */
static inline void raster_write(int use, vmask inside, vf32 z, int at, const raster_constants *c,
                                const e3d_piece *piece, const e3d_tile_buffers *tile)
{
    float *depth = tile->z + at;
    int32_t *slot = tile->slot + at;
    vf32 old = v_loadf(depth);
    vf32 limit = use == RASTER_OVERWRITE ? v_setf(E3D_BEYOND_FAR) : old;
    vmask pass = v_lt_in(inside, z, limit);
    vmask equal_lanes = v_eq_in(inside, z, old);
    if (!v_any(use == RASTER_DEPTH ? v_mor(pass, equal_lanes) : pass))
        return;
    vi32 before = v_loadi(slot);
    if (use == RASTER_COUNT) {
        v_storei(slot, v_seli(pass, v_addi(before, v_seti(1)), before));
    } else if (use == RASTER_DEPTH) {
        uint32_t equal = v_bits(equal_lanes);
        v_storef(depth, v_self(pass, z, old));
        v_storei(slot, v_seli(pass, c->slot, before));
        if (equal)
            raster_take_ties(raster_ties(equal, slot, piece, tile), z, depth, slot, piece);
    } else {
        if (use == RASTER_OVERWRITE)
            v_storef(depth, v_self(pass, z, old));
        v_storei(slot, v_seli(pass, c->slot, before));
    }
}

static inline vi32 raster_step(int32_t per_sample)
{
    return v_muli(v_iota(), v_seti(per_sample));
}

/* Draws one column of vectors, from x on, over the rows of the box. */
static inline void raster_strip(int use, const e3d_piece *p, int x, const raster_constants *c,
                                const e3d_tile_buffers *tile)
{
    vi32 e[3];
    for (int k = 0; k < 3; k++)
        e[k] = v_addi(v_seti(p->e[k] + p->a[k] * x + p->b[k] * p->y0), raster_step(p->a[k]));
    vf32 column = raster_column(c, x - p->base_x);
    for (int y = p->y0; y <= p->y1; y++) {
        vmask inside = v_mnot(v_negi(v_ori(v_ori(e[0], e[1]), e[2])));
        if (v_any(inside)) {
            vf32 z = raster_z(c, column, y - p->base_y);
            raster_write(use, inside, z, y * E3D_TILE + x, c, p, tile);
        }
        for (int k = 0; k < 3; k++)
            e[k] = v_addi(e[k], v_seti(p->b[k]));
    }
}

/* Draws strips from the box's first column on; the last strip begins where the tile still holds a vector. */
static inline void raster_piece(int use, const e3d_piece *p, const e3d_tile_buffers *tile)
{
    raster_constants c = {v_setf(p->z0), v_setf(p->gx), v_setf(p->gy),
                          v_setf(p->zmin), v_setf(p->zmax), v_seti((int32_t)p->slot)};
    int strips = (p->x1 - p->x0) / V_LANES + 1, most = E3D_TILE - strips * V_LANES;
    int x = p->x0 < most ? p->x0 : most;
    for (int i = 0; i < strips; i++)
        raster_strip(use, p, x + i * V_LANES, &c, tile);
}

#define RASTER_KERNEL(name, use) \
    static void kernel_raster_##name(const e3d_piece *piece, const e3d_tile_buffers *tile) \
    { \
        raster_piece(use, piece, tile); \
    }

RASTER_KERNEL(depth, RASTER_DEPTH)
RASTER_KERNEL(overwrite, RASTER_OVERWRITE)
RASTER_KERNEL(count, RASTER_COUNT)
RASTER_KERNEL(mark, RASTER_MARK)
