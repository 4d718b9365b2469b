/* Lens: the colours of a lens's picture, filtered from the pinhole pictures around it (docs/exactness, R204, R205).
 *
 * In: RGBA of the faces, and where each pixel looks. Out: RGBA. Bytes become 16-bit light, a tent as wide as the pixel's
 * footprint weighs it, and the mean becomes a byte again. Each channel is summed by itself, in one order.
 */
#include "e3d_lens.h"

#include <string.h>

#include "base/fpenv.h"
#include "base/pool.h"
#include "data/srgb_tables.h"

enum { ONE = 256, /* a face's pixel */
       BAND = 16, /* rows of a task */
       PART = 16384, /* pixels of a task */
       NARROW = 384, /* half the widest tent that has at most three taps */
       MOST_HALF = 32, /* pixels: half the widest filter */
       FULL = 65535 };

void e3d_lens_codes_fill(e3d_lens_codes *codes, int is_srgb)
{
    for (int c = 0; c < 256; c++)
        codes->light[c] = is_srgb ? SRGB_TO_LINEAR16[c] : (uint16_t)(c * 257);
    for (int v = 0, c = 0; v <= FULL; v++) {
        if (is_srgb)
            while (c < 255 && (float)v * (1.0f / FULL) >= SRGB_THRESHOLDS[c])
                c++;
        codes->code[v] = (uint8_t)(is_srgb ? c : (v * 255 + FULL / 2) / FULL);
    }
    for (int c = 0; c < 256; c++) /* a byte that is not mixed with others stays as it is */
        codes->code[codes->light[c]] = (uint8_t)c;
}

/* Red, green, blue times opacity, and opacity, of one pixel. */
typedef float v4f __attribute__((vector_size(16)));
typedef int32_t v4i __attribute__((vector_size(16)));
typedef uint16_t v4h __attribute__((vector_size(8)));

static void decode_band(void *argument, int band)
{
    const e3d_lens_colors *all = argument;
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

/* The taps of a tent along one axis: their weights are those of pixels whose centres lie within half its width. */
typedef struct taps {
    int32_t first, count;
    float sum, weight[2 * MOST_HALF + 2];
} taps;

static void find_taps(taps *t, int32_t at, int32_t half, int32_t side)
{
    /* The centre of pixel i is at 256 i + 128. */
    int32_t first = ((at - half - ONE / 2) >> 8) + 1, last = (at + half - ONE / 2 - 1) >> 8;
    first = first < 0 ? 0 : first > side - 1 ? side - 1
                                             : first;
    last = last < first ? first : last > side - 1 ? side - 1
                                                  : last;
    t->first = first;
    t->count = last - first + 1;
    int32_t sum = 0;
    for (int32_t i = 0; i < t->count; i++) {
        int32_t away = ONE * (first + i) + ONE / 2 - at, weight = half - (away < 0 ? -away : away);
        sum += weight = weight > 0 ? weight : 0;
        t->weight[i] = (float)weight;
    }
    t->sum = (float)sum;
}

static inline v4f light_of(const uint16_t *pixel)
{
    v4h light;
    memcpy(&light, pixel, sizeof light);
    return __builtin_convertvector(__builtin_convertvector(light, v4i), v4f);
}

static v4f wide_mean(const e3d_lens_colors *all, const e3d_lens_pixel *p)
{
    const e3d_lens_face *face = all->faces + p->face;
    taps x, y;
    v4f sum = {0};
    find_taps(&x, p->x, p->across, face->width);
    find_taps(&y, p->y, p->down, face->height);
    const uint16_t *row = all->light + 4 * (face->start + (int64_t)y.first * face->width + x.first);
    for (int32_t j = 0; j < y.count; j++, row += 4 * (int64_t)face->width) {
        v4f part = {0};
        for (int32_t i = 0; i < x.count; i++)
            part = part + light_of(row + 4 * i) * x.weight[i];
        sum = sum + part * y.weight[j];
    }
    float whole = x.sum * y.sum;
    return sum * (whole > 0 ? 1.0f / whole : 0);
}

/* The three weights of a narrow tent, whose first tap is `first`. */
static inline int32_t narrow_taps(int32_t at, int32_t half, int32_t first, float weight[3])
{
    int32_t away = ONE * first + ONE / 2 - at, sum = 0;
    for (int i = 0; i < 3; i++, away += ONE) {
        int32_t w = half - (away < 0 ? -away : away);
        sum += w = w > 0 ? w : 0;
        weight[i] = (float)w;
    }
    return sum;
}

/* The same as wide_mean, where tents have up to three taps: what is added for others is 0. */
static v4f mean_of(const e3d_lens_colors *all, const e3d_lens_pixel *p)
{
    const e3d_lens_face *face = all->faces + p->face;
    int32_t left = ((p->x - p->across - ONE / 2) >> 8) + 1, top = ((p->y - p->down - ONE / 2) >> 8) + 1;
    if (p->across > NARROW || p->down > NARROW || left < 0 || top < 0 || left + 2 >= face->width ||
        top + 2 >= face->height)
        return wide_mean(all, p);
    float x[3], y[3];
    float whole = (float)narrow_taps(p->x, p->across, left, x) * (float)narrow_taps(p->y, p->down, top, y);
    const uint16_t *row = all->light + 4 * (face->start + (int64_t)top * face->width + left);
    v4f sum = {0};
    for (int j = 0; j < 3; j++, row += 4 * (int64_t)face->width)
        sum = sum + ((light_of(row) * x[0] + light_of(row + 4) * x[1]) + light_of(row + 8) * x[2]) * y[j];
    return sum * (1.0f / whole);
}

static uint8_t code_of(const e3d_lens_colors *all, float light)
{
    int32_t v = (int32_t)(light + 0.5f);
    return all->codes->code[v < FULL ? v : FULL];
}

static void draw_pixel(const e3d_lens_colors *all, size_t i)
{
    const e3d_lens_pixel *p = all->pixels + i;
    uint8_t *to = all->to + 4 * i;
    if (p->face < 0) {
        memcpy(to, all->outside, 4);
        return;
    }
    v4f mean = mean_of(all, p);
    int32_t opaque = (int32_t)(mean[3] + 0.5f);
    if (opaque < FULL && all->behind) {
        float open = 1.0f - mean[3] * (1.0f / FULL);
        for (int k = 0; k < 3; k++)
            mean[k] = mean[k] + open * (float)all->codes->light[all->behind[4 * i + (size_t)k]];
        opaque = FULL;
    } else if (opaque < FULL) {
        mean = mean * (opaque > 0 ? (float)FULL / mean[3] : 0);
    }
    for (int k = 0; k < 3; k++)
        to[k] = code_of(all, mean[k]);
    to[3] = (uint8_t)((opaque * 255 + FULL / 2) / FULL);
}

static void draw_band(void *argument, int band)
{
    const e3d_lens_colors *all = argument;
    size_t first = (size_t)band * BAND * (size_t)all->width, last = first + BAND * (size_t)all->width;
    size_t end = (size_t)all->height * (size_t)all->width;
    e3d_fpenv saved = e3d_fpenv_enter();
    for (size_t i = first; i < (last < end ? last : end); i++)
        draw_pixel(all, i);
    e3d_fpenv_leave(saved);
}

void e3d_lens_draw(const e3d_lens_colors *colors, int threads)
{
    void *all = (void *)(uintptr_t)colors;
    e3d_pool_share(threads, (int)((colors->total + PART - 1) / PART), decode_band, all);
    e3d_pool_share(threads, (colors->height + BAND - 1) / BAND, draw_band, all);
}
