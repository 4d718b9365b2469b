/* The vector words for NEON, which every AArch64 has: four lanes. vec_1.h says what each means. Minimum and maximum are a
 * comparison and a selection, since NEON's own treat zeros and NaN differently. NEON's conversions saturate, where v_rint
 * gives INT32_MIN. */
#pragma once

#include <arm_neon.h>
#include <stdint.h>
#include <string.h>

#include "base/always_inline.h"
#include "kernels/simd/pack_order.h"

#define V_LANES 4

typedef float32x4_t vf32;
typedef int32x4_t vi32;
typedef uint32x4_t vmask; /* all ones or 0 */
typedef float64x2_t vf64;

static inline vf32 v_setf(float a) { return vdupq_n_f32(a); }
static inline vi32 v_seti(int32_t a) { return vdupq_n_s32(a); }
static inline vi32 four_numbers(int32_t a, int32_t b, int32_t c, int32_t d) { return (vi32){a, b, c, d}; }
static inline vi32 v_iota(void) { return four_numbers(0, 1, 2, 3); }
static inline vi32 v_onebit(void) { return four_numbers(1, 2, 4, 8); }
static inline vf32 v_loadf(const float *p) { return vld1q_f32(p); }
static inline vi32 v_loadi(const void *p) { return vld1q_s32((const int32_t *)p); }
static inline void v_storef(float *p, vf32 a) { vst1q_f32(p, a); }
static inline void v_storei(void *p, vi32 a) { vst1q_s32((int32_t *)p, a); }
static inline void v_streami(void *p, vi32 a) { v_storei(p, a); } /* no intrinsic bypasses the caches */
static inline vi32 v_loadu8(const uint8_t *p) {
    uint32_t four;
    memcpy(&four, p, 4);
    return vreinterpretq_s32_u32(vmovl_u16(vget_low_u16(vmovl_u8(vcreate_u8(four)))));
}
static inline vi32 v_gatheri(const void *base, vi32 i) {
    const int32_t *b = (const int32_t *)base;
    return four_numbers(b[vgetq_lane_s32(i, 0)], b[vgetq_lane_s32(i, 1)], b[vgetq_lane_s32(i, 2)], b[vgetq_lane_s32(i, 3)]);
}
static inline vi32 v_fetch(const void *base, const int32_t *at) {
    const int32_t *b = (const int32_t *)base;
    return four_numbers(b[at[0]], b[at[1]], b[at[2]], b[at[3]]);
}
/* Four registers hold all bytes; an index whose byte has all bits set finds 0. */
static inline vi32 v_lookup8(const uint8_t bytes[64], vi32 i) {
    return vreinterpretq_s32_u8(vqtbl4q_u8(vld1q_u8_x4(bytes), vreinterpretq_u8_s32(vorrq_s32(i, v_seti(~255)))));
}

static inline vf32 v_add(vf32 a, vf32 b) { return vaddq_f32(a, b); }
static inline vf32 v_sub(vf32 a, vf32 b) { return vsubq_f32(a, b); }
static inline vf32 v_mul(vf32 a, vf32 b) { return vmulq_f32(a, b); }
static inline vf32 v_div(vf32 a, vf32 b) { return vdivq_f32(a, b); }
static inline vf32 v_sqrt(vf32 a) { return vsqrtq_f32(a); }
static inline vf32 v_min(vf32 a, vf32 b) { return vbslq_f32(vcltq_f32(a, b), a, b); }
static inline vf32 v_max(vf32 a, vf32 b) { return vbslq_f32(vcgtq_f32(a, b), a, b); }
static inline vmask v_lt(vf32 a, vf32 b) { return vcltq_f32(a, b); }
static inline vmask v_gt(vf32 a, vf32 b) { return vcgtq_f32(a, b); }
static inline vmask v_ge(vf32 a, vf32 b) { return vcgeq_f32(a, b); }
static inline vmask v_eq(vf32 a, vf32 b) { return vceqq_f32(a, b); }
/* Makes the other lanes NaN, for which comparisons are false. Two words about the same lanes share this. */
static inline vf32 or_nan(vmask m, vf32 a) { return vreinterpretq_f32_u32(vornq_u32(vreinterpretq_u32_f32(a), m)); }
static inline vmask v_lt_in(vmask m, vf32 a, vf32 b) { return vcltq_f32(or_nan(m, a), b); }
static inline vmask v_eq_in(vmask m, vf32 a, vf32 b) { return vceqq_f32(or_nan(m, a), b); }

