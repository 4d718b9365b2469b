/* The output of setup: the triangles of a cluster that may show, and their records. */
#pragma once

#include <stdint.h>

#include "base/limits.h"
#include "kernels/types/vertices.h"

/* The triangles of a cluster that may show, a bit each: `small` ones become fragments if the plan has these, `draw` ones
 * become records, and `clip` ones are clipped first. Every triangle that covers a sample is among them. A triangle is left
 * out if its box has no sample, or if it faces the wrong way and 32 bits hold its area. */
typedef struct e3d_survivors {
    uint64_t draw, small, clip;
} e3d_survivors;

_Static_assert(E3D_CLUSTER_TRIANGLES == 64, "a bit for each triangle of a cluster");

/* The limits of a micro-triangle: samples a side of its box, and 1/256 samples along an axis. Within them, edge functions fit
 * 32 bits. */
enum { E3D_SMALL = 4,
       E3D_SMALL_REACH = 16383 };

/* A set-up triangle: everything that raster and shading need of one piece of a primitive, in one cache line. */
typedef struct e3d_record {
    int32_t x[3], y[3]; /* snapped; exchanged if needed (R9), so that the area is positive */
    float z0, gx, gy, zmin, zmax;
    float iw[3];
    uint32_t order;
    uint32_t meta; /* flags; above E3D_RECORD_SHIFT the number of the corners' barycentrics, or the cover */
} e3d_record;

_Static_assert(sizeof(e3d_record) == 64, "a record is a cache line");

enum {
    E3D_RECORD_BACK = 1,    /* not front-facing */
    E3D_RECORD_SWAPPED = 2, /* vertices 1 and 2 were exchanged (R9) */
    E3D_RECORD_CUT = 4,     /* has corner barycentrics */
    E3D_RECORD_FACE = 8,
    E3D_RECORD_TINY = 16,   /* its box has at most 2 x 2 samples; the cover's bit 2 * row + column is set for covered ones */
    E3D_RECORD_SHIFT = 5
};

/* The triangles of a cluster that are to become records. */
typedef struct e3d_record_request {
    const e3d_vertices *vertices;
    const uint8_t *indices;   /* three planes of E3D_CLUSTER_TRIANGLES */
    const uint8_t *triangles; /* `count` numbers of triangles; whole vectors are read, so E3D_PAD more must be below 64 */
    int count;
    /* Not 0: finds the covers of triangles of at most 2 x 2 samples, and leaves out those that cover none */
    int tiny;
    int cull, mirrored;       /* cull: the sign of the area to drop, as for setup; mirrored: front faces have the other sign */
    uint32_t order;           /* the order of the instance's first face */
    const int32_t *faces;     /* the face of each triangle of the cluster */
    const e3d_viewport *viewport;
} e3d_record_request;

/* The rectangle of tiles that a record's box touches: row << 16 | column, of the first and of the last. */
typedef struct e3d_tile_rect {
    uint32_t first, last;
} e3d_tile_rect;
