/* Words for eight records of eight words at a time (AVX2 and up): columns to rows, and back. */
#pragma once

#include <immintrin.h>
#include <stdint.h>

/* Transposes: lane l of vector c becomes lane c of vector l. */
static inline void rows_turn8(const __m256i c[8], __m256i out[8])
{
    __m256i a[8], b[8];
    for (int i = 0; i < 4; i++) { /* pairs of columns */
        a[2 * i] = _mm256_unpacklo_epi32(c[2 * i], c[2 * i + 1]);
        a[2 * i + 1] = _mm256_unpackhi_epi32(c[2 * i], c[2 * i + 1]);
    }
    for (int i = 0; i < 2; i++) { /* fours: lanes 0 and 4, 1 and 5, 2 and 6, 3 and 7 */
        b[4 * i] = _mm256_unpacklo_epi64(a[4 * i], a[4 * i + 2]);
        b[4 * i + 1] = _mm256_unpackhi_epi64(a[4 * i], a[4 * i + 2]);
        b[4 * i + 2] = _mm256_unpacklo_epi64(a[4 * i + 1], a[4 * i + 3]);
        b[4 * i + 3] = _mm256_unpackhi_epi64(a[4 * i + 1], a[4 * i + 3]);
    }
    for (int l = 0; l < 4; l++) {
        out[l] = _mm256_permute2x128_si256(b[l], b[4 + l], 0x20);
        out[l + 4] = _mm256_permute2x128_si256(b[l], b[4 + l], 0x31);
    }
}

/* Writes lane l of column c to out[stride * l + c]. */
static inline void rows_store8(const __m256i c[8], int32_t *out, int stride)
{
    __m256i row[8];
    rows_turn8(c, row);
    for (int l = 0; l < 8; l++)
        _mm256_storeu_si256((__m256i *)(out + stride * l), row[l]);
}

/* Loads eight words of eight rows: word c of row l becomes lane l of column c. */
static inline void rows_load8(const void *const row[8], __m256i c[8])
{
    __m256i a[8];
    for (int l = 0; l < 8; l++)
        a[l] = _mm256_loadu_si256((const __m256i *)row[l]);
    rows_turn8(a, c);
}
