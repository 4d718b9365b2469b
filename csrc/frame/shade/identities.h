/* IDs of what shows in a tile, of frames that ask for little else: nothing of it is shaded. */
#ifndef E3D_IDENTITIES_H
#define E3D_IDENTITIES_H

#include <stdint.h>

#include "frame/pass/view.h"
#include "frame/shade/job.h"

/* Writes the IDs of all pixels of a tile. The first `count` of the memory's runs, which IDs own, are all that shows, row by row. */
void e3d_identify_runs(const e3d_shade_in *in, const e3d_tile *tile, int32_t count, const e3d_shade_out *out);
/* Writes the IDs of the runs of the list of what shows, in any order, over the background. */
void e3d_identify_shown(const e3d_shade_in *in, const e3d_shade_out *out);

#endif
