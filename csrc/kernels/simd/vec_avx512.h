/* The vector words for AVX-512 (F, CD, BW, DQ, VL): sixteen lanes. vec_1.h says what each means. */
#pragma once

#include <immintrin.h>
#include <stdint.h>

#include "base/always_inline.h"
#include "kernels/simd/pairs_sse.h"
#include "kernels/simd/rows_avx2.h"

#define V_LANES 16

typedef __m512 vf32;
typedef __m512i vi32;
typedef __mmask16 vmask;
typedef __m512d vf64;

#define MM(op) _mm512_##op
#define MMW(op) _mm512_##op##_si512
static inline __m512i quarters(__m128i a) { return _mm512_broadcast_i32x4(a); }
static inline vf32 v_asf(vi32 a) { return _mm512_castsi512_ps(a); }
/* Vectors are loaded by halves and joined once: on processors that work on halves, this takes half as long as by quarters. */
static inline vi32 halves_join(__m256i low, __m256i high) { return _mm512_inserti64x4(_mm512_castsi256_si512(low), high, 1); }
static inline __m128i pairs_low(const void *texels, int32_t at) {
    return _mm_loadl_epi64((const __m128i *)((const char *)texels + 4 * (intptr_t)at));
}
/* Loads the texels of two lanes, four apart, and those below, by masked broadcasts: more units do loads and blends than
 * shuffles. */
static inline __m256i quads_two(const void *texels, const void *below, const int32_t *at) {
    __m256i two = _mm256_castsi128_si256(pairs_low(texels, at[0]));
    two = _mm256_mask_broadcastq_epi64(two, 2, pairs_low(below, at[0]));
    two = _mm256_mask_broadcastq_epi64(two, 4, pairs_low(texels, at[4]));
    return _mm256_mask_broadcastq_epi64(two, 8, pairs_low(below, at[4]));
}
static inline __m512i quads_apart(const void *texels, const void *below, const int32_t *at) {
    return halves_join(quads_two(texels, below, at), quads_two(texels, below, at + 8));
}
static inline vi32 inserted_lanes(const int32_t a[V_LANES]) { return _mm512_setr_epi32(a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], a[9], a[10], a[11], a[12], a[13], a[14], a[15]); }
#include "kernels/simd/words_x86.h"

static inline vi32 v_iota(void) {
    return _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}
static inline vi32 v_onebit(void) { return _mm512_sllv_epi32(_mm512_set1_epi32(1), v_iota()); }
/* The lanes whose places follow from one lane's: those of its run, and others that happen to fit. */
static ALWAYS_INLINE __mmask16 run_of(const int32_t *at, int lane, vi32 row) {
    return _mm512_cmpeq_epi32_mask(row, _mm512_set1_epi32(at[lane] - lane));
}
/* Most vectors have at most two runs, which two masked stores write; a loop over runs would be mispredicted at its end. */
static ALWAYS_INLINE int v_store_runs(uint32_t *base, const int32_t *at, vi32 a) {
    __m512i row = _mm512_sub_epi32(v_loadi(at), v_iota());
    __mmask16 first = run_of(at, 0, row), last = run_of(at, 15, row);
    if ((__mmask16)(first | last) != 0xFFFF)
        return 0;
    _mm512_mask_storeu_epi32(base + at[0], first, a);
    _mm512_mask_storeu_epi32(base + at[15] - 15, last, a);
    return 1;
}
/* These load and store lanes 0-7 and 8-15 separately. */
static inline vi32 v_load_halves(const void *low, const void *high) {
    return halves_join(_mm256_loadu_si256((const __m256i *)low), _mm256_loadu_si256((const __m256i *)high));
}
static inline void v_store_halves(void *low, void *high, vi32 a) {
    _mm256_storeu_si256((__m256i *)low, _mm512_castsi512_si256(a));
    _mm256_storeu_si256((__m256i *)high, _mm512_extracti64x4_epi64(a, 1)); /* this goes to memory at once; extracti32x8 takes a register first */
}
static inline vi32 v_loadu8(const uint8_t *p) {
    return _mm512_cvtepu8_epi32(_mm_loadu_si128((const __m128i *)p));
}
static inline vi32 v_gatheri(const void *base, vi32 i) {
    return _mm512_i32gather_epi32(i, base, 4);
}
static inline vi32 v_fetch(const void *base, const int32_t *at) {
    __m256i low = _mm256_set_m128i(fetch_four(base, at + 4), fetch_four(base, at));
    return halves_join(low, _mm256_set_m128i(fetch_four(base, at + 12), fetch_four(base, at + 8)));
}
/* One register holds all bytes: a shuffle of 16-bit words brings each lane the two bytes that contain its own. */
static inline vi32 v_lookup8(const uint8_t bytes[64], vi32 i) {
    __m512i two = _mm512_permutexvar_epi16(_mm512_srli_epi32(i, 1), _mm512_loadu_si512(bytes));
    __m512i shift = _mm512_slli_epi32(_mm512_and_si512(i, _mm512_set1_epi32(1)), 3);
    return _mm512_and_si512(_mm512_srlv_epi32(two, shift), _mm512_set1_epi32(255));
}

