/* The backends, and which of them this machine can run. */
#pragma once

#include "e3d_options.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The kernels for x86-64, the fastest last: X(ENUMERATOR, name, the instructions that they use, by the names that compilers have
 * for them). setup.py reads this list: it compiles kernels/isa_NAME.c for these instructions. */
#define E3D_EACH_X86_BACKEND(X) \
    X(E3D_BACKEND_SSE41, sse41, HAS("sse4.1")) \
    X(E3D_BACKEND_AVX2, avx2, HAS("avx2")) \
    X(E3D_BACKEND_AVX512, avx512, \
      HAS("avx512f") && HAS("avx512cd") && HAS("avx512bw") && HAS("avx512dq") && HAS("avx512vl"))

/* The kernels for AArch64, in the same form; every such processor has NEON. */
#define E3D_EACH_AARCH64_BACKEND(X) X(E3D_BACKEND_NEON, neon, 1)

/* SCALAR is the reference: plain loops on one thread. PORTABLE is the kernels with vectors of one lane, for any processor. */
#define E3D_EACH_BACKEND(X) \
    X(E3D_BACKEND_SCALAR, scalar) \
    X(E3D_BACKEND_PORTABLE, portable) \
    E3D_EACH_X86_BACKEND(X) \
    E3D_EACH_AARCH64_BACKEND(X)

typedef enum e3d_backend { E3D_EACH_BACKEND(E3D_ENUMERATOR) E3D_BACKEND_COUNT } e3d_backend;

/* Returns "unknown" for any other number. */
const char *e3d_backend_name(e3d_backend backend);
/* Returns 1 if the backend is compiled in, and the processor and the operating system support it. */
int e3d_backend_available(e3d_backend backend);
/* The fastest available kernel backend; never E3D_BACKEND_SCALAR. */
e3d_backend e3d_backend_best(void);
/* CPUs of the affinity mask, capped by the cgroup's quota; at least 1. */
int e3d_thread_count(void);

#ifdef __cplusplus
}
#endif
