/* The ranges of a soft light's map: the least depths around each block of 2 x 2 texels, in windows from small to as wide as a
 * lookup can be.
 * In: depths of a map, and the radii of lookups. Out: two words for each block: the codes (shadow_ranges.h) of four windows. */
#include "data/shadow_maps/soft_ranges.h"

#include <stdlib.h>
#include <string.h>

#include "data/shadow_maps/shadow_ranges.h"

/* The least code of each block. */
static void find_blocks(const float *depths, int32_t size, int32_t side, int16_t *blocks)
{
    for (int32_t i = 0; i < side * side; i++)
        blocks[i] = E3D_SHADOW_CODE_LIMIT;
    for (int32_t row = 0; row < size; row++)
        for (int32_t column = 0; column < size; column++) {
            int16_t code = e3d_shadow_code(depths[(size_t)row * (size_t)size + (size_t)column]);
            int16_t *block = &blocks[(row >> E3D_SHADOW_BLOCK_SHIFT) * side + (column >> E3D_SHADOW_BLOCK_SHIFT)];
            *block = code < *block ? code : *block;
        }
}

/* Lowers each of the first `count - ahead` items, of `width` codes each, to the one that far ahead of it. */
static void lower(int16_t *items, int32_t count, int32_t width, int32_t ahead)
{
    for (int32_t i = 0; i < (count - ahead) * width; i++) {
        int16_t other = items[i + ahead * width];
        items[i] = other < items[i] ? other : items[i];
    }
}

/* Lowers each item to the least of those up to `reach` items away, and at the begin to some more. */
static void widen(int16_t *items, int32_t count, int32_t width, int32_t reach)
{
    int32_t within = 1, all = 2 * reach + 1;
    for (; 2 * within <= all; within *= 2)
        lower(items, count, width, within);
    lower(items, count, width, all - within);
    for (int32_t i = count - 1; i > 0; i--)
        memmove(items + i * width, items + (i > reach ? i - reach : 0) * width, (size_t)width * sizeof *items);
}

e3d_status e3d_find_soft_ranges(const float *depths, int32_t size, int32_t taps, int32_t step, float widest, uint32_t *ranges)
{
    int32_t side = e3d_shadow_ranges_side(size), count = side * side;
    int16_t *blocks = malloc(2 * (size_t)count * sizeof *blocks);
    if (!blocks)
        return E3D_OUT_OF_MEMORY;
    int16_t *window = blocks + count;
    find_blocks(depths, size, side, blocks);
    for (int n = 0; n < E3D_SOFT_WINDOWS; n++) {
        int32_t reach = e3d_soft_blocks(taps, step, widest, n);
        memcpy(window, blocks, (size_t)count * sizeof *window);
        widen(window, side, side, reach < side ? reach : side);
        for (int32_t row = 0; row < side; row++)
            widen(window + row * side, side, 1, reach < side ? reach : side);
        uint32_t *words = ranges + (size_t)(n / 2) * (size_t)count;
        for (int32_t i = 0; i < count; i++)
            words[i] = n & 1 ? words[i] | (uint32_t)(uint16_t)window[i] << 16 : (uint16_t)window[i];
    }
    free(blocks);
    return E3D_OK;
}
