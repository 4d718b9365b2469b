/* The farthest depths of kept tiles, which hide what is behind them. */
#ifndef E3D_DEPTHS_H
#define E3D_DEPTHS_H

#include "base/limits.h"
#include "kernels/kernels.h"
#include "kernels/types/visible.h"
#include "frame/pass/boxes.h"

/* The farthest depths of a kept tile: of all, of its blocks, and of the columns of those that aren't noted. */
typedef struct e3d_tile_depths {
    float most;
    uint64_t noted;
    float zmax[E3D_TILE_BLOCKS], columns[E3D_TILE_BLOCKS][E3D_BLOCK];
} e3d_tile_depths;

/* Whether what is drawn in the tiles, `tiles_x` in a row, hides all that is in a box. */
int e3d_is_hidden(const e3d_tile_depths *depths, int32_t tiles_x, const e3d_box_view *view);
/* Says that nothing is drawn in a tile, which therefore hides nothing. */
void e3d_depths_clear(e3d_tile_depths *depths);
/* Notes a tile's farthest depths, of all of so many planes. */
void e3d_note_depths(const e3d_kernels *kernels, int planes, e3d_visible_tile *visible, e3d_tile_depths *out);

#endif
