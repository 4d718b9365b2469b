/* The sets of kernels, and what of them this machine can run. */
#ifndef E3D_API_BACKENDS_H
#define E3D_API_BACKENDS_H

#ifdef __cplusplus
extern "C" {
#endif

typedef enum e3d_backend {
    E3D_BACKEND_SCALAR = 0, /* the reference: obvious loops, one thread */
    E3D_BACKEND_PORTABLE,   /* the kernels, one lane wide, any processor */
    E3D_BACKEND_SSE41,
    E3D_BACKEND_AVX2,
    E3D_BACKEND_AVX512,
    E3D_BACKEND_COUNT
} e3d_backend;

const char *e3d_backend_name(e3d_backend backend);
/* 1 where this build has the backend and both CPU and operating system support it. */
int e3d_backend_available(e3d_backend backend);
/* The fastest available kernel backend; never E3D_BACKEND_SCALAR. */
e3d_backend e3d_backend_best(void);
/* CPUs of the affinity mask, capped by the cgroup's quota; at least 1. */
int e3d_thread_count(void);

#ifdef __cplusplus
}
#endif

#endif
