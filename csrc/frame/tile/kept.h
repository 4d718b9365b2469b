/* The tiles that are kept over the rounds of a pass. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "base/grow.h"
#include "kernels/types/visible.h"
#include "frame/tile/job.h"

typedef struct e3d_kept_memory {
    e3d_visible_tile *tiles;
    size_t room;
    e3d_array depths; /* e3d_tile_depths */
} e3d_kept_memory;

void e3d_kept_free(e3d_kept_memory *kept);
/* Makes room for so many tiles, and touches its pages; 0 when memory is out. */
int e3d_kept_prepare(e3d_kept_memory *kept, int64_t tiles);
/* Begins to keep tiles, of so many planes each; at first they hide nothing. Returns 0 when memory is out. */
int e3d_kept_begin(e3d_kept_memory *kept, int64_t tiles, int32_t planes, e3d_tiles_out *out);
/* Adds the bins' records and fragments to the kept tiles, and notes their depths. */
void e3d_keep_tiles(const e3d_tiles_in *in, e3d_tiles_out *out);
