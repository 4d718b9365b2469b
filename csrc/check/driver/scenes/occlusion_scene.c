/* Random and hostile pictures of depths: planes and noise, holes, depths of any size, odd sizes of pictures. */
#include "check/driver/scenes/occlusion_scene.h"

#include <math.h>
#include <stdio.h>

#include "e3d_occlusion.h"

enum { SIDE = 140,
       PIXELS = SIDE * SIDE };

static const float HOSTILE[] = {0.0f, -0.0f, -1.0f, 1e-40f, 1e-30f, 1e30f, 3e38f};

/* Sheets at some slopes, one in front of another. */
static void random_depths(random_stream *r, const e3d_depth_picture *picture, float *depth)
{
    float along = random_float(r, -0.1f, 0.1f), slope[2] = {along, random_float(r, -0.1f, 0.1f)};
    float noise = random_once_in(r, 2) ? 0.0f : 0.2f;
    int32_t edge = random_below(r, SIDE);
    int hostile = random_once_in(r, 3);
    for (int32_t i = 0; i < picture->width * picture->height; i++) {
        float x = (float)(i % picture->width), y = (float)(i / picture->width);
        depth[i] = 20.0f + slope[0] * x + slope[1] * y + (x < (float)edge ? 0.0f : 1.5f) + random_float(r, 0.0f, noise);
        if (random_once_in(r, 40))
            depth[i] = hostile ? HOSTILE[random_below(r, sizeof HOSTILE / sizeof *HOSTILE)] : 0.0f;
    }
}

static e3d_depth_picture random_picture(random_stream *r, float *depth)
{
    e3d_depth_picture picture = {.depth = depth};
    picture.width = 1 + random_below(r, SIDE);
    picture.height = 1 + random_below(r, SIDE);
    float pixel = random_float(r, 0.001f, 0.1f);
    picture.across[0] = random_once_in(r, 4) ? -pixel : pixel * random_float(r, 0.5f, 2.0f);
    picture.across[1] = random_float(r, -2.0f, 2.0f);
    picture.down[0] = random_once_in(r, 4) ? pixel : -pixel;
    picture.down[1] = random_float(r, -2.0f, 2.0f);
    picture.is_perspective = random_below(r, 2);
    random_depths(r, &picture, depth);
    return picture;
}

/* The hash of a picture's visibility, whose bytes are all written; 0 where it holds a NaN or fails. */
static uint64_t find(e3d_backend backend, int32_t threads, const e3d_depth_picture *picture, float radius)
{
    static float scratch[PIXELS], visibility[PIXELS];
    size_t count = (size_t)picture->width * (size_t)picture->height;
    memset(visibility, 0x5A + threads, sizeof visibility);
    if (e3d_find_occlusion(backend, threads, picture, radius, scratch, visibility) != E3D_OK)
        return 0;
    for (size_t i = 0; i < count; i++)
        if (isnan(visibility[i]))
            return 0;
    return hash_bytes(HASH_START, (const uint8_t *)visibility, count * sizeof *visibility);
}

outcome compare_occlusion(random_stream r, const run_plan *plan, const char *title)
{
    static float depth[PIXELS];
    e3d_depth_picture picture = random_picture(&r, depth);
    float radius = random_float(&r, 0.01f, 4.0f);
    outcome result = {.agrees = 1};
    for (int k = 0; k < E3D_BACKEND_COUNT; k++)
        for (int32_t t = 0; t < plan->thread_counts && plan->backends[k]; t++) {
            uint64_t hash = find((e3d_backend)k, plan->threads[t], &picture, radius);
            result.hash = result.hash == 0 ? hash : result.hash;
            if (hash != 0 && hash == result.hash)
                continue;
            result.agrees = 0;
            if (title != NULL)
                fprintf(stderr, "%s: %s with %d threads differs, or is NaN\n", title, e3d_backend_name((e3d_backend)k), (int)plan->threads[t]);
        }
    return result;
}