/* Sums and products of signed numbers are those of unsigned ones, which wrap around: arm_neon.h writes them as operators of
 * C, in which signed ones must not overflow. */
static inline uint32x4_t words(vi32 a) { return vreinterpretq_u32_s32(a); }
static inline vi32 of_words(uint32x4_t a) { return vreinterpretq_s32_u32(a); }
static inline vi32 v_addi(vi32 a, vi32 b) { return of_words(vaddq_u32(words(a), words(b))); }
static inline vi32 v_sums(vi32 a) {
    a = v_addi(a, vextq_s32(v_seti(0), a, 3));
    return v_addi(a, vextq_s32(v_seti(0), a, 2));
}
static inline vi32 v_last(vi32 a) { return vdupq_laneq_s32(a, 3); }
static inline vi32 v_subi(vi32 a, vi32 b) { return of_words(vsubq_u32(words(a), words(b))); }
static inline vi32 v_muli(vi32 a, vi32 b) { return of_words(vmulq_u32(words(a), words(b))); }
static inline vi32 v_andi(vi32 a, vi32 b) { return vandq_s32(a, b); }
static inline vi32 v_ori(vi32 a, vi32 b) { return vorrq_s32(a, b); }
static inline vi32 v_xori(vi32 a, vi32 b) { return veorq_s32(a, b); }
static inline vi32 v_mini(vi32 a, vi32 b) { return vminq_s32(a, b); }
static inline vi32 v_maxi(vi32 a, vi32 b) { return vmaxq_s32(a, b); }
static inline vmask v_gti(vi32 a, vi32 b) { return vcgtq_s32(a, b); }
static inline vmask v_eqi(vi32 a, vi32 b) { return vceqq_s32(a, b); }
static inline vmask v_negi(vi32 a) { return vcltzq_s32(a); }

static inline int16x8_t halves(vi32 a) { return vreinterpretq_s16_s32(a); }
static inline vi32 of_halves(int16x8_t a) { return vreinterpretq_s32_s16(a); }
static inline uint16x8_t bare_halves(vi32 a) { return vreinterpretq_u16_s32(a); }
static inline vi32 of_bare_halves(uint16x8_t a) { return vreinterpretq_s32_u16(a); }
static inline vi32 v_add16(vi32 a, vi32 b) { return of_bare_halves(vaddq_u16(bare_halves(a), bare_halves(b))); }
static inline vi32 v_sub16(vi32 a, vi32 b) { return of_bare_halves(vsubq_u16(bare_halves(a), bare_halves(b))); }
static inline vi32 v_min16(vi32 a, vi32 b) { return of_halves(vminq_s16(halves(a), halves(b))); }
static inline vi32 v_max16(vi32 a, vi32 b) { return of_halves(vmaxq_s16(halves(a), halves(b))); }
static inline vi32 v_mul16(vi32 a, vi32 b) { return of_bare_halves(vmulq_u16(bare_halves(a), bare_halves(b))); }
static inline vi32 v_madd16(vi32 a, vi32 b) {
    int32x4_t low = vmull_s16(vget_low_s16(halves(a)), vget_low_s16(halves(b)));
    return vpaddq_s32(low, vmull_high_s16(halves(a), halves(b)));
}
static inline vi32 v_madd8(vi32 a, vi32 b) {
    uint16x8_t bytes = vreinterpretq_u16_s32(a);
    int16x8_t first = vreinterpretq_s16_u16(vandq_u16(bytes, vdupq_n_u16(255))), second = vreinterpretq_s16_u16(vshrq_n_u16(bytes, 8));
    int16x8_t sum = vmulq_s16(first, vshrq_n_s16(vshlq_n_s16(halves(b), 8), 8));
    return of_halves(vmlaq_s16(sum, second, vshrq_n_s16(halves(b), 8)));
}
/* Operators of C, since NEON's shifts by a constant take neither a variable nor 0. */
#define v_sra16(a, n) of_halves(halves(a) >> (n))
#define v_shr16(a, n) vreinterpretq_s32_u16(vreinterpretq_u16_s32(a) >> (n))
#define v_shl(a, n) vreinterpretq_s32_u32(vreinterpretq_u32_s32(a) << (n))
#define v_shr(a, n) vreinterpretq_s32_u32(vreinterpretq_u32_s32(a) >> (n))
#define v_sra(a, n) ((vi32)(a) >> (n))

