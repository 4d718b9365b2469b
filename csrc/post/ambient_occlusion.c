/* occlusion: finds the ambient occlusion of a picture of depths, band by band of rows (R125-R128).
 * In: depths, 0 where nothing shows. Out: the share of light from all around that reaches each pixel.
 * Always: the same bytes for any backend and number of threads: a pixel depends on depths alone, and its filtered value on
 * shares that are all found before. */
#include "e3d_occlusion.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "base/fpenv.h"
#include "base/limits.h"
#include "data/occlusion_pattern.h"
#include "base/pool.h"
#include "e3d_frame.h"
#include "kernels/kernels.h"
#include "kernels/types/ambient_occlusion.h"
#include "reference/post/ambient_occlusion.h"

enum { BAND = 64, /* a thread takes so many rows at a time */
       SPAN = E3D_OCCLUSION_SPAN };

/* The kinds of a worker's rows: SPAN rows of each. */
typedef enum row_kind { NEARNESS = 0,
                        MEANS,
                        DEPTH,
                        RESULT,
                        KINDS } row_kind;

/* The data of both passes over the picture. */
typedef struct occlusion_job {
    const e3d_kernels *kernels;
    const e3d_occlusion_plan *plan;
    float *scratch, *visibility;
    float *rows;   /* a worker's own rows: SPAN of each kind */
    size_t pitch;  /* of such a row */
    uint8_t *some; /* for each row of the picture whether anything in it is hidden */
    atomic_int next;
} occlusion_job;

/* ---- the plan ---- */

static float absolute(float v) { return v < 0.0f ? 0.0f - v : v; }

/* R126 */
static void fill_pattern(const e3d_depth_picture *picture, int row, e3d_occlusion_pattern *out)
{
    float aspect = absolute(picture->down[0]) / absolute(picture->across[0]);
    for (int lane = 0; lane < E3D_OCCLUSION_CELL + E3D_PAD; lane++) {
        int column = lane % E3D_OCCLUSION_CELL;
        int number = e3d_occlusion_number(column, row);
        float shift = (float)e3d_occlusion_shift(number) * 0x1p-6f, direction[2];
        e3d_occlusion_direction(number, direction);
        out->step[0][lane] = direction[0] * aspect;
        out->step[1][lane] = direction[1];
        out->side[0][lane] = picture->across[0] < 0.0f ? 0.0f - direction[0] : direction[0];
        out->side[1][lane] = picture->down[0] < 0.0f ? 0.0f - direction[1] : direction[1];
        for (int tap = 0; tap < E3D_OCCLUSION_TAPS; tap++) {
            float t = ((float)tap + shift) * (1.0f / E3D_OCCLUSION_TAPS);
            out->share[tap][lane] = t * t;
        }
    }
}

static void fill_plan(const e3d_depth_picture *picture, float radius, e3d_occlusion_plan *out)
{
    float pixel = absolute(picture->down[0]);
    out->picture = picture;
    out->over_across = (picture->is_perspective ? -1.0f : 1.0f) / picture->across[0];
    out->over_down = (picture->is_perspective ? -1.0f : 1.0f) / picture->down[0];
    out->fall = E3D_OCCLUSION_FALL / (radius * radius);
    out->reach = radius / pixel;
    out->over_step = 1.0f / (E3D_OCCLUSION_STEP * pixel);
    for (int row = 0; row < E3D_OCCLUSION_CELL; row++)
        fill_pattern(picture, row, &out->rows[row]);
}

/* ---- rows ---- */

/* The first pixel of row y, among a worker's rows of one kind. */
static float *own_row(const occlusion_job *job, int worker, row_kind kind, int32_t y)
{
    size_t number = ((size_t)worker * KINDS + (size_t)kind) * SPAN + (size_t)((y + SPAN) % SPAN);
    return job->rows + number * job->pitch + E3D_PAD;
}

/* Whether kernels, which work on whole vectors, neither read nor write beyond the end of a picture's row. */
static int is_whole(const occlusion_job *job) { return job->plan->picture->width % E3D_PAD == 0; }

