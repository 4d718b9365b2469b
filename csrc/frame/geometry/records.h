/* The output of a thread's geometry: records and fragments, and for each tile the lists of those that it may show. */
#pragma once

#include <stdint.h>

#include "base/grow.h"
#include "kernels/types/fragments.h"
#include "kernels/types/records.h"
#include "kernels/types/vertices.h"
#include "frame/cull/cull.h"

/* A link of a bin's chain: IDs of records, in order of arrival. */
typedef struct e3d_bin_link {
    uint32_t next, count;
    uint32_t id[30];
} e3d_bin_link;

/* The bins of all tiles. */
typedef struct e3d_chains {
    e3d_array links;  /* e3d_bin_link or e3d_fragment_link */
    e3d_array bins;    /* e3d_bin, one for each tile */
    e3d_array earlier; /* the bins of the round that finished the tiles */
} e3d_chains;

/* Records with alpha are listed apart. Which samples they cover is known late, so they hide no clusters. */
enum { E3D_ALPHA_MASKED = 0, /* alpha test: they show wherever their alpha reaches the cutoff */
       E3D_ALPHA_BLENDED,
       E3D_ALPHA_KINDS,
       E3D_ALPHA_NONE,    /* has no alpha */
       E3D_ALPHA_UNSEEN }; /* isn't drawn at all */

/* Sets of records: the scene, and the edges of a wireframe. */
enum { E3D_SET_SCENE = 0,
       E3D_SET_EDGES,
       E3D_SETS };

/* One thread's records of one set. */
typedef struct e3d_record_set {
    e3d_array records; /* e3d_record */
    e3d_array corners; /* float[9]: c[k][j] of the clipped ones */
    e3d_array keys;    /* float: the keys of the painter's algorithm */
    e3d_chains chains;
    e3d_chains alpha[E3D_ALPHA_KINDS]; /* records with alpha of the whole pass: they are drawn after the last round */
    size_t earlier_records; /* how many records there were when the tiles were finished */
} e3d_record_set;

/* One thread's fragments: what small triangles cover, sample by sample. */
typedef struct e3d_fragment_set {
    e3d_chains chains;
    e3d_array drawn;      /* e3d_drawn_cluster, of the whole pass, since IDs refer to them */
    size_t earlier_drawn; /* how many clusters there were when the tiles were finished */
    _Alignas(64) e3d_small_triangles triangles; /* the triangles that become fragments next */
} e3d_fragment_set;

typedef struct e3d_geometry_counters {
    e3d_cull_counters culled;
    int64_t triangles_rejected, triangles_drawn; /* the triangles of clusters that show */
    int64_t triangles_clipped, records, bin_entries;
} e3d_geometry_counters;

/* A thread's memory for geometry. */
typedef struct e3d_geometry_memory {
    e3d_record_set sets[E3D_SETS];
    e3d_fragment_set fragments;
    _Alignas(64) e3d_vertices vertices; /* the vertices of the cluster that is drawn */
    e3d_survivors survivors;
    uint32_t number; /* of the thread */
    int id_bits;     /* how many bits of an ID hold the thread's number */
    int failed;      /* out of memory */
    e3d_geometry_counters counters;
} e3d_geometry_memory;

/* The number of a tile's first link; `earlier`: in the bins of the round that finished the tile. */
static inline uint32_t e3d_first_link(const e3d_chains *chains, int earlier, int64_t tile)
{
    return ((const e3d_bin *)(earlier ? &chains->earlier : &chains->bins)->data)[tile].first;
}
/* Walks over the links of a chain; NULL behind the last. */
static inline const e3d_bin_link *e3d_bin_link_at(const e3d_record_set *set, uint32_t number)
{
    return number == E3D_NO_LINK ? NULL : (const e3d_bin_link *)set->chains.links.data + number;
}
static inline const e3d_bin_link *e3d_first_alpha(const e3d_record_set *set, int kind, int64_t tile)
{
    uint32_t number = ((const e3d_bin *)set->alpha[kind].bins.data)[tile].first;
    return number == E3D_NO_LINK ? NULL : (const e3d_bin_link *)set->alpha[kind].links.data + number;
}
static inline const e3d_bin_link *e3d_next_alpha(const e3d_record_set *set, int kind, const e3d_bin_link *link)
{
    return link->next == E3D_NO_LINK ? NULL : (const e3d_bin_link *)set->alpha[kind].links.data + link->next;
}
static inline const e3d_bin_link *e3d_first_records(const e3d_record_set *set, int earlier, int64_t tile)
{
    return e3d_bin_link_at(set, e3d_first_link(&set->chains, earlier, tile));
}
static inline const e3d_fragment_link *e3d_fragment_link_at(const e3d_fragment_set *set, uint32_t number)
{
    return number == E3D_NO_LINK ? NULL : (const e3d_fragment_link *)set->chains.links.data + number;
}
static inline const e3d_fragment_link *e3d_first_fragments(const e3d_fragment_set *set, int earlier, int64_t tile)
{
    return e3d_fragment_link_at(set, e3d_first_link(&set->chains, earlier, tile));
}
