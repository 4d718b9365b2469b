/* Packs chosen lanes of four (SSE4.1 and up), for the word v_pack. */
#pragma once

#include <smmintrin.h>
#include <stdint.h>
#include <string.h>

#include "kernels/simd/pack_order.h"

static inline __m128i pack_lanes(__m128i a, uint32_t bits)
{
    return _mm_shuffle_epi8(a, _mm_loadu_si128((const __m128i *)pack_order[bits]));
}

/* Writes the lanes whose bits are set, packed; returns how many. All sixteen bytes are written. */
static inline int pack_four(void *out, __m128i a, uint32_t bits)
{
    _mm_storeu_si128((__m128i *)out, pack_lanes(a, bits));
    return pack_count(bits);
}

/* The same for numbers below 256, to bytes; four are written. */
static inline int pack_bytes(uint8_t *out, __m128i a, uint32_t bits)
{
    int32_t four = _mm_cvtsi128_si32(_mm_shuffle_epi8(pack_lanes(a, bits), _mm_set1_epi32(0x0C080400)));
    memcpy(out, &four, 4);
    return pack_count(bits);
}

/* The same for numbers below 65536, to halves of words. */
static inline int pack_halves(uint16_t *out, __m128i a, uint32_t bits)
{
    __m128i four = pack_lanes(a, bits);
    _mm_storel_epi64((__m128i *)out, _mm_packus_epi32(four, four));
    return pack_count(bits);
}
