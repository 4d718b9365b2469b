/* Random pictures behind glass: light and codes that seldom agree, in odd sizes. */
#include "check/driver/scenes/behind_scene.h"

#include <stdlib.h>

#include "e3d_behind.h"

enum { SIDE = 90,
       PIXELS = SIDE * SIDE };

typedef struct seen {
    float radiance[3 * PIXELS];
    uint8_t color[4 * PIXELS];
    e3d_behind picture;
} seen;

/* Patches of one light and one code; black light is black in all tone mappings but one. */
static void random_picture(random_stream *r, seen *s)
{
    e3d_behind *picture = &s->picture;
    *picture = (e3d_behind){.radiance = s->radiance, .color = s->color};
    picture->width = 1 + random_below(r, SIDE);
    picture->height = 1 + random_below(r, SIDE);
    picture->srgb = random_below(r, 2);
    picture->is_transparent = random_once_in(r, 3);
    picture->tone_mapping = (e3d_tone_mapping)random_below(r, E3D_TONE_MAPPINGS);
    int32_t pixels = picture->width * picture->height;
    for (int32_t i = 0, end = 0; i < pixels;) {
        float most = random_once_in(r, 3) ? 0.0f : 4.0f;
        if (random_once_in(r, 8))
            most = 3e38f;
        int black = random_once_in(r, 2);
        for (end = i + 1 + random_below(r, 40); i < end && i < pixels; i++)
            for (int k = 0; k < 4; k++) {
                s->color[4 * i + k] = black ? 0 : (uint8_t)random_bits(r);
                if (k < 3)
                    s->radiance[3 * i + k] = random_float(r, most * -0.1f, most);
            }
    }
}

/* The hash of the levels; 0 where it fails. */
static uint64_t find(const void *input, e3d_backend backend, int32_t threads)
{
    const seen *s = input;
    size_t floats = e3d_behind_floats(s->picture.width, s->picture.height);
    float *levels = malloc(floats * sizeof *levels);
    if (!levels)
        return 0;
    e3d_status status = e3d_find_behind(&s->picture, backend, threads, levels);
    uint64_t hash = status == E3D_OK ? hash_bytes(HASH_START, (const uint8_t *)levels, floats * sizeof *levels) : 0;
    free(levels);
    return hash;
}

outcome compare_behind(random_stream r, const run_plan *plan, const char *title)
{
    static seen s;
    random_picture(&r, &s);
    return compare_hashes(find, &s, plan, title);
}
