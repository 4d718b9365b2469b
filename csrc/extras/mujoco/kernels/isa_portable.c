/* The kernels as backend `portable`: this file only chooses the vector words. */
#include "kernels/simd/vec_1.h"

#define MUJ_TABLE muj_kernels_portable
#include "extras/mujoco/kernels/table.inl"
