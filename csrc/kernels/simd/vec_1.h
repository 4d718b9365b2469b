/* The vector words, one lane wide: plain C for any processor (backend `portable`).
 *
 * Every word means the same in each vec_*.h: see docs/exactness for min, max and the conversions.
 * v_min(a, b) = a < b ? a : b, v_max(a, b) = a > b ? a : b; v_rint is to nearest even, v_trunc
 * towards zero, of values that fit int32; of others v_rint gives INT32_MIN. A zero of v_floor has either sign.
 */
#pragma once

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/always_inline.h"

#define V_LANES 1

typedef float vf32;
typedef int32_t vi32;
typedef uint32_t vmask; /* 0 or 1 */

static inline vf32 v_setf(float a) { return a; }
static inline vi32 v_seti(int32_t a) { return a; }
static inline vi32 v_iota(void) { return 0; }
static inline vi32 v_onebit(void) { return 1; } /* 1 << lane */
static inline vf32 v_loadf(const float *p) { return *p; }
static inline vi32 v_loadi(const void *p) { int32_t v; memcpy(&v, p, 4); return v; }
static inline void v_storef(float *p, vf32 a) { *p = a; }
static inline void v_storei(void *p, vi32 a) { memcpy(p, &a, 4); }
/* Stores each lane at its place, if that is faster than one by one, as for neighbouring places; else stores nothing and
 * returns 0. */
static ALWAYS_INLINE int v_store_runs(uint32_t *base, const int32_t *at, vi32 a) { base[at[0]] = (uint32_t)a; return 1; }
/* Stores past the caches; the place is aligned to a vector. */
static inline void v_streami(void *p, vi32 a) { memcpy(p, &a, 4); }
static inline vi32 v_loadu8(const uint8_t *p) { return *p; }
/* Looks up bytes in 64, which are aligned to four; reads whole fours, or all. */
static inline vi32 v_lookup8(const uint8_t bytes[64], vi32 i) { return bytes[i]; }
static inline vi32 v_gatheri(const void *base, vi32 i) { return v_loadi((const char *)base + 4 * (intptr_t)i); }
/* Gathers from places that lie in memory, by single loads. */
static inline vi32 v_fetch(const void *base, const int32_t *at) { return v_gatheri(base, at[0]); }

/* Compares four floats from base[at] on, and the fours below them in rows `pitch` floats apart, with a number: a bit each,
 * set if the float is no less. */
static inline vi32 v_ge16(const float *base, int32_t pitch, vi32 at, vf32 least) {
    int32_t bits = 0;
    for (int k = 0; k < 16; k++)
        bits |= (int32_t)(base[at + k / 4 * pitch + k % 4] >= least) << k;
    return bits;
}

static inline vf32 v_add(vf32 a, vf32 b) { return a + b; }
static inline vf32 v_sub(vf32 a, vf32 b) { return a - b; }
static inline vf32 v_mul(vf32 a, vf32 b) { return a * b; }
static inline vf32 v_div(vf32 a, vf32 b) { return a / b; }
static inline vf32 v_sqrt(vf32 a) { return sqrtf(a); }
static inline vf32 v_min(vf32 a, vf32 b) { return a < b ? a : b; }
static inline vf32 v_max(vf32 a, vf32 b) { return a > b ? a : b; }
static inline vmask v_lt(vf32 a, vf32 b) { return a < b; }
static inline vmask v_gt(vf32 a, vf32 b) { return a > b; }
static inline vmask v_ge(vf32 a, vf32 b) { return a >= b; }
static inline vmask v_eq(vf32 a, vf32 b) { return a == b; }
/* Compares among the lanes of a mask. */
static inline vmask v_lt_in(vmask m, vf32 a, vf32 b) { return m & (a < b); }
static inline vmask v_eq_in(vmask m, vf32 a, vf32 b) { return m & (a == b); }

