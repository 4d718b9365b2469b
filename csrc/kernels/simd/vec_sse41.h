/* The vector words for SSE4.1: four lanes. vec_1.h says what each means. */
#pragma once

#include <smmintrin.h>
#include <stdint.h>
#include <string.h>

#include "base/always_inline.h"
#include "kernels/simd/pack_sse.h"
#include "kernels/simd/pairs_sse.h"

#define V_LANES 4

typedef __m128 vf32;
typedef __m128i vi32;
typedef __m128 vmask;
typedef __m128d vf64;

#define MM(op) _mm_##op
#define MMW(op) _mm_##op##_si128
static inline __m128i quarters(__m128i a) { return a; }
static inline vf32 v_asf(vi32 a) { return _mm_castsi128_ps(a); }
static inline vi32 v_iota(void) { return _mm_setr_epi32(0, 1, 2, 3); }
static inline vi32 v_onebit(void) { return _mm_setr_epi32(1, 2, 4, 8); }
static inline vi32 v_loadu8(const uint8_t *p) {
    int32_t v;
    memcpy(&v, p, 4);
    return _mm_cvtepu8_epi32(_mm_cvtsi32_si128(v));
}
static inline vi32 v_gatheri(const void *base, vi32 i) {
    const int32_t *b = (const int32_t *)base;
    return _mm_setr_epi32(b[_mm_extract_epi32(i, 0)], b[_mm_extract_epi32(i, 1)],
                          b[_mm_extract_epi32(i, 2)], b[_mm_extract_epi32(i, 3)]);
}
static inline vi32 v_lookup8(const uint8_t b[64], vi32 i) {
    return _mm_setr_epi32(b[_mm_extract_epi32(i, 0)], b[_mm_extract_epi32(i, 1)],
                          b[_mm_extract_epi32(i, 2)], b[_mm_extract_epi32(i, 3)]);
}
/* Loads the texels of one lane, and those below. */
static inline __m128i quads_apart(const void *texels, const void *below, const int32_t *at) {
    return _mm_unpacklo_epi64(pairs_eight(texels, at[0]), pairs_eight(below, at[0]));
}
static inline __m128i rows_pairs(const void *texels, const int32_t *at) { return pairs_one(texels, (uint32_t)at[0]); }
static inline vi32 v_fetch(const void *base, const int32_t *at) { return fetch_four(base, at); }
static inline vi32 inserted_lanes(const int32_t a[V_LANES]) { return _mm_setr_epi32(a[0], a[1], a[2], a[3]); }
#include "kernels/simd/words_narrow.h"

static inline vmask v_lt(vf32 a, vf32 b) { return _mm_cmplt_ps(a, b); }
static inline vmask v_gt(vf32 a, vf32 b) { return _mm_cmpgt_ps(a, b); }
static inline vmask v_ge(vf32 a, vf32 b) { return _mm_cmpge_ps(a, b); }
static inline vmask v_eq(vf32 a, vf32 b) { return _mm_cmpeq_ps(a, b); }
static inline vmask v_lt_in(vmask m, vf32 a, vf32 b) { return v_mand(m, v_lt(a, b)); }
static inline vmask v_eq_in(vmask m, vf32 a, vf32 b) { return v_mand(m, v_eq(a, b)); }

static inline vi32 v_sums(vi32 a) {
    a = _mm_add_epi32(a, _mm_slli_si128(a, 4));
    return _mm_add_epi32(a, _mm_slli_si128(a, 8));
}
static inline vi32 v_last(vi32 a) { return _mm_shuffle_epi32(a, 0xFF); }

static inline vf32 v_floor(vf32 a) { return _mm_floor_ps(a); }
static inline vi32 v_floori(vf32 a) { return v_trunc(v_floor(a)); }

static inline int v_count(uint32_t bits) { return pack_count(bits); }

static inline vf64 v_widenf(vf32 a, int h) { return _mm_cvtps_pd(h ? _mm_movehl_ps(a, a) : a); }
static inline vf64 v_wideni(vi32 a, int h) { return _mm_cvtepi32_pd(h ? _mm_unpackhi_epi64(a, a) : a); }
static inline vf32 v_narrow(const vf64 a[V_HALVES]) { return _mm_movelh_ps(_mm_cvtpd_ps(a[0]), _mm_cvtpd_ps(a[1])); }

