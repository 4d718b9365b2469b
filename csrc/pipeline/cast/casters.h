/* What casts exact shadows, as triangles in the world, kept from frame to frame for as long as they stay the same. */
#ifndef E3D_CASTERS_H
#define E3D_CASTERS_H

#include "core/grow.h"
#include "e3d.h"
#include "kernels/types/casters.h"

/* An instance of a caster's mesh: its faces are the casters from `first` on. */
typedef struct e3d_caster_instance {
    int64_t first;
    int32_t draw, number;
} e3d_caster_instance;

/* The memory of one light's corners and grids. */
typedef struct e3d_light_memory {
    e3d_array corners;                  /* float[9] */
    e3d_array starts[E3D_CASTER_FACES]; /* uint32_t: of all levels */
    e3d_array boxes[E3D_CASTER_FACES];  /* e3d_caster_box */
} e3d_light_memory;

typedef struct e3d_caster_memory {
    e3d_casters casters; /* those that the rest was made from */
    e3d_caster_index index;
    e3d_caster_light lights[E3D_MAX_EXACT_LIGHTS];
    e3d_light made_for[E3D_MAX_EXACT_LIGHTS]; /* the lights, as they were */
    e3d_light_memory of_light[E3D_MAX_EXACT_LIGHTS];
    e3d_array instances; /* e3d_caster_instance, and one that is behind the last */
    e3d_array world;     /* float[9] */
    e3d_array may_be_open; /* uint8_t */
    int64_t count;       /* of casters */
    int32_t kept_lights; /* whose grids are those of the casters */
} e3d_caster_memory;

/* Brings the index up to date with a frame that has such lights. */
e3d_status e3d_casters_prepare(e3d_caster_memory *memory, const e3d_frame *frame, int32_t threads);
void e3d_casters_free(e3d_caster_memory *memory);

/* Finds the instance that a caster is of. */
const e3d_caster_instance *e3d_caster_instance_of(const e3d_caster_memory *memory, uint32_t caster);

#endif
