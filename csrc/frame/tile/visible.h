/* The visible surface of a tile, by record IDs; shading comes afterwards. */
#pragma once

#include <stdint.h>

#include "kernels/kernels.h"
#include "kernels/types/shown.h"
#include "kernels/types/visible.h"
#include "frame/geometry/bin.h"
#include "frame/pass/prepared.h"
#include "frame/pass/view.h"

void e3d_visible_clear(e3d_visible_tile *visible, const e3d_tile *tile);
/* The same for callers that write sample by sample, and know no blocks. */
void e3d_visible_empty(e3d_visible_tile *visible);
/* Draws what is in a tile's bins; with multisampling, into all planes. `earlier`: begins with the bins of the round that
 * finished the tile. */
void e3d_visible_draw(const e3d_prepared *pass, const e3d_bins *bins, int64_t tile_number, int earlier, e3d_visible_tile *out);
/* Lists what shows, if the tile's bins hold all of it. */
void e3d_visible_show(const e3d_kernels *kernels, const e3d_bins *bins, int64_t tile_number, const e3d_visible_tile *visible,
                      e3d_shown *out);