static inline vi32 v_addi(vi32 a, vi32 b) { return (int32_t)((uint32_t)a + (uint32_t)b); }
/* Prefix sums: each lane plus all below it. */
static inline vi32 v_sums(vi32 a) { return a; }
/* Copies the last lane to all. */
static inline vi32 v_last(vi32 a) { return a; }
static inline vi32 v_subi(vi32 a, vi32 b) { return (int32_t)((uint32_t)a - (uint32_t)b); }
static inline vi32 v_muli(vi32 a, vi32 b) { return (int32_t)((uint32_t)a * (uint32_t)b); }
static inline vi32 v_andi(vi32 a, vi32 b) { return a & b; }
static inline vi32 v_ori(vi32 a, vi32 b) { return a | b; }
static inline vi32 v_xori(vi32 a, vi32 b) { return a ^ b; }
static inline vi32 v_mini(vi32 a, vi32 b) { return a < b ? a : b; }
static inline vi32 v_maxi(vi32 a, vi32 b) { return a > b ? a : b; }
static inline vmask v_gti(vi32 a, vi32 b) { return a > b; }
static inline vmask v_eqi(vi32 a, vi32 b) { return a == b; }
static inline vmask v_negi(vi32 a) { return a < 0; }
/* The signed lower and upper 16-bit halves. */
static inline int32_t half_low(vi32 a) { return (int16_t)a; }
static inline int32_t half_high(vi32 a) { return (int16_t)(a >> 16); }
static inline vi32 halves_of(int32_t low, int32_t high) { return (int32_t)((uint16_t)low | (uint32_t)high << 16); }
static inline vi32 v_add16(vi32 a, vi32 b) { return halves_of(half_low(a) + half_low(b), half_high(a) + half_high(b)); }
static inline vi32 v_sub16(vi32 a, vi32 b) { return halves_of(half_low(a) - half_low(b), half_high(a) - half_high(b)); }
static inline vi32 v_min16(vi32 a, vi32 b) {
    return halves_of(v_mini(half_low(a), half_low(b)), v_mini(half_high(a), half_high(b)));
}
static inline vi32 v_max16(vi32 a, vi32 b) {
    return halves_of(v_maxi(half_low(a), half_low(b)), v_maxi(half_high(a), half_high(b)));
}
static inline vi32 v_mul16(vi32 a, vi32 b) { return halves_of(half_low(a) * half_low(b), half_high(a) * half_high(b)); }
#define v_sra16(a, n) halves_of(half_low(a) >> (n), half_high(a) >> (n))
#define v_shr16(a, n) halves_of((uint16_t)half_low(a) >> (n), (uint16_t)half_high(a) >> (n))
/* Products of the signed 16-bit halves, added in pairs. */
static inline vi32 v_madd16(vi32 a, vi32 b) {
    return v_addi(half_low(a) * half_low(b), half_high(a) * half_high(b));
}
/* Products of bytes, unsigned in a and signed in b, added in pairs; the sums must fit signed 16 bits. */
static inline vi32 v_madd8(vi32 a, vi32 b) {
    uint32_t x = (uint32_t)a, y = (uint32_t)b;
    return halves_of((int32_t)(x & 255u) * (int8_t)y + (int32_t)(x >> 8 & 255u) * (int8_t)(y >> 8),
                     (int32_t)(x >> 16 & 255u) * (int8_t)(y >> 16) + (int32_t)(x >> 24) * (int8_t)(y >> 24));
}
#define v_shl(a, n) ((int32_t)((uint32_t)(a) << (n)))
#define v_shr(a, n) ((int32_t)((uint32_t)(a) >> (n)))
#define v_sra(a, n) ((int32_t)(a) >> (n))

static inline vf32 v_float(vi32 a) { return (float)a; }
static inline vi32 v_rint(vf32 a) { return a >= -0x1p31f && a < 0x1p31f ? (int32_t)lrintf(a) : INT32_MIN; }
static inline vi32 v_trunc(vf32 a) { return (int32_t)a; }
static inline vf32 v_floor(vf32 a) { return floorf(a); }
/* Rounds down, for values that fit int32. */
static inline vi32 v_floori(vf32 a) { return (int32_t)a - ((float)(int32_t)a > a); }
static inline vf32 v_asf(vi32 a) { float f; memcpy(&f, &a, 4); return f; }
static inline vi32 v_asi(vf32 a) { int32_t i; memcpy(&i, &a, 4); return i; }

static inline vf32 v_self(vmask m, vf32 a, vf32 b) { return m ? a : b; }
static inline vi32 v_seli(vmask m, vi32 a, vi32 b) { return m ? a : b; }
static inline vmask v_mand(vmask a, vmask b) { return a & b; }
static inline vmask v_mor(vmask a, vmask b) { return a | b; }
static inline vmask v_mandnot(vmask a, vmask b) { return a & (b ^ 1u); } /* a and not b */
static inline vmask v_mnot(vmask a) { return a ^ 1u; }
static inline uint32_t v_bits(vmask m) { return m; }
/* Counts the set bits. */
static inline int v_count(uint32_t bits) { return (int)bits; }
static inline int v_any(vmask m) { return m != 0; }

/* Doubles: a vector holds half as many lanes; half h of V_HALVES. */
#define V_HALVES 1
typedef double vf64;
static inline vf64 v_setd(double a) { return a; }
static inline vf64 v_widenf(vf32 a, int h) { (void)h; return a; }
static inline vf64 v_wideni(vi32 a, int h) { (void)h; return a; }
static inline vf64 v_addd(vf64 a, vf64 b) { return a + b; }
static inline vf64 v_subd(vf64 a, vf64 b) { return a - b; }
static inline vf64 v_muld(vf64 a, vf64 b) { return a * b; }
static inline vf64 v_divd(vf64 a, vf64 b) { return a / b; }
static inline vf32 v_narrow(const vf64 a[V_HALVES]) { return (float)a[0]; } /* Narrows; rounds to nearest even. */

