/* Copies a picture into a window's memory.
 *
 * In:  RGBA or BGRA pixels, and memory of as many pixels that shows the picture before.
 * Out: that memory, and which of its rows are other ones now. A part of a row that stays is not written.
 */
#include "e3d_window.h"

#include <stdbool.h>
#include <string.h>

/* Pixels compared at once: their bytes stay in the first cache. */
#define PART 256

/* Machines are little-endian: the first byte is the lowest. */
static inline uint32_t word_at(const uint8_t *bytes, int32_t index)
{
    uint32_t word;
    memcpy(&word, bytes + 4 * (size_t)index, sizeof word);
    return word;
}

static inline uint32_t swap_red_and_blue(uint32_t word)
{
    return (word & 0x0000FF00u) | (word >> 16 & 0xFFu) | (word & 0xFFu) << 16;
}

/* Copies at most PART pixels; returns whether they were others. Alpha 255 makes them opaque. */
static bool copy_part(const uint8_t *from, uint8_t *to, int32_t count, bool is_swapped)
{
    uint32_t words[PART], difference = 0;
    /* Two loops, so that the compiler makes vectors of either. */
    if (is_swapped) {
        for (int32_t k = 0; k < count; k++) {
            words[k] = swap_red_and_blue(word_at(from, k)) | 0xFF000000u;
            difference |= words[k] ^ word_at(to, k);
        }
    } else {
        for (int32_t k = 0; k < count; k++) {
            words[k] = word_at(from, k) | 0xFF000000u;
            difference |= words[k] ^ word_at(to, k);
        }
    }
    if (difference != 0) {
        memcpy(to, words, 4 * (size_t)count);
    }
    return difference != 0;
}

static bool copy_row(const uint8_t *from, uint8_t *to, int32_t width, bool is_swapped)
{
    bool is_changed = false;
    for (int32_t start = 0; start < width; start += PART) {
        const int32_t count = width - start < PART ? width - start : PART;
        is_changed |= copy_part(from + 4 * (size_t)start, to + 4 * (size_t)start, count, is_swapped);
    }
    return is_changed;
}

void e3d_window_copy(const uint8_t *pixels, ptrdiff_t stride, uint8_t *shown, ptrdiff_t shown_stride, int32_t width,
                     int32_t height, int is_swapped, uint8_t *changed)
{
    for (int32_t row = 0; row < height; row++) {
        changed[row] = copy_row(pixels + row * stride, shown + row * shown_stride, width, is_swapped);
    }
}
