/* Loads numbers from scattered places, and channels of pixels, by single loads and shuffles (SSE4.1 and up): the words
 * v_quads8, v_rows16, v_rgba and v_curve_rgba are made of these. Gathers are seldom faster, and much slower on some
 * processors. */
#pragma once

#include <immintrin.h>
#include <stdint.h>
#include <string.h>

enum { PAIRS_EVEN = _MM_SHUFFLE(2, 0, 2, 0), PAIRS_ODD = _MM_SHUFFLE(3, 1, 3, 1) };

/* Loads two indices, which are not negative, at once: a core has fewer units for loads than for arithmetic. */
static inline uint64_t index_two(const int32_t *at)
{
    uint64_t two;
    memcpy(&two, at, sizeof two);
    return two;
}
static inline uint64_t index_first(uint64_t two) { return (uint32_t)two; }
static inline uint64_t index_second(uint64_t two) { return two >> 32; }

static inline __m128i fetch_four(const int32_t *table, const int32_t *at)
{
    uint64_t low = index_two(at), high = index_two(at + 2);
    return _mm_setr_epi32(table[index_first(low)], table[index_second(low)], table[index_first(high)], table[index_second(high)]);
}

/* Loads two neighbouring floats of each of four lanes. */
static inline void floats_four(const float *base, const int32_t *at, __m128 *first, __m128 *second)
{
    uint64_t low = index_two(at), high = index_two(at + 2);
    __m128 a = _mm_loadl_pi(_mm_setzero_ps(), (const __m64 *)(base + index_first(low)));
    __m128 b = _mm_loadl_pi(_mm_setzero_ps(), (const __m64 *)(base + index_first(high)));
    a = _mm_loadh_pi(a, (const __m64 *)(base + index_second(low)));
    b = _mm_loadh_pi(b, (const __m64 *)(base + index_second(high)));
    *first = _mm_shuffle_ps(a, b, PAIRS_EVEN);
    *second = _mm_shuffle_ps(a, b, PAIRS_ODD);
}

/* Compares four floats from `at` on, and the fours below them in rows `pitch` floats apart, with a number: a bit each, set if
 * the float is no less. */
static inline int32_t floats_sixteen(const float *at, intptr_t pitch, float least)
{
    __m128 least4 = _mm_set1_ps(least), row[4];
    for (int r = 0; r < 4; r++)
        row[r] = _mm_cmpge_ps(_mm_loadu_ps(at + r * pitch), least4);
    __m128i upper = _mm_packs_epi32(_mm_castps_si128(row[0]), _mm_castps_si128(row[1]));
    __m128i lower = _mm_packs_epi32(_mm_castps_si128(row[2]), _mm_castps_si128(row[3]));
    return _mm_movemask_epi8(_mm_packs_epi16(upper, lower));
}

/* The shuffle of two pairs of pixels, of the upper and the lower row, that makes each channel's bytes neighbours. */
static inline __m128i pairs_quad(void)
{
    return _mm_setr_epi8(0, 8, 4, 12, 1, 9, 5, 13, 2, 10, 6, 14, 3, 11, 7, 15);
}

/* The shuffle of each channel's bytes to four pixels. */
static inline __m128i pairs_pixels(void)
{
    return _mm_setr_epi8(0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15);
}

/* The shuffle that moves the upper bytes of each lane's two words to its byte `at`; where that is 0, to bytes 0 and 1. */
static inline __m128i pairs_second(int at)
{
    return at == 0 ? _mm_setr_epi8(1, 3, -1, -1, 5, 7, -1, -1, 9, 11, -1, -1, 13, 15, -1, -1)
                   : _mm_setr_epi8(-1, -1, 1, -1, -1, -1, 5, -1, -1, -1, 9, -1, -1, -1, 13, -1);
}

/* Loads a pair of 4-byte texels, and the two after it. */
static inline __m128i pairs_eight(const void *texels, int32_t at)
{
    return _mm_loadu_si128((const __m128i *)((const char *)texels + 4 * (intptr_t)at));
}

/* Loads a pair of 8-byte texels. */
static inline __m128i pairs_one(const void *texels, uint64_t at)
{
    return _mm_loadu_si128((const __m128i *)((const char *)texels + 8 * at));
}

/* The shuffle of such a pair that makes left and right of each channel neighbours. */
static inline __m128i pairs_halves(void)
{
    return _mm_setr_epi8(0, 1, 8, 9, 2, 3, 10, 11, 4, 5, 12, 13, 6, 7, 14, 15);
}
