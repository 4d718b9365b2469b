/* The picture behind glass: light and colours of what isn't blended, and its blurred levels.
 *
 * In:  radiance and codes of a picture. Out: the texels of all levels.
 * Rules: R161, R162.
 */
#include "base/fpenv.h"
#include "data/behind_levels.h"
#include "data/tone_tables.h"
#include "reference/arithmetic.h"
#include "reference/decoding.h"
#include "reference/post/halving.h"
#include "reference/reference.h"
#include "reference/stages.h"
#include "reference/surface.h"

/* R161: whether light shows as these codes where it is tone mapped. */
static int shows_as(const e3d_behind *picture, const float light[3], const uint8_t code[3])
{
    float shown[3] = {light[0], light[1], light[2]};
    ref_map_tone(picture->tone_mapping, shown);
    for (int c = 0; c < 3; c++)
        if (ref_encode(ref_clamp(shown[c], 0.0f, 1.0f), picture->srgb) != code[c])
            return 0;
    return 1;
}

/* R161 */
static void find_texel(const e3d_behind *picture, size_t pixel, float texel[4])
{
    const uint8_t *code = picture->color + 4 * pixel;
    for (int c = 0; c < 3; c++)
        texel[c] = ref_clamp(picture->radiance[3 * pixel + (size_t)c], 0.0f, E3D_MOST_LIGHT);
    texel[3] = picture->is_transparent ? code[3] != 0 : shows_as(picture, texel, code);
    for (int c = 0; c < 3 && texel[3] == 0.0f; c++) {
        float decoded = ref_decode(code[c], picture->srgb);
        texel[c] = picture->is_transparent ? 0.0f : decoded;
    }
}

/* R162: column x of a level's rows 2y - 1 to 2y + 2, filtered. */
static float column(const e3d_behind_level *from, const float *texels, int32_t x, int32_t y, int c)
{
    float four[4];
    for (int32_t k = 0; k < 4; k++) {
        int32_t row = ref_within(2 * y - 1 + k, from->height);
        size_t at = (size_t)row * (size_t)from->width + (size_t)ref_within(x, from->width);
        four[k] = texels[4 * at + (size_t)c];
    }
    return ref_halve(four[0], four[1], four[2], four[3]);
}

/* R162 */
static void fill_level(const e3d_behind_level *from, const e3d_behind_level *to, float *levels)
{
    const float *texels = levels + from->first;
    float *out = levels + to->first;
    for (int32_t y = 0; y < to->height; y++)
        for (int32_t x = 0; x < to->width; x++)
            for (int c = 0; c < 4; c++)
                *out++ = ref_halve(column(from, texels, 2 * x - 1, y, c), column(from, texels, 2 * x, y, c),
                                   column(from, texels, 2 * x + 1, y, c), column(from, texels, 2 * x + 2, y, c));
}

void e3d_reference_behind(const e3d_behind *picture, float *levels)
{
    e3d_behind_level level[E3D_BEHIND_LEVELS];
    int count = e3d_behind_levels(picture->width, picture->height, level);
    e3d_fpenv saved = e3d_fpenv_enter();
    for (size_t pixel = 0; pixel < (size_t)picture->width * (size_t)picture->height; pixel++)
        find_texel(picture, pixel, levels + 4 * pixel);
    for (int l = 1; l < count; l++)
        fill_level(&level[l - 1], &level[l], levels);
    e3d_fpenv_leave(saved);
}
