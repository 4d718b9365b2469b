/* occlusion: finds the ambient occlusion of a picture of depths and normals, band by band of rows (R125-R128, R180, R216).
 * In: depths, 0 where nothing shows; normals. Out: the share of light from all around that reaches each pixel.
 * Always: the same bytes for any backend and number of threads: a site depends on depths and normals alone, and a pixel on
 * sites that are all found before. */
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

enum { BAND = 32, /* a thread takes so many rows of sites at a time */
       SPAN = E3D_OCCLUSION_SPAN,
       FARTHEST = E3D_OCCLUSION_FILTER + E3D_OCCLUSION_CELL }; /* rows from which the filters take something */

/* The rows of sites in scratch memory, of which each array has as many as the picture. */
typedef enum site_kind { DEPTH = 0,
                         NEAR,
                         ACROSS,
                         DOWN,
                         FIRM,
                         SHARE,
                         MEANS,
                         SITE_KINDS } site_kind;

/* A worker's own rows: of pixels, and of sites, which are shorter: zeros, shares and means before they are filtered, those filtered. */
typedef enum own_kind { PIXELS = 0,
                        RESULT,
                        ZEROS,
                        UNFILTERED,
                        EVEN_ROW,
                        ODD_ROW,
                        OWN_KINDS } own_kind;

/* The data of all passes over the picture. */
typedef struct occlusion_job {
    const e3d_kernels *kernels;
    const e3d_occlusion_plan *plan;
    float *scratch, *visibility;
    float *own; /* each worker's own rows */
    size_t own_pitch;
    uint8_t *some; /* for each row of sites whether anything in it is hidden */
    atomic_int next;
} occlusion_job;

/* ---- sizes ---- */

static int32_t sites_of(int32_t pixels) { return (pixels + 1) / E3D_OCCLUSION_STEP; }

/* A row is rounded up to whole vectors, and has zeros before and after. */
static size_t pitch_of(int32_t sites) { return ((size_t)sites + E3D_PAD - 1) / E3D_PAD * E3D_PAD + 2 * E3D_PAD; }

/* ---- the plan ---- */

static float absolute(float v) { return v < 0.0f ? 0.0f - v : v; }

/* R126 */
static void fill_pattern(const e3d_depth_picture *picture, float radius, int row, e3d_occlusion_pattern *out)
{
    float aspect = absolute(picture->down[0]) / absolute(picture->across[0]);
    for (int lane = 0; lane < E3D_OCCLUSION_CELL + E3D_PAD; lane++) {
        int number = e3d_occlusion_number(lane % E3D_OCCLUSION_CELL, row);
        float direction[2];
        e3d_occlusion_direction(number, direction);
        out->step[0][lane] = direction[0] * aspect;
        out->step[1][lane] = direction[1];
        out->side[0][lane] = picture->across[0] < 0.0f ? 0.0f - direction[0] : direction[0];
        out->side[1][lane] = picture->down[0] < 0.0f ? 0.0f - direction[1] : direction[1];
        out->range2[lane] = (radius * radius) * (1.0f - (float)e3d_occlusion_lack(number) * 0x1p-8f);
        for (int side = 0; side < 2; side++)
            for (int tap = 0; tap < E3D_OCCLUSION_TAPS; tap++) {
                float shift = (float)(2 * e3d_occlusion_shift(number, side) + 1) * 0x1p-7f;
                out->share[side][tap][lane] = ((float)tap + shift) * (1.0f / E3D_OCCLUSION_TAPS);
            }
    }
}

/* The light of each set of the sectors of a right angle: that without its highest sector, and that sector's. */
static void fill_light(int quadrant, int32_t light[E3D_OCCLUSION_HALF])
{
    light[0] = 0;
    for (int k = 0; k < E3D_OCCLUSION_QUADRANT; k++) {
        int sector = quadrant * E3D_OCCLUSION_QUADRANT + k;
        int32_t its = E3D_OCCLUSION_LIGHT[1][sector] * 65536 + E3D_OCCLUSION_LIGHT[0][sector];
        for (int set = 0; set < 1 << k; set++)
            light[1 << k | set] = light[set] + its;
    }
}

