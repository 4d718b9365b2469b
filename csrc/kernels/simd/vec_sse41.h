/* The vector words for SSE4.1: four lanes. vec_1.h says what each means. */
#ifndef E3D_VEC_SSE41_H
#define E3D_VEC_SSE41_H

#include <smmintrin.h>
#include <stdint.h>
#include <string.h>

#include "core/always_inline.h"
#include "kernels/simd/pack_sse.h"
#include "kernels/simd/pairs_sse.h"

#define V_LANES 4

typedef __m128 vf32;
typedef __m128i vi32;
typedef __m128 vmask;

static inline vf32 v_setf(float a) { return _mm_set1_ps(a); }
static inline vi32 v_seti(int32_t a) { return _mm_set1_epi32(a); }
static inline vi32 v_iota(void) { return _mm_setr_epi32(0, 1, 2, 3); }
static inline vi32 v_onebit(void) { return _mm_setr_epi32(1, 2, 4, 8); }
static inline vf32 v_loadf(const float *p) { return _mm_loadu_ps(p); }
static inline vi32 v_loadi(const void *p) { return _mm_loadu_si128((const __m128i *)p); }
static inline void v_storef(float *p, vf32 a) { _mm_storeu_ps(p, a); }
static inline void v_storei(void *p, vi32 a) { _mm_storeu_si128((__m128i *)p, a); }
static ALWAYS_INLINE int v_store_runs(uint32_t *base, const int32_t *at, vi32 a) {
    __m128i row = _mm_add_epi32(_mm_set1_epi32(at[0]), v_iota());
    if (_mm_movemask_epi8(_mm_cmpeq_epi32(v_loadi(at), row)) != 0xFFFF)
        return 0;
    v_storei(base + at[0], a);
    return 1;
}
static inline void v_streami(void *p, vi32 a) { _mm_stream_si128((__m128i *)p, a); }
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
static inline vf32 v_gatherf(const float *base, vi32 i) {
    return _mm_castsi128_ps(v_gatheri(base, i));
}

typedef const int32_t *vtable;
static inline void v_table(const int32_t *base, int count, vtable *out) { (void)count; *out = base; }
static inline vi32 v_lookup(const vtable *t, vi32 i) { return v_gatheri(*t, i); }
typedef const float *vtablef;
static inline void v_tablef(const float *base, int count, vtablef *out) { (void)count; *out = base; }
static inline vf32 v_lookupf(const vtablef *t, vi32 i) { return v_gatherf(*t, i); }

static inline vf32 v_add(vf32 a, vf32 b) { return _mm_add_ps(a, b); }
static inline vf32 v_sub(vf32 a, vf32 b) { return _mm_sub_ps(a, b); }
static inline vf32 v_mul(vf32 a, vf32 b) { return _mm_mul_ps(a, b); }
static inline vf32 v_div(vf32 a, vf32 b) { return _mm_div_ps(a, b); }
static inline vf32 v_sqrt(vf32 a) { return _mm_sqrt_ps(a); }
static inline vf32 v_min(vf32 a, vf32 b) { return _mm_min_ps(a, b); }
static inline vf32 v_max(vf32 a, vf32 b) { return _mm_max_ps(a, b); }
static inline vmask v_lt(vf32 a, vf32 b) { return _mm_cmplt_ps(a, b); }
static inline vmask v_gt(vf32 a, vf32 b) { return _mm_cmpgt_ps(a, b); }
static inline vmask v_ge(vf32 a, vf32 b) { return _mm_cmpge_ps(a, b); }
static inline vmask v_eq(vf32 a, vf32 b) { return _mm_cmpeq_ps(a, b); }

