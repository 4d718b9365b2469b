/* Pixels whose samples show different surfaces. */
#pragma once

#include "frame/tile/job.h"

/* Shades pixels, given as bits row by row, and averages them; `layered`: leaves their colours in the samples instead. */
int e3d_mixed_shade(const e3d_tile_job *job, int layered);
/* Averages the colours of the samples of all pixels. */
void e3d_mixed_average_samples(const e3d_tile_job *job);
