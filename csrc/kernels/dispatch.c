/* Which table of kernels serves which backend. */
#include "e3d.h"
#include "kernels/kernels.h"

const e3d_kernels *e3d_kernels_for(e3d_backend backend)
{
    if (!e3d_backend_available(backend))
        return NULL;
    switch (backend) {
    case E3D_BACKEND_PORTABLE: return &e3d_kernels_portable;
#ifdef E3D_HAVE_X86
    case E3D_BACKEND_SSE41: return &e3d_kernels_sse41;
    case E3D_BACKEND_AVX2: return &e3d_kernels_avx2;
    case E3D_BACKEND_AVX512: return &e3d_kernels_avx512;
#endif
    default: return NULL;
    }
}
