/* The picture behind glass (R161, R162): light that is tone mapped where it shows, other colours as they show, and ever smaller
 * levels of it.
 * In: radiance and colours of a picture. Out: the texels of all levels.
 * Always: each row of a level is one task, made from rows of the level before alone; all rows of a level are finished before the
 * next level begins. */
#include "e3d_behind.h"

#include <stdatomic.h>
#include <string.h>

#include "base/fpenv.h"
#include "base/limits.h"
#include "base/pool.h"
#include "base/vectors.h"
#include "data/behind_levels.h"
#include "data/code_light.h"
#include "data/tone_tables.h"
#include "kernels/kernels.h"
#include "post/rows.h"
#include "reference/reference.h"

enum { ROWS_AT_ONCE = 8,
       CHUNK = 64 }; /* pixels that are tone mapped at once */

typedef struct behind_job {
    const e3d_kernels *kernels;
    const e3d_behind *picture;
    e3d_behind_level level[E3D_BEHIND_LEVELS];
    float *texels, decode[256];
    int number; /* of the level that is made */
    atomic_int next;
} behind_job;

/* ---- level 0 ---- */

/* The codes that light has where it is tone mapped. */
static void find_codes(const behind_job *job, const float *light, int count, uint32_t rgba[CHUNK + E3D_PAD])
{
    float room[3][CHUNK + E3D_PAD] = {{0}};
    float *const planes[3] = {room[0], room[1], room[2]};
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            planes[k][i] = light[4 * i + k];
    job->kernels->tone(job->picture->tone_mapping, planes, count);
    job->kernels->encode(planes[0], planes[1], planes[2], count, job->picture->srgb, rgba);
}

static void limit(const float *radiance, int count, float *texels)
{
    float4 zero = splat(0.0f), most = splat(E3D_MOST_LIGHT);
    for (int i = 0; i < count; i++, radiance += 3)
        store4(texels + 4 * i, less_of(more_of((float4){radiance[0], radiance[1], radiance[2], 0.0f}, zero), most));
}

/* In front of a transparent background: leaves what shows. */
static void find_covered(const uint8_t *color, int count, float *texels)
{
    for (int i = 0; i < count; i++) {
        float shows = color[4 * i + 3] != 0;
        texels[4 * i + 3] = shows;
        for (int k = 0; k < 3; k++)
            texels[4 * i + k] = shows != 0.0f ? texels[4 * i + k] : 0.0f;
    }
}

/* Leaves what shows as tone mapped light; the rest becomes the colours that show. */
static void find_mapped(const behind_job *job, const uint8_t *color, int count, float *texels)
{
    uint32_t rgba[CHUNK + E3D_PAD];
    find_codes(job, texels, count, rgba);
    for (int i = 0; i < count; i++) {
        uint32_t code;
        memcpy(&code, color + 4 * i, sizeof code);
        int mapped = ((rgba[i] ^ code) & 0xFFFFFFu) == 0;
        texels[4 * i + 3] = (float)mapped;
        for (int k = 0; k < 3 && !mapped; k++)
            texels[4 * i + k] = job->decode[color[4 * i + k]];
    }
}

static void fill_row(const behind_job *job, int32_t y)
{
    const e3d_behind *picture = job->picture;
    size_t first = (size_t)y * (size_t)picture->width;
    for (int32_t x = 0; x < picture->width; x += CHUNK) {
        size_t at = first + (size_t)x;
        int count = picture->width - x < CHUNK ? picture->width - x : CHUNK;
        limit(picture->radiance + 3 * at, count, job->texels + 4 * at);
        if (picture->is_transparent)
            find_covered(picture->color + 4 * at, count, job->texels + 4 * at);
        else
            find_mapped(job, picture->color + 4 * at, count, job->texels + 4 * at);
    }
}

/* ---- further levels ---- */

static inline float4 filter(float4 a, float4 b, float4 c, float4 d) { return ((a + d) + (b + c) * splat(3.0f)) * splat(0.125f); }

/* Column x of four rows. */
static inline float4 column(const float *const rows[4], int32_t x)
{
    size_t at = 4 * (size_t)x;
    return filter(load4(rows[0] + at), load4(rows[1] + at), load4(rows[2] + at), load4(rows[3] + at));
}

static void halve_row(const behind_job *job, int32_t y)
{
    const e3d_behind_level *from = &job->level[job->number - 1], *to = &job->level[job->number];
    float *out = job->texels + to->first + 4 * (size_t)y * (size_t)to->width;
    const float *rows[4];
    for (int32_t r = 0; r < 4; r++)
        rows[r] = job->texels + from->first + 4 * (size_t)within(2 * y - 1 + r, from->height) * (size_t)from->width;
    float4 before = column(rows, 0), at = before;
    for (int32_t x = 0; x < to->width; x++) {
        float4 second = column(rows, within(2 * x + 1, from->width)), after = column(rows, within(2 * x + 2, from->width));
        store4(out + 4 * (size_t)x, filter(before, at, second, after));
        before = second;
        at = after;
    }
}

/* ---- all of them ---- */

static void work(void *argument, int worker)
{
    behind_job *job = argument;
    int32_t rows = job->level[job->number].height;
    (void)worker;
    for (;;) {
        int32_t first = atomic_fetch_add(&job->next, ROWS_AT_ONCE);
        if (first >= rows)
            return;
        for (int32_t y = first; y < first + ROWS_AT_ONCE && y < rows; y++) {
            if (job->number)
                halve_row(job, y);
            else
                fill_row(job, y);
        }
    }
}

static void find_levels(const e3d_behind *picture, const e3d_kernels *kernels, int32_t threads, float *levels)
{
    behind_job job = {.kernels = kernels, .picture = picture, .texels = levels};
    int count = e3d_behind_levels(picture->width, picture->height, job.level);
    e3d_light_of_codes(picture->srgb, job.decode);
    for (job.number = 0; job.number < count; job.number++) {
        atomic_store(&job.next, 0);
        e3d_pool_run(job.level[job.number].height > ROWS_AT_ONCE ? threads : 1, work, &job);
    }
}

size_t e3d_behind_floats(int32_t width, int32_t height) { return e3d_behind_size(width, height); }

e3d_status e3d_find_behind(const e3d_behind *picture, e3d_backend backend, int32_t threads, float *levels)
{
    if (backend == E3D_BACKEND_SCALAR) {
        e3d_reference_behind(picture, levels);
        return E3D_OK;
    }
    const e3d_kernels *kernels = e3d_kernels_for(backend);
    if (!kernels)
        return E3D_UNSUPPORTED_BACKEND;
    e3d_fpenv saved = e3d_fpenv_enter();
    find_levels(picture, kernels, threads, levels);
    e3d_fpenv_leave(saved);
    return E3D_OK;
}
