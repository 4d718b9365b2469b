/* Pairs of neighbouring texels, a load each (SSE4.1 and up): what the words v_pairs8 and v_pairs16 are made of.
 *
 * Gathers are no faster anywhere, and much slower on some processors.
 */
#ifndef E3D_PAIRS_SSE_H
#define E3D_PAIRS_SSE_H

#include <smmintrin.h>
#include <stdint.h>

enum { PAIRS_EVEN = _MM_SHUFFLE(2, 0, 2, 0), PAIRS_ODD = _MM_SHUFFLE(3, 1, 3, 1) };

/* The pairs of 4-byte texels at at[0] and at[1]. */
static inline __m128 pairs_two(const void *texels, const int32_t *at)
{
    const char *t = (const char *)texels;
    __m128 low = _mm_castsi128_ps(_mm_loadl_epi64((const __m128i *)(t + 4 * (intptr_t)at[0])));
    return _mm_loadh_pi(low, (const __m64 *)(t + 4 * (intptr_t)at[1]));
}

/* A pair of 8-byte texels. */
static inline __m128i pairs_one(const void *texels, int32_t at)
{
    return _mm_loadu_si128((const __m128i *)((const char *)texels + 8 * (intptr_t)at));
}

/* Shuffles such a pair to left and right of each channel side by side. */
static inline __m128i pairs_halves(void)
{
    return _mm_setr_epi8(0, 1, 8, 9, 2, 3, 10, 11, 4, 5, 12, 13, 6, 7, 14, 15);
}

#endif
