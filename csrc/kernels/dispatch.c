/* The table of kernels of each backend. */
#include "base/machine.h"
#include "e3d.h"
#include "kernels/kernels.h"

const e3d_kernels *e3d_kernels_for(e3d_backend backend)
{
    if (!e3d_backend_available(backend))
        return NULL;
    switch (backend) {
    case E3D_BACKEND_PORTABLE: return &e3d_kernels_portable;
#define KERNELS(backend, name, ...) \
    case backend: return &e3d_kernels_##name;
        E3D_EACH_BUILT_BACKEND(KERNELS)
    default: return NULL;
    }
}
