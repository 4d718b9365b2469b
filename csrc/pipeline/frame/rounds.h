/* Rounds: what is near, or what the last frames showed, is drawn first, and hides what is behind it. */
#ifndef E3D_ROUNDS_H
#define E3D_ROUNDS_H

#include <stddef.h>

#include "core/grow.h"
#include "e3d.h"
#include "kernels/types/visible.h"

typedef struct e3d_context e3d_context;
typedef struct e3d_renderer e3d_renderer;

/* The tiles that are kept over the rounds of a frame. */
typedef struct e3d_kept_memory {
    e3d_visible_tile *tiles;
    size_t room;
    e3d_array depths; /* e3d_tile_depths */
} e3d_kept_memory;

void e3d_kept_free(e3d_kept_memory *kept);

/* Draws the frame's geometry in as many rounds as pay. Tiles are finished meanwhile or not; e3d_tiles() draws what the last round
 * left in their bins. 0 when memory is out. */
int e3d_rounds(e3d_context *context, e3d_stats *stats);

#endif
