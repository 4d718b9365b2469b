/* Shuffles of bytes (SSE4.1, NEON) that move chosen lanes of four to the front. */
#pragma once

#include <stdint.h>

#define PACK_LANE(n) 4 * n, 4 * n + 1, 4 * n + 2, 4 * n + 3
#define PACK_ROW(a, b, c, d) {PACK_LANE(a), PACK_LANE(b), PACK_LANE(c), PACK_LANE(d)}

/* indexed by the lanes' bits */
static const uint8_t pack_order[16][16] = {
    PACK_ROW(0, 0, 0, 0), PACK_ROW(0, 0, 0, 0), PACK_ROW(1, 0, 0, 0), PACK_ROW(0, 1, 0, 0),
    PACK_ROW(2, 0, 0, 0), PACK_ROW(0, 2, 0, 0), PACK_ROW(1, 2, 0, 0), PACK_ROW(0, 1, 2, 0),
    PACK_ROW(3, 0, 0, 0), PACK_ROW(0, 3, 0, 0), PACK_ROW(1, 3, 0, 0), PACK_ROW(0, 1, 3, 0),
    PACK_ROW(2, 3, 0, 0), PACK_ROW(0, 2, 3, 0), PACK_ROW(1, 2, 3, 0), PACK_ROW(0, 1, 2, 3)};

/* Counts the bits of a nibble: SSE4.1 has no popcnt, and AArch64 counts bits in vectors only. */
static inline int pack_count(uint32_t bits) { return (int)(0x4332322132212110ull >> (4 * bits) & 7); }
