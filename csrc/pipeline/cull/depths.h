/* The farthest depths of kept tiles, which hide what is behind them. */
#ifndef E3D_DEPTHS_H
#define E3D_DEPTHS_H

#include "core/limits.h"
#include "kernels/types/records.h"
#include "kernels/types/visible.h"
#include "pipeline/cull/cull.h"
#include "pipeline/pass/boxes.h"

typedef struct e3d_context e3d_context;

/* The farthest depths of a kept tile: of all, of its blocks, and of the columns of those that aren't noted. */
typedef struct e3d_tile_depths {
    float most;
    uint64_t noted;
    float zmax[E3D_TILE_BLOCKS], columns[E3D_TILE_BLOCKS][E3D_BLOCK];
} e3d_tile_depths;

int e3d_is_hidden(const e3d_context *context, const e3d_box_view *view);
/* Says that nothing is drawn in a tile, which therefore hides nothing. */
void e3d_depths_clear(e3d_tile_depths *depths);
/* Notes a tile's farthest depths. */
void e3d_note_depths(e3d_context *context, e3d_visible_tile *visible, int64_t tile);

#endif