static inline vf32 v_float(vi32 a) { return vcvtq_f32_s32(a); }
static inline vi32 v_rint(vf32 a) {
    return vbslq_s32(vcltq_f32(a, v_setf(0x1p31f)), vcvtnq_s32_f32(a), v_seti(INT32_MIN));
}
static inline vi32 v_trunc(vf32 a) { return vcvtq_s32_f32(a); }
static inline vf32 v_floor(vf32 a) { return vrndmq_f32(a); }
static inline vi32 v_floori(vf32 a) { return vcvtmq_s32_f32(a); }
static inline vf32 v_asf(vi32 a) { return vreinterpretq_f32_s32(a); }
static inline vi32 v_asi(vf32 a) { return vreinterpretq_s32_f32(a); }

static inline vf32 v_self(vmask m, vf32 a, vf32 b) { return vbslq_f32(m, a, b); }
static inline vi32 v_seli(vmask m, vi32 a, vi32 b) { return vbslq_s32(m, a, b); }
static inline vmask v_mand(vmask a, vmask b) { return vandq_u32(a, b); }
static inline vmask v_mor(vmask a, vmask b) { return vorrq_u32(a, b); }
static inline vmask v_mandnot(vmask a, vmask b) { return vbicq_u32(a, b); }
static inline vmask v_mnot(vmask a) { return vmvnq_u32(a); }
static inline uint32_t v_bits(vmask m) { return vaddvq_u32(vandq_u32(m, vreinterpretq_u32_s32(v_onebit()))); }
static inline int v_count(uint32_t bits) { return pack_count(bits); }
static inline int v_any(vmask m) { return vmaxvq_u32(m) != 0; }

static ALWAYS_INLINE int v_store_runs(uint32_t *base, const int32_t *at, vi32 a) {
    if (vminvq_u32(v_eqi(v_loadi(at), v_addi(v_seti(at[0]), v_iota()))) == 0)
        return 0;
    v_storei(base + at[0], a);
    return 1;
}

#define V_HALVES 2
static inline vf64 v_setd(double a) { return vdupq_n_f64(a); }
static inline vf64 v_widenf(vf32 a, int h) { return h ? vcvt_high_f64_f32(a) : vcvt_f64_f32(vget_low_f32(a)); }
static inline vf64 v_wideni(vi32 a, int h) { return vcvtq_f64_s64(h ? vmovl_high_s32(a) : vmovl_s32(vget_low_s32(a))); }
static inline vf64 v_addd(vf64 a, vf64 b) { return vaddq_f64(a, b); }
static inline vf64 v_subd(vf64 a, vf64 b) { return vsubq_f64(a, b); }
static inline vf64 v_muld(vf64 a, vf64 b) { return vmulq_f64(a, b); }
static inline vf64 v_divd(vf64 a, vf64 b) { return vdivq_f64(a, b); }
static inline vf32 v_narrow(const vf64 a[V_HALVES]) { return vcvt_high_f32_f64(vcvt_f32_f64(a[0]), a[1]); }

