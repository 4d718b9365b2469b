/* The kernels as backend `sse41`: this file only chooses the vector words. */
#if !defined(__SSE4_1__) || defined(__AVX__)
#error "compile with -msse4.1 and nothing above it"
#endif
#include "kernels/simd/vec_sse41.h"

#define MUJ_TABLE muj_kernels_sse41
#include "extras/mujoco/kernels/table.inl"
