/* The ranges of a shadow map: the least and the greatest depth that comparisons may read.
 * In: depths of a map, the number of comparisons and the distance between them. Out: a word for each block of 2 x 2 texels
 * (shadow_ranges.h). */
#include <stdlib.h>

#include "data/shadow_maps/shadow_ranges.h"
#include "e3d.h"

enum { BLOCK = 1 << E3D_SHADOW_BLOCK_SHIFT };

int32_t e3d_shadow_ranges_side(int32_t size) { return (size + BLOCK - 1) / BLOCK; }

static int16_t code_of(float depth)
{
    return depth == depth ? e3d_shadow_code(depth) : E3D_SHADOW_CODE_NONE;
}

static void find_codes(const float *depths, int32_t count, int16_t *codes)
{
    for (int32_t i = 0; i < count; i++)
        codes[i] = code_of(depths[i]);
}

static void widen(const int16_t *codes, int32_t count, int16_t *least, int16_t *greatest)
{
    for (int32_t i = 0; i < count; i++) {
        least[i] = codes[i] < least[i] ? codes[i] : least[i];
        greatest[i] = codes[i] > greatest[i] ? codes[i] : greatest[i];
    }
}

static void clear(int32_t count, int16_t *least, int16_t *greatest)
{
    for (int32_t i = 0; i < count; i++) {
        least[i] = E3D_SHADOW_CODE_LIMIT;
        greatest[i] = E3D_SHADOW_CODE_NONE;
    }
}

/* Finds the words of a row of blocks from the columns' least and greatest codes; `reach` columns behind a block's first one
 * count, too. */
static void join_columns(const int16_t *least, const int16_t *greatest, int32_t side, int32_t reach, uint32_t *words)
{
    for (int32_t b = 0; b < side; b++) {
        int16_t low = least[BLOCK * b], high = greatest[BLOCK * b];
        for (int32_t k = 1; k <= reach; k++) {
            low = least[BLOCK * b + k] < low ? least[BLOCK * b + k] : low;
            high = greatest[BLOCK * b + k] > high ? greatest[BLOCK * b + k] : high;
        }
        words[b] = (uint32_t)(uint16_t)high << 16 | (uint16_t)low;
    }
}

/* The codes of `reach + 1` rows are kept, each row until no block needs it any more. */
static void find_rows(const float *depths, int32_t size, int32_t reach, int16_t *kept, uint32_t *ranges)
{
    int32_t side = e3d_shadow_ranges_side(size), rows = reach + 1, room = size + reach + BLOCK, next = 0;
    int16_t *least = kept + (size_t)rows * (size_t)size, *greatest = least + room;
    for (int32_t b = 0; b < side; b++) {
        int32_t first = BLOCK * b, end = first + rows < size ? first + rows : size;
        for (; next < end; next++)
            find_codes(depths + (size_t)next * (size_t)size, size, kept + (size_t)(next % rows) * (size_t)size);
        clear(room, least, greatest);
        for (int32_t row = first; row < end; row++)
            widen(kept + (size_t)(row % rows) * (size_t)size, size, least, greatest);
        join_columns(least, greatest, side, reach, ranges + (size_t)b * (size_t)side);
    }
}

e3d_status e3d_find_shadow_ranges(const float *depths, int32_t size, int32_t taps, int32_t step, uint32_t *ranges)
{
    /* From the first texel on, comparisons read (255 + across)/256 + 1 others; the first one may be the last one of its block. */
    int32_t across = step * (taps - 1), reach = (255 + across) / 256 + 1 + BLOCK - 1;
    reach = reach < size ? reach : size;
    size_t room = (size_t)size + (size_t)reach + BLOCK;
    int16_t *kept = malloc((((size_t)reach + 1) * (size_t)size + 2 * room) * sizeof *kept);
    if (!kept)
        return E3D_OUT_OF_MEMORY;
    find_rows(depths, size, reach, kept, ranges);
    free(kept);
    return E3D_OK;
}
