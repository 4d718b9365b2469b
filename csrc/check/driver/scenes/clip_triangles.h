/* Random and hostile triangles in clip space, for e3d_rasterize and e3d_draw_clip.
 *
 * In:  a stream of random numbers.
 * Out: arrays, which the triangles own.
 * Always: the same stream gives the same triangles, on every machine.
 */
#pragma once

#include "check/driver/random.h"
#include "e3d.h"

typedef struct clip_triangles {
    float *clip;    /* (vertices, 4) */
    int32_t *faces; /* (faces_count, 3) */
    uint8_t *colors; /* (vertices, 4) */
    int32_t *looks;  /* (faces_count,) 0: opaque, 1: blended */
    int32_t samples; /* a pixel, of those that are drawn with colours */
    int32_t vertices, faces_count, width, height;
    e3d_cull cull;
} clip_triangles;

/* Sides are limited to `most_side` pixels; 0: by nothing. */
clip_triangles clip_triangles_create(random_stream *r, int32_t most_side);
void clip_triangles_destroy(clip_triangles *t);
