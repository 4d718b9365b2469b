/* The levels of textures that hold normals: how far these spread within a texel (R192).
 * In: two rows of a level. Out: the fourth channel of a row of the next coarser level.
 * The mean of unit vectors is the shorter, the more they differ (Toksvig 2005). Half of their variance over the square of their mean
 * says the same to first order, and doesn't take a texel that is a little too short for one whose normals differ. */
#include <string.h>

#include "data/normal_levels.h"

enum { UNIT = 32767,
       TEXEL = 8 };

/* The sums over the finer texels: their squares with what these spread themselves, and the texels. */
typedef struct sums {
    float square, x, y, z;
} sums;

static sums sums_of(const uint8_t *texel)
{
    uint16_t c[4];
    memcpy(c, texel, sizeof c);
    sums out = {.x = (float)(2 * c[0] - UNIT), .y = (float)(2 * c[1] - UNIT), .z = (float)(2 * c[2] - UNIT)};
    out.square = ((out.x * out.x + out.y * out.y) + out.z * out.z) * (1.0f + (float)c[3] * (2.0f / UNIT));
    return out;
}

static sums with(sums a, sums b) { return (sums){a.square + b.square, a.x + b.x, a.y + b.y, a.z + b.z}; }

static uint16_t spread_of(const uint8_t *top, const uint8_t *bottom, size_t next)
{
    sums all = with(with(with(sums_of(top), sums_of(top + next)), sums_of(bottom)), sums_of(bottom + next));
    float mean = (all.x * all.x + all.y * all.y) + all.z * all.z, spread = (4.0f * all.square - mean) / (2.0f * mean);
    if (!(spread < 1.0f))
        return UNIT;
    return spread > 0.0f ? (uint16_t)(spread * UNIT + 0.5f) : 0;
}

void e3d_spread_row(const uint8_t *top, const uint8_t *bottom, int32_t width, size_t next, uint8_t *out)
{
    for (int32_t x = 0; x < width; x++, top += 2 * TEXEL, bottom += 2 * TEXEL, out += TEXEL) {
        uint16_t spread = spread_of(top, bottom, next);
        memcpy(out + 6, &spread, sizeof spread);
    }
}
