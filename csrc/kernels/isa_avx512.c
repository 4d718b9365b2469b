/* The kernels as backend `avx512`: this file only chooses the vector words. */
#if !defined(__AVX512F__) || !defined(__AVX512CD__) || !defined(__AVX512BW__) || !defined(__AVX512DQ__) || \
    !defined(__AVX512VL__)
#error "compile with AVX-512 F, CD, BW, DQ and VL"
#endif
#include "kernels/simd/vec_avx512.h"

#define E3D_NARROW_TABLE e3d_kernels_avx2 /* every such CPU has AVX2 */
#define E3D_TABLE e3d_kernels_avx512
#include "kernels/generic/table.inl"
