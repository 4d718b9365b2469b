/* The visible surface of a tile by record ID, for whatever shades it afterwards. */
#ifndef E3D_VISIBLE_H
#define E3D_VISIBLE_H

#include "kernels/types/visible.h"

typedef struct e3d_context e3d_context;
typedef struct e3d_worker e3d_worker;
typedef struct e3d_tile e3d_tile;

void e3d_visible_clear(e3d_visible_tile *visible, const e3d_tile *tile);
/* Draws what is in a tile's bins; `earlier`: first what was in them when the tile was finished. */
void e3d_visible_draw(const e3d_context *context, e3d_visible_tile *visible, int64_t tile_number, int earlier);
/* Makes the list of what shows, where the tile's bins hold all of it. */
void e3d_visible_show(const e3d_context *context, e3d_worker *worker, int64_t tile_number);

#endif
