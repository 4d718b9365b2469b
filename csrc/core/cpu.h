/* What is known of the processor beyond its instruction sets. */
#ifndef E3D_CORE_CPU_H
#define E3D_CORE_CPU_H

/* Whether a gather of sixteen takes less than sixteen loads and stores: so on Intel's since Sapphire Rapids, which are told by
 * AVX512-FP16, and also look farther ahead than others. Earlier ones' gathers were slowed down by microcode (gather data sampling), and AMD's are made of single loads. */
int e3d_cpu_gathers(void);

#endif
