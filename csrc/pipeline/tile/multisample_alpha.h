/* Records with alpha in a tile of several samples a pixel. */
#ifndef E3D_MULTISAMPLE_ALPHA_H
#define E3D_MULTISAMPLE_ALPHA_H

#include "pipeline/tile/job.h"

/* These return 0 when memory is out. */

/* Adds what masked records show to the planes, whose samples are written. */
int e3d_multisample_cut(const e3d_tile_job *job);
/* Lays blended records over the samples of the planes. */
int e3d_multisample_blend(const e3d_tile_job *job);

#endif
