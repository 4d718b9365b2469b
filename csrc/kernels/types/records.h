/* What setup leaves: which triangles of a cluster may show, and their records. */
#ifndef E3D_KERNELS_RECORDS_H
#define E3D_KERNELS_RECORDS_H

#include <stdint.h>

#include "core/limits.h"
#include "kernels/types/vertices.h"

/* Triangles of a cluster that may show, a bit each: `small` become fragments, where these are asked for, `draw` records, and
 * `clip` need clipping first. None that covers a sample is missing; of the others, those go that have no sample in their box,
 * or face the wrong way as far as 32 bits tell. */
typedef struct e3d_survivors {
    uint64_t draw, small, clip;
} e3d_survivors;

_Static_assert(E3D_CLUSTER_TRIANGLES == 64, "a bit for each triangle of a cluster");

/* Small are boxes of so many samples a side, and sides of so many steps at most: 32 bits hold their edge functions. */
enum { E3D_SMALL = 4, E3D_SMALL_REACH = 16383 };

/* What setup leaves of a piece of a primitive, ready for any tile: a cache line. */
typedef struct e3d_record {
    int32_t x[3], y[3]; /* snapped, counter-clockwise in R9's sense */
    float z0, gx, gy, zmin, zmax;
    float iw[3];
    uint32_t order;
    uint32_t meta; /* flags, and above E3D_RECORD_SHIFT the corners' number or the cover */
} e3d_record;

_Static_assert(sizeof(e3d_record) == 64, "a record is a cache line");

enum {
    E3D_RECORD_BACK = 1,    /* not front-facing */
    E3D_RECORD_SWAPPED = 2, /* vertices 1 and 2 were exchanged (R9) */
    E3D_RECORD_CUT = 4,     /* has corner barycentrics */
    E3D_RECORD_FACE = 8,
    E3D_RECORD_TINY = 16,   /* a box of at most 2 x 2 samples: bit 2 * row + column tells which are covered */
    E3D_RECORD_SHIFT = 5
};

/* Triangles of a cluster, to become records. */
typedef struct e3d_record_request {
    const e3d_vertices *vertices;
    const uint8_t *indices;   /* three planes of E3D_CLUSTER_TRIANGLES */
    const uint8_t *triangles; /* `count` of the cluster; E3D_PAD more are read and must be less than 64 */
    int count;
    int tiny;                 /* those of at most 2 x 2 samples are told from the others: without cover, they are left out */
    int cull, mirrored;       /* sign of the area to drop, as for setup; front faces are the mirrored ones */
    uint32_t order;           /* of the mesh's first face */
    const int32_t *faces;     /* of the cluster's triangles */
    const e3d_viewport *viewport;
} e3d_record_request;

/* Tiles that a record's box touches: row << 16 | column, inclusive. */
typedef struct e3d_tile_span {
    uint32_t first, last;
} e3d_tile_span;

#endif
