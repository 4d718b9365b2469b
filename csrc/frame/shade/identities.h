/* The IDs of a tile, for frames that ask for little else, so that nothing is shaded. */
#pragma once

#include <stdint.h>

#include "frame/pass/view.h"
#include "frame/shade/job.h"

/* Writes the IDs of all pixels of a tile. Everything that shows is the first `count` of the memory's runs, row by row, owned by
 * IDs. */
void e3d_identify_runs(const e3d_shade_in *in, const e3d_tile *tile, int32_t count, const e3d_shade_out *out);
/* Writes the IDs of the shown list's runs, in any order, over the background. */
void e3d_identify_shown(const e3d_shade_in *in, const e3d_shade_out *out);
