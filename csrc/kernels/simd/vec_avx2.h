/* The vector words for AVX2: eight lanes. vec_1.h says what each means. */
#ifndef E3D_VEC_AVX2_H
#define E3D_VEC_AVX2_H

#include <immintrin.h>
#include <stdint.h>

#include "core/always_inline.h"
#include "kernels/simd/rows_avx2.h"
#include "kernels/simd/pack_sse.h"
#include "kernels/simd/pairs_sse.h"

#define V_LANES 8

typedef __m256 vf32;
typedef __m256i vi32;
typedef __m256 vmask;

static inline vf32 v_setf(float a) { return _mm256_set1_ps(a); }
static inline vi32 v_seti(int32_t a) { return _mm256_set1_epi32(a); }
static inline vi32 v_iota(void) { return _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7); }
static inline vi32 v_onebit(void) { return _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128); }
static inline vf32 v_loadf(const float *p) { return _mm256_loadu_ps(p); }
static inline vi32 v_loadi(const void *p) { return _mm256_loadu_si256((const __m256i *)p); }
static inline void v_storef(float *p, vf32 a) { _mm256_storeu_ps(p, a); }
static inline void v_storei(void *p, vi32 a) { _mm256_storeu_si256((__m256i *)p, a); }
static ALWAYS_INLINE int v_store_runs(uint32_t *base, const int32_t *at, vi32 a) {
    __m256i row = _mm256_add_epi32(_mm256_set1_epi32(at[0]), v_iota());
    if (_mm256_movemask_epi8(_mm256_cmpeq_epi32(v_loadi(at), row)) != -1)
        return 0;
    v_storei(base + at[0], a);
    return 1;
}
static inline void v_streami(void *p, vi32 a) { _mm256_stream_si256((__m256i *)p, a); }
static inline vi32 v_loadu8(const uint8_t *p) {
    return _mm256_cvtepu8_epi32(_mm_loadl_epi64((const __m128i *)p));
}
static inline vf32 v_gatherf(const float *base, vi32 i) { return _mm256_i32gather_ps(base, i, 4); }
static inline vi32 v_gatheri(const void *base, vi32 i) {
    return _mm256_i32gather_epi32((const int *)base, i, 4);
}
static inline vi32 v_lookup8(const uint8_t bytes[64], vi32 i) {
    __m256i four = _mm256_i32gather_epi32((const int *)bytes, _mm256_srli_epi32(i, 2), 4);
    __m256i shift = _mm256_slli_epi32(_mm256_and_si256(i, _mm256_set1_epi32(3)), 3);
    return _mm256_and_si256(_mm256_srlv_epi32(four, shift), _mm256_set1_epi32(255));
}

typedef const int32_t *vtable;
static inline void v_table(const int32_t *base, int count, vtable *out) { (void)count; *out = base; }
static inline vi32 v_lookup(const vtable *t, vi32 i) { return v_gatheri(*t, i); }
typedef const float *vtablef;
static inline void v_tablef(const float *base, int count, vtablef *out) { (void)count; *out = base; }
static inline vf32 v_lookupf(const vtablef *t, vi32 i) { return v_gatherf(*t, i); }

static inline vf32 v_add(vf32 a, vf32 b) { return _mm256_add_ps(a, b); }
static inline vf32 v_sub(vf32 a, vf32 b) { return _mm256_sub_ps(a, b); }
static inline vf32 v_mul(vf32 a, vf32 b) { return _mm256_mul_ps(a, b); }
static inline vf32 v_div(vf32 a, vf32 b) { return _mm256_div_ps(a, b); }
static inline vf32 v_sqrt(vf32 a) { return _mm256_sqrt_ps(a); }
static inline vf32 v_min(vf32 a, vf32 b) { return _mm256_min_ps(a, b); }
static inline vf32 v_max(vf32 a, vf32 b) { return _mm256_max_ps(a, b); }
static inline vmask v_lt(vf32 a, vf32 b) { return _mm256_cmp_ps(a, b, _CMP_LT_OQ); }
static inline vmask v_gt(vf32 a, vf32 b) { return _mm256_cmp_ps(a, b, _CMP_GT_OQ); }
static inline vmask v_ge(vf32 a, vf32 b) { return _mm256_cmp_ps(a, b, _CMP_GE_OQ); }
static inline vmask v_eq(vf32 a, vf32 b) { return _mm256_cmp_ps(a, b, _CMP_EQ_OQ); }