/* Up to 128 numbers fit eight registers; looking them up there is faster than a gather. */
typedef struct vtable {
    int quarters; /* of 32 numbers */
    __m512i part[8];
} vtable;
static inline void v_table(const void *base, int count, vtable *out) {
    out->quarters = (count + 31) / 32;
    for (int k = 0; k < 4; k++)
        out->part[k] = v_loadi((const int32_t *)base + 16 * k);
    for (int k = 4; k < 8 && count > 64; k++)
        out->part[k] = v_loadi((const int32_t *)base + 16 * k);
}
static inline vi32 v_lookup(const vtable *t, vi32 i) {
    vi32 found = _mm512_permutex2var_epi32(t->part[0], i, t->part[1]);
    if (t->quarters == 1)
        return found;
    __mmask16 odd = _mm512_test_epi32_mask(i, _mm512_set1_epi32(32));
    found = _mm512_mask_blend_epi32(odd, found, _mm512_permutex2var_epi32(t->part[2], i, t->part[3]));
    if (t->quarters == 2)
        return found;
    vi32 low = _mm512_permutex2var_epi32(t->part[4], i, t->part[5]);
    low = _mm512_mask_blend_epi32(odd, low, _mm512_permutex2var_epi32(t->part[6], i, t->part[7]));
    return _mm512_mask_blend_epi32(_mm512_test_epi32_mask(i, _mm512_set1_epi32(64)), found, low);
}

static inline vmask v_lt(vf32 a, vf32 b) { return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ); }
static inline vmask v_gt(vf32 a, vf32 b) { return _mm512_cmp_ps_mask(a, b, _CMP_GT_OQ); }
static inline vmask v_ge(vf32 a, vf32 b) { return _mm512_cmp_ps_mask(a, b, _CMP_GE_OQ); }
static inline vmask v_eq(vf32 a, vf32 b) { return _mm512_cmp_ps_mask(a, b, _CMP_EQ_OQ); }
static inline vmask v_lt_in(vmask m, vf32 a, vf32 b) { return _mm512_mask_cmp_ps_mask(m, a, b, _CMP_LT_OQ); }
static inline vmask v_eq_in(vmask m, vf32 a, vf32 b) { return _mm512_mask_cmp_ps_mask(m, a, b, _CMP_EQ_OQ); }

static inline vi32 v_sums(vi32 a) {
    const __m512i none = _mm512_setzero_si512();
    a = _mm512_add_epi32(a, _mm512_alignr_epi32(a, none, 15));
    a = _mm512_add_epi32(a, _mm512_alignr_epi32(a, none, 14));
    a = _mm512_add_epi32(a, _mm512_alignr_epi32(a, none, 12));
    return _mm512_add_epi32(a, _mm512_alignr_epi32(a, none, 8));
}
static inline vi32 v_last(vi32 a) { return _mm512_permutexvar_epi32(_mm512_set1_epi32(15), a); }
static inline vmask v_gti(vi32 a, vi32 b) { return _mm512_cmpgt_epi32_mask(a, b); }
static inline vmask v_eqi(vi32 a, vi32 b) { return _mm512_cmpeq_epi32_mask(a, b); }
static inline vmask v_negi(vi32 a) { return _mm512_movepi32_mask(a); }

static inline vf32 v_floor(vf32 a) { return _mm512_roundscale_ps(a, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC); }
static inline vi32 v_floori(vf32 a) { return _mm512_cvt_roundps_epi32(a, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC); }

