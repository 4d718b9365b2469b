/* A scene of the driver and the fuzzer: a frame with all that it points to. */
#pragma once

#include "e3d.h"

enum {
    SCENE_MAX_MESHES = 4,
    SCENE_MAX_TEXTURES = 2,
    SCENE_MAX_LIGHTS = 24,
    SCENE_MAX_MATERIALS = 4,
    SCENE_MAX_MIRRORS = 3,
    SCENE_MAX_ARRAYS = 87 + SCENE_MAX_MIRRORS + SCENE_MAX_LIGHTS
};

typedef struct scene {
    e3d_frame frame;
    e3d_draw draws[SCENE_MAX_MESHES];
    e3d_mesh *meshes[SCENE_MAX_MESHES];
    e3d_texture *textures[SCENE_MAX_TEXTURES];
    e3d_material materials[SCENE_MAX_MATERIALS];
    e3d_light lights[SCENE_MAX_LIGHTS];
    e3d_aperture apertures[2];
    e3d_mirror mirrors[SCENE_MAX_MIRRORS];
    e3d_environment *environment; /* or NULL */
    void *arrays[SCENE_MAX_ARRAYS]; /* freed with the scene: what the meshes and draws borrow */
    int32_t array_count;
    int calm; /* nothing but sheets, some way off: few triangles, none of them large */
} scene;