static inline vi32 v_addi(vi32 a, vi32 b) { return _mm256_add_epi32(a, b); }
static inline vi32 v_sums(vi32 a) {
    a = _mm256_add_epi32(a, _mm256_slli_si256(a, 4));
    a = _mm256_add_epi32(a, _mm256_slli_si256(a, 8));
    __m256i low = _mm256_permute2x128_si256(a, a, 0x08); /* in the upper half */
    return _mm256_add_epi32(a, _mm256_shuffle_epi32(low, 0xFF));
}
static inline vi32 v_last(vi32 a) { return _mm256_permutevar8x32_epi32(a, _mm256_set1_epi32(7)); }
static inline vi32 v_subi(vi32 a, vi32 b) { return _mm256_sub_epi32(a, b); }
static inline vi32 v_muli(vi32 a, vi32 b) { return _mm256_mullo_epi32(a, b); }
static inline vi32 v_andi(vi32 a, vi32 b) { return _mm256_and_si256(a, b); }
static inline vi32 v_ori(vi32 a, vi32 b) { return _mm256_or_si256(a, b); }
static inline vi32 v_xori(vi32 a, vi32 b) { return _mm256_xor_si256(a, b); }
static inline vi32 v_mini(vi32 a, vi32 b) { return _mm256_min_epi32(a, b); }
static inline vi32 v_maxi(vi32 a, vi32 b) { return _mm256_max_epi32(a, b); }
static inline vmask v_gti(vi32 a, vi32 b) { return _mm256_castsi256_ps(_mm256_cmpgt_epi32(a, b)); }
static inline vmask v_eqi(vi32 a, vi32 b) { return _mm256_castsi256_ps(_mm256_cmpeq_epi32(a, b)); }
static inline vmask v_negi(vi32 a) { return _mm256_castsi256_ps(_mm256_srai_epi32(a, 31)); }
static inline vi32 v_add16(vi32 a, vi32 b) { return _mm256_add_epi16(a, b); }
static inline vi32 v_sub16(vi32 a, vi32 b) { return _mm256_sub_epi16(a, b); }
static inline vi32 v_min16(vi32 a, vi32 b) { return _mm256_min_epi16(a, b); }
static inline vi32 v_max16(vi32 a, vi32 b) { return _mm256_max_epi16(a, b); }
static inline vi32 v_mul16(vi32 a, vi32 b) { return _mm256_mullo_epi16(a, b); }
static inline vi32 v_madd16(vi32 a, vi32 b) { return _mm256_madd_epi16(a, b); }
static inline vi32 v_madd8(vi32 a, vi32 b) { return _mm256_maddubs_epi16(a, b); }
#define v_sra16(a, n) _mm256_srai_epi16(a, n)
#define v_shr16(a, n) _mm256_srli_epi16(a, n)
#define v_shl(a, n) _mm256_slli_epi32(a, n)
#define v_shr(a, n) _mm256_srli_epi32(a, n)
#define v_sra(a, n) _mm256_srai_epi32(a, n)

static inline vf32 v_float(vi32 a) { return _mm256_cvtepi32_ps(a); }
static inline vi32 v_rint(vf32 a) { return _mm256_cvtps_epi32(a); }
static inline vi32 v_trunc(vf32 a) { return _mm256_cvttps_epi32(a); }
static inline vf32 v_floor(vf32 a) { return _mm256_floor_ps(a); }
static inline vf32 v_asf(vi32 a) { return _mm256_castsi256_ps(a); }
static inline vi32 v_asi(vf32 a) { return _mm256_castps_si256(a); }

static inline vf32 v_self(vmask m, vf32 a, vf32 b) { return _mm256_blendv_ps(b, a, m); }
static inline vi32 v_seli(vmask m, vi32 a, vi32 b) {
    return _mm256_blendv_epi8(b, a, _mm256_castps_si256(m));
}
static inline vmask v_mand(vmask a, vmask b) { return _mm256_and_ps(a, b); }
static inline vmask v_mor(vmask a, vmask b) { return _mm256_or_ps(a, b); }
static inline vmask v_mandnot(vmask a, vmask b) { return _mm256_andnot_ps(b, a); }
static inline vmask v_mnot(vmask a) {
    return _mm256_xor_ps(a, _mm256_castsi256_ps(_mm256_set1_epi32(-1)));
}
static inline uint32_t v_bits(vmask m) { return (uint32_t)_mm256_movemask_ps(m); }
static inline int v_count(uint32_t bits) { return __builtin_popcount(bits); }
static inline int v_any(vmask m) { return _mm256_movemask_ps(m) != 0; }

#define V_HALVES 2
typedef __m256d vf64;
static inline vf64 v_setd(double a) { return _mm256_set1_pd(a); }
static inline vf64 v_widenf(vf32 a, int h) {
    return _mm256_cvtps_pd(h ? _mm256_extractf128_ps(a, 1) : _mm256_castps256_ps128(a));
}
static inline vf64 v_wideni(vi32 a, int h) {
    return _mm256_cvtepi32_pd(h ? _mm256_extracti128_si256(a, 1) : _mm256_castsi256_si128(a));
}
static inline vf64 v_addd(vf64 a, vf64 b) { return _mm256_add_pd(a, b); }
static inline vf64 v_subd(vf64 a, vf64 b) { return _mm256_sub_pd(a, b); }
static inline vf64 v_muld(vf64 a, vf64 b) { return _mm256_mul_pd(a, b); }
static inline vf64 v_divd(vf64 a, vf64 b) { return _mm256_div_pd(a, b); }
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