static inline vf32 v_self(vmask m, vf32 a, vf32 b) { return _mm512_mask_blend_ps(m, b, a); }
static inline vi32 v_seli(vmask m, vi32 a, vi32 b) { return _mm512_mask_blend_epi32(m, b, a); }
static inline vmask v_mand(vmask a, vmask b) { return (vmask)(a & b); }
static inline vmask v_mor(vmask a, vmask b) { return (vmask)(a | b); }
static inline vmask v_mandnot(vmask a, vmask b) { return (vmask)(a & ~b); }
static inline vmask v_mnot(vmask a) { return (vmask)~a; }
static inline uint32_t v_bits(vmask m) { return m; }
static inline int v_count(uint32_t bits) { return __builtin_popcount(bits); }
static inline int v_any(vmask m) { return m != 0; }

static inline vf64 v_widenf(vf32 a, int h) {
    return _mm512_cvtps_pd(h ? _mm512_extractf32x8_ps(a, 1) : _mm512_castps512_ps256(a));
}
static inline vf64 v_wideni(vi32 a, int h) {
    return _mm512_cvtepi32_pd(h ? _mm512_extracti32x8_epi32(a, 1) : _mm512_castsi512_si256(a));
}
static inline vf32 v_narrow(const vf64 a[V_HALVES]) {
    return _mm512_insertf32x8(_mm512_castps256_ps512(_mm512_cvtpd_ps(a[0])), _mm512_cvtpd_ps(a[1]), 1);
}

static inline void v_load_rows(const void *const row[16], vi32 c[8]) {
    __m256i low[8], high[8];
    rows_load8(row, low);
    rows_load8(row + 8, high);
    for (int i = 0; i < 8; i++)
        c[i] = halves_join(low[i], high[i]);
}
static inline void v_store_rows(const vi32 c[16], int32_t *out) {
    for (int part = 0; part < 2; part++) { /* eight lanes */
        __m256i half[16];
        for (int i = 0; i < 16; i++)
            half[i] = part ? _mm512_extracti32x8_epi32(c[i], 1) : _mm512_castsi512_si256(c[i]);
        rows_store8(half, out + 128 * part, 16);
        rows_store8(half + 8, out + 128 * part + 8, 16);
    }
}

static inline vi32 v_span(vi32 at, vi32 length, int h) {
    __m256i at8 = h ? _mm512_extracti32x8_epi32(at, 1) : _mm512_castsi512_si256(at);
    __m256i length8 = h ? _mm512_extracti32x8_epi32(length, 1) : _mm512_castsi512_si256(length);
    __m512i none = _mm512_sub_epi64(_mm512_set1_epi64(64), _mm512_cvtepu32_epi64(length8));
    return _mm512_sllv_epi64(_mm512_srlv_epi64(_mm512_set1_epi64(-1), none), _mm512_cvtepu32_epi64(at8));
}
static inline int v_pack(void *out, vi32 a, uint32_t bits) {
    v_storei(out, _mm512_maskz_compress_epi32((__mmask16)bits, a));
    return __builtin_popcount(bits);
}
static inline int v_pack8(uint8_t *out, vi32 a, uint32_t bits) {
    __m512i packed = _mm512_maskz_compress_epi32((__mmask16)bits, a);
    _mm_storeu_si128((__m128i *)out, _mm512_cvtepi32_epi8(packed));
    return __builtin_popcount(bits);
}
static inline int v_pack16(uint16_t *out, vi32 a, uint32_t bits) {
    __m512i packed = _mm512_maskz_compress_epi32((__mmask16)bits, a);
    _mm256_storeu_si256((__m256i *)out, _mm512_cvtepi32_epi16(packed));
    return __builtin_popcount(bits);
}

typedef __m512i vpick;
static inline vpick v_picker(vi32 index) { return index; }
static inline vf32 v_pick(const void *base, vpick p) {
    return _mm512_permutexvar_ps(p, _mm512_loadu_ps(base));
}

static inline void v_store_pairs(void *out, vi32 a, vi32 b) { /* lane 16 + n of two registers is lane n of the second */
    vi32 at = v_ori(_mm512_srli_epi32(v_iota(), 1), _mm512_slli_epi32(_mm512_and_si512(v_iota(), _mm512_set1_epi32(1)), 4));
    v_storei(out, _mm512_permutex2var_epi32(a, at, b));
    v_storei((int32_t *)out + 16, _mm512_permutex2var_epi32(a, _mm512_add_epi32(at, _mm512_set1_epi32(8)), b));
}

