/* Random and hostile pictures of depths and normals: planes and noise, holes, depths and normals of any size, odd sizes of
 * pictures. */
#include "check/driver/scenes/occlusion_scene.h"

#include <math.h>
#include <stdlib.h>

#include "e3d_occlusion.h"

enum { SIDE = 140,
       PIXELS = SIDE * SIDE };

typedef struct surfaces {
    float depth[PIXELS], normal[3 * PIXELS];
    e3d_depth_picture picture;
    float radius;
} surfaces;

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

/* Normals that look to the viewer, mostly: of sheets, of no length, or of any. */
static void random_normals(random_stream *r, const e3d_depth_picture *picture, float *normal)
{
    float lean[2] = {random_float(r, -1.0f, 1.0f), random_float(r, -1.0f, 1.0f)}, noise = random_once_in(r, 2) ? 0.0f : 0.5f;
    int hostile = random_once_in(r, 3);
    for (int32_t i = 0; i < picture->width * picture->height; i++) {
        for (int c = 0; c < 3; c++)
            normal[3 * i + c] = (c < 2 ? lean[c] : 1.0f) + random_float(r, -noise, noise);
        for (int c = 0; c < 3 && random_once_in(r, 30); c++)
            normal[3 * i + c] = hostile ? HOSTILE[random_below(r, sizeof HOSTILE / sizeof *HOSTILE)] : 0.0f;
    }
}

static void random_picture(random_stream *r, surfaces *s)
{
    e3d_depth_picture picture = {.depth = s->depth, .normal = s->normal};
    picture.width = 1 + random_below(r, SIDE);
    picture.height = 1 + random_below(r, SIDE);
    float pixel = random_float(r, 0.001f, 0.1f);
    picture.across[0] = random_once_in(r, 4) ? -pixel : pixel * random_float(r, 0.5f, 2.0f);
    picture.across[1] = random_float(r, -2.0f, 2.0f);
    picture.down[0] = random_once_in(r, 4) ? pixel : -pixel;
    picture.down[1] = random_float(r, -2.0f, 2.0f);
    picture.is_perspective = random_below(r, 2);
    random_depths(r, &picture, s->depth);
    random_normals(r, &picture, s->normal);
    s->picture = picture;
    s->radius = random_float(r, 0.01f, 4.0f);
}

/* The hash of a picture's visibility, whose bytes are all written; 0 where it holds a NaN or fails. */
static uint64_t find(const void *input, e3d_backend backend, int32_t threads)
{
    const surfaces *s = input;
    const e3d_depth_picture *picture = &s->picture;
    static float visibility[PIXELS];
    size_t count = (size_t)picture->width * (size_t)picture->height, floats = e3d_occlusion_scratch(picture->width, picture->height);
    float *scratch = malloc(floats * sizeof *scratch);
    if (!scratch)
        return 0;
    memset(visibility, 0x5A + threads, sizeof visibility);
    memset(scratch, 0x5A + threads, floats * sizeof *scratch);
    e3d_status status = e3d_find_occlusion(backend, threads, picture, s->radius, scratch, visibility);
    free(scratch);
    if (status != E3D_OK)
        return 0;
    for (size_t i = 0; i < count; i++)
        if (isnan(visibility[i]))
            return 0;
    return hash_bytes(HASH_START, (const uint8_t *)visibility, count * sizeof *visibility);
}

outcome compare_occlusion(random_stream r, const run_plan *plan, const char *title)
{
    static surfaces s;
    random_picture(&r, &s);
    return compare_hashes(find, &s, plan, title);
}
