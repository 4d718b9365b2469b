/* The floating-point environment of docs/exactness: round to nearest even, denormals kept.
 *
 * A caller may have set flush-to-zero or another rounding: it is put aside and given back.
 */
#ifndef E3D_REFERENCE_FLOAT_ENVIRONMENT_H
#define E3D_REFERENCE_FLOAT_ENVIRONMENT_H

#include <stdint.h>

typedef uint64_t ref_float_environment;

#if defined(__x86_64__)
static inline ref_float_environment ref_float_environment_enter(void)
{
    uint32_t saved, wanted = 0x1F80;
    __asm__ volatile("stmxcsr %0" : "=m"(saved));
    __asm__ volatile("ldmxcsr %0" : : "m"(wanted) : "memory");
    return saved;
}

static inline void ref_float_environment_leave(ref_float_environment environment)
{
    uint32_t saved = (uint32_t)environment;
    __asm__ volatile("ldmxcsr %0" : : "m"(saved) : "memory");
}
#elif defined(__aarch64__)
static inline ref_float_environment ref_float_environment_enter(void)
{
    uint64_t saved, wanted = 0;
    __asm__ volatile("mrs %0, fpcr" : "=r"(saved));
    __asm__ volatile("msr fpcr, %0" : : "r"(wanted) : "memory");
    return saved;
}

static inline void ref_float_environment_leave(ref_float_environment environment)
{
    __asm__ volatile("msr fpcr, %0" : : "r"(environment) : "memory");
}
#else
#include <fenv.h>
static inline ref_float_environment ref_float_environment_enter(void)
{
    int rounding = fegetround();
    fesetround(FE_TONEAREST);
    return (ref_float_environment)rounding;
}

static inline void ref_float_environment_leave(ref_float_environment environment)
{
    fesetround((int)environment);
}
#endif

#endif
