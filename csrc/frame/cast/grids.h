/* Grids that find casters by their place in the plane of a light. */
#pragma once

#include "base/grow.h"
#include "e3d.h"
#include "kernels/types/casters.h"
#include "frame/cast/faces.h"

/* The memory of one light's corners and grids. */
typedef struct e3d_light_memory {
    e3d_array corners;                  /* float[9] */
    e3d_array starts[E3D_CASTER_FACES]; /* uint32_t: the starts of cells, of all levels */
    e3d_array boxes[E3D_CASTER_FACES];  /* e3d_caster_box */
} e3d_light_memory;

/* Finds the corners of all casters as a light sees them, and the grids; 0 when memory is out. */
int e3d_find_grids(const e3d_caster_faces *casters, const e3d_light *light, e3d_light_memory *memory, e3d_caster_light *out, int32_t threads);
