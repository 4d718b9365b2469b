/* The kernels: one table of functions for each instruction set. The plain structs that they work on are in kernels/types/.
 * Every kernel gives the bytes of docs/exactness; tables differ only in speed. Arrays that a kernel reads or writes vector by
 * vector have room for E3D_PAD elements beyond the end; their contents mean nothing. */
#pragma once

#include "base/limits.h"
#include "base/machine.h"
#include "data/mesh/mesh.h"
#include "data/sample_patterns.h"
#include "e3d.h"
#include "e3d_canvas.h"
#include "kernels/types/alpha.h"
#include "kernels/types/ambient_occlusion.h"
#include "kernels/types/bending.h"
#include "kernels/types/casters.h"
#include "kernels/types/fog.h"
#include "kernels/types/fragments.h"
#include "kernels/types/lens.h"
#include "kernels/types/lobe.h"
#include "kernels/types/msaa_mixed.h"
#include "kernels/types/records.h"
#include "kernels/types/samples.h"
#include "kernels/types/shown.h"
#include "kernels/types/texture_slots.h"
#include "kernels/types/ui.h"
#include "kernels/types/vertices.h"
#include "kernels/types/visible.h"

#define E3D_KERNEL(type, name, parameters) type(*name) parameters;
typedef struct e3d_kernels {
#include "kernels/each_kernel.inl"
} e3d_kernels;
#undef E3D_KERNEL

/* NULL for E3D_BACKEND_SCALAR, and if this build or CPU lacks the backend. */
const e3d_kernels *e3d_kernels_for(e3d_backend backend);

extern const e3d_kernels e3d_kernels_portable;
#define E3D_DECLARE_KERNELS(backend, name, ...) extern const e3d_kernels e3d_kernels_##name;
E3D_EACH_BUILT_BACKEND(E3D_DECLARE_KERNELS)