/* Row y of a picture for kernels to read: the row itself, or a copy. Outside the picture it is 0. */
static const float *row_to_read(const occlusion_job *job, int worker, const float *picture, row_kind kind, int32_t y)
{
    size_t width = (size_t)job->plan->picture->width;
    float *own = own_row(job, worker, kind, y);
    int outside = y < 0 || y >= job->plan->picture->height;
    if (!outside && is_whole(job))
        return picture + (size_t)y * width;
    if (outside)
        memset(own, 0, width * sizeof *own);
    else
        memcpy(own, picture + (size_t)y * width, width * sizeof *own);
    return own;
}

/* The row of a picture for kernels to write: the row itself, or a worker's row, which is copied there afterwards. */
static float *row_to_write(const occlusion_job *job, int worker, float *picture, int32_t y)
{
    return is_whole(job) ? picture + (size_t)y * (size_t)job->plan->picture->width : own_row(job, worker, RESULT, 0);
}

static void put_row(const occlusion_job *job, const float *row, float *picture, int32_t y)
{
    size_t width = (size_t)job->plan->picture->width;
    if (!is_whole(job))
        memcpy(picture + (size_t)y * width, row, width * sizeof *row);
}

/* Finds the nearness of a row; beyond the last pixel, depths and nearness stay 0. Returns the depths. */
static const float *find_nearness(const occlusion_job *job, int worker, int32_t y)
{
    const e3d_depth_picture *picture = job->plan->picture;
    const float *depth = row_to_read(job, worker, picture->depth, DEPTH, y);
    job->kernels->nearness(depth, picture->width, picture->is_perspective, own_row(job, worker, NEARNESS, y));
    return depth;
}

static e3d_occlusion_rows rows_around(const occlusion_job *job, int worker, int32_t y)
{
    e3d_occlusion_rows rows = {.y = y};
    for (int k = 0; k < SPAN; k++)
        rows.nearness[k] = own_row(job, worker, NEARNESS, y + k - E3D_OCCLUSION_FILTER);
    return rows;
}

static int has_some(const float *row, int32_t width)
{
    uint32_t some = 0, bits[64];
    for (int32_t x = 0; x < width && !some; x += 64) {
        int32_t count = width - x < 64 ? width - x : 64;
        memcpy(bits, row + x, (size_t)count * sizeof *bits);
        for (int32_t i = 0; i < count; i++)
            some |= bits[i];
    }
    return some != 0;
}

/* ---- the two passes ---- */

/* Finds the shares of a band, and filters them along rows. */
static void find_shares(const occlusion_job *job, int worker, int32_t first, int32_t end)
{
    int32_t width = job->plan->picture->width;
    float *shares = own_row(job, worker, RESULT, 1);
    find_nearness(job, worker, first - 1);
    const float *next = find_nearness(job, worker, first);
    for (int32_t y = first; y < end; y++) {
        e3d_occlusion_rows rows = rows_around(job, worker, y);
        rows.depth = next;
        next = find_nearness(job, worker, y + 1);
        job->kernels->occlusion(job->plan, &rows, shares);
        rows.share[E3D_OCCLUSION_FILTER] = shares;
        job->some[y] = (uint8_t)has_some(shares, width);
        if (!job->some[y]) { /* the means are 0, too */
            memset(job->scratch + (size_t)y * (size_t)width, 0, (size_t)width * sizeof *job->scratch);
            continue;
        }
        float *out = row_to_write(job, worker, job->scratch, y);
        job->kernels->occlusion_across(job->plan, &rows, out);
        put_row(job, out, job->scratch, y);
    }
}

/* Whether anything is hidden in the rows around y. */
static int has_some_around(const occlusion_job *job, int32_t y)
{
    for (int32_t row = y - E3D_OCCLUSION_FILTER; row <= y + E3D_OCCLUSION_FILTER; row++)
        if (row >= 0 && row < job->plan->picture->height && job->some[row])
            return 1;
    return 0;
}

