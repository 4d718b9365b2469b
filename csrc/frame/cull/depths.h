/* The farthest depths of kept tiles, which hide what is behind them. */
#pragma once

#include "base/limits.h"
#include "kernels/kernels.h"
#include "kernels/types/visible.h"
#include "frame/pass/boxes.h"

/* The farthest depths of a kept tile: of the whole tile, of its blocks, and of the columns of blocks that aren't noted. */
typedef struct e3d_tile_depths {
    float most;
    uint64_t noted;
    float zmax[E3D_TILE_BLOCKS], columns[E3D_TILE_BLOCKS][E3D_BLOCK];
} e3d_tile_depths;

/* Whether the drawn tiles, `tiles_x` in a row, hide everything in a box. */
int e3d_is_hidden(const e3d_tile_depths *depths, int32_t tiles_x, const e3d_box_view *view);
/* Marks a tile as empty, so that it hides nothing. */
void e3d_depths_clear(e3d_tile_depths *depths);
/* Finds a tile's farthest depths, over all its planes. */
void e3d_note_depths(const e3d_kernels *kernels, int planes, e3d_visible_tile *visible, e3d_tile_depths *out);
