/* The windows of the ranges of soft lights: how far from a sample which of them reach. */
#pragma once

#include "e3d.h"

enum { E3D_SOFT_WINDOWS = 4 };

/* How many blocks to each side of a sample's own block window n reaches; all that may hide any light is within the last one. */
static inline int32_t e3d_soft_blocks(int32_t taps, int32_t step, float widest, int n)
{
    int32_t least = (step * (taps - 1) + 512 + 1023) / 1024; /* blocks of two texels in the least radius of R226 */
    const int32_t blocks[E3D_SOFT_WINDOWS] = {least, 2 * least, 8 * least, (int32_t)(1.16f * widest) / 2 + 1};
    return blocks[n];
}
