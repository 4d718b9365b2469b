/* What is known of the processor beyond its instruction sets. */
#ifndef E3D_CORE_CPU_H
#define E3D_CORE_CPU_H

/* Whether the out-of-order window is large enough to overlap a long loop body with the next iteration's. That of Intel's processors
 * since Sapphire Rapids is, which AVX512-FP16 identifies. On Zen 4 two short loops are faster: 2.86 instead of 3.04 ms a frame. */
int e3d_cpu_looks_ahead(void);

#endif
