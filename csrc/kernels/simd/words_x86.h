/* The vector words that are one instruction, or the same few, in SSE4.1, AVX2 and AVX-512. vec_1.h says what each means.
 *
 * Whoever includes it has the types, V_LANES, MM(op), which names an instruction for its vectors, MMW(op), which names one for
 * whole registers, inserted_lanes (lanes by inserts, as what was just stored one by one cannot be loaded at once), v_asf, quarters (a register of copies of one of 16 bytes) and quads_apart.
 */
#pragma once

static inline vf32 v_setf(float a) { return MM(set1_ps)(a); }
static inline vi32 v_seti(int32_t a) { return MM(set1_epi32)(a); }
static inline vf32 v_loadf(const float *p) { return MM(loadu_ps)(p); }
static inline vi32 v_loadi(const void *p) { return MMW(loadu)((const vi32 *)p); }
static inline void v_storef(float *p, vf32 a) { MM(storeu_ps)(p, a); }
static inline void v_storei(void *p, vi32 a) { MMW(storeu)((vi32 *)p, a); }
static inline void v_streami(void *p, vi32 a) { MMW(stream)((vi32 *)p, a); }

/* As in vec_1.h, by loads of four floats. */
static ALWAYS_INLINE vi32 v_ge16(const float *base, int32_t pitch, vi32 at, vf32 least)
{
    int32_t places[V_LANES], bits[V_LANES];
    float leasts[V_LANES];
    v_storei(places, at);
    v_storef(leasts, least);
    for (int lane = 0; lane < V_LANES; lane++)
        bits[lane] = floats_sixteen(base + places[lane], pitch, leasts[lane]);
    return inserted_lanes(bits);
}

static inline vf32 v_add(vf32 a, vf32 b) { return MM(add_ps)(a, b); }
static inline vf32 v_sub(vf32 a, vf32 b) { return MM(sub_ps)(a, b); }
static inline vf32 v_mul(vf32 a, vf32 b) { return MM(mul_ps)(a, b); }
static inline vf32 v_div(vf32 a, vf32 b) { return MM(div_ps)(a, b); }
static inline vf32 v_sqrt(vf32 a) { return MM(sqrt_ps)(a); }
static inline vf32 v_min(vf32 a, vf32 b) { return MM(min_ps)(a, b); }
static inline vf32 v_max(vf32 a, vf32 b) { return MM(max_ps)(a, b); }

static inline vi32 v_addi(vi32 a, vi32 b) { return MM(add_epi32)(a, b); }
static inline vi32 v_subi(vi32 a, vi32 b) { return MM(sub_epi32)(a, b); }
static inline vi32 v_muli(vi32 a, vi32 b) { return MM(mullo_epi32)(a, b); }
static inline vi32 v_andi(vi32 a, vi32 b) { return MMW(and)(a, b); }
static inline vi32 v_ori(vi32 a, vi32 b) { return MMW(or)(a, b); }
static inline vi32 v_xori(vi32 a, vi32 b) { return MMW(xor)(a, b); }
static inline vi32 v_mini(vi32 a, vi32 b) { return MM(min_epi32)(a, b); }
static inline vi32 v_maxi(vi32 a, vi32 b) { return MM(max_epi32)(a, b); }
static inline vi32 v_add16(vi32 a, vi32 b) { return MM(add_epi16)(a, b); }
static inline vi32 v_sub16(vi32 a, vi32 b) { return MM(sub_epi16)(a, b); }
static inline vi32 v_min16(vi32 a, vi32 b) { return MM(min_epi16)(a, b); }
static inline vi32 v_max16(vi32 a, vi32 b) { return MM(max_epi16)(a, b); }
static inline vi32 v_mul16(vi32 a, vi32 b) { return MM(mullo_epi16)(a, b); }
static inline vi32 v_madd16(vi32 a, vi32 b) { return MM(madd_epi16)(a, b); }
static inline vi32 v_madd8(vi32 a, vi32 b) { return MM(maddubs_epi16)(a, b); }
#define v_sra16(a, n) MM(srai_epi16)(a, n)
#define v_shr16(a, n) MM(srli_epi16)(a, n)
#define v_shl(a, n) MM(slli_epi32)(a, n)
#define v_shr(a, n) MM(srli_epi32)(a, n)
#define v_sra(a, n) MM(srai_epi32)(a, n)

static inline vf32 v_float(vi32 a) { return MM(cvtepi32_ps)(a); }
static inline vi32 v_rint(vf32 a) { return MM(cvtps_epi32)(a); }
static inline vi32 v_trunc(vf32 a) { return MM(cvttps_epi32)(a); }
static inline vi32 v_asi(vf32 a) { return MMW(castps)(a); }

#define V_HALVES 2
static inline vf64 v_setd(double a) { return MM(set1_pd)(a); }
static inline vf64 v_addd(vf64 a, vf64 b) { return MM(add_pd)(a, b); }
static inline vf64 v_subd(vf64 a, vf64 b) { return MM(sub_pd)(a, b); }
static inline vf64 v_muld(vf64 a, vf64 b) { return MM(mul_pd)(a, b); }
static inline vf64 v_divd(vf64 a, vf64 b) { return MM(div_pd)(a, b); }

static inline vi32 v_rgba(const vi32 c[3]) {
    vi32 low = MM(packs_epi32)(c[0], c[1]), high = MM(packs_epi32)(c[2], v_seti(255));
    return MM(shuffle_epi8)(MM(packus_epi16)(low, high), quarters(pairs_pixels()));
}
/* Separates red, green and blue, which lane 4 n + i has side by side in quarter n of vector i, into a vector each. Unpacking
 * works within quarters. */
static ALWAYS_INLINE void channels_apart(const vi32 q[4], vi32 out[3]) {
    vi32 low01 = MM(unpacklo_epi32)(q[0], q[1]), low23 = MM(unpacklo_epi32)(q[2], q[3]);
    vi32 high01 = MM(unpackhi_epi32)(q[0], q[1]), high23 = MM(unpackhi_epi32)(q[2], q[3]);
    out[0] = MM(unpacklo_epi64)(low01, low23);
    out[1] = MM(unpackhi_epi64)(low01, low23);
    out[2] = MM(unpacklo_epi64)(high01, high23);
}
static ALWAYS_INLINE void v_quads8(const void *texels, const void *below, const int32_t *at, vi32 out[3]) {
    vi32 q[4], order = quarters(pairs_quad());
    for (int i = 0; i < 4; i++)
        q[i] = MM(shuffle_epi8)(quads_apart(texels, below, at + i), order);
    channels_apart(q, out);
}

/* The weights of lanes 4 n + i in quarter n of vector i, for each channel of a pair, multiplied by 2^7 for pmulhrsw. */
static ALWAYS_INLINE void rows_weights(vi32 weight, vi32 each[4]) {
    vi32 twice = v_ori(v_shl(weight, 7), v_shl(weight, 23));
    each[0] = MM(shuffle_epi32)(twice, 0x00);
    each[1] = MM(shuffle_epi32)(twice, 0x55);
    each[2] = MM(shuffle_epi32)(twice, 0xAA);
    each[3] = MM(shuffle_epi32)(twice, 0xFF);
}
static inline vi32 rows_blend(vi32 upper, vi32 lower, vi32 weight) {
    return v_add16(upper, MM(mulhrs_epi16)(v_sub16(lower, upper), weight));
}
