/* Arrays of random numbers that a scene owns, and frees with it.
 *
 * In:  a scene, a stream of random numbers, how many are wanted.
 * Out: the array; the program ends if there is no memory, or no room for one more.
 */
#pragma once

#include <stddef.h>

#include "check/driver/random.h"
#include "check/driver/scene.h"

/* Holds zeros. */
void *scene_array(scene *s, size_t count, size_t size);
float *random_floats(scene *s, random_stream *r, int32_t count, float low, float high);
uint8_t *random_bytes(scene *s, random_stream *r, int32_t count);
/* Of a picture: one number of the stream begins them all. */
float *random_texels(scene *s, random_stream *r, size_t count, float low, float high);
/* Below a bound. */
int32_t *random_indices(scene *s, random_stream *r, int32_t count, int32_t bound);
