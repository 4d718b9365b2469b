/* The faces that cast exact shadows, as triangles in the world. */
#pragma once

#include "base/grow.h"
#include "e3d.h"
#include "kernels/types/casters.h"

/* An instance of a caster's mesh: its faces are the casters from `first` on. */
typedef struct e3d_caster_instance {
    int64_t first;
    int32_t draw, number;
} e3d_caster_instance;

typedef struct e3d_caster_faces {
    e3d_casters casters;   /* the draws that the rest was made from */
    e3d_array instances;   /* e3d_caster_instance; the last one is an end mark */
    e3d_array world;       /* float[9]: of each caster the corners' x, y, z */
    e3d_array may_be_open; /* uint8_t: whether a caster's material has holes */
    e3d_array is_mirrored; /* uint8_t: whether its instance's matrix mirrors */
    int64_t count;         /* of casters */
} e3d_caster_faces;

int e3d_casters_are_valid(const e3d_casters *casters);
/* Finds the rest. */
e3d_status e3d_place_casters(e3d_caster_faces *faces, int32_t threads);
/* Returns the mesh that a caster belongs to. */
const void *e3d_caster_mesh_of(const e3d_caster_index *index, uint32_t caster);
/* Whether a caster is none for an exact light. */
int e3d_caster_is_spared(const e3d_caster_index *index, uint32_t caster, int32_t exact);
int e3d_any_caster_is_spared(const e3d_casters *casters);
/* Returns the instance that a caster belongs to. */
const e3d_caster_instance *e3d_caster_instance_of(const e3d_caster_faces *faces, uint32_t caster);
