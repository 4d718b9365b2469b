/* Small triangles, and the fragments that they become. */
#ifndef E3D_KERNELS_FRAGMENTS_H
#define E3D_KERNELS_FRAGMENTS_H

#include <stddef.h>
#include <stdint.h>

#include "core/limits.h"
#include "kernels/types/records.h"

enum { E3D_SMALLS = 4 * E3D_CLUSTER_TRIANGLES, E3D_MOST_FRAGMENTS = E3D_SMALLS * E3D_SMALL * E3D_SMALL };

/* Small triangles of some clusters, with area and a sample in their boxes: snapped corners, and the ID of the fragments. (Arrays
 * are whole lines of the cache, as those of e3d_vertices.) */
typedef int32_t e3d_small_words[E3D_SMALLS + E3D_PAD];
typedef struct e3d_small_triangles {
    e3d_small_words x[3], y[3], id;
    float zn[3][E3D_SMALLS + E3D_PAD];
    int32_t count;
} e3d_small_triangles;

/* A chain of blocks; without any, both are E3D_NO_BLOCK. */
enum { E3D_NO_BLOCK = 0xFFFFFFFFu };
typedef struct e3d_bin {
    uint32_t first, last;
} e3d_bin;

/* What they cover, sample by sample: fragments of one tile, in order of arrival. A whole vector is written, so that the last
 * block of a bin takes none where there is less room than that. */
enum { E3D_BLOCK_FRAGMENTS = 127 };
typedef struct e3d_fragment_block {
    uint32_t next, count;
    float z[E3D_BLOCK_FRAGMENTS];
    int32_t id[E3D_BLOCK_FRAGMENTS];
    uint16_t sample[E3D_BLOCK_FRAGMENTS];
} e3d_fragment_block;

_Static_assert(sizeof(e3d_fragment_block) % 64 == 0, "blocks are whole cache lines");

/* Blocks in use, and one bin for each tile. There is room for as many blocks more as fragments of E3D_SMALLS triangles take. */
typedef struct e3d_fragment_bins {
    e3d_fragment_block *blocks;
    e3d_bin *bins;
    uint32_t count;
    int32_t fragments, triangles; /* made; triangles that they are of */
} e3d_fragment_bins;

static inline size_t e3d_fragment_blocks_most(size_t tiles)
{
    return (tiles < E3D_MOST_FRAGMENTS ? tiles : E3D_MOST_FRAGMENTS) + E3D_MOST_FRAGMENTS / (E3D_BLOCK_FRAGMENTS - E3D_PAD);
}

#endif
