/* The vector words for AVX2: eight lanes. vec_1.h says what each means. */
#pragma once

#include <immintrin.h>
#include <stdint.h>

#include "base/always_inline.h"
#include "kernels/simd/pack_sse.h"
#include "kernels/simd/pairs_sse.h"
#include "kernels/simd/rows_avx2.h"

#define V_LANES 8

typedef __m256 vf32;
typedef __m256i vi32;
typedef __m256 vmask;
typedef __m256d vf64;

#define MM(op) _mm256_##op
#define MMW(op) _mm256_##op##_si256
static inline __m256i quarters(__m128i a) { return _mm256_broadcastsi128_si256(a); }
static inline vf32 v_asf(vi32 a) { return _mm256_castsi256_ps(a); }
static inline vi32 v_iota(void) { return _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7); }
static inline vi32 v_onebit(void) { return _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128); }
static inline vi32 v_loadu8(const uint8_t *p) {
    return _mm256_cvtepu8_epi32(_mm_loadl_epi64((const __m128i *)p));
}
static inline vi32 v_gatheri(const void *base, vi32 i) {
    return _mm256_i32gather_epi32((const int *)base, i, 4);
}
static inline vi32 v_lookup8(const uint8_t bytes[64], vi32 i) {
    __m256i four = _mm256_i32gather_epi32((const int *)bytes, _mm256_srli_epi32(i, 2), 4);
    __m256i shift = _mm256_slli_epi32(_mm256_and_si256(i, _mm256_set1_epi32(3)), 3);
    return _mm256_and_si256(_mm256_srlv_epi32(four, shift), _mm256_set1_epi32(255));
}
static inline __m256i pairs_two(const void *texels, const int32_t *at) {
    return _mm256_set_m128i(pairs_eight(texels, at[4]), pairs_eight(texels, at[0]));
}
/* Loads the texels of two lanes, four apart, and those below. */
static inline __m256i quads_apart(const void *texels, const void *below, const int32_t *at) {
    return _mm256_unpacklo_epi64(pairs_two(texels, at), pairs_two(below, at));
}
static inline __m256i rows_pairs(const void *texels, const int32_t *at) {
    return _mm256_set_m128i(pairs_one(texels, (uint32_t)at[4]), pairs_one(texels, (uint32_t)at[0]));
}
static inline vi32 v_fetch(const void *base, const int32_t *at) {
    return _mm256_set_m128i(fetch_four(base, at + 4), fetch_four(base, at));
}
static inline vi32 inserted_lanes(const int32_t a[V_LANES]) { return _mm256_setr_epi32(a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7]); }
#include "kernels/simd/words_narrow.h"

static inline vmask v_lt(vf32 a, vf32 b) { return _mm256_cmp_ps(a, b, _CMP_LT_OQ); }
static inline vmask v_gt(vf32 a, vf32 b) { return _mm256_cmp_ps(a, b, _CMP_GT_OQ); }
static inline vmask v_ge(vf32 a, vf32 b) { return _mm256_cmp_ps(a, b, _CMP_GE_OQ); }
static inline vmask v_eq(vf32 a, vf32 b) { return _mm256_cmp_ps(a, b, _CMP_EQ_OQ); }
static inline vmask v_lt_in(vmask m, vf32 a, vf32 b) { return v_mand(m, v_lt(a, b)); }
static inline vmask v_eq_in(vmask m, vf32 a, vf32 b) { return v_mand(m, v_eq(a, b)); }

static inline vi32 v_sums(vi32 a) {
    a = _mm256_add_epi32(a, _mm256_slli_si256(a, 4));
    a = _mm256_add_epi32(a, _mm256_slli_si256(a, 8));
    __m256i low = _mm256_permute2x128_si256(a, a, 0x08); /* in the upper half */
    return _mm256_add_epi32(a, _mm256_shuffle_epi32(low, 0xFF));
}
static inline vi32 v_last(vi32 a) { return _mm256_permutevar8x32_epi32(a, _mm256_set1_epi32(7)); }

static inline vf32 v_floor(vf32 a) { return _mm256_floor_ps(a); }
static inline vi32 v_floori(vf32 a) { return v_trunc(v_floor(a)); }

