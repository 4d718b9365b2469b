/* Environments: a picture of the whole sphere becomes a cube, its halves, and what mirrors of some roughness show of it.
 *
 * In:  an equirectangular picture of linear radiance.
 * Out: the levels of e3d_environment_view, in one piece of memory.
 * Always: the same bytes for any number of threads: each texel is computed by one thread, in a fixed order, from directions of
 *      written polynomials (docs/exactness.md, R65-R68).
 */
#include <stdlib.h>

#include "core/fpenv.h"
#include "e3d_environment.h"
#include "environment/cube.h"
#include "environment/picture.h"
#include "environment/prefilter.h"

struct e3d_environment {
    e3d_environment_view view;
    float *texels;
};

enum { LEAST_SIZE = 32,
       MOST_SIZE = 1024,
       LEAST_HALF = 8 };

/* Of faces that have about as many texels to a degree as the picture has along the horizon and along a meridian. */
static int32_t size_of_faces(int32_t width, int32_t height)
{
    int32_t size = LEAST_SIZE, around = width > 2 * height ? width : 2 * height;
    while (size < MOST_SIZE && 4 * size < around)
        size *= 2;
    return size;
}

/* A lobe needs no more texels than show its shape. */
static int32_t size_of_level(int32_t faces, int level)
{
    static const int32_t MOST[E3D_ENVIRONMENT_LEVELS] = {MOST_SIZE, 256, 128, 64, 32, 32, 16, 16, 16};
    return faces < MOST[level] ? faces : MOST[level];
}

static size_t floats_of(int32_t size) { return E3D_TEXEL * e3d_cube_texels(size); }

/* Room for all levels, and for the halves of the first; 0 when memory is out. */
static int allocate(e3d_environment *environment, int32_t faces, e3d_halves *halves, float **of_halves)
{
    size_t total = 0, halved = 0;
    for (int l = 0; l < E3D_ENVIRONMENT_LEVELS; l++)
        total += floats_of(size_of_level(faces, l));
    for (int32_t size = faces / 2; size >= LEAST_HALF; size /= 2)
        halved += floats_of(size);
    environment->texels = malloc(total * sizeof(float));
    *of_halves = malloc(halved * sizeof(float));
    if (!environment->texels || !*of_halves)
        return 0;
    float *next = environment->texels;
    for (int l = 0; l < E3D_ENVIRONMENT_LEVELS; l++) {
        environment->view.levels[l] = (e3d_environment_level){next, size_of_level(faces, l)};
        next += floats_of(size_of_level(faces, l));
    }
    halves->of[halves->count++] = (e3d_cube){environment->texels, faces};
    next = *of_halves;
    for (int32_t size = faces / 2; size >= LEAST_HALF; size /= 2) {
        halves->of[halves->count++] = (e3d_cube){next, size};
        next += floats_of(size);
    }
    return 1;
}

static int fill(const e3d_environment *environment, const float *pixels, int32_t width, int32_t height, int threads,
                const e3d_halves *halves)
{
    if (!e3d_cube_from_picture(pixels, width, height, threads, &halves->of[0]))
        return 0;
    for (int n = 1; n < halves->count; n++)
        e3d_cube_halve(&halves->of[n - 1], &halves->of[n]);
    for (int l = 1; l < E3D_ENVIRONMENT_LEVELS; l++) {
        const e3d_environment_level *level = &environment->view.levels[l];
        const e3d_cube out = {(float *)level->texels, level->size};
        e3d_prefilter(halves, (double)l / (E3D_ENVIRONMENT_LEVELS - 1), threads, &out);
    }
    return 1;
}

e3d_status e3d_environment_create(const float *pixels, int32_t width, int32_t height, int threads, e3d_environment **out)
{
    *out = NULL;
    if (!pixels || width < 1 || height < 1 || width > E3D_MAX_ENVIRONMENT_SIZE || height > E3D_MAX_ENVIRONMENT_SIZE || threads < 1)
        return E3D_INVALID_ARGUMENT;
    e3d_environment *environment = calloc(1, sizeof *environment);
    e3d_halves halves = {.count = 0};
    float *of_halves = NULL;
    if (environment && allocate(environment, size_of_faces(width, height), &halves, &of_halves)) {
        e3d_fpenv saved = e3d_fpenv_enter();
        if (fill(environment, pixels, width, height, threads, &halves))
            *out = environment;
        e3d_fpenv_leave(saved);
    }
    free(of_halves);
    if (!*out)
        e3d_environment_destroy(environment);
    return *out ? E3D_OK : E3D_OUT_OF_MEMORY;
}

void e3d_environment_destroy(e3d_environment *environment)
{
    if (!environment)
        return;
    free(environment->texels);
    free(environment);
}

const e3d_environment_view *e3d_environment_get_view(const e3d_environment *environment) { return &environment->view; }
