/* Casters in the plane of a light, by where they are there. */
#ifndef E3D_GRIDS_H
#define E3D_GRIDS_H

#include "e3d.h"
#include "kernels/types/casters.h"
#include "pipeline/cast/casters.h"

/* Finds the corners of all casters as a light sees them, and the grids; 0 when memory is out. */
int e3d_find_grids(const e3d_caster_memory *casters, const e3d_light *light, e3d_light_memory *memory, e3d_caster_light *out, int32_t threads);

#endif
