/* The kernels as backend `avx512`: this file only chooses the vector words. */
#if !defined(__AVX512F__) || !defined(__AVX512CD__) || !defined(__AVX512BW__) || !defined(__AVX512DQ__) || !defined(__AVX512VL__)
#error "compile with AVX-512 F, CD, BW, DQ and VL"
#endif
#include "kernels/simd/vec_avx512.h"

#define MUJ_TABLE muj_kernels_avx512
#include "extras/mujoco/kernels/table.inl"
