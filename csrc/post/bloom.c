/* Bloom (R124): halves the light above 1 level by level, adds the levels up from the smallest on, and adds the sum to the
 * picture.
 * In: radiance and colours of a picture. Out: the colours, changed.
 * Always: each row of a level is one task, made from rows of another level alone; all rows of a level are finished before the
 * next level begins.
 * Source of the pyramid: Jimenez, "Next generation post processing in Call of Duty: Advanced Warfare", 2014, with other
 * filters. */
#include <stdatomic.h>
#include <string.h>

#include "data/bloom_levels.h"
#include "base/fpenv.h"
#include "base/limits.h"
#include "base/pool.h"
#include "data/code_light.h"
#include "e3d_bloom.h"
#include "kernels/kernels.h"
#include "post/rows.h"
#include "reference/reference.h"

enum { CHANNELS = E3D_BLOOM_CHANNELS,
       ROWS = 1 + CHANNELS, /* rows of scratch for each worker */
       ROWS_AT_ONCE = 8 };

/* The planes of a level, red, green, blue; rows are `width` floats apart. */
typedef struct level {
    int32_t width, height;
    float *planes[CHANNELS];
} level;

typedef struct bloom_job {
    const e3d_kernels *kernels;
    const e3d_bloom *bloom;
    const level *from, *to; /* from is NULL for the radiance, to for the picture */
    float *rows;            /* of each worker */
    size_t row;             /* floats of one */
    float decode[256], scale;
    void (*task)(const struct bloom_job *job, int32_t y, float *rows);
    int32_t count;
    atomic_int next;
    atomic_int *bright; /* not 0: something is brighter than 1 */
} bloom_job;

static size_t row_floats(int32_t width) { return (size_t)width + E3D_PAD; }

size_t e3d_bloom_scratch(int32_t width, int32_t height, int32_t threads)
{
    size_t floats = (size_t)threads * ROWS * row_floats(width);
    for (int n = 0; n < e3d_bloom_level_count(height); n++)
        floats += CHANNELS * (size_t)e3d_bloom_side(width, n) * (size_t)e3d_bloom_side(height, n);
    return floats + E3D_PAD;
}

static void halve_radiance(const bloom_job *job, int32_t y, float *rows)
{
    const e3d_bloom *bloom = job->bloom;
    float *planes[CHANNELS];
    const float *four[4];
    for (int k = 0; k < 4; k++)
        four[k] = bloom->radiance + (size_t)CHANNELS * (size_t)bloom->width * (size_t)within(2 * y - 1 + k, bloom->height);
    for (int k = 0; k < CHANNELS; k++)
        planes[k] = rows + (size_t)k * job->row;
    if (job->kernels->bloom_bright(four, bloom->width, planes))
        atomic_store(job->bright, 1);
    for (int k = 0; k < CHANNELS; k++)
        job->kernels->bloom_halve(planes[k], bloom->width, job->to->planes[k] + (size_t)y * (size_t)job->to->width);
}

static void halve_level(const bloom_job *job, int32_t y, float *rows)
{
    const level *from = job->from;
    for (int k = 0; k < CHANNELS; k++) {
        const float *four[4];
        for (int r = 0; r < 4; r++)
            four[r] = from->planes[k] + (size_t)from->width * (size_t)within(2 * y - 1 + r, from->height);
        job->kernels->bloom_rows(four, from->width, rows);
        job->kernels->bloom_halve(rows, from->width, job->to->planes[k] + (size_t)y * (size_t)job->to->width);
    }
}

/* Finds row y of a level's plane at twice its height. */
static void mix_rows(const bloom_job *job, int k, int32_t y, float *out)
{
    const level *from = job->from;
    const float *near = from->planes[k] + (size_t)from->width * (size_t)(y / 2);
    const float *far = from->planes[k] + (size_t)from->width * (size_t)within(y / 2 + (y % 2 ? 1 : -1), from->height);
    job->kernels->bloom_mix(near, far, from->width, out);
}

