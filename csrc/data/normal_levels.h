/* The levels of textures that hold normals: how far these spread within a texel (R192). */
#pragma once

#include <stddef.h>
#include <stdint.h>

/* Sets the fourth channel of `width` texels of a coarser level, each from two neighbours of `top` and two of `bottom`, which are
 * `next` bytes apart. Texels have four channels of 15 bits. */
void e3d_spread_row(const uint8_t *top, const uint8_t *bottom, int32_t width, size_t next, uint8_t *out);