static void filter_row(const occlusion_job *job, int worker, int32_t y, const float *const *means)
{
    e3d_occlusion_rows rows = rows_around(job, worker, y);
    float *out = row_to_write(job, worker, job->visibility, y);
    for (int k = 0; k < SPAN; k++)
        rows.share[k] = means[(y + k - E3D_OCCLUSION_FILTER + SPAN) % SPAN];
    job->kernels->occlusion_down(job->plan, &rows, out);
    put_row(job, out, job->visibility, y);
}

/* Filters the means of a band down columns. Rows are found when they are needed. */
static void filter(const occlusion_job *job, int worker, int32_t first, int32_t end)
{
    const float *means[SPAN];
    int32_t known = first - E3D_OCCLUSION_FILTER, width = job->plan->picture->width;
    for (int32_t y = first; y < end; y++) {
        if (!has_some_around(job, y)) {
            for (int32_t x = 0; x < width; x++)
                job->visibility[(size_t)y * (size_t)width + (size_t)x] = 1.0f;
            continue;
        }
        known = known > y - E3D_OCCLUSION_FILTER ? known : y - E3D_OCCLUSION_FILTER;
        for (; known <= y + E3D_OCCLUSION_FILTER; known++) {
            find_nearness(job, worker, known);
            means[(known + SPAN) % SPAN] = row_to_read(job, worker, job->scratch, MEANS, known);
        }
        filter_row(job, worker, y, means);
    }
}

static void each_band(occlusion_job *job, int worker, void (*pass)(const occlusion_job *, int, int32_t, int32_t))
{
    int32_t height = job->plan->picture->height;
    for (int band = atomic_fetch_add(&job->next, 1); band * BAND < height; band = atomic_fetch_add(&job->next, 1)) {
        int32_t end = (band + 1) * BAND;
        pass(job, worker, band * BAND, end < height ? end : height);
    }
}

static void find_some(void *job, int worker) { each_band(job, worker, find_shares); }

static void filter_some(void *job, int worker) { each_band(job, worker, filter); }

/* ---- the entry ---- */

static int is_valid(const e3d_depth_picture *p, float radius)
{
    if (p->width < 1 || p->height < 1 || p->width > E3D_MAX_SIZE || p->height > E3D_MAX_SIZE || !p->depth)
        return 0;
    return p->across[0] != 0.0f && p->down[0] != 0.0f && radius > 0.0f;
}

static e3d_status find(const e3d_kernels *kernels, int32_t threads, const e3d_depth_picture *picture, float radius, float *scratch,
                       float *visibility)
{
    e3d_occlusion_plan plan;
    occlusion_job job = {.kernels = kernels, .plan = &plan, .scratch = scratch, .visibility = visibility};
    job.pitch = (size_t)picture->width + 2 * E3D_PAD;
    job.rows = calloc((size_t)threads * KINDS * SPAN * job.pitch, sizeof *job.rows);
    job.some = calloc((size_t)picture->height, sizeof *job.some);
    if (job.rows && job.some) {
        fill_plan(picture, radius, &plan);
        e3d_pool_run(threads, find_some, &job);
        atomic_store(&job.next, 0);
        e3d_pool_run(threads, filter_some, &job);
    }
    e3d_status status = job.rows && job.some ? E3D_OK : E3D_OUT_OF_MEMORY;
    free(job.rows);
    free(job.some);
    return status;
}

e3d_status e3d_find_occlusion(e3d_backend backend, int32_t threads, const e3d_depth_picture *picture, float radius, float *scratch,
                              float *visibility)
{
    if (!is_valid(picture, radius))
        return E3D_INVALID_ARGUMENT;
    if (backend == E3D_BACKEND_SCALAR) {
        e3d_reference_occlusion(picture, radius, scratch, visibility);
        return E3D_OK;
    }
    const e3d_kernels *kernels = e3d_kernels_for(backend);
    if (!kernels)
        return E3D_UNSUPPORTED_BACKEND;
    threads = threads > 0 ? threads : e3d_thread_count();
    e3d_fpenv saved = e3d_fpenv_enter();
    e3d_status status = find(kernels, threads < E3D_MAX_THREADS ? threads : E3D_MAX_THREADS, picture, radius, scratch, visibility);
    e3d_fpenv_leave(saved);
    return status;
}
