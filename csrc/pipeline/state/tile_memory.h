/* What a thread has at hand while it draws a tile. */
#ifndef E3D_TILE_MEMORY_H
#define E3D_TILE_MEMORY_H

#include "core/limits.h"
#include "kernels/types/shading.h"
#include "kernels/types/shown.h"
#include "kernels/types/visible.h"

typedef struct e3d_tile_memory {
    e3d_visible_tile visible; /* where tiles aren't kept over several rounds */
    float bound[E3D_TILE_SAMPLES + E3D_PAD]; /* E3D_BEYOND_FAR everywhere */
    float edge_limit[E3D_TILE_SAMPLES + E3D_PAD]; /* wireframe: what an edge's depth must be less than */
    int32_t mark[E3D_TILE_SAMPLES + E3D_PAD];  /* overdraw counts, then wireframe marks */
    uint32_t pixels[2][E3D_TILE_SAMPLES + E3D_PAD]; /* of one sample a pixel: this tile's, and the last one's; */
    uint32_t *rgba;                                 /* the former */
    e3d_samples samples;                       /* of several */
    e3d_run runs[E3D_TILE_SAMPLES + 1];   /* what shows, row by row */
    e3d_run blocks[E3D_TILE_SAMPLES + 1]; /* the same, cut at blocks and in their order */
    char apart[2048]; /* padding against 4K aliasing: sorting reads `blocks` and writes `spare`; loads at the same offset in a
                       * page as a store before them would wait for it */
    e3d_run spare[E3D_TILE_SAMPLES]; /* while runs are sorted */
    _Alignas(64) e3d_cover cover;
    _Alignas(64) e3d_layers layers;
    _Alignas(64) e3d_shown shown;
    _Alignas(64) e3d_batch batch;
    _Alignas(64) e3d_surfaces surfaces;       /* of the batch and its neighbours */
} e3d_tile_memory;

#endif
