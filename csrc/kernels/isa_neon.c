/* The kernels as backend `neon`: this file only chooses the vector words. */
#if !defined(__aarch64__) || defined(__AARCH64EB__)
#error "compile for little-endian AArch64"
#endif
#include "kernels/simd/vec_neon.h"

#define E3D_TABLE e3d_kernels_neon
#include "kernels/generic/table.inl"
