/* The records of a thread, and of each tile the list of those that it may show. */
#ifndef E3D_RECORDS_H
#define E3D_RECORDS_H

#include "core/grow.h"
#include "kernels/types/fragments.h"

/* Bins are chains of blocks of record IDs, in order of arrival. */
typedef struct e3d_bin_block {
    uint32_t next, count;
    uint32_t id[30];
} e3d_bin_block;

/* Records are of the scene, or of the edges of a wireframe. */
enum { E3D_SET_SCENE = 0,
       E3D_SET_EDGES,
       E3D_SETS };

/* One thread's records of one pass. */
typedef struct e3d_record_set {
    e3d_array records; /* e3d_record */
    e3d_array corners; /* float[9]: c[k][j] of the cut ones */
    e3d_array keys;    /* float: painter's algorithm only */
    e3d_array blocks;  /* e3d_bin_block */
    e3d_array bins;    /* e3d_bin, one a tile */
    e3d_array earlier; /* the same, of the round that finished the tiles */
    size_t earlier_records; /* how many there were then */
} e3d_record_set;

/* The first block of a tile's chain, of records or of fragments. */
static inline uint32_t e3d_first_block(const e3d_array *bins, int64_t tile) { return ((const e3d_bin *)bins->data)[tile].first; }
/* The blocks of a chain, one after the other; NULL behind the last. The bins are the set's own, or its earlier ones. */
static inline const e3d_bin_block *e3d_bin_block_at(const e3d_record_set *set, uint32_t number)
{
    return number == E3D_NO_BLOCK ? NULL : (const e3d_bin_block *)set->blocks.data + number;
}
static inline const e3d_bin_block *e3d_first_records(const e3d_record_set *set, const e3d_array *bins, int64_t tile)
{
    return e3d_bin_block_at(set, e3d_first_block(bins, tile));
}
static inline const e3d_bin_block *e3d_next_records(const e3d_record_set *set, const e3d_bin_block *block)
{
    return e3d_bin_block_at(set, block->next);
}

#endif
