/* Tables and curves that are looked up in memory: the words v_table, v_lookup, v_curve and v_curve_rgba of processors whose
 * registers don't hold them. A file that includes this one has the other words, v_fetch and curve_rise. */
#pragma once

/* A table of at most 128 numbers of 32 bits, of which `count` are looked up often. */
typedef const void *vtable;
static inline void v_table(const void *base, int count, vtable *out) { (void)count; *out = base; }
static inline vi32 v_lookup(const vtable *t, vi32 i) { return v_gatheri(*t, i); }

/* A curve of 64 linear pieces: each number has the base of a piece in the upper half, and its rise in the lower one. */
typedef const int32_t *vcurve;
static inline void v_curve(const int32_t pieces[64], vcurve *out) { *out = pieces; }
/* The curve's values at three places of each lane, over 256, as bytes of one lane, with an alpha of 255. The low half of a
 * place is the position along a piece; the low six bits of the high half are the number of that piece. */
static inline vi32 v_curve_rgba(const vcurve *curve, const vi32 place[3]) {
    vi32 code[3];
    int32_t at[3][V_LANES];
    for (int k = 0; k < 3; k++)
        v_storei(at[k], v_andi(v_shr(place[k], 16), v_seti(63)));
    for (int k = 0; k < 3; k++) {
        vi32 piece = v_fetch(*curve, at[k]), rise = curve_rise(piece, v_andi(place[k], v_seti(0xFFFF)));
        code[k] = v_shr(v_addi(v_shr(piece, 16), rise), 8);
    }
    return v_rgba(code);
}
