/* Small triangles, and the fragments that they become. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "base/limits.h"
#include "kernels/types/records.h"

enum { E3D_SMALLS = 4 * E3D_CLUSTER_TRIANGLES,
       E3D_MOST_FRAGMENTS = E3D_SMALLS * E3D_SMALL * E3D_SMALL };

/* Micro-triangles of several clusters that wait to become fragments: each has an area, and a sample in its box. Every array
 * fills whole cache lines, so that no vector is split across two. */
typedef int32_t e3d_small_words[E3D_SMALLS + E3D_PAD];
typedef struct e3d_small_triangles {
    e3d_small_words x[3], y[3], id;
    float zn[3][E3D_SMALLS + E3D_PAD];
    int32_t count;
} e3d_small_triangles;

/* A chain of links: the numbers of the first and the last, or E3D_NO_LINK twice. */
enum { E3D_NO_LINK = 0xFFFFFFFFu };
typedef struct e3d_bin {
    uint32_t first, last;
} e3d_bin;

/* Fragments of one tile, in the order in which they were made. Kernels store whole vectors, so a link is full when less than
 * a vector is left. */
enum { E3D_LINK_FRAGMENTS = 127 };
typedef struct e3d_fragment_link {
    uint32_t next, count;
    float z[E3D_LINK_FRAGMENTS];
    int32_t id[E3D_LINK_FRAGMENTS];
    uint16_t sample[E3D_LINK_FRAGMENTS];
} e3d_fragment_link;

_Static_assert(sizeof(e3d_fragment_link) % 64 == 0, "links are whole cache lines");

/* The links in use, and a bin for each tile. The caller makes room for the links that E3D_SMALLS triangles may need
 * (e3d_fragment_links_most). */
typedef struct e3d_fragment_bins {
    e3d_fragment_link *links;
    e3d_bin *bins;
    uint32_t count;
    int32_t fragments, triangles; /* how many fragments were made, and of how many triangles */
} e3d_fragment_bins;

/* The most new links for the fragments of E3D_SMALLS triangles: one that is begun in each tile that they can reach, and full
 * ones. */
static inline size_t e3d_fragment_links_most(size_t tiles)
{
    return (tiles < E3D_MOST_FRAGMENTS ? tiles : E3D_MOST_FRAGMENTS) + E3D_MOST_FRAGMENTS / (E3D_LINK_FRAGMENTS - E3D_PAD);
}
