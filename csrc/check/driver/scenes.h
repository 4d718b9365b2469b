/* Random and hostile scenes for the driver and the fuzzer.
 *
 * In:  a stream of random numbers.
 * Out: a frame with all that it points to, owned by the scene.
 * Always: the same stream gives the same scene, on every machine.
 */
#pragma once

#include "check/driver/random.h"
#include "check/driver/scene.h"
#include "e3d.h"

/* Sides are limited to `most_side` pixels; 0: by nothing. The scene must be destroyed also where this gives an error. */
e3d_status scene_create(scene *s, random_stream *r, int32_t most_side);
/* Masks some of its materials, and blends some: at least one. Glass may bend what is behind it. */
void scene_add_alpha(scene *s, random_stream *r);
/* Light from all around, of a random picture; it may be the background as well. */
e3d_status scene_add_environment(scene *s, random_stream *r);
void scene_destroy(scene *s);
