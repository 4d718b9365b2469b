/* Environments: turns a picture of the whole sphere into a cube, and finds what mirrors of several roughnesses show of it.
 * In: an equirectangular picture of linear radiance. Out: the levels of e3d_environment_view, in one piece of memory.
 * Always: the same bytes for any number of threads: each texel is computed by one thread, in a fixed order, from directions
 * by written polynomials (docs/exactness, R65-R68). */
#include <stdlib.h>

#include "base/fpenv.h"
#include "e3d_environment.h"
#include "light/cube.h"
#include "light/handle.h"
#include "light/light_tree.h"
#include "light/picture.h"
#include "light/prefilter.h"

enum { LEAST_SIZE = 32,
       LEAST_LOBES = 64,
       MOST_SIZE = 1024 };

/* The size of faces that have about as many texels a degree as the picture has along the horizon and along a meridian. */
static int32_t size_of_faces(int32_t width, int32_t height)
{
    int32_t size = LEAST_SIZE, around = width > 2 * height ? width : 2 * height;
    while (size < MOST_SIZE && 4 * size < around)
        size *= 2;
    return size;
}

/* The size of a level: enough texels for the shape of its lobe, even if the picture has fewer. */
static int32_t size_of_level(int32_t faces, int level)
{
    static const int32_t MOST[E3D_ENVIRONMENT_LEVELS] = {MOST_SIZE, 256, 128, 64, 32, 32, 32, 32, 32};
    int32_t half = faces / 2 > LEAST_LOBES ? faces / 2 : LEAST_LOBES;
    if (level == 0)
        return faces;
    return half < MOST[level] ? half : MOST[level];
}

static size_t floats_of(int32_t size) { return E3D_TEXEL * e3d_cube_texels(size); }

static int allocate(e3d_environment *environment, int32_t faces)
{
    size_t total = 0;
    for (int l = 0; l < E3D_ENVIRONMENT_LEVELS; l++)
        total += floats_of(size_of_level(faces, l));
    float *next = environment->texels = malloc(total * sizeof(float));
    if (!next)
        return 0;
    for (int l = 0; l < E3D_ENVIRONMENT_LEVELS; l++) {
        environment->view.levels[l] = (e3d_environment_level){next, size_of_level(faces, l)};
        next += floats_of(size_of_level(faces, l));
    }
    return 1;
}

static e3d_cube cube_of(const e3d_environment *environment, int level)
{
    const e3d_environment_level *view = &environment->view.levels[level];
    return (e3d_cube){(float *)view->texels, view->size};
}

/* Fills the levels, from the first on; 0 when memory is out. */
static int fill(const e3d_environment *environment, const float *pixels, int32_t width, int32_t height, int threads)
{
    e3d_cube faces = cube_of(environment, 0);
    e3d_light_tree tree;
    if (!e3d_cube_from_picture(pixels, width, height, threads, &faces))
        return 0;
    int built = e3d_light_tree_create(&faces, threads, &tree);
    for (int l = 1; l < E3D_ENVIRONMENT_LEVELS && built; l++) {
        e3d_cube out = cube_of(environment, l);
        e3d_prefilter(&tree, (double)l / (E3D_ENVIRONMENT_LEVELS - 1), threads, &out);
    }
    e3d_light_tree_free(&tree);
    return built;
}

e3d_status e3d_environment_create(const float *pixels, int32_t width, int32_t height, int threads, e3d_environment **out)
{
    *out = NULL;
    if (!pixels || width < 1 || height < 1 || width > E3D_MAX_ENVIRONMENT_SIZE || height > E3D_MAX_ENVIRONMENT_SIZE || threads < 1)
        return E3D_INVALID_ARGUMENT;
    e3d_environment *environment = calloc(1, sizeof *environment);
    if (environment && allocate(environment, size_of_faces(width, height))) {
        e3d_fpenv saved = e3d_fpenv_enter();
        if (fill(environment, pixels, width, height, threads))
            *out = environment;
        e3d_fpenv_leave(saved);
    }
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
