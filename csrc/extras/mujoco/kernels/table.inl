/* All kernels of one instruction set, and their table MUJ_TABLE. */
#include "extras/mujoco/kernels/kernels.h"

#include "extras/mujoco/kernels/geometry.inl"
#include "extras/mujoco/kernels/power.inl"
#include "extras/mujoco/kernels/light.inl"
#include "extras/mujoco/kernels/texels.inl"
#include "extras/mujoco/kernels/shade.inl"

extern const muj_kernels MUJ_TABLE;
const muj_kernels MUJ_TABLE = {kernel_transform, kernel_choose, kernel_draw, kernel_cover, kernel_light, kernel_shade};
