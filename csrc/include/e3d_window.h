/* The memory of a window, to which pictures are copied.
 * In: a picture of (height, width) pixels of four bytes, red, green, blue, alpha or blue, green, red, alpha.
 * Out: the window's memory. Nothing is allocated. */
#pragma once

#include <stddef.h>
#include <stdint.h>

/* Copies pixels to `shown`, all opaque, with red and blue swapped or not. `stride` and `shown_stride` are bytes from a row to the
 * one below it. `changed` tells of each row whether `shown` had another colour anywhere. */
void e3d_window_copy(const uint8_t *pixels, ptrdiff_t stride, uint8_t *shown, ptrdiff_t shown_stride, int32_t width,
                     int32_t height, int is_swapped, uint8_t *changed);
