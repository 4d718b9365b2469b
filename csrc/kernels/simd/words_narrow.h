/* The vector words that SSE4.1 and AVX2 share beyond words_x86.h: a mask is a vector whose lanes are all ones or 0, and
 * tables lie in memory. A file that includes this one has v_iota, rows_pairs and v_fetch, too. */
#pragma once

#include "kernels/simd/words_x86.h"

static inline vmask v_gti(vi32 a, vi32 b) { return v_asf(MM(cmpgt_epi32)(a, b)); }
static inline vmask v_eqi(vi32 a, vi32 b) { return v_asf(MM(cmpeq_epi32)(a, b)); }
static inline vmask v_negi(vi32 a) { return v_asf(v_sra(a, 31)); }
static inline vf32 v_self(vmask m, vf32 a, vf32 b) { return MM(blendv_ps)(b, a, m); }
static inline vi32 v_seli(vmask m, vi32 a, vi32 b) { return MM(blendv_epi8)(b, a, v_asi(m)); }
static inline vmask v_mand(vmask a, vmask b) { return MM(and_ps)(a, b); }
static inline vmask v_mor(vmask a, vmask b) { return MM(or_ps)(a, b); }
static inline vmask v_mandnot(vmask a, vmask b) { return MM(andnot_ps)(b, a); }
static inline vmask v_mnot(vmask a) { return MM(xor_ps)(a, v_asf(v_seti(-1))); }
static inline uint32_t v_bits(vmask m) { return (uint32_t)MM(movemask_ps)(m); }
static inline int v_any(vmask m) { return MM(movemask_ps)(m) != 0; }

static ALWAYS_INLINE int v_store_runs(uint32_t *base, const int32_t *at, vi32 a) {
    if (v_any(v_mnot(v_eqi(v_loadi(at), v_addi(v_seti(at[0]), v_iota())))))
        return 0;
    v_storei(base + at[0], a);
    return 1;
}
static ALWAYS_INLINE void v_rows16(const void *texels, const int32_t *top, const int32_t *bottom, vi32 weight, vi32 out[3]) {
    vi32 q[4], each[4];
    rows_weights(weight, each);
    for (int i = 0; i < 4; i++)
        q[i] = MM(shuffle_epi8)(rows_blend(rows_pairs(texels, top + i), rows_pairs(texels, bottom + i), each[i]), quarters(pairs_halves()));
    channels_apart(q, out);
}

static inline vi32 curve_rise(vi32 piece, vi32 along) { return MM(mulhi_epu16)(piece, along); }
#include "kernels/simd/tables_memory.h"
