/* occlusion: ambient occlusion of a picture of depths, band by band of rows (R125-R128).
 *
 * In:  depths, 0 where nothing shows.
 * Out: what of the light from all around reaches each pixel.
 * Always: the same bytes for any backend and number of threads: a pixel depends on depths alone, its filtered value on shares that are
 *      all found before.
 */
#include "e3d_occlusion.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "core/fpenv.h"
#include "core/limits.h"
#include "core/occlusion_pattern.h"
#include "core/pool.h"
#include "e3d_frame.h"
#include "kernels/kernels.h"
#include "kernels/types/occlusion.h"
#include "reference/occlusion.h"

enum { BAND = 64, /* rows that a thread takes at a time */
       SPAN = E3D_OCCLUSION_SPAN };

/* A worker's rows: SPAN of each kind. */
typedef enum row_kind { NEARNESS = 0,
                        SHARES,
                        DEPTH,
                        RESULT,
                        KINDS } row_kind;

/* What both passes over the picture work on. */
typedef struct occlusion_job {
    const e3d_kernels *kernels;
    const e3d_occlusion_plan *plan;
    float *scratch, *visibility;
    float *rows;   /* a worker's own: SPAN of each kind */
    size_t pitch;  /* of such a row */
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

/* Row y of a worker's rows of one kind, where its first pixel is. */
static float *own_row(const occlusion_job *job, int worker, row_kind kind, int32_t y)
{
    size_t number = ((size_t)worker * KINDS + (size_t)kind) * SPAN + (size_t)((y + SPAN) % SPAN);
    return job->rows + number * job->pitch + E3D_PAD;
}

static void take_row(const occlusion_job *job, const float *picture, int32_t y, float *out)
{
    size_t width = (size_t)job->plan->picture->width;
    if (y < 0 || y >= job->plan->picture->height)
        memset(out, 0, width * sizeof *out);
    else
        memcpy(out, picture + (size_t)y * width, width * sizeof *out);
}

/* Where the kernels write a row of a picture: to its place, if they write no pixel past its end, else to a worker's own row, which
 * is put there afterwards. */
static int is_whole(const occlusion_job *job) { return job->plan->picture->width % E3D_PAD == 0; }

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

/* What lies after the last pixel of a row of depths stays 0, and so does its nearness. */
static void take_depths(const occlusion_job *job, int worker, int32_t y)
{
    const e3d_depth_picture *picture = job->plan->picture;
    float *depth = own_row(job, worker, DEPTH, y);
    take_row(job, picture->depth, y, depth);
    job->kernels->nearness(depth, picture->width, picture->is_perspective, own_row(job, worker, NEARNESS, y));
}

static e3d_occlusion_rows rows_around(const occlusion_job *job, int worker, int32_t y)
{
    e3d_occlusion_rows rows = {.y = y, .depth = own_row(job, worker, DEPTH, y)};
    for (int k = 0; k < SPAN; k++) {
        rows.nearness[k] = own_row(job, worker, NEARNESS, y + k - E3D_OCCLUSION_FILTER);
        rows.share[k] = own_row(job, worker, SHARES, y + k - E3D_OCCLUSION_FILTER);
    }
    return rows;
}

/* ---- the two passes ---- */

/* The shares of a band, unfiltered. */
static void find_shares(const occlusion_job *job, int worker, int32_t first, int32_t end)
{
    take_depths(job, worker, first - 1);
    take_depths(job, worker, first);
    for (int32_t y = first; y < end; y++) {
        take_depths(job, worker, y + 1);
        e3d_occlusion_rows rows = rows_around(job, worker, y);
        float *out = row_to_write(job, worker, job->scratch, y);
        job->kernels->occlusion(job->plan, &rows, out);
        put_row(job, out, job->scratch, y);
    }
}

/* Row y with its neighbours to the left and right. */
static void filter_across(const occlusion_job *job, int worker, int32_t y)
{
    e3d_occlusion_rows rows = rows_around(job, worker, y);
    float *unfiltered = own_row(job, worker, RESULT, 1);
    take_depths(job, worker, y);
    take_row(job, job->scratch, y, unfiltered);
    rows.share[E3D_OCCLUSION_FILTER] = unfiltered;
    job->kernels->occlusion_across(job->plan, &rows, own_row(job, worker, SHARES, y));
}

static void filter(const occlusion_job *job, int worker, int32_t first, int32_t end)
{
    for (int32_t y = first - E3D_OCCLUSION_FILTER; y < end + E3D_OCCLUSION_FILTER; y++) {
        filter_across(job, worker, y);
        int32_t middle = y - E3D_OCCLUSION_FILTER;
        if (middle < first)
            continue;
        e3d_occlusion_rows rows = rows_around(job, worker, middle);
        float *out = row_to_write(job, worker, job->visibility, middle);
        job->kernels->occlusion_down(job->plan, &rows, out);
        put_row(job, out, job->visibility, middle);
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
    if (!job.rows)
        return E3D_OUT_OF_MEMORY;
    fill_plan(picture, radius, &plan);
    e3d_pool_run(threads, find_some, &job);
    atomic_store(&job.next, 0);
    e3d_pool_run(threads, filter_some, &job);
    free(job.rows);
    return E3D_OK;
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
