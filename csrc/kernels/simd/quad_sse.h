/* Words for one texel at a time: four 16-bit channels in, four 32-bit ones out (SSE4.1 and up).
 *
 * Processors with slow gathers fetch a texel's channels faster as one 64-bit load.
 */
#ifndef E3D_QUAD_SSE_H
#define E3D_QUAD_SSE_H

#include <smmintrin.h>
#include <stdint.h>

#define V_QUADS 1

/* left * (256 - f) + right * f for each channel; weights is (256 - f) | f << 16. The products are of signed
 * 16 bits: channels are shifted by 32768 down before, and 256 * 32768 up after. */
static inline __m128i quad_blend(const uint16_t *texels, int32_t left, int32_t right, int32_t weights)
{
    __m128i a = _mm_loadl_epi64((const __m128i *)(texels + 4 * (intptr_t)left));
    __m128i b = _mm_loadl_epi64((const __m128i *)(texels + 4 * (intptr_t)right));
    __m128i both = _mm_xor_si128(_mm_unpacklo_epi16(a, b), _mm_set1_epi16((short)0x8000));
    return _mm_add_epi32(_mm_madd_epi16(both, _mm_set1_epi32(weights)), _mm_set1_epi32(256 * 32768));
}

/* (upper * (256 - f) + lower * f + 32768) >> 16, unsigned. */
static inline __m128i quad_mix(__m128i upper, __m128i lower, int32_t weight)
{
    __m128i sum = _mm_add_epi32(_mm_mullo_epi32(upper, _mm_set1_epi32(256 - weight)),
                                _mm_mullo_epi32(lower, _mm_set1_epi32(weight)));
    return _mm_srli_epi32(_mm_add_epi32(sum, _mm_set1_epi32(32768)), 16);
}

/* Four texels to three planes of four. */
static inline void quad_store(const __m128i q[4], int32_t *red, int32_t *green, int32_t *blue)
{
    __m128i low01 = _mm_unpacklo_epi32(q[0], q[1]), low23 = _mm_unpacklo_epi32(q[2], q[3]);
    __m128i high01 = _mm_unpackhi_epi32(q[0], q[1]), high23 = _mm_unpackhi_epi32(q[2], q[3]);
    _mm_storeu_si128((__m128i *)red, _mm_unpacklo_epi64(low01, low23));
    _mm_storeu_si128((__m128i *)green, _mm_unpackhi_epi64(low01, low23));
    _mm_storeu_si128((__m128i *)blue, _mm_unpacklo_epi64(high01, high23));
}

#endif
