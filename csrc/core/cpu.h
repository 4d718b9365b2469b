/* What is known of the processor beyond its instruction sets. */
#ifndef E3D_CORE_CPU_H
#define E3D_CORE_CPU_H

/* Whether it looks ahead far enough to overlap the long loops of some samples with those of the next: Intel's since Sapphire Rapids
 * do, which are told by AVX512-FP16. */
int e3d_cpu_looks_ahead(void);

#endif
