/* Random light that glows: patches of any brightness, mostly below 1, in pictures of odd sizes. */
#include "check/driver/scenes/bloom_scene.h"

#include <stdlib.h>

#include "e3d_bloom.h"

enum { SIDE = 90,
       PIXELS = SIDE * SIDE };

typedef struct glow {
    float radiance[3 * PIXELS];
    uint8_t color[4 * PIXELS];
    e3d_bloom bloom;
} glow;

static void random_glow(random_stream *r, glow *g)
{
    e3d_bloom *bloom = &g->bloom;
    bloom->width = 1 + random_below(r, SIDE);
    bloom->height = 1 + random_below(r, SIDE);
    bloom->strength = random_once_in(r, 8) ? 1048576.0f : random_float(r, 0.0f, 2.0f);
    bloom->srgb = random_below(r, 2);
    int dark = random_once_in(r, 8);
    int32_t values = 3 * bloom->width * bloom->height;
    for (int32_t i = 0, end = 0; i < values;) {
        float most = 1.0f;
        if (!dark && random_once_in(r, 4))
            most = random_once_in(r, 8) ? 3e38f : 90.0f;
        for (end = i + 1 + random_below(r, 60); i < end && i < values; i++)
            g->radiance[i] = random_float(r, 0.0f, most);
    }
    for (int32_t i = 0; i < 4 * bloom->width * bloom->height; i++)
        g->color[i] = (uint8_t)random_bits(r);
}

/* The hash of the picture; 0 where it fails. */
static uint64_t add(const void *input, e3d_backend backend, int32_t threads)
{
    const glow *g = input;
    static uint8_t color[4 * PIXELS];
    e3d_bloom bloom = g->bloom;
    size_t bytes = 4 * (size_t)bloom.width * (size_t)bloom.height;
    float *scratch = malloc(e3d_bloom_scratch(bloom.width, bloom.height, threads) * sizeof *scratch);
    if (!scratch)
        return 0;
    memcpy(color, g->color, bytes);
    bloom.radiance = g->radiance;
    bloom.color = color;
    e3d_status status = e3d_add_bloom(&bloom, backend, threads, scratch);
    free(scratch);
    return status == E3D_OK ? hash_bytes(HASH_START, color, bytes) : 0;
}

outcome compare_bloom(random_stream r, const run_plan *plan, const char *title)
{
    static glow g;
    random_glow(&r, &g);
    return compare_hashes(add, &g, plan, title);
}
