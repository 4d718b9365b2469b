/* The default floating-point environment around every piece of core code.
 *
 * Another library's flush-to-zero or rounding mode must not change a pixel, and ours must not leak
 * out: every entry and every worker enters and leaves.
 */
#ifndef E3D_FPENV_H
#define E3D_FPENV_H

#include <stdint.h>

#ifdef __FAST_MATH__
#error "engine3d needs IEEE arithmetic: build without -ffast-math"
#endif

#if defined(__x86_64__) || defined(__i386__)
#include <xmmintrin.h>
typedef uint32_t e3d_fpenv;
static inline e3d_fpenv e3d_fpenv_enter(void)
{
    e3d_fpenv saved = _mm_getcsr();
    _mm_setcsr(0x1F80);
    return saved;
}
static inline void e3d_fpenv_leave(e3d_fpenv saved) { _mm_setcsr(saved); }
#elif defined(__aarch64__)
typedef uint64_t e3d_fpenv;
static inline e3d_fpenv e3d_fpenv_enter(void)
{
    e3d_fpenv saved;
    __asm__ volatile("mrs %0, fpcr" : "=r"(saved));
    __asm__ volatile("msr fpcr, %0" : : "r"((uint64_t)0));
    return saved;
}
static inline void e3d_fpenv_leave(e3d_fpenv saved)
{
    __asm__ volatile("msr fpcr, %0" : : "r"(saved));
}
#else
#include <fenv.h>
typedef fenv_t e3d_fpenv;
static inline e3d_fpenv e3d_fpenv_enter(void)
{
    fenv_t saved;
    fegetenv(&saved);
    fesetenv(FE_DFL_ENV);
    return saved;
}
static inline void e3d_fpenv_leave(e3d_fpenv saved) { fesetenv(&saved); }
#endif

#endif