/* Writes lane l of column c to out[16 * l + c]. */
static inline void v_store_rows(const vi32 c[16], int32_t *out) { memcpy(out, c, 64); }
/* Loads rows: word c of row[l] becomes lane l of column c; there are eight. */
static inline void v_load_rows(const void *const row[1], vi32 c[8]) { memcpy(c, row[0], 32); }

/* Sets `length` bits from bit `at` on in each lane's 64-bit word, up to its end. The words of all lanes fill two vectors;
 * returns half h. */
static inline vi32 v_span(vi32 at, vi32 length, int h) {
    uint64_t bits = length ? ~(uint64_t)0 >> (64 - length) << at : 0;
    vi32 words[2];
    memcpy(words, &bits, sizeof bits);
    return words[h];
}
/* Writes the lanes whose bits are set, packed; returns how many. A whole vector is written. */
static inline int v_pack(void *out, vi32 a, uint32_t bits) { memcpy(out, &a, 4); return (int)bits; }
/* The same for numbers below 256, to bytes. */
static inline int v_pack8(uint8_t *out, vi32 a, uint32_t bits) { *out = (uint8_t)a; return (int)bits; }
/* The same for numbers below 65536, to halves. */
static inline int v_pack16(uint16_t *out, vi32 a, uint32_t bits) { *out = (uint16_t)a; return (int)bits; }

/* Elements base[index[lane]] of an array, 0 <= index < V_LANES; an index is prepared once for many arrays. */
typedef int32_t vpick;
static inline vpick v_picker(vi32 index) { return index; }
static inline vf32 v_pick(const void *base, vpick p) { float v; memcpy(&v, (const char *)base + 4 * p, 4); return v; }

/* Loads base[at[lane]], and the number after it. */
static inline void v_load_pairs(const float *base, const int32_t *at, vf32 *first, vf32 *second) {
    *first = base[at[0]];
    *second = base[at[0] + 1];
}

/* Stores the first lanes of a and b, then the second ones, and so on. */
static inline void v_store_pairs(void *out, vi32 a, vi32 b) {
    memcpy(out, &a, 4);
    memcpy((char *)out + 4, &b, 4);
}

/* Splits the lanes of a, followed by those of b: the first, third and so on; and the others. */
static inline void v_split(vf32 a, vf32 b, vf32 *even, vf32 *odd) { *even = a; *odd = b; }

/* Packs red, green and blue, at most 255, into bytes of one lane, with an alpha of 255; numbers below 0 count as 0. */
static inline vi32 v_rgba(const vi32 c[3]) {
    uint32_t pixel = 0xFF000000u;
    for (int k = 0; k < 3; k++)
        pixel |= (uint32_t)(c[k] > 0 ? c[k] : 0) << (8 * k);
    return (vi32)pixel;
}

static inline vi32 curve_rise(vi32 piece, vi32 along) { return (int32_t)(((uint32_t)piece & 0xFFFF) * (uint32_t)along >> 16); }
#include "kernels/simd/tables_memory.h"

/* Loads the 8-bit texels at[lane] and at[lane] + 1, and those below: for red, green and blue each, a lane has the bytes upper
 * left, lower left, upper right, lower right. Sixteen bytes are read from each left texel on. */
static ALWAYS_INLINE void v_quads8(const void *texels, const void *below, const int32_t *at, vi32 out[3]) {
    const uint8_t *t = (const uint8_t *)texels + 4 * (intptr_t)at[0], *b = (const uint8_t *)below + 4 * (intptr_t)at[0];
    for (int k = 0; k < 3; k++)
        out[k] = (int32_t)(t[k] | (uint32_t)b[k] << 8 | (uint32_t)t[4 + k] << 16 | (uint32_t)b[4 + k] << 24);
}

/* Blends two texels above each other, with channels of 15 bits; weights are below 256. */
static inline uint32_t row_blend(int32_t upper, int32_t lower, vi32 weight) { return (uint32_t)(upper + (((lower - upper) * weight + 128) >> 8)); }
/* Blends the texels at top[lane] with those at bottom[lane], and likewise the next ones: for red, green and blue each, the
 * left texel is in the low half, the right one in the high half. */
static ALWAYS_INLINE void v_rows16(const void *texels, const int32_t *top, const int32_t *bottom, vi32 weight, vi32 out[3]) {
    const int16_t *t = (const int16_t *)texels + 4 * (intptr_t)top[0], *b = (const int16_t *)texels + 4 * (intptr_t)bottom[0];
    for (int k = 0; k < 3; k++)
        out[k] = (int32_t)(row_blend(t[k], b[k], weight) | row_blend(t[4 + k], b[4 + k], weight) << 16);
}