static inline void v_load_rows(const void *const row[4], vi32 c[8]) {
    for (int i = 0; i < 8; i += 4) {
        __m128i a[4];
        for (int l = 0; l < 4; l++)
            a[l] = v_loadi((const int32_t *)row[l] + i);
        __m128i low01 = _mm_unpacklo_epi32(a[0], a[1]), low23 = _mm_unpacklo_epi32(a[2], a[3]);
        __m128i high01 = _mm_unpackhi_epi32(a[0], a[1]), high23 = _mm_unpackhi_epi32(a[2], a[3]);
        c[i] = _mm_unpacklo_epi64(low01, low23);
        c[i + 1] = _mm_unpackhi_epi64(low01, low23);
        c[i + 2] = _mm_unpacklo_epi64(high01, high23);
        c[i + 3] = _mm_unpackhi_epi64(high01, high23);
    }
}

static inline void v_store_rows(const vi32 c[16], int32_t *out) {
    for (int i = 0; i < 16; i += 4) {
        __m128i low01 = _mm_unpacklo_epi32(c[i], c[i + 1]), low23 = _mm_unpacklo_epi32(c[i + 2], c[i + 3]);
        __m128i high01 = _mm_unpackhi_epi32(c[i], c[i + 1]), high23 = _mm_unpackhi_epi32(c[i + 2], c[i + 3]);
        v_storei(out + i, _mm_unpacklo_epi64(low01, low23));
        v_storei(out + 16 + i, _mm_unpackhi_epi64(low01, low23));
        v_storei(out + 32 + i, _mm_unpacklo_epi64(high01, high23));
        v_storei(out + 48 + i, _mm_unpackhi_epi64(high01, high23));
    }
}

/* SSE4.1 shifts all lanes of a vector by one number, so each word is shifted in a vector of its own. */
static inline __m128i span_one(int32_t at, int32_t length) {
    __m128i ones = _mm_srl_epi64(_mm_set1_epi64x(-1), _mm_cvtsi32_si128(64 - length));
    return _mm_sll_epi64(ones, _mm_cvtsi32_si128(at));
}
static inline vi32 v_span(vi32 at, vi32 length, int h) {
    int32_t first[4], count[4];
    v_storei(first, at);
    v_storei(count, length);
    return _mm_unpacklo_epi64(span_one(first[2 * h], count[2 * h]), span_one(first[2 * h + 1], count[2 * h + 1]));
}
static inline int v_pack(void *out, vi32 a, uint32_t bits) { return pack_four(out, a, bits); }
static inline int v_pack8(uint8_t *out, vi32 a, uint32_t bits) { return pack_bytes(out, a, bits); }
static inline int v_pack16(uint16_t *out, vi32 a, uint32_t bits) { return pack_halves(out, a, bits); }

typedef __m128i vpick;
static inline vpick v_picker(vi32 index) {
    return _mm_add_epi32(_mm_mullo_epi32(index, _mm_set1_epi32(0x04040404)), _mm_set1_epi32(0x03020100));
}
static inline vf32 v_pick(const void *base, vpick p) {
    return _mm_castsi128_ps(_mm_shuffle_epi8(_mm_loadu_si128((const __m128i *)base), p));
}

static inline void v_store_pairs(void *out, vi32 a, vi32 b) {
    v_storei(out, _mm_unpacklo_epi32(a, b));
    v_storei((int32_t *)out + 4, _mm_unpackhi_epi32(a, b));
}
static inline void v_split(vf32 a, vf32 b, vf32 *even, vf32 *odd) {
    *even = _mm_shuffle_ps(a, b, PAIRS_EVEN);
    *odd = _mm_shuffle_ps(a, b, PAIRS_ODD);
}
static inline void v_load_pairs(const float *base, const int32_t *at, vf32 *first, vf32 *second) {
    floats_four(base, at, first, second);
}
