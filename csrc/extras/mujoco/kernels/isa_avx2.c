/* The kernels as backend `avx2`: this file only chooses the vector words. */
#if !defined(__AVX2__) || defined(__FMA__) || defined(__AVX512F__)
#error "compile with -mavx2 alone"
#endif
#include "kernels/simd/vec_avx2.h"

#define MUJ_TABLE muj_kernels_avx2
#include "extras/mujoco/kernels/table.inl"
