/* Random and hostile scenes for the driver and the fuzzer.
 *
 * In:  a stream of random numbers.
 * Out: a frame with all that it points to, owned by the scene.
 * Always: the same stream gives the same scene, on every machine.
 */
#pragma once

#include "check/driver/random.h"
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

/* Sides are limited to `most_side` pixels; 0: by nothing. The scene must be destroyed also where this gives an error. */
e3d_status scene_create(scene *s, random_stream *r, int32_t most_side);
/* Masks some of its materials, and blends some: at least one. Glass may bend what is behind it. */
void scene_add_alpha(scene *s, random_stream *r);
/* Light from all around, of a random picture; it may be the background as well. */
e3d_status scene_add_environment(scene *s, random_stream *r);
void scene_destroy(scene *s);
