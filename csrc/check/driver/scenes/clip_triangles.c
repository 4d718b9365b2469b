/* Random triangles in clip space: scattered, or aligned to pixels. */
#include "check/driver/scenes/clip_triangles.h"

#include <stdlib.h>

#include "check/driver/hostile.h"

/* Corners anywhere, some of them hostile. */
static void scatter(clip_triangles *t, random_stream *r)
{
    float extent = random_once_in(r, 3) ? 100.0f : 1.5f;
    for (int32_t i = 0; i < 4 * t->vertices; i++)
        t->clip[i] = random_float(r, -extent, extent);
    if (random_once_in(r, 2))
        hostile_replace(t->clip, 4 * t->vertices, r, 20);
}

/* Corners on pixel centres, with depths that are a few steps of the last bits apart: edges go through centres, depths
 * are equal, and rounding takes some beyond those of the corners. */
static void align(clip_triangles *t, random_stream *r)
{
    const float depth = (float)random_below(r, 64) * (1.0f / 64.0f), step = 1.0f / (float)(1 << 24);
    for (int32_t i = 0; i < t->vertices; i++) {
        float *const v = t->clip + 4 * (size_t)i;
        v[0] = (float)(2 * random_below(r, t->width) + 1 - t->width) / (float)t->width;
        v[1] = (float)(2 * random_below(r, t->height) + 1 - t->height) / (float)t->height;
        v[2] = depth + (float)random_below(r, 4) * step;
        v[3] = 1.0f;
    }
}

clip_triangles clip_triangles_create(random_stream *r, int32_t most_side)
{
    clip_triangles t = {0};
    hostile_size(r, most_side, &t.width, &t.height);
    t.vertices = 3 + random_below(r, 200);
    t.faces_count = random_below(r, 300);
    t.cull = (e3d_cull)random_below(r, 3);
    t.clip = calloc((size_t)t.vertices * 4, sizeof *t.clip);
    t.faces = calloc((size_t)t.faces_count * 3 + 1, sizeof *t.faces);
    t.colors = calloc((size_t)t.vertices * 4, sizeof *t.colors);
    t.looks = calloc((size_t)t.faces_count + 1, sizeof *t.looks);
    if (t.clip == NULL || t.faces == NULL || t.colors == NULL || t.looks == NULL)
        abort();
    (random_once_in(r, 3) ? align : scatter)(&t, r);
    for (int32_t i = 0; i < 3 * t.faces_count; i++)
        t.faces[i] = random_below(r, t.vertices);
    t.samples = 1 << random_below(r, 5);
    for (int32_t i = 0; i < 4 * t.vertices; i++)
        t.colors[i] = (uint8_t)random_below(r, 256);
    for (int32_t i = 0; i < t.faces_count; i++)
        t.looks[i] = random_below(r, 2);
    return t;
}

void clip_triangles_destroy(clip_triangles *t)
{
    free(t->clip);
    free(t->faces);
    free(t->colors);
    free(t->looks);
}
