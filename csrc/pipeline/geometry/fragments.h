/* The fragments of a thread, and of each tile the list of those that it may show. */
#ifndef E3D_FRAGMENTS_H
#define E3D_FRAGMENTS_H

#include "core/grow.h"
#include "kernels/types/fragments.h"
#include "kernels/types/visible.h"
#include "pipeline/geometry/records.h"
#include "pipeline/pass/prepared.h"

typedef struct e3d_geometry_state e3d_geometry_state;

/* One thread's fragments: what small triangles cover, sample by sample. */
typedef struct e3d_fragment_set {
    e3d_array blocks; /* e3d_fragment_block */
    e3d_array bins;   /* e3d_bin, one a tile */
    e3d_array earlier; /* the same, of the round that finished the tiles */
    e3d_array drawn;  /* e3d_drawn_cluster: of the whole frame, since IDs tell of them */
    size_t earlier_drawn; /* how many there were when the tiles were finished */
    _Alignas(64) e3d_small_triangles triangles; /* that are fragments soon */
} e3d_fragment_set;

/* The blocks of a chain of fragments, as those of records in records.h. */
static inline const e3d_fragment_block *e3d_fragment_block_at(const e3d_fragment_set *set, uint32_t number)
{
    return number == E3D_NO_BLOCK ? NULL : (const e3d_fragment_block *)set->blocks.data + number;
}
static inline const e3d_fragment_block *e3d_first_fragments(const e3d_fragment_set *set, const e3d_array *bins, int64_t tile)
{
    return e3d_fragment_block_at(set, e3d_first_block(bins, tile));
}
static inline const e3d_fragment_block *e3d_next_fragments(const e3d_fragment_set *set, const e3d_fragment_block *block)
{
    return e3d_fragment_block_at(set, block->next);
}

/* Whether a cluster more can have IDs. */
int e3d_fragments_fit(const e3d_geometry_state *state);
/* Another cluster that has fragments, to be filled in; NULL when memory is out. */
e3d_drawn_cluster *e3d_fragments_cluster(e3d_fragment_set *set);
/* Takes small triangles of that cluster, a bit each, whose vertices the thread has: they become fragments now or later. */
void e3d_fragments_add(const e3d_prepared *pass, e3d_geometry_state *state, const uint8_t *indices, uint64_t triangles);
/* All that were taken become fragments. */
void e3d_fragments_flush(const e3d_prepared *pass, e3d_geometry_state *state);

#endif
