/* Tiles of several samples a pixel; each surface is shaded once (R103-R108). */
#pragma once

#include <stdint.h>

#include "frame/tile/job.h"
#include "frame/tile/memory.h"

/* Makes room for so many samples a pixel; 0 when memory is out. */
int e3d_multisample_reserve(e3d_multisample_memory **memory, int32_t samples);
void e3d_multisample_free(e3d_multisample_memory *memory);

/* These functions return 0 when memory is out. */

/* Draws a tile to its pixels. */
int e3d_multisample_draw(const e3d_tile_job *job);
