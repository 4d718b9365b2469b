/* The data of raster: pieces in a tile, records by their IDs, the visible surface. */
#pragma once

#include <stdint.h>

#include "base/limits.h"
#include "kernels/types/records.h"

/* A piece in one tile. e, a, b are its edge functions at the tile's first sample, floor(E / 256) with the top-left rule
 * included. An edge with the whole tile on its inner side is all 0. */
typedef struct e3d_piece {
    int32_t e[3], a[3], b[3];
    int32_t x0, y0, x1, y1;  /* its box in the tile, inclusive */
    float z0, gx, gy, zmin, zmax;
    int32_t base_x, base_y;  /* the base of the depth plane, from the tile's first sample */
    uint32_t slot, order;
} e3d_piece;

enum { E3D_NO_SLOT = -1 };

/* The depth of an empty sample: z is below it exactly if z <= 1 (R15). */
#define E3D_BEYOND_FAR 0x1.000002p0f

/* A cluster of one instance that has fragments; their IDs lead to it. */
typedef struct e3d_drawn_cluster {
    const int32_t *faces; /* the face of each of its triangles */
    uint32_t order;       /* the order of the instance's first face */
    int32_t instance, draw; /* their numbers in the frame */
    int32_t mirrored;
} e3d_drawn_cluster;

/* The tables that IDs lead to. Record n of worker w has the ID n << bits | w; triangle t of its drawn cluster n has the ID
 * E3D_FRAGMENT_ID | (64 * n + t) << bits | w. */
typedef struct e3d_record_table {
    const e3d_record *const *records;
    const e3d_drawn_cluster *const *drawn;
    int32_t bits;
} e3d_record_table;

enum { E3D_FRAGMENT_ID = 1 << 30 };

static inline const e3d_record *e3d_record_at(const e3d_record_table *table, uint32_t id)
{
    return table->records[id & ((1u << table->bits) - 1)] + (id >> table->bits);
}

static inline const e3d_drawn_cluster *e3d_drawn_at(const e3d_record_table *table, uint32_t id, int32_t *triangle)
{
    uint32_t number = (id & (E3D_FRAGMENT_ID - 1)) >> table->bits;
    *triangle = (int32_t)(number % E3D_CLUSTER_TRIANGLES);
    return table->drawn[id & ((1u << table->bits) - 1)] + number / E3D_CLUSTER_TRIANGLES;
}

/* The order of the primitive that an ID stands for. */
static inline uint32_t e3d_order_at(const e3d_record_table *table, uint32_t id)
{
    if (!(id & E3D_FRAGMENT_ID))
        return e3d_record_at(table, id)->order;
    int32_t triangle;
    const e3d_drawn_cluster *drawn = e3d_drawn_at(table, id, &triangle);
    return drawn->order + (uint32_t)drawn->faces[triangle];
}

/* Whether an ID comes before the visible one, if both are equally near (R16). */
static inline int e3d_id_comes_first(const e3d_record_table *table, int32_t id, int32_t kept)
{
    uint32_t order = e3d_order_at(table, (uint32_t)id), other = e3d_order_at(table, (uint32_t)kept);
    return order < other || (order == other && id < kept);
}

enum { E3D_TILE_BLOCKS = E3D_TILE_SAMPLES / 64 };

/* The visible surface of a tile: depth and ID of each sample, and bounds of each block of 8 x 8 samples, row by row. A noted block
 * shows one record everywhere (or nothing: ID -1), and its samples are not written yet. zmin and zmax bound a block's depths; zmax
 * of a stale block is too large, since samples were written after it was measured. */
typedef struct e3d_visible_tile {
    float z[E3D_TILE_SAMPLES + E3D_PAD];
    int32_t id[E3D_TILE_SAMPLES + E3D_PAD];
    float zmin[E3D_TILE_BLOCKS], zmax[E3D_TILE_BLOCKS];
    int32_t noted_id[E3D_TILE_BLOCKS];
    uint64_t noted, stale;
    int32_t x, y; /* first sample */
    int32_t unused[10]; /* padding, so that the next tile of an array, or plane of a tile, begins at a cache line, too */
} e3d_visible_tile;

_Static_assert(sizeof(e3d_visible_tile) % 64 == 0, "tiles are whole lines of the cache");

typedef struct e3d_tile_buffers {
    float *z;               /* E3D_TILE_SAMPLES, 64-byte aligned */
    int32_t *slot;          /* or counts, or marks */
    const uint32_t *orders; /* the order of each slot, for ties of depth */
} e3d_tile_buffers;