static void fill_plan(const e3d_depth_picture *picture, float radius, const float *scratch, e3d_occlusion_plan *out)
{
    *out = (e3d_occlusion_plan){.picture = picture, .width = sites_of(picture->width), .height = sites_of(picture->height)};
    out->pitch = (int32_t)pitch_of(out->width);
    out->depth = scratch + E3D_PAD;
    for (int axis = 0; axis < 2; axis++) {
        out->across[axis] = axis ? picture->across[1] : picture->across[0] * E3D_OCCLUSION_STEP;
        out->down[axis] = axis ? picture->down[1] : picture->down[0] * E3D_OCCLUSION_STEP;
    }
    out->side = absolute(out->down[0]);
    out->reach = radius / out->side;
    out->radius = radius;
    for (int row = 0; row < E3D_OCCLUSION_CELL; row++)
        fill_pattern(picture, radius, row, &out->rows[row]);
    for (int quadrant = 0; quadrant < 2; quadrant++)
        fill_light(quadrant, out->light[quadrant]);
}

/* ---- rows ---- */

static float *own_row(const occlusion_job *job, int worker, own_kind kind)
{
    return job->own + ((size_t)worker * OWN_KINDS + (size_t)kind) * job->own_pitch + E3D_PAD;
}

/* Whether kernels, which work on pairs of whole vectors, neither read nor write beyond the end of a picture's row. */
static int is_whole(const occlusion_job *job) { return job->plan->picture->width % (E3D_OCCLUSION_STEP * E3D_PAD) == 0; }

/* Row y of the depths for kernels to read: the row itself, or a copy, which is 0 after its last pixel. */
static const float *depths_of(const occlusion_job *job, int worker, int32_t y)
{
    const e3d_depth_picture *picture = job->plan->picture;
    const float *row = picture->depth + (size_t)y * (size_t)picture->width;
    return is_whole(job) ? row : memcpy(own_row(job, worker, PIXELS), row, (size_t)picture->width * sizeof *row);
}

static float *kept_row(const occlusion_job *job, site_kind kind, int32_t row)
{
    size_t rows = (size_t)kind * (size_t)job->plan->height + (size_t)row;
    return job->scratch + rows * (size_t)job->plan->pitch + E3D_PAD;
}

/* A row of sites; outside the picture, zeros. */
static e3d_occlusion_sites sites_at(const occlusion_job *job, int worker, int32_t row)
{
    float *zeros = own_row(job, worker, ZEROS);
    if (row < 0 || row >= job->plan->height)
        return (e3d_occlusion_sites){zeros, zeros, {zeros, zeros}, zeros, zeros};
    return (e3d_occlusion_sites){kept_row(job, DEPTH, row), kept_row(job, NEAR, row), {kept_row(job, ACROSS, row), kept_row(job, DOWN, row)}, kept_row(job, FIRM, row), kept_row(job, SHARE, row)};
}

