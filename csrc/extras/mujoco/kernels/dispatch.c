/* The kernels of each backend. */
#include "base/machine.h"
#include "extras/mujoco/kernels/kernels.h"

extern const muj_kernels muj_kernels_scalar, muj_kernels_portable;
#define DECLARE(backend, name, ...) extern const muj_kernels muj_kernels_##name;
E3D_EACH_BUILT_BACKEND(DECLARE)

const muj_kernels *muj_kernels_for(e3d_backend backend)
{
    switch (backend) {
    case E3D_BACKEND_SCALAR: return &muj_kernels_scalar;
#define KERNELS(backend, name, ...) \
    case backend: return &muj_kernels_##name;
        E3D_EACH_BUILT_BACKEND(KERNELS)
    default: return &muj_kernels_portable;
    }
}