static inline vi32 v_addi(vi32 a, vi32 b) { return _mm_add_epi32(a, b); }
static inline vi32 v_sums(vi32 a) {
    a = _mm_add_epi32(a, _mm_slli_si128(a, 4));
    return _mm_add_epi32(a, _mm_slli_si128(a, 8));
}
static inline vi32 v_last(vi32 a) { return _mm_shuffle_epi32(a, 0xFF); }
static inline vi32 v_subi(vi32 a, vi32 b) { return _mm_sub_epi32(a, b); }
static inline vi32 v_muli(vi32 a, vi32 b) { return _mm_mullo_epi32(a, b); }
static inline vi32 v_andi(vi32 a, vi32 b) { return _mm_and_si128(a, b); }
static inline vi32 v_ori(vi32 a, vi32 b) { return _mm_or_si128(a, b); }
static inline vi32 v_xori(vi32 a, vi32 b) { return _mm_xor_si128(a, b); }
static inline vi32 v_mini(vi32 a, vi32 b) { return _mm_min_epi32(a, b); }
static inline vi32 v_maxi(vi32 a, vi32 b) { return _mm_max_epi32(a, b); }
static inline vmask v_gti(vi32 a, vi32 b) { return _mm_castsi128_ps(_mm_cmpgt_epi32(a, b)); }
static inline vmask v_eqi(vi32 a, vi32 b) { return _mm_castsi128_ps(_mm_cmpeq_epi32(a, b)); }
static inline vmask v_negi(vi32 a) { return _mm_castsi128_ps(_mm_srai_epi32(a, 31)); }
static inline vi32 v_add16(vi32 a, vi32 b) { return _mm_add_epi16(a, b); }
static inline vi32 v_sub16(vi32 a, vi32 b) { return _mm_sub_epi16(a, b); }
static inline vi32 v_min16(vi32 a, vi32 b) { return _mm_min_epi16(a, b); }
static inline vi32 v_max16(vi32 a, vi32 b) { return _mm_max_epi16(a, b); }
static inline vi32 v_mul16(vi32 a, vi32 b) { return _mm_mullo_epi16(a, b); }
static inline vi32 v_madd16(vi32 a, vi32 b) { return _mm_madd_epi16(a, b); }
static inline vi32 v_madd8(vi32 a, vi32 b) { return _mm_maddubs_epi16(a, b); }
#define v_sra16(a, n) _mm_srai_epi16(a, n)
#define v_shr16(a, n) _mm_srli_epi16(a, n)
#define v_shl(a, n) _mm_slli_epi32(a, n)
#define v_shr(a, n) _mm_srli_epi32(a, n)
#define v_sra(a, n) _mm_srai_epi32(a, n)

static inline vf32 v_float(vi32 a) { return _mm_cvtepi32_ps(a); }
static inline vi32 v_rint(vf32 a) { return _mm_cvtps_epi32(a); }
static inline vi32 v_trunc(vf32 a) { return _mm_cvttps_epi32(a); }
static inline vf32 v_floor(vf32 a) { return _mm_floor_ps(a); }
static inline vf32 v_asf(vi32 a) { return _mm_castsi128_ps(a); }
static inline vi32 v_asi(vf32 a) { return _mm_castps_si128(a); }

static inline vf32 v_self(vmask m, vf32 a, vf32 b) { return _mm_blendv_ps(b, a, m); }
static inline vi32 v_seli(vmask m, vi32 a, vi32 b) {
    return _mm_blendv_epi8(b, a, _mm_castps_si128(m));
}
static inline vmask v_mand(vmask a, vmask b) { return _mm_and_ps(a, b); }
static inline vmask v_mor(vmask a, vmask b) { return _mm_or_ps(a, b); }
static inline vmask v_mandnot(vmask a, vmask b) { return _mm_andnot_ps(b, a); }
static inline vmask v_mnot(vmask a) {
    return _mm_xor_ps(a, _mm_castsi128_ps(_mm_set1_epi32(-1)));
}
static inline uint32_t v_bits(vmask m) { return (uint32_t)_mm_movemask_ps(m); }
static inline int v_count(uint32_t bits) { return pack_count(bits); }
static inline int v_any(vmask m) { return _mm_movemask_ps(m) != 0; }