/* Lane l of vector c becomes lane c of vector l. */
static ALWAYS_INLINE void turn_four(const vi32 c[4], vi32 out[4]) {
    int64x2_t even01 = vreinterpretq_s64_s32(vtrn1q_s32(c[0], c[1])), odd01 = vreinterpretq_s64_s32(vtrn2q_s32(c[0], c[1]));
    int64x2_t even23 = vreinterpretq_s64_s32(vtrn1q_s32(c[2], c[3])), odd23 = vreinterpretq_s64_s32(vtrn2q_s32(c[2], c[3]));
    out[0] = vreinterpretq_s32_s64(vtrn1q_s64(even01, even23));
    out[1] = vreinterpretq_s32_s64(vtrn1q_s64(odd01, odd23));
    out[2] = vreinterpretq_s32_s64(vtrn2q_s64(even01, even23));
    out[3] = vreinterpretq_s32_s64(vtrn2q_s64(odd01, odd23));
}
static inline void v_load_rows(const void *const row[4], vi32 c[8]) {
    for (int i = 0; i < 8; i += 4) {
        vi32 a[4];
        for (int l = 0; l < 4; l++)
            a[l] = v_loadi((const int32_t *)row[l] + i);
        turn_four(a, c + i);
    }
}
static inline void v_store_rows(const vi32 c[16], int32_t *out) {
    for (int i = 0; i < 16; i += 4) {
        vi32 row[4];
        turn_four(c + i, row);
        for (int l = 0; l < 4; l++)
            v_storei(out + 16 * l + i, row[l]);
    }
}

/* A shift by a negative number goes to the right, and a shift by all 64 bits leaves none. */
static inline vi32 v_span(vi32 at, vi32 length, int h) {
    int64x2_t place = h ? vmovl_high_s32(at) : vmovl_s32(vget_low_s32(at));
    int64x2_t count = h ? vmovl_high_s32(length) : vmovl_s32(vget_low_s32(length));
    uint64x2_t ones = vshlq_u64(vdupq_n_u64(~(uint64_t)0), vsubq_s64(count, vdupq_n_s64(64)));
    return vreinterpretq_s32_u64(vshlq_u64(ones, place));
}

static inline uint8x16_t pack_lanes(vi32 a, uint32_t bits) {
    return vqtbl1q_u8(vreinterpretq_u8_s32(a), vld1q_u8(pack_order[bits]));
}
static inline int v_pack(void *out, vi32 a, uint32_t bits) {
    vst1q_u8((uint8_t *)out, pack_lanes(a, bits));
    return pack_count(bits);
}
static inline int v_pack16(uint16_t *out, vi32 a, uint32_t bits) {
    vst1_u16(out, vmovn_u32(vreinterpretq_u32_u8(pack_lanes(a, bits))));
    return pack_count(bits);
}
static inline int v_pack8(uint8_t *out, vi32 a, uint32_t bits) {
    uint16x4_t four = vmovn_u32(vreinterpretq_u32_u8(pack_lanes(a, bits)));
    uint32_t bytes = vget_lane_u32(vreinterpret_u32_u8(vmovn_u16(vcombine_u16(four, four))), 0);
    memcpy(out, &bytes, 4);
    return pack_count(bits);
}

typedef uint8x16_t vpick;
static inline vpick v_picker(vi32 index) {
    return vreinterpretq_u8_s32(vmlaq_s32(v_seti(0x03020100), index, v_seti(0x04040404)));
}
static inline vf32 v_pick(const void *base, vpick p) { return vreinterpretq_f32_u8(vqtbl1q_u8(vld1q_u8((const uint8_t *)base), p)); }

static inline void v_store_pairs(void *out, vi32 a, vi32 b) {
    v_storei(out, vzip1q_s32(a, b));
    v_storei((int32_t *)out + 4, vzip2q_s32(a, b));
}
static inline void v_split(vf32 a, vf32 b, vf32 *even, vf32 *odd) {
    *even = vuzp1q_f32(a, b);
    *odd = vuzp2q_f32(a, b);
}
static inline void v_load_pairs(const float *base, const int32_t *at, vf32 *first, vf32 *second) {
    v_split(vcombine_f32(vld1_f32(base + at[0]), vld1_f32(base + at[1])), vcombine_f32(vld1_f32(base + at[2]), vld1_f32(base + at[3])), first, second);
}

