/* Lens: the colours of a lens's picture, filtered from the pinhole pictures around it (docs/exactness, R204, R205).
 *
 * In: RGBA of the faces, and where each pixel looks. Out: RGBA. Bytes become 16-bit light, a tent as wide as the pixel's
 * footprint weighs it, and the mean becomes a byte again. Each channel is summed by itself, in one order.
 */
#include "e3d_lens.h"

#include <string.h>

#include "base/fpenv.h"
#include "base/pool.h"
#include "base/vectors.h"
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
        uint32_t opaque = c[3];
        uint16_t of[4] = {light[c[0]], light[c[1]], light[c[2]], (uint16_t)(opaque * 257)};
        if (opaque != 255)
            for (int k = 0; k < 3; k++)
                of[k] = (uint16_t)((of[k] * opaque + 127) / 255);
        memcpy(all->light + 4 * i, of, sizeof of);
    }
}

/* Returns the light of a pixel that is not opaque, by its mean light, which is times alpha, and alpha. */
static float4 light_of(const e3d_lens_colors *all, size_t i, const float mean[4], int32_t opaque)
{
    if (!all->behind)
        return load4(mean) * splat(opaque > 0 ? (float)E3D_LENS_FULL / mean[3] : 0);
    const uint8_t *behind = all->behind + 4 * i;
    const uint16_t *light = all->codes->light;
    float4 open = splat(1.0f - mean[3] * (1.0f / E3D_LENS_FULL));
    return load4(mean) + open * (float4){(float)light[behind[0]], (float)light[behind[1]], (float)light[behind[2]], 0};
}

/* Writes a pixel by its mean light, which is times alpha, and alpha (R205). */
static void write_pixel(const e3d_lens_colors *all, size_t i, const float mean[4])
{
    const uint8_t *code = all->codes->code;
    int32_t opaque = (int32_t)(mean[3] + 0.5f), alpha = 255;
    float4 light = load4(mean);
    if (opaque < E3D_LENS_FULL) {
        light = light_of(all, i, mean, opaque);
        alpha = all->behind ? 255 : (opaque * 255 + E3D_LENS_FULL / 2) / E3D_LENS_FULL;
    }
    int4 v = __builtin_convertvector(less_of(light + splat(0.5f), splat(E3D_LENS_FULL)), int4);
    uint8_t rgba[4] = {code[v[0]], code[v[1]], code[v[2]], (uint8_t)alpha};
    memcpy(all->to + 4 * i, rgba, sizeof rgba);
}

/* Returns how many pixels from one on look into the same face, at most those of a batch. */
static int alike(const e3d_lens_pixel *pixels, size_t most)
{
    int count = 1;
    while (count < E3D_LENS_BATCH && (size_t)count < most && pixels[count].face == pixels->face)
        count++;
    return count;
}

static void draw_band(void *argument, int band)
{
    const lens_job *job = argument;
    const e3d_lens_colors *all = job->colors;
    size_t first = (size_t)band * BAND * (size_t)all->width, last = first + BAND * (size_t)all->width;
    size_t end = (size_t)all->height * (size_t)all->width;
    float mean[E3D_LENS_BATCH][4];
    e3d_fpenv saved = e3d_fpenv_enter();
    last = last < end ? last : end;
    for (size_t i = first; i < last;) {
        const e3d_lens_pixel *p = all->pixels + i;
        int count = alike(p, last - i);
        if (p->face >= 0)
            job->kernels->lens(all->light, all->faces + p->face, p, count, mean[0]);
        for (int n = 0; n < count; n++, i++) {
            if (p->face < 0)
                memcpy(all->to + 4 * i, all->outside, 4);
            else
                write_pixel(all, i, mean[n]);
        }
    }
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
