/* Visible samples become colours and outputs. */
#pragma once

#include <stdint.h>

#include "frame/pass/view.h"
#include "frame/shade/job.h"

/* Finds the constants of a pass. */
void e3d_shade_prepare(e3d_shade_in *in);
void e3d_shade_free(e3d_shade_memory *memory);
/* Shades the first `count` of the memory's runs, which IDs own; 0 when memory is out. */
int e3d_shade_runs(const e3d_shade_in *in, const e3d_tile *tile, int32_t count, const e3d_shade_out *out);
/* The same with multisampling, for sample `number` of each pixel alone (R195). */
int e3d_shade_plane(const e3d_shade_in *in, const e3d_tile *tile, int32_t count, int32_t number, const e3d_shade_out *out);
/* Shades the list of what shows; 0 when memory is out. */
int e3d_shade_shown(const e3d_shade_in *in, const e3d_tile *tile, const e3d_shade_out *out);
