/* The colours of a picture through a lens.
 *
 * In:  colours of the pinhole pictures, and where the pixels look in them. Out: the colours of the pixels.
 * Rules: R204, R205.
 */
#include "e3d_lens.h"

#include <string.h>

#include "base/fpenv.h"
#include "reference/reference.h"

/* R204: the light of a channel of the faces' pixel; 3: alpha. */
static float light_at(const e3d_lens_colors *all, int64_t pixel, int c)
{
    const uint8_t *rgba = all->from + 4 * pixel;
    int32_t alpha = rgba[3];
    return c == 3 ? (float)(257 * alpha) : (float)((all->codes->light[rgba[c]] * alpha + 127) / 255);
}

/* R204: the weight of pixel i of a row or column. */
static int32_t weight_of(int32_t i, int32_t at, int32_t half)
{
    int32_t away = 256 * i + 128 - at, weight = half - (away < 0 ? -away : away);
    return weight > 0 ? weight : 0;
}

static int32_t sum_of_weights(int32_t at, int32_t half, int32_t side)
{
    int32_t sum = 0;
    for (int32_t i = 0; i < side; i++)
        sum += weight_of(i, at, half);
    return sum;
}

/* The first pixel whose weight is not 0; `side` if there is none. */
static int32_t first_of(int32_t at, int32_t half, int32_t side)
{
    int32_t i = 0;
    while (i < side && !weight_of(i, at, half))
        i++;
    return i;
}

/* R204 */
static float mean_of(const e3d_lens_colors *all, const e3d_lens_pixel *p, int c)
{
    const e3d_lens_face *face = all->faces + p->face;
    int32_t left = first_of(p->x, p->across, face->width), top = first_of(p->y, p->down, face->height);
    float sum = 0.0f;
    for (int32_t y = top; y < face->height && weight_of(y, p->y, p->down); y++) {
        float row = 0.0f;
        for (int32_t x = left; x < face->width && weight_of(x, p->x, p->across); x++)
            row = row + light_at(all, face->start + (int64_t)y * face->width + x, c) * (float)weight_of(x, p->x, p->across);
        sum = sum + row * (float)weight_of(y, p->y, p->down);
    }
    float whole = (float)sum_of_weights(p->x, p->across, face->width) * (float)sum_of_weights(p->y, p->down, face->height);
    return whole > 0.0f ? sum * (1.0f / whole) : 0.0f;
}

/* R205 */
static void draw_pixel(const e3d_lens_colors *all, size_t i)
{
    uint8_t *to = all->to + 4 * i;
    float mean[4];
    for (int c = 0; c < 4; c++)
        mean[c] = mean_of(all, all->pixels + i, c);
    int32_t alpha = (int32_t)(mean[3] + 0.5f);
    int is_open = alpha < 65535;
    for (int c = 0; c < 3; c++) {
        float light = mean[c];
        if (is_open && all->behind)
            light = light + (1.0f - mean[3] * (1.0f / 65535)) * (float)all->codes->light[all->behind[4 * i + (size_t)c]];
        else if (is_open)
            light = light * (alpha > 0 ? 65535.0f / mean[3] : 0.0f);
        int32_t whole = (int32_t)(light + 0.5f);
        to[c] = all->codes->code[whole < 65535 ? whole : 65535];
    }
    to[3] = is_open && !all->behind ? (uint8_t)((alpha * 255 + 32767) / 65535) : 255;
}

void e3d_reference_lens(const e3d_lens_colors *colors)
{
    e3d_fpenv saved = e3d_fpenv_enter();
    for (size_t i = 0; i < (size_t)colors->width * (size_t)colors->height; i++) {
        if (colors->pixels[i].face < 0)
            memcpy(colors->to + 4 * i, colors->outside, 4);
        else
            draw_pixel(colors, i);
    }
    e3d_fpenv_leave(saved);
}
