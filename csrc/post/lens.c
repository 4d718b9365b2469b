/* Lens: the colours of a lens's picture, filtered from the pinhole pictures around it (docs/exactness, R204, R205).
 *
 * In: RGBA of the faces, and where each pixel looks. Out: RGBA. Bytes become 16-bit light, a tent as wide as the pixel's
 * footprint weighs it, and the mean becomes a byte again. Each channel is summed by itself, in one order.
 */
#include "e3d_lens.h"

#include <string.h>

#include "base/fpenv.h"
#include "base/pool.h"
#include "data/lens_filter.h"
#include "data/srgb_tables.h"
#include "kernels/kernels.h"
#include "reference/reference.h"

enum { BAND = 16,      /* rows of a task */
       PART = 16384 }; /* pixels of a task */

typedef struct lens_job {
    const e3d_kernels *kernels;
    const e3d_lens_colors *colors;
} lens_job;

void e3d_lens_codes_fill(e3d_lens_codes *codes, int is_srgb)
{
    e3d_fpenv saved = e3d_fpenv_enter();
    for (int c = 0; c < 256; c++)
        codes->light[c] = is_srgb ? SRGB_TO_LINEAR16[c] : (uint16_t)(c * 257);
    for (int v = 0, c = 0; v <= E3D_LENS_FULL; v++) {
        if (is_srgb)
            while (c < 255 && (float)v * (1.0f / E3D_LENS_FULL) >= SRGB_THRESHOLDS[c])
                c++;
        codes->code[v] = (uint8_t)(is_srgb ? c : (v * 255 + E3D_LENS_FULL / 2) / E3D_LENS_FULL);
    }
    for (int c = 0; c < 256; c++) /* a byte that is not mixed with others stays as it is */
        codes->code[codes->light[c]] = (uint8_t)c;
    e3d_fpenv_leave(saved);
}

static void decode_band(void *argument, int band)
{
    const e3d_lens_colors *all = ((const lens_job *)argument)->colors;
    const uint16_t *light = all->codes->light;
    int64_t first = (int64_t)band * PART, last = first + PART < all->total ? first + PART : all->total;
    for (int64_t i = first; i < last; i++) {
        const uint8_t *c = all->from + 4 * i;
        uint16_t *to = all->light + 4 * i;
        uint32_t opaque = c[3];
        for (int k = 0; k < 3; k++)
            to[k] = opaque == 255 ? light[c[k]] : (uint16_t)((light[c[k]] * opaque + 127) / 255);
        to[3] = (uint16_t)(opaque * 257);
    }
}

static uint8_t code_of(const e3d_lens_colors *all, float light)
{
    int32_t v = (int32_t)(light + 0.5f);
    return all->codes->code[v < E3D_LENS_FULL ? v : E3D_LENS_FULL];
}

/* Writes a pixel by its mean light, which is times alpha, and alpha (R205). */
static void write_pixel(const e3d_lens_colors *all, size_t i, float mean[4])
{
    uint8_t *to = all->to + 4 * i;
    int32_t opaque = (int32_t)(mean[3] + 0.5f);
    if (opaque < E3D_LENS_FULL && all->behind) {
        float open = 1.0f - mean[3] * (1.0f / E3D_LENS_FULL);
        for (int k = 0; k < 3; k++)
            mean[k] = mean[k] + open * (float)all->codes->light[all->behind[4 * i + (size_t)k]];
        opaque = E3D_LENS_FULL;
    } else if (opaque < E3D_LENS_FULL) {
        float share = opaque > 0 ? (float)E3D_LENS_FULL / mean[3] : 0;
        for (int k = 0; k < 3; k++)
            mean[k] = mean[k] * share;
    }
    for (int k = 0; k < 3; k++)
        to[k] = code_of(all, mean[k]);
    to[3] = (uint8_t)((opaque * 255 + E3D_LENS_FULL / 2) / E3D_LENS_FULL);
}

/* Pixels that wait to be filtered together. */
typedef struct waiting {
    e3d_lens_batch batch;
    size_t pixel[E3D_LENS_BATCH];
} waiting;

static void add_pixel(waiting *w, int n, const e3d_lens_pixel *p, const e3d_lens_face *face)
{
    e3d_lens_batch *batch = &w->batch;
    batch->x[n] = p->x;
    batch->y[n] = p->y;
    batch->across[n] = p->across;
    batch->down[n] = p->down;
    batch->start[n] = (int32_t)face->start;
    batch->width[n] = face->width;
    batch->height[n] = face->height;
}

static void draw_waiting(const lens_job *job, waiting *w)
{
    const e3d_lens_colors *all = job->colors;
    e3d_lens_batch *batch = &w->batch;
    if (!batch->count)
        return;
    const e3d_lens_pixel *last = all->pixels + w->pixel[batch->count - 1];
    for (int n = batch->count; n < batch->count + E3D_PAD && n < E3D_LENS_BATCH + E3D_PAD; n++)
        add_pixel(w, n, last, all->faces + last->face);
    job->kernels->lens(all->light, batch);
    for (int n = 0; n < batch->count; n++) {
        float mean[4] = {batch->light[0][n], batch->light[1][n], batch->light[2][n], batch->light[3][n]};
        write_pixel(all, w->pixel[n], mean);
    }
    batch->count = 0;
}

static void draw_band(void *argument, int band)
{
    const lens_job *job = argument;
    const e3d_lens_colors *all = job->colors;
    size_t first = (size_t)band * BAND * (size_t)all->width, last = first + BAND * (size_t)all->width;
    size_t end = (size_t)all->height * (size_t)all->width;
    waiting w;
    e3d_fpenv saved = e3d_fpenv_enter();
    w.batch.count = 0;
    for (size_t i = first; i < (last < end ? last : end); i++) {
        const e3d_lens_pixel *p = all->pixels + i;
        if (p->face < 0) {
            memcpy(all->to + 4 * i, all->outside, 4);
            continue;
        }
        w.pixel[w.batch.count] = i;
        add_pixel(&w, w.batch.count, p, all->faces + p->face);
        if (++w.batch.count == E3D_LENS_BATCH)
            draw_waiting(job, &w);
    }
    draw_waiting(job, &w);
    e3d_fpenv_leave(saved);
}

e3d_status e3d_lens_draw(const e3d_lens_colors *colors, e3d_backend backend, int threads)
{
    if (backend == E3D_BACKEND_SCALAR) {
        e3d_reference_lens(colors);
        return E3D_OK;
    }
    lens_job job = {.kernels = e3d_kernels_for(backend), .colors = colors};
    if (!job.kernels)
        return E3D_UNSUPPORTED_BACKEND;
    e3d_pool_share(threads, (int)((colors->total + PART - 1) / PART), decode_band, &job);
    e3d_pool_share(threads, (colors->height + BAND - 1) / BAND, draw_band, &job);
    return E3D_OK;
}
