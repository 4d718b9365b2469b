/* The kernels as backend `neon`: this file only chooses the vector words. */
#if !defined(__aarch64__) || defined(__AARCH64EB__)
#error "compile for little-endian AArch64"
#endif
#include "kernels/simd/vec_neon.h"

#define MUJ_TABLE muj_kernels_neon
#include "extras/mujoco/kernels/table.inl"
