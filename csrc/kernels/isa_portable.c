/* The kernels as backend `portable`: this file only chooses the vector words. */
#include "kernels/simd/vec_1.h"

#define E3D_TABLE e3d_kernels_portable
#include "kernels/generic/table.inl"
