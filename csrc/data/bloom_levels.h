/* The levels of a bloom: their number and sizes (R124). */
#pragma once

#include <stdint.h>

enum { E3D_BLOOM_LEVELS = 8,
       E3D_BLOOM_CHANNELS = 3 };

#define E3D_MOST_BLOOM 64.0f /* above 1: brighter pixels glow no more than this */

/* So many levels that the last one is at least eight rows high, so that light spreads over a share of the picture. */
static inline int e3d_bloom_level_count(int32_t height)
{
    int count = 1;
    while (count < E3D_BLOOM_LEVELS && (INT32_C(8) << (count + 1)) <= height)
        count++;
    return count;
}

/* A side of level n; the picture itself is level -1. */
static inline int32_t e3d_bloom_side(int32_t side, int level)
{
    for (; level >= 0; level--)
        side = (side + 1) / 2;
    return side;
}
