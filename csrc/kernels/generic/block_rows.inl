/* Vectors over the rows of a block of 8 x 8 samples. Up to eight lanes lie in one row; of sixteen lanes, eight lie in an even
 * row and eight in the next. With one row of eight lanes, as in AVX2, a fill from back to front took AVX-512 3.1 instead of
 * 2.4 ms. */
#pragma once

#include "base/limits.h"

enum { ROW_LANES = V_LANES < 8 ? V_LANES : 8,
       ROWS = V_LANES / ROW_LANES };
enum { ROW_SHIFT = ROW_LANES == 8 ? 3 : ROW_LANES == 4 ? 2
                                                       : 0 };

static inline vi32 rows_x(void) { return ROWS > 1 ? v_andi(v_iota(), v_seti(ROW_LANES - 1)) : v_iota(); }
static inline vi32 rows_y(void) { return ROWS > 1 ? v_shr(v_iota(), 3) : v_seti(0); }

/* x * a + y * b for each lane's column x and row y in the vector. */
static inline vi32 rows_step(int32_t a, int32_t b)
{
    vi32 along = v_muli(rows_x(), v_seti(a));
    return ROWS > 1 ? v_addi(along, v_muli(rows_y(), v_seti(b))) : along;
}

#if V_LANES > 8
static inline vi32 rows_loadi(const void *p) { return v_load_halves(p, (const int32_t *)p + E3D_TILE); }
static inline void rows_storei(void *p, vi32 a) { v_store_halves(p, (int32_t *)p + E3D_TILE, a); }
static inline vf32 rows_loadf(const float *p) { return v_asf(rows_loadi(p)); }
static inline void rows_storef(float *p, vf32 a) { rows_storei(p, v_asi(a)); }
#else
static inline vi32 rows_loadi(const void *p) { return v_loadi(p); }
static inline void rows_storei(void *p, vi32 a) { v_storei(p, a); }
static inline vf32 rows_loadf(const float *p) { return v_loadf(p); }
static inline void rows_storef(float *p, vf32 a) { v_storef(p, a); }
#endif

/* The offset of a lane's sample from the vector's first, in the tile. */
static inline int rows_sample(int lane) { return lane / ROW_LANES * E3D_TILE + lane % ROW_LANES; }
