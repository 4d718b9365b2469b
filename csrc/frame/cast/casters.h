/* The casters of exact shadows. They are kept from frame to frame for as long as they stay the same. */
#pragma once

#include "e3d.h"
#include "kernels/types/casters.h"
#include "frame/cast/faces.h"
#include "frame/cast/grids.h"
#include "frame/cast/tree.h"

typedef struct e3d_caster_memory {
    e3d_caster_faces faces;
    e3d_caster_index index;
    e3d_caster_light lights[E3D_MAX_EXACT_LIGHTS];
    e3d_light made_for[E3D_MAX_EXACT_LIGHTS]; /* the lights, as they were */
    e3d_light_memory of_light[E3D_MAX_EXACT_LIGHTS];
    int32_t kept_lights; /* whose grids are those of the casters */
    e3d_tree_memory tree;
    int has_tree; /* of the casters */
} e3d_caster_memory;

/* Brings the index of casters up to date with a frame whose lights have exact shadows. */
e3d_status e3d_casters_prepare(e3d_caster_memory *memory, const e3d_frame *frame, int32_t threads);
void e3d_casters_free(e3d_caster_memory *memory);
