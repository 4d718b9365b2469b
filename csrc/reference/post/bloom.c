/* Bloom: the glow of what is brighter than a screen can show.
 *
 * In:  radiance and colours of a picture. Out: the colours, changed.
 * Rules: R124.
 */
#include <stdlib.h>

#include "data/bloom_levels.h"
#include "base/fpenv.h"
#include "reference/arithmetic.h"
#include "reference/decoding.h"
#include "reference/post/halving.h"
#include "reference/reference.h"
#include "reference/stages.h"

typedef struct bloom_image {
    int32_t width, height;
    float (*pixels)[3];
} bloom_image;

static float at(const bloom_image *image, int32_t x, int32_t y, int c)
{
    x = ref_within(x, image->width);
    y = ref_within(y, image->height);
    return image->pixels[(size_t)y * (size_t)image->width + (size_t)x][c];
}

static float column(const bloom_image *image, int32_t x, int32_t y, int c)
{
    return ref_halve(at(image, x, 2 * y - 1, c), at(image, x, 2 * y, c), at(image, x, 2 * y + 1, c), at(image, x, 2 * y + 2, c));
}

/* A pixel of the next level, half the size. */
static float halved(const bloom_image *image, int32_t x, int32_t y, int c)
{
    return ref_halve(column(image, 2 * x > 0 ? 2 * x - 1 : 0, y, c), column(image, 2 * x, y, c), column(image, 2 * x + 1, y, c),
                     column(image, 2 * x + 2, y, c));
}

static int32_t neighbour(int32_t i) { return i / 2 + (i % 2 ? 1 : -1); }

static float rows_mixed(const bloom_image *image, int32_t x, int32_t y, int c)
{
    return at(image, x, y / 2, c) * 0.75f + at(image, x, neighbour(y), c) * 0.25f;
}

/* A level at pixel (x, y) of the level before, which has twice the size. */
static float doubled(const bloom_image *image, int32_t x, int32_t y, int c)
{
    return rows_mixed(image, x / 2, y, c) * 0.75f + rows_mixed(image, neighbour(x), y, c) * 0.25f;
}

static int make_image(int32_t width, int32_t height, bloom_image *out)
{
    out->width = width;
    out->height = height;
    out->pixels = malloc((size_t)width * (size_t)height * sizeof *out->pixels);
    return out->pixels != NULL;
}

/* R124 */
static void fill_bright(const e3d_bloom *bloom, bloom_image *out)
{
    size_t pixels = (size_t)bloom->width * (size_t)bloom->height;
    for (size_t i = 0; i < pixels; i++)
        for (int c = 0; c < 3; c++)
            out->pixels[i][c] = ref_clamp(bloom->radiance[3 * i + (size_t)c] - 1.0f, 0.0f, E3D_MOST_BLOOM);
}

static void fill_halved(const bloom_image *from, bloom_image *out)
{
    for (int32_t y = 0; y < out->height; y++)
        for (int32_t x = 0; x < out->width; x++)
            for (int c = 0; c < 3; c++)
                out->pixels[(size_t)y * (size_t)out->width + (size_t)x][c] = halved(from, x, y, c);
}

static void add_doubled(const bloom_image *from, bloom_image *out)
{
    for (int32_t y = 0; y < out->height; y++)
        for (int32_t x = 0; x < out->width; x++)
            for (int c = 0; c < 3; c++) {
                float *sum = &out->pixels[(size_t)y * (size_t)out->width + (size_t)x][c];
                *sum = *sum + doubled(from, x, y, c);
            }
}

/* R124 */
static uint8_t glowing(uint8_t code, float glow, int srgb)
{
    float shown = ref_decode(code, srgb);
    float share = glow / (1.0f + glow);
    return ref_encode(ref_clamp(shown + (1.0f - shown) * share, 0.0f, 1.0f), srgb);
}

/* R124 */
static void lay(const e3d_bloom *bloom, const bloom_image *from, float scale)
{
    for (int32_t y = 0; y < bloom->height; y++)
        for (int32_t x = 0; x < bloom->width; x++)
            for (int c = 0; c < 3; c++) {
                uint8_t *code = &bloom->color[4 * ((size_t)y * (size_t)bloom->width + (size_t)x) + (size_t)c];
                *code = glowing(*code, doubled(from, x, y, c) * scale, bloom->srgb);
            }
}

e3d_status e3d_reference_bloom(const e3d_bloom *bloom)
{
    bloom_image images[1 + E3D_BLOOM_LEVELS] = {{0}}; /* the bright picture, and the levels */
    int count = e3d_bloom_level_count(bloom->height), made = 1;
    e3d_fpenv saved = e3d_fpenv_enter();
    for (int n = 0; n <= count; n++)
        made &= make_image(e3d_bloom_side(bloom->width, n - 1), e3d_bloom_side(bloom->height, n - 1), &images[n]);
    if (made) {
        fill_bright(bloom, &images[0]);
        for (int n = 1; n <= count; n++)
            fill_halved(&images[n - 1], &images[n]);
        for (int n = count - 1; n >= 1; n--)
            add_doubled(&images[n + 1], &images[n]);
        lay(bloom, &images[1], bloom->strength * (1.0f / (float)count));
    }
    for (int n = 0; n <= count; n++)
        free(images[n].pixels);
    e3d_fpenv_leave(saved);
    return made ? E3D_OK : E3D_OUT_OF_MEMORY;
}
