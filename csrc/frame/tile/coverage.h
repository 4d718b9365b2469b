/* Alpha to coverage: which samples of a pixel the alpha of a masked record leaves. */
#pragma once

#include <stdint.h>

#include "frame/tile/job.h"

/* These functions return 0 when memory is out. */

/* Finds the alphas of the list, and leaves in each cover the samples that the alpha covers. Pixels that it covers in part are
 * left out, and counted. */
int e3d_cover_pixels(const e3d_tile_job *job, int32_t *edges);
/* Makes the list that of the pixels that were left out, and leaves in their covers the samples that their alphas cover. */
int e3d_cover_edges(const e3d_tile_job *job);