static inline int v_count(uint32_t bits) { return __builtin_popcount(bits); }

static inline vf64 v_widenf(vf32 a, int h) {
    return _mm256_cvtps_pd(h ? _mm256_extractf128_ps(a, 1) : _mm256_castps256_ps128(a));
}
static inline vf64 v_wideni(vi32 a, int h) {
    return _mm256_cvtepi32_pd(h ? _mm256_extracti128_si256(a, 1) : _mm256_castsi256_si128(a));
}
static inline vf32 v_narrow(const vf64 a[V_HALVES]) {
    return _mm256_set_m128(_mm256_cvtpd_ps(a[1]), _mm256_cvtpd_ps(a[0]));
}

static inline void v_load_rows(const void *const row[8], vi32 c[8]) { rows_load8(row, c); }
static inline void v_store_rows(const vi32 c[16], int32_t *out) {
    rows_store8(c, out, 16);
    rows_store8(c + 8, out + 8, 16);
}

static inline vi32 v_span(vi32 at, vi32 length, int h) {
    __m128i at4 = h ? _mm256_extracti128_si256(at, 1) : _mm256_castsi256_si128(at);
    __m128i length4 = h ? _mm256_extracti128_si256(length, 1) : _mm256_castsi256_si128(length);
    __m256i none = _mm256_sub_epi64(_mm256_set1_epi64x(64), _mm256_cvtepu32_epi64(length4));
    return _mm256_sllv_epi64(_mm256_srlv_epi64(_mm256_set1_epi64x(-1), none), _mm256_cvtepu32_epi64(at4));
}
static inline int v_pack(void *out, vi32 a, uint32_t bits) {
    int low = pack_four(out, _mm256_castsi256_si128(a), bits & 15);
    return low + pack_four((int32_t *)out + low, _mm256_extracti128_si256(a, 1), bits >> 4);
}
static inline int v_pack8(uint8_t *out, vi32 a, uint32_t bits) {
    int low = pack_bytes(out, _mm256_castsi256_si128(a), bits & 15);
    return low + pack_bytes(out + low, _mm256_extracti128_si256(a, 1), bits >> 4);
}
static inline int v_pack16(uint16_t *out, vi32 a, uint32_t bits) {
    int low = pack_halves(out, _mm256_castsi256_si128(a), bits & 15);
    return low + pack_halves(out + low, _mm256_extracti128_si256(a, 1), bits >> 4);
}

typedef __m256i vpick;
static inline vpick v_picker(vi32 index) { return index; }
static inline vf32 v_pick(const void *base, vpick p) {
    return _mm256_permutevar8x32_ps(_mm256_loadu_ps((const float *)base), p);
}

static inline void v_store_pairs(void *out, vi32 a, vi32 b) { /* unpacking works within halves */
    vi32 low = _mm256_unpacklo_epi32(a, b), high = _mm256_unpackhi_epi32(a, b);
    v_storei(out, _mm256_permute2x128_si256(low, high, 0x20));
    v_storei((int32_t *)out + 8, _mm256_permute2x128_si256(low, high, 0x31));
}

/* Puts quarters 0, 2, 1, 3 in order: a shuffle of two registers works within their halves. */
static inline vf32 quarters_in_order(__m256 a) {
    return _mm256_castpd_ps(_mm256_permute4x64_pd(_mm256_castps_pd(a), _MM_SHUFFLE(3, 1, 2, 0)));
}
static inline void v_split(vf32 a, vf32 b, vf32 *even, vf32 *odd) {
    *even = quarters_in_order(_mm256_shuffle_ps(a, b, PAIRS_EVEN));
    *odd = quarters_in_order(_mm256_shuffle_ps(a, b, PAIRS_ODD));
}
static inline void v_load_pairs(const float *base, const int32_t *at, vf32 *first, vf32 *second) {
    __m128 a[2], b[2];
    for (int half = 0; half < 2; half++)
        floats_four(base, at + 4 * half, &a[half], &b[half]);
    *first = _mm256_set_m128(a[1], a[0]);
    *second = _mm256_set_m128(b[1], b[0]);
}
