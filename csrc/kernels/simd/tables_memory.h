/* Tables and curves that are looked up where they lie: the words v_table, v_lookup, v_curve and v_curve_rgba of processors whose
 * registers don't hold them. Whoever includes it has the other words, curve_fetch and curve_rise.
 */
#ifndef E3D_TABLES_MEMORY_H
#define E3D_TABLES_MEMORY_H

/* A table of at most 128 numbers of 32 bits, of which `count` are looked up often. */
typedef const void *vtable;
static inline void v_table(const void *base, int count, vtable *out) { (void)count; *out = base; }
static inline vi32 v_lookup(const vtable *t, vi32 i) { return v_gatheri(*t, i); }

/* A curve of 64 straight pieces: the base of each in the upper half of a number, the rise in the lower. */
typedef const int32_t *vcurve;
static inline void v_curve(const int32_t pieces[64], vcurve *out) { *out = pieces; }
/* Its values at three places of each lane, over 256, to bytes of one lane, with an alpha of 255. The low half of a place tells how
 * far along a piece it is; of the high half, the low six bits are the number of that piece. */
static inline vi32 v_curve_rgba(const vcurve *curve, const vi32 place[3]) {
    vi32 code[3];
    int32_t at[3][V_LANES];
    for (int k = 0; k < 3; k++)
        v_storei(at[k], v_andi(v_shr(place[k], 16), v_seti(63)));
    for (int k = 0; k < 3; k++) {
        vi32 piece = curve_fetch(*curve, at[k]), rise = curve_rise(piece, v_andi(place[k], v_seti(0xFFFF)));
        code[k] = v_shr(v_addi(v_shr(piece, 16), rise), 8);
    }
    return v_rgba(code);
}

#endif
