/* Chosen lanes of four, side by side (SSE4.1 and up): what the word v_pack is made of. */
#ifndef E3D_PACK_SSE_H
#define E3D_PACK_SSE_H

#include <smmintrin.h>
#include <stdint.h>
#include <string.h>

#define PACK_LANE(n) 4 * n, 4 * n + 1, 4 * n + 2, 4 * n + 3
#define PACK_ROW(a, b, c, d) {PACK_LANE(a), PACK_LANE(b), PACK_LANE(c), PACK_LANE(d)}

static inline __m128i pack_lanes(__m128i a, uint32_t bits)
{
    static const uint8_t order[16][16] = {
        PACK_ROW(0, 0, 0, 0), PACK_ROW(0, 0, 0, 0), PACK_ROW(1, 0, 0, 0), PACK_ROW(0, 1, 0, 0),
        PACK_ROW(2, 0, 0, 0), PACK_ROW(0, 2, 0, 0), PACK_ROW(1, 2, 0, 0), PACK_ROW(0, 1, 2, 0),
        PACK_ROW(3, 0, 0, 0), PACK_ROW(0, 3, 0, 0), PACK_ROW(1, 3, 0, 0), PACK_ROW(0, 1, 3, 0),
        PACK_ROW(2, 3, 0, 0), PACK_ROW(0, 2, 3, 0), PACK_ROW(1, 2, 3, 0), PACK_ROW(0, 1, 2, 3)};
    return _mm_shuffle_epi8(a, _mm_loadu_si128((const __m128i *)order[bits]));
}

/* Counts the bits of a nibble: SSE4.1 has no popcnt. */
static inline int pack_count(uint32_t bits) { return (int)(0x4332322132212110ull >> (4 * bits) & 7); }

/* The lanes whose bits are set; returns how many. All sixteen bytes are written. */
static inline int pack_four(void *out, __m128i a, uint32_t bits)
{
    _mm_storeu_si128((__m128i *)out, pack_lanes(a, bits));
    return pack_count(bits);
}

/* The same, of numbers below 256 to bytes, of which four are written. */
static inline int pack_bytes(uint8_t *out, __m128i a, uint32_t bits)
{
    int32_t four = _mm_cvtsi128_si32(_mm_shuffle_epi8(pack_lanes(a, bits), _mm_set1_epi32(0x0C080400)));
    memcpy(out, &four, 4);
    return pack_count(bits);
}

/* The same, of numbers below 65536 to halves of words. */
static inline int pack_halves(uint16_t *out, __m128i a, uint32_t bits)
{
    __m128i four = pack_lanes(a, bits);
    _mm_storel_epi64((__m128i *)out, _mm_packus_epi32(four, four));
    return pack_count(bits);
}

#endif