/* Lanes 0 .. 3 in the low half, 4 .. 7 in the high one: unpacking works within halves. */
static inline vf32 quarters_in_order(__m256 a) {
    return _mm256_castpd_ps(_mm256_permute4x64_pd(_mm256_castps_pd(a), _MM_SHUFFLE(3, 1, 2, 0)));
}
static inline void v_split(vf32 a, vf32 b, vf32 *even, vf32 *odd) {
    *even = quarters_in_order(_mm256_shuffle_ps(a, b, PAIRS_EVEN));
    *odd = quarters_in_order(_mm256_shuffle_ps(a, b, PAIRS_ODD));
}
static inline __m256i pairs_two(const void *texels, const int32_t *at) {
    return _mm256_inserti128_si256(_mm256_castsi128_si256(pairs_eight(texels, at[0])), pairs_eight(texels, at[4]), 1);
}
/* Lane 4 n + i is in quarter n of vector i, its red, green and blue side by side: to a vector each. */
static ALWAYS_INLINE void channels_apart(const __m256i q[4], vi32 out[3]) {
    __m256i low01 = _mm256_unpacklo_epi32(q[0], q[1]), low23 = _mm256_unpacklo_epi32(q[2], q[3]);
    __m256i high01 = _mm256_unpackhi_epi32(q[0], q[1]), high23 = _mm256_unpackhi_epi32(q[2], q[3]);
    out[0] = _mm256_unpacklo_epi64(low01, low23);
    out[1] = _mm256_unpackhi_epi64(low01, low23);
    out[2] = _mm256_unpacklo_epi64(high01, high23);
}
static ALWAYS_INLINE void v_quads8(const void *texels, const void *below, const int32_t *at, vi32 out[3]) {
    __m256i q[4], order = _mm256_broadcastsi128_si256(pairs_quad());
    for (int i = 0; i < 4; i++)
        q[i] = _mm256_shuffle_epi8(_mm256_unpacklo_epi64(pairs_two(texels, at + i), pairs_two(below, at + i)), order);
    channels_apart(q, out);
}
static inline vi32 v_rgba(const vi32 c[3]) {
    __m256i low = _mm256_packs_epi32(c[0], c[1]), high = _mm256_packs_epi32(c[2], _mm256_set1_epi32(255));
    return _mm256_shuffle_epi8(_mm256_packus_epi16(low, high), _mm256_broadcastsi128_si256(pairs_pixels()));
}
static inline vi32 curve_fetch(const int32_t *pieces, const int32_t *at) {
    return _mm256_inserti128_si256(_mm256_castsi128_si256(fetch_four(pieces, at)), fetch_four(pieces, at + 4), 1);
}
static inline vi32 curve_rise(vi32 piece, vi32 along) { return _mm256_mulhi_epu16(piece, along); }
#include "kernels/simd/curve_memory.h"

/* The weight of one lane, to each of a pair's channels: 2^7 of it, for pmulhrsw. */
static inline __m256i rows_weights(vi32 weight) { return _mm256_or_si256(_mm256_slli_epi32(weight, 7), _mm256_slli_epi32(weight, 23)); }
static inline __m256i rows_pairs(const void *texels, const int32_t *at) {
    return _mm256_set_m128i(pairs_one(texels, (uint32_t)at[4]), pairs_one(texels, (uint32_t)at[0]));
}
static inline __m256i rows_blend(__m256i upper, __m256i lower, __m256i weight) {
    return _mm256_add_epi16(upper, _mm256_mulhrs_epi16(_mm256_sub_epi16(lower, upper), weight));
}
static ALWAYS_INLINE void v_rows16(const void *texels, const int32_t *top, const int32_t *bottom, vi32 weight, vi32 out[3]) {
    __m256i q[4], twice = rows_weights(weight), halves = _mm256_broadcastsi128_si256(pairs_halves());
    const __m256i each[4] = {_mm256_shuffle_epi32(twice, 0x00), _mm256_shuffle_epi32(twice, 0x55), _mm256_shuffle_epi32(twice, 0xAA),
                             _mm256_shuffle_epi32(twice, 0xFF)};
    for (int i = 0; i < 4; i++)
        q[i] = _mm256_shuffle_epi8(rows_blend(rows_pairs(texels, top + i), rows_pairs(texels, bottom + i), each[i]), halves);
    channels_apart(q, out);
}

#endif