/* Clears what of a row lies outside the picture. */
static void clear_around(const occlusion_job *job, float *row)
{
    size_t width = (size_t)job->plan->width;
    memset(row - E3D_PAD, 0, E3D_PAD * sizeof *row);
    memset(row + width, 0, ((size_t)job->plan->pitch - E3D_PAD - width) * sizeof *row);
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

/* ---- the passes ---- */

/* Finds the depths and nearness of a band of rows of sites. */
static void find_sites(const occlusion_job *job, int worker, int32_t first, int32_t end)
{
    for (int32_t row = first; row < end; row++) {
        e3d_occlusion_sites sites = sites_at(job, worker, row);
        for (int kind = 0; kind < SITE_KINDS; kind++)
            clear_around(job, kept_row(job, (site_kind)kind, row));
        job->kernels->occlusion_sites(depths_of(job, worker, row * E3D_OCCLUSION_STEP), job->plan->width, job->plan->picture->is_perspective, &sites);
    }
}

/* Finds the shares of a band, and filters them along rows. */
static void find_shares(const occlusion_job *job, int worker, int32_t first, int32_t end)
{
    for (int32_t row = first; row < end; row++) {
        e3d_occlusion_sites rows[3] = {sites_at(job, worker, row - 1), sites_at(job, worker, row), sites_at(job, worker, row + 1)};
        float *means = rows[1].share;
        rows[1].share = own_row(job, worker, UNFILTERED);
        job->kernels->occlusion(job->plan, rows, row);
        job->some[row] = (uint8_t)has_some(rows[1].share, job->plan->width);
        if (job->some[row])
            job->kernels->occlusion_across(job->plan, &rows[1], means);
        else /* the means are 0, too */
            memset(means, 0, (size_t)job->plan->width * sizeof *means);
    }
}

/* Whether anything is hidden in the rows of sites from one to another. */
static int has_some_in(const occlusion_job *job, int32_t first, int32_t last)
{
    for (int32_t row = first; row <= last; row++)
        if (row >= 0 && row < job->plan->height && job->some[row])
            return 1;
    return 0;
}

/* Filters the shares of a band down columns, and the means along rows again, widely. */
static void find_means(const occlusion_job *job, int worker, int32_t first, int32_t end)
{
    for (int32_t row = first; row < end; row++) {
        e3d_occlusion_sites around[SPAN], here = sites_at(job, worker, row);
        float *means = kept_row(job, MEANS, row);
        if (!has_some_in(job, row - E3D_OCCLUSION_FILTER, row + E3D_OCCLUSION_FILTER)) {
            memset(means, 0, (size_t)job->plan->width * sizeof *means);
            continue;
        }
        for (int k = 0; k < SPAN; k++)
            around[k] = sites_at(job, worker, row + k - E3D_OCCLUSION_FILTER);
        here.share = own_row(job, worker, UNFILTERED);
        job->kernels->occlusion_down(job->plan, around, here.share);
        job->kernels->occlusion_wide_across(job->plan, &here, means);
    }
}

/* A row of sites with its means. */
static e3d_occlusion_sites means_at(const occlusion_job *job, int worker, int32_t row)
{
    e3d_occlusion_sites out = sites_at(job, worker, row);
    if (row >= 0 && row < job->plan->height)
        out.share = kept_row(job, MEANS, row);
    return out;
}

/* The row of sites with its means filtered widely down the columns, unless they are known. */
static e3d_occlusion_sites filtered(const occlusion_job *job, int worker, int32_t row, int is_known)
{
    e3d_occlusion_sites around[3], out = means_at(job, worker, row);
    if (row >= job->plan->height)
        return out;
    out.share = own_row(job, worker, row % 2 ? ODD_ROW : EVEN_ROW);
    for (int k = 0; k < 3; k++)
        around[k] = means_at(job, worker, row + (k - 1) * E3D_OCCLUSION_CELL);
    if (!is_known)
        job->kernels->occlusion_wide_down(job->plan, around, out.share);
    return out;
}

/* Writes row y of the picture, from the row of sites at or above it and that below; where they are NULL, all light arrives. */
static void write_row(const occlusion_job *job, int worker, int32_t y, const e3d_occlusion_sites *rows)
{
    int32_t width = job->plan->picture->width;
    float *row = job->visibility + (size_t)y * (size_t)width, *out = is_whole(job) ? row : own_row(job, worker, RESULT);
    for (int32_t x = 0; x < width && !rows; x++)
        row[x] = 1.0f;
    if (rows)
        job->kernels->occlusion_spread(job->plan, rows, depths_of(job, worker, y), y % E3D_OCCLUSION_STEP, out);
    if (rows && out != row)
        memcpy(row, out, (size_t)width * sizeof *row);
}

/* Filters the means of a band of rows of sites down the columns, and writes its pixels. */
static void filter(const occlusion_job *job, int worker, int32_t first, int32_t end)
{
    int32_t known = first - 1; /* the last row that is filtered */
    for (int32_t row = first; row < end; row++) {
        int is_hidden = has_some_in(job, row - FARTHEST, row + 1 + FARTHEST);
        e3d_occlusion_sites rows[2];
        for (int k = 0; k < 2 && is_hidden; k++) {
            rows[k] = filtered(job, worker, row + k, row + k <= known);
            known = row + k;
        }
        for (int32_t y = row * E3D_OCCLUSION_STEP; y < (row + 1) * E3D_OCCLUSION_STEP && y < job->plan->picture->height; y++)
            write_row(job, worker, y, is_hidden ? rows : NULL);
    }
}

static void each_band(occlusion_job *job, int worker, void (*pass)(const occlusion_job *, int, int32_t, int32_t))
{
    int32_t height = job->plan->height;
    for (int band = atomic_fetch_add(&job->next, 1); band * BAND < height; band = atomic_fetch_add(&job->next, 1)) {
        int32_t end = (band + 1) * BAND;
        pass(job, worker, band * BAND, end < height ? end : height);
    }
}

static void find_some_sites(void *job, int worker) { each_band(job, worker, find_sites); }

static void find_some_shares(void *job, int worker) { each_band(job, worker, find_shares); }

static void find_some_means(void *job, int worker) { each_band(job, worker, find_means); }

static void filter_some(void *job, int worker) { each_band(job, worker, filter); }

/* ---- the entry ---- */

static int is_size(int32_t width, int32_t height) { return width >= 1 && height >= 1 && width <= E3D_MAX_SIZE && height <= E3D_MAX_SIZE; }

size_t e3d_occlusion_scratch(int32_t width, int32_t height)
{
    return is_size(width, height) ? SITE_KINDS * (size_t)sites_of(height) * pitch_of(sites_of(width)) : 0;
}

static int is_valid(const e3d_depth_picture *p, float radius)
{
    if (!is_size(p->width, p->height) || !p->depth || !p->normal)
        return 0;
    return p->across[0] != 0.0f && p->down[0] != 0.0f && radius > 0.0f;
}

static e3d_status find(const e3d_kernels *kernels, int32_t threads, const e3d_depth_picture *picture, float radius, float *scratch,
                       float *visibility)
{
    static void (*const passes[])(void *, int) = {find_some_sites, find_some_shares, find_some_means, filter_some};
    e3d_occlusion_plan plan;
    occlusion_job job = {.kernels = kernels, .plan = &plan, .scratch = scratch, .visibility = visibility};
    fill_plan(picture, radius, scratch, &plan);
    job.own_pitch = E3D_OCCLUSION_STEP * (size_t)plan.pitch;
    job.own = calloc((size_t)threads * OWN_KINDS * job.own_pitch, sizeof *job.own);
    job.some = calloc((size_t)plan.height, sizeof *job.some);
    int has_memory = job.own && job.some;
    for (size_t k = 0; k < sizeof passes / sizeof *passes && has_memory; k++) {
        atomic_store(&job.next, 0);
        e3d_pool_run(threads, passes[k], &job);
    }
    free(job.own);
    free(job.some);
    return has_memory ? E3D_OK : E3D_OUT_OF_MEMORY;
}

e3d_status e3d_find_occlusion(e3d_backend backend, int32_t threads, const e3d_depth_picture *picture, float radius, float *scratch,
                              float *visibility)
{
    if (!is_valid(picture, radius))
        return E3D_INVALID_ARGUMENT;
    if (backend == E3D_BACKEND_SCALAR)
        return e3d_reference_occlusion(picture, radius, visibility);
    const e3d_kernels *kernels = e3d_kernels_for(backend);
    if (!kernels)
        return E3D_UNSUPPORTED_BACKEND;
    threads = threads > 0 ? threads : e3d_thread_count();
    e3d_fpenv saved = e3d_fpenv_enter();
    e3d_status status = find(kernels, threads < E3D_MAX_THREADS ? threads : E3D_MAX_THREADS, picture, radius, scratch, visibility);
    e3d_fpenv_leave(saved);
    return status;
}
