/* Soft shadow: the share of a light that has a size, by the shadow maps that were drawn from its middle.
 * In: the maps of a light, the place of a sample in one of them. Out: the share, from 0 to 1.
 * Rules: R226 (radii, discs), R227 (the search), R228 (the lattice), R229 (the share).
 * Sources: Fernando 2005 (percentage-closer soft shadows); Guennebaud, Barthe and Paulin 2006 (parts of the light). */
#include "reference/shadows/soft_shadow.h"

#include "reference/arithmetic.h"

enum { LEVELS = 5 };

/* R226: a sample's column and row, and the least radius, in 1/256 texel. */
typedef struct sample {
    const e3d_light_maps *shadow;
    const float *map;
    int32_t x, y, least;
    const ref_soft_place *at;
} sample;

/* R227: the sums of parts, and of these times depths. */
typedef struct parts {
    float sum, depths;
} parts;

static float least_of(const e3d_light_maps *shadow) { return (float)(shadow->step * (shadow->taps - 1)) * (1.0f / 512.0f) + 1.0f; }

/* R226 */
static int32_t radius_of(const e3d_light_maps *shadow, float v)
{
    return ref_rint(ref_clamp(v, least_of(shadow), shadow->widest) * 256.0f);
}

/* R226 */
static float disc(int32_t d, float fall) { return ref_clamp(2.0f - (float)d * fall, 0.0f, 1.0f); }

static int32_t at_side(int32_t at, int32_t size)
{
    if (at < 0)
        return 0;
    return at < size ? at : size - 1;
}

static float texel_of(const sample *of, int32_t column, int32_t row)
{
    int32_t size = of->shadow->size;
    return of->map[(size_t)at_side(row, size) * (size_t)size + (size_t)at_side(column, size)];
}

/* R226: the square of a texel's distance. */
static int32_t distance(const sample *of, int32_t column, int32_t row)
{
    int32_t dx = 256 * column + 128 - of->x, dy = 256 * row + 128 - of->y;
    return dx * dx + dy * dy;
}

/* R227: adds a texel of a level. */
static void add_part(const sample *of, int32_t level, int32_t d, float texel, parts *to)
{
    const ref_soft_place *at = of->at;
    float fall = 0x1.8p-20f / (float)(1 << (2 * level)), ring = disc(d, fall) - (level > 0 ? disc(d, 4.0f * fall) : 0.0f);
    if (!(texel < at->depth))
        return;
    float radius = ref_min((at->depth - texel) * (at->spread * 256.0f) + 0.75f * (float)of->least, of->shadow->widest * 256.0f);
    float e = 1.0f / (radius * radius);
    float part = ((ring * disc(d, 1.5f * e)) * e) * (float)(1 << (2 * level));
    if (part > 0.0f) { /* what is not adds nothing, whatever its depth */
        to->sum += part;
        to->depths += part * texel;
    }
}

/* R227 */
static parts search(const sample *of)
{
    const ref_soft_place *at = of->at;
    float most = (at->depth - of->shadow->nearest) * at->spread + least_of(of->shadow);
    parts found = {0.0f, 0.0f};
    for (int32_t level = 0; level < LEVELS; level++) {
        int32_t pitch = 1 << level, reach = 5 * pitch;
        if (level > 0 && !(most >= 0.7f * (float)(2 << level)))
            continue;
        for (int32_t row = (of->y >> 8) - reach; row <= (of->y >> 8) + reach; row++)
            for (int32_t column = (of->x >> 8) - reach; column <= (of->x >> 8) + reach; column++)
                if (((row | column) & (pitch - 1)) == 0)
                    add_part(of, level, distance(of, column, row), texel_of(of, column, row), &found);
    }
    return found;
}

/* R229 */
static int is_before(const sample *of, float texel, int32_t d)
{
    const ref_soft_place *at = of->at;
    float reach = (at->depth - texel) * (at->rise * 256.0f) + (float)of->least;
    return texel < at->depth && reach * reach >= (float)d;
}

/* R228, R229 */
static float share_of(const sample *of, int32_t radius)
{
    int32_t pitch = 1, all = 0, before = 0, reach = (radius + radius / 4) / 256 + 2;
    while (radius > 2048 * pitch)
        pitch *= 2;
    int32_t thin = (int32_t)((float)(2048 * pitch - radius) * (0.25f / (float)pitch));
    float fall = 1.5f / (float)(radius * radius);
    for (int32_t row = (of->y >> 8) - reach; row <= (of->y >> 8) + reach; row++)
        for (int32_t column = (of->x >> 8) - reach; column <= (of->x >> 8) + reach; column++) {
            if ((row | column) & (pitch - 1))
                continue;
            int32_t d = distance(of, column, row), weight = (int32_t)(disc(d, fall) * 256.0f);
            if ((row | column) & pitch)
                weight = (weight * (thin < 256 ? thin : 256)) >> 8;
            all += weight;
            before += is_before(of, texel_of(of, column, row), d) ? weight : 0;
        }
    return (float)(all - before) / (float)all;
}

/* R227-R229 */
float ref_soft_share(const e3d_light_maps *shadow, const float *map, const ref_soft_place *at)
{
    float size = (float)shadow->size;
    sample of = {shadow, map, ref_rint(ref_clamp(at->x, 0.0f, size) * 256.0f), ref_rint(ref_clamp(at->y, 0.0f, size) * 256.0f),
                 radius_of(shadow, 0.0f), at};
    parts found = search(&of);
    if (!(found.sum > 0.0f))
        return 1.0f;
    float share = share_of(&of, radius_of(shadow, (at->depth - found.depths / found.sum) * at->spread));
    return ref_max(share, 1.0f - found.sum * 81920.0f);
}