/* Compares four floats from `at` on, and the fours below them: a byte each, with one bit set or none. */
static inline uint8x16_t floats_sixteen(const float *at, intptr_t pitch, vf32 least) {
    static const uint8_t bit[16] = {1, 2, 4, 8, 16, 32, 64, 128, 1, 2, 4, 8, 16, 32, 64, 128};
    uint16x8_t row[4];
    for (int r = 0; r < 4; r++)
        row[r] = vreinterpretq_u16_u32(vcgeq_f32(vld1q_f32(at + r * pitch), least));
    uint8x16_t upper = vreinterpretq_u8_u16(vuzp1q_u16(row[0], row[1])), lower = vreinterpretq_u8_u16(vuzp1q_u16(row[2], row[3]));
    return vandq_u8(vuzp1q_u8(upper, lower), vld1q_u8(bit));
}
/* Adds neighbours three times: eight bytes become one, and sixteen become a lane's number. */
static ALWAYS_INLINE vi32 v_ge16(const float *base, int32_t pitch, vi32 at, vf32 least) {
    uint8x16_t a = floats_sixteen(base + vgetq_lane_s32(at, 0), pitch, vdupq_laneq_f32(least, 0));
    uint8x16_t b = floats_sixteen(base + vgetq_lane_s32(at, 1), pitch, vdupq_laneq_f32(least, 1));
    uint8x16_t c = floats_sixteen(base + vgetq_lane_s32(at, 2), pitch, vdupq_laneq_f32(least, 2));
    uint8x16_t d = floats_sixteen(base + vgetq_lane_s32(at, 3), pitch, vdupq_laneq_f32(least, 3));
    uint8x16_t fours = vpaddq_u8(vpaddq_u8(a, b), vpaddq_u8(c, d)), bits = vpaddq_u8(fours, fours);
    return vreinterpretq_s32_u32(vmovl_u16(vget_low_u16(vreinterpretq_u16_u8(bits))));
}

static inline vi32 v_rgba(const vi32 c[3]) {
    vi32 none = v_seti(0), pixel = vsliq_n_s32(vmaxq_s32(c[0], none), vmaxq_s32(c[1], none), 8);
    return vsliq_n_s32(vsliq_n_s32(pixel, vmaxq_s32(c[2], none), 16), v_seti(255), 24);
}
static inline vi32 curve_rise(vi32 piece, vi32 along) { return v_shr(v_muli(v_andi(piece, v_seti(0xFFFF)), along), 16); }
#include "kernels/simd/tables_memory.h"

/* Separates red, green and blue of four lanes into a vector each. */
static ALWAYS_INLINE void channels_apart(const uint8x16_t q[4], const uint8_t order[16], vi32 out[3]) {
    vi32 lane[4], channel[4];
    uint8x16_t places = vld1q_u8(order);
    for (int i = 0; i < 4; i++)
        lane[i] = vreinterpretq_s32_u8(vqtbl1q_u8(q[i], places));
    turn_four(lane, channel);
    for (int k = 0; k < 3; k++)
        out[k] = channel[k];
}
static ALWAYS_INLINE void v_quads8(const void *texels, const void *below, const int32_t *at, vi32 out[3]) {
    static const uint8_t order[16] = {0, 8, 4, 12, 1, 9, 5, 13, 2, 10, 6, 14, 3, 11, 7, 15};
    const uint8_t *upper = (const uint8_t *)texels, *lower = (const uint8_t *)below;
    uint8x16_t q[4];
    for (int i = 0; i < 4; i++)
        q[i] = vcombine_u8(vld1_u8(upper + 4 * (intptr_t)at[i]), vld1_u8(lower + 4 * (intptr_t)at[i]));
    channels_apart(q, order, out);
}
/* Weights are multiplied by 2^7, since vqrdmulhq_s16 shifts products by 15. */
static ALWAYS_INLINE void v_rows16(const void *texels, const int32_t *top, const int32_t *bottom, vi32 weight, vi32 out[3]) {
    static const uint8_t order[16] = {0, 1, 8, 9, 2, 3, 10, 11, 4, 5, 12, 13, 6, 7, 14, 15};
    const int16_t *t = (const int16_t *)texels;
    uint8x16_t q[4];
    for (int i = 0; i < 4; i++) {
        int16x8_t upper = vld1q_s16(t + 4 * (intptr_t)top[i]), lower = vld1q_s16(t + 4 * (intptr_t)bottom[i]);
        int16x8_t weights = vdupq_n_s16((int16_t)(weight[i] << 7));
        q[i] = vreinterpretq_u8_s16(vaddq_s16(upper, vqrdmulhq_s16(vsubq_s16(lower, upper), weights)));
    }
    channels_apart(q, order, out);
}