static void double_level(const bloom_job *job, int32_t y, float *rows)
{
    for (int k = 0; k < CHANNELS; k++) {
        mix_rows(job, k, y, rows);
        job->kernels->bloom_spread(rows, job->to->width, 1, job->to->planes[k] + (size_t)y * (size_t)job->to->width);
    }
}

static void lay(const bloom_job *job, int32_t y, float *rows)
{
    const e3d_bloom *bloom = job->bloom;
    const float *glow[CHANNELS];
    for (int k = 0; k < CHANNELS; k++) {
        float *out = rows + (size_t)(1 + k) * job->row;
        mix_rows(job, k, y, rows);
        job->kernels->bloom_spread(rows, bloom->width, 0, out);
        memset(out + bloom->width, 0, E3D_PAD * sizeof *out); /* whole vectors are read; beyond the end it is dark */
        glow[k] = out;
    }
    uint32_t *rgba = (uint32_t *)(void *)bloom->color + (size_t)y * (size_t)bloom->width;
    job->kernels->bloom_lay(glow, job->scale, job->decode, bloom->srgb, bloom->width, rgba);
}

static void work(void *argument, int worker)
{
    bloom_job *job = argument;
    float *rows = job->rows + (size_t)worker * ROWS * job->row;
    for (;;) {
        int32_t first = atomic_fetch_add(&job->next, ROWS_AT_ONCE);
        if (first >= job->count)
            return;
        for (int32_t y = first; y < first + ROWS_AT_ONCE && y < job->count; y++)
            job->task(job, y, rows);
    }
}

static void run(bloom_job *job, int32_t threads, const level *from, const level *to, int32_t rows,
                void (*task)(const bloom_job *job, int32_t y, float *rows))
{
    job->from = from;
    job->to = to;
    job->task = task;
    job->count = rows;
    atomic_store(&job->next, 0);
    e3d_pool_run(rows > ROWS_AT_ONCE ? threads : 1, work, job);
}

static float *place_levels(const e3d_bloom *bloom, int count, float *at, level *levels)
{
    for (int n = 0; n < count; n++) {
        levels[n].width = e3d_bloom_side(bloom->width, n);
        levels[n].height = e3d_bloom_side(bloom->height, n);
        for (int k = 0; k < CHANNELS; k++, at += (size_t)levels[n].width * (size_t)levels[n].height)
            levels[n].planes[k] = at;
    }
    return at;
}

static void add_bloom(const e3d_bloom *bloom, const e3d_kernels *kernels, int32_t threads, float *scratch)
{
    level levels[E3D_BLOOM_LEVELS];
    int count = e3d_bloom_level_count(bloom->height);
    atomic_int bright = 0;
    bloom_job job = {.kernels = kernels, .bloom = bloom, .row = row_floats(bloom->width), .bright = &bright};
    job.rows = place_levels(bloom, count, scratch, levels);
    job.scale = bloom->strength * (1.0f / (float)count);
    e3d_light_of_codes(bloom->srgb, job.decode);
    run(&job, threads, NULL, &levels[0], levels[0].height, halve_radiance);
    if (!atomic_load(&bright))
        return;
    for (int n = 1; n < count; n++)
        run(&job, threads, &levels[n - 1], &levels[n], levels[n].height, halve_level);
    for (int n = count - 2; n >= 0; n--)
        run(&job, threads, &levels[n + 1], &levels[n], levels[n].height, double_level);
    run(&job, threads, &levels[0], NULL, bloom->height, lay);
}

e3d_status e3d_add_bloom(const e3d_bloom *bloom, e3d_backend backend, int32_t threads, float *scratch)
{
    if (backend == E3D_BACKEND_SCALAR)
        return e3d_reference_bloom(bloom);
    const e3d_kernels *kernels = e3d_kernels_for(backend);
    if (!kernels)
        return E3D_UNSUPPORTED_BACKEND;
    e3d_fpenv saved = e3d_fpenv_enter();
    add_bloom(bloom, kernels, threads, scratch);
    e3d_fpenv_leave(saved);
    return E3D_OK;
}