static inline void v_split(vf32 a, vf32 b, vf32 *even, vf32 *odd) {
    __m512i first = _mm512_slli_epi32(v_iota(), 1);
    *even = _mm512_permutex2var_ps(a, first, b);
    *odd = _mm512_permutex2var_ps(a, _mm512_add_epi32(first, _mm512_set1_epi32(1)), b);
}

/* Four registers hold the curve as 16-bit words, so that one shuffle looks up two places of each lane. */
typedef struct vcurve {
    __m512i base[2], rise[2];
} vcurve;
static inline void v_curve(const int32_t pieces[64], vcurve *out) {
    for (int k = 0; k < 2; k++) {
        vi32 low = v_loadi(pieces + 32 * k), high = v_loadi(pieces + 32 * k + 16);
        out->base[k] = halves_join(_mm512_cvtepi32_epi16(_mm512_srli_epi32(low, 16)), _mm512_cvtepi32_epi16(_mm512_srli_epi32(high, 16)));
        out->rise[k] = halves_join(_mm512_cvtepi32_epi16(low), _mm512_cvtepi32_epi16(high));
    }
}
static ALWAYS_INLINE __m512i curve_words(const vcurve *curve, __m512i piece, __m512i t) {
    __m512i base = _mm512_permutex2var_epi16(curve->base[0], piece, curve->base[1]);
    return _mm512_add_epi16(base, _mm512_mulhi_epu16(_mm512_permutex2var_epi16(curve->rise[0], piece, curve->rise[1]), t));
}
static ALWAYS_INLINE vi32 v_curve_rgba(const vcurve *curve, const vi32 place[3]) {
    const __mmask32 high = 0xAAAAAAAA; /* halves of lanes */
    __m512i piece = _mm512_mask_blend_epi16(high, _mm512_srli_epi32(place[0], 16), place[1]);
    __m512i t = _mm512_mask_blend_epi16(high, place[0], _mm512_slli_epi32(place[1], 16));
    __m512i red_green = curve_words(curve, piece, t), blue = curve_words(curve, _mm512_srli_epi32(place[2], 16), place[2]);
    red_green = _mm512_shuffle_epi8(red_green, quarters(pairs_second(0)));
    blue = _mm512_shuffle_epi8(blue, quarters(pairs_second(2)));
    return _mm512_ternarylogic_epi32(red_green, blue, _mm512_set1_epi32((int32_t)0xFF000000), 0xFE); /* or */
}

static inline __m256i pairs_two(const void *texels, uint64_t a, uint64_t b) {
    return _mm256_inserti128_si256(_mm256_castsi128_si256(pairs_one(texels, a)), pairs_one(texels, b), 1);
}
/* Loads the pairs of lanes 0, 4, 8 and 12 of `at`, and those of the lanes after them. */
static ALWAYS_INLINE void rows_pairs(const void *texels, const int32_t *at, __m512i out[2]) {
    uint64_t a = index_two(at), b = index_two(at + 4), c = index_two(at + 8), d = index_two(at + 12);
    out[0] = halves_join(pairs_two(texels, index_first(a), index_first(b)), pairs_two(texels, index_first(c), index_first(d)));
    out[1] = halves_join(pairs_two(texels, index_second(a), index_second(b)), pairs_two(texels, index_second(c), index_second(d)));
}
static ALWAYS_INLINE void v_rows16(const void *texels, const int32_t *top, const int32_t *bottom, vi32 weight, vi32 out[3]) {
    __m512i q[4], each[4], halves = quarters(pairs_halves());
    rows_weights(weight, each);
    for (int i = 0; i < 4; i += 2) {
        __m512i upper[2], lower[2];
        rows_pairs(texels, top + i, upper);
        rows_pairs(texels, bottom + i, lower);
        for (int k = 0; k < 2; k++)
            q[i + k] = _mm512_shuffle_epi8(rows_blend(upper[k], lower[k], each[i + k]), halves);
    }
    channels_apart(q, out);
}

static inline vf32 quarters_join(const __m128 q[4]) {
    __m512 low = _mm512_insertf32x4(_mm512_castps128_ps512(q[0]), q[1], 1);
    return _mm512_insertf32x8(low, _mm256_set_m128(q[3], q[2]), 1);
}
static inline void v_load_pairs(const float *base, const int32_t *at, vf32 *first, vf32 *second) {
    __m128 a[4], b[4];
    for (int quarter = 0; quarter < 4; quarter++)
        floats_four(base, at + 4 * quarter, &a[quarter], &b[quarter]);
    *first = quarters_join(a);
    *second = quarters_join(b);
}
