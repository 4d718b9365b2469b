/* Random and hostile pictures in TinyRenderer's manner: surfaces, lights and maps of shadows whose numbers are any, or none.
 */
#include "check/driver/scenes/pybullet_scene.h"

#include <math.h>

#include "check/driver/hostile.h"
#include "e3d_pybullet.h"

enum { SIDE = 160,
       PIXELS = SIDE * SIDE,
       MASKS = 6 };

/* All that a picture points to. */
typedef struct scene {
    e3d_tiny_picture picture;
    uint8_t own[4 * PIXELS], colors[4 * PIXELS];
    float normals[3 * PIXELS], positions[3 * PIXELS], depths[PIXELS], shadows[PIXELS], window_depths[PIXELS];
    int32_t shown[PIXELS], masks[MASKS], shown_masks[PIXELS];
} scene;

static void set_light(random_stream *r, e3d_tiny_picture *p, int hostile)
{
    hostile_fill(r, p->light.direction, 3, 1.0f, hostile);
    hostile_fill(r, p->light.color, 3, 2.0f, hostile);
    float shares[3];
    hostile_fill(r, shares, 3, 1.0f, hostile);
    p->light.ambient = shares[0];
    p->light.diffuse = shares[1];
    p->light.specular = shares[2];
    p->lens.is_parallel = random_once_in(r, 3);
    hostile_fill(r, &p->lens.scale, 1, 2.0f, hostile);
    hostile_fill(r, &p->lens.offset, 1, 2.0f, hostile);
    hostile_fill(r, p->shadows.clip, 16, 1.0f, hostile);
}

static void set_scene(random_stream *r, scene *s)
{
    e3d_tiny_picture *p = &s->picture;
    const int hostile = random_once_in(r, 2), is_large = random_once_in(r, 8);
    *p = (e3d_tiny_picture){.own = s->own, .normals = s->normals, .depths = s->depths, .shown = s->shown, .masks = s->masks};
    p->colors = s->colors;
    p->window_depths = s->window_depths;
    p->shown_masks = s->shown_masks;
    p->width = is_large ? SIDE : 1 + random_below(r, 24);
    p->height = is_large ? SIDE - random_below(r, 9) : 1 + random_below(r, 24);
    p->mask_count = 1 + random_below(r, MASKS);
    const size_t pixels = (size_t)p->width * (size_t)p->height;
    for (size_t i = 0; i < 4 * pixels; i++)
        s->own[i] = (uint8_t)random_below(r, 256);
    for (size_t i = 0; i < pixels; i++)
        s->shown[i] = random_below(r, MASKS + 2) - 1;
    for (int k = 0; k < MASKS; k++)
        s->masks[k] = random_below(r, 1 << 30) - 1;
    hostile_fill(r, s->normals, 3 * pixels, 1.0f, hostile);
    hostile_fill(r, s->depths, pixels, 1.0f, hostile);
    hostile_fill(r, s->positions, 3 * pixels, 2.0f, hostile);
    hostile_fill(r, s->shadows, pixels, 1.0f, hostile);
    set_light(r, p, hostile);
    if (!random_once_in(r, 3)) {
        p->shadows.positions = s->positions;
        p->shadows.depths = s->shadows;
    }
}

/* The hash of the picture, whose bytes are all written; 0 where a depth is no number. */
static uint64_t hash_drawn(const void *input, e3d_backend backend, int32_t threads)
{
    const scene *s = input;
    const e3d_tiny_picture *p = &s->picture;
    const size_t pixels = (size_t)p->width * (size_t)p->height;
    (void)backend; /* no instruction set is chosen */
    memset(p->colors, 0x5A + threads, 4 * pixels);
    memset(p->window_depths, 0x5A + threads, pixels * sizeof *p->window_depths);
    memset(p->shown_masks, 0x5A + threads, pixels * sizeof *p->shown_masks);
    e3d_tiny_shade(p, threads);
    for (size_t i = 0; i < pixels; i++) {
        if (isnan(p->window_depths[i]))
            return 0;
    }
    uint64_t hash = hash_bytes(HASH_START, p->colors, 4 * pixels);
    hash = hash_bytes(hash, (const uint8_t *)p->window_depths, pixels * sizeof *p->window_depths);
    return hash_bytes(hash, (const uint8_t *)p->shown_masks, pixels * sizeof *p->shown_masks);
}

outcome compare_pybullet(random_stream r, const run_plan *plan, const char *title)
{
    static scene s;
    set_scene(&r, &s);
    return compare_thread_counts(hash_drawn, &s, plan, title);
}