#define V_HALVES 2
typedef __m128d vf64;
static inline vf64 v_setd(double a) { return _mm_set1_pd(a); }
static inline vf64 v_widenf(vf32 a, int h) { return _mm_cvtps_pd(h ? _mm_movehl_ps(a, a) : a); }
static inline vf64 v_wideni(vi32 a, int h) { return _mm_cvtepi32_pd(h ? _mm_unpackhi_epi64(a, a) : a); }
static inline vf64 v_addd(vf64 a, vf64 b) { return _mm_add_pd(a, b); }
static inline vf64 v_subd(vf64 a, vf64 b) { return _mm_sub_pd(a, b); }
static inline vf64 v_muld(vf64 a, vf64 b) { return _mm_mul_pd(a, b); }
static inline vf64 v_divd(vf64 a, vf64 b) { return _mm_div_pd(a, b); }
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

/* Whole vectors are shifted by one number. */
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

static inline void v_split(vf32 a, vf32 b, vf32 *even, vf32 *odd) {
    *even = _mm_shuffle_ps(a, b, PAIRS_EVEN);
    *odd = _mm_shuffle_ps(a, b, PAIRS_ODD);
}
/* Lane 4 n + i is in quarter n of vector i, its red, green and blue side by side: to a vector each. */
static ALWAYS_INLINE void channels_apart(const __m128i q[4], vi32 out[3]) {
    __m128i low01 = _mm_unpacklo_epi32(q[0], q[1]), low23 = _mm_unpacklo_epi32(q[2], q[3]);
    __m128i high01 = _mm_unpackhi_epi32(q[0], q[1]), high23 = _mm_unpackhi_epi32(q[2], q[3]);
    out[0] = _mm_unpacklo_epi64(low01, low23);
    out[1] = _mm_unpackhi_epi64(low01, low23);
    out[2] = _mm_unpacklo_epi64(high01, high23);
}
static ALWAYS_INLINE void v_quads8(const void *texels, const void *below, const int32_t *at, vi32 out[3]) {
    __m128i q[4];
    for (int i = 0; i < 4; i++)
        q[i] = _mm_shuffle_epi8(_mm_unpacklo_epi64(pairs_eight(texels, at[i]), pairs_eight(below, at[i])), pairs_quad());
    channels_apart(q, out);
}
static inline vi32 v_rgba(const vi32 c[3]) {
    __m128i low = _mm_packs_epi32(c[0], c[1]), high = _mm_packs_epi32(c[2], _mm_set1_epi32(255));
    return _mm_shuffle_epi8(_mm_packus_epi16(low, high), pairs_pixels());
}
static inline vi32 curve_fetch(const int32_t *pieces, const int32_t *at) { return fetch_four(pieces, at); }
static inline vi32 curve_rise(vi32 piece, vi32 along) { return _mm_mulhi_epu16(piece, along); }
#include "kernels/simd/curve_memory.h"

/* The weight of one lane, to each of a pair's channels: 2^7 of it, for pmulhrsw. */
static inline __m128i rows_weights(vi32 weight) { return _mm_or_si128(_mm_slli_epi32(weight, 7), _mm_slli_epi32(weight, 23)); }
static inline __m128i rows_blend(__m128i upper, __m128i lower, __m128i weight) {
    return _mm_add_epi16(upper, _mm_mulhrs_epi16(_mm_sub_epi16(lower, upper), weight));
}
static ALWAYS_INLINE void v_rows16(const void *texels, const int32_t *top, const int32_t *bottom, vi32 weight, vi32 out[3]) {
    __m128i q[4], twice = rows_weights(weight);
    const __m128i each[4] = {_mm_shuffle_epi32(twice, 0x00), _mm_shuffle_epi32(twice, 0x55), _mm_shuffle_epi32(twice, 0xAA),
                             _mm_shuffle_epi32(twice, 0xFF)};
    for (int i = 0; i < 4; i++) {
        __m128i upper = pairs_one(texels, (uint32_t)top[i]), lower = pairs_one(texels, (uint32_t)bottom[i]);
        q[i] = _mm_shuffle_epi8(rows_blend(upper, lower, each[i]), pairs_halves());
    }
    channels_apart(q, out);
}

#endif
