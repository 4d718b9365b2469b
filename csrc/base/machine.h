/* The parts that differ from processor to processor: the floating-point control register, and its bits that flush denormals
 * and round towards +inf; how a spinning thread rests; stores past the caches; and which backends this build has. */
#pragma once

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "e3d_backends.h"

/* The backends of this build whose kernels have more than one lane: E3D_EACH_BUILT_BACKEND(X). The build says which processor
 * it is for. */
#if defined(E3D_HAVE_X86)
#include "base/instructions.h"
#define E3D_EACH_BUILT_BACKEND(X) E3D_EACH_X86_BACKEND(X)
#elif defined(E3D_HAVE_AARCH64)
#define E3D_EACH_BUILT_BACKEND(X) E3D_EACH_AARCH64_BACKEND(X)
#else
#define E3D_EACH_BUILT_BACKEND(X)
#endif

#if defined(__x86_64__) || defined(__i386__)

#include <emmintrin.h>
typedef uint32_t e3d_float_control; /* MXCSR */
enum { E3D_FLOAT_FLUSH = 0x8040,
       E3D_FLOAT_ROUND_UP = 0x4000 };
static inline e3d_float_control e3d_float_control_get(void) { return _mm_getcsr(); }
static inline void e3d_float_control_set(e3d_float_control value) { _mm_setcsr(value); }
static inline void e3d_float_control_reset(void) { _mm_setcsr(0x1F80); }
static inline void e3d_pause(void) { _mm_pause(); }

#elif defined(__aarch64__)

typedef uint64_t e3d_float_control; /* FPCR */
enum { E3D_FLOAT_FLUSH = 1 << 24,
       E3D_FLOAT_ROUND_UP = 1 << 22 };
static inline e3d_float_control e3d_float_control_get(void)
{
    e3d_float_control value;
    __asm__ volatile("mrs %0, fpcr" : "=r"(value));
    return value;
}
static inline void e3d_float_control_set(e3d_float_control value) { __asm__ volatile("msr fpcr, %0" : : "r"(value)); }
static inline void e3d_float_control_reset(void) { e3d_float_control_set(0); }
static inline void e3d_pause(void) { __asm__ volatile("yield"); }

#else

#include <fenv.h>
typedef fenv_t e3d_float_control;
enum { E3D_FLOAT_FLUSH = 0,
       E3D_FLOAT_ROUND_UP = 0 }; /* whatever they are */
static inline e3d_float_control e3d_float_control_get(void)
{
    e3d_float_control value;
    fegetenv(&value);
    return value;
}
static inline void e3d_float_control_set(e3d_float_control value) { fesetenv(&value); }
static inline void e3d_float_control_reset(void) { fesetenv(FE_DFL_ENV); }
static inline void e3d_pause(void) {}

#endif

/* Copies by non-temporal stores, 16 bytes at a time. e3d_stream_end must be called before other threads may read the bytes. */
#if defined(__SSE2__)

static inline void e3d_stream(void *to, const void *from, size_t bytes)
{
    if (((uintptr_t)to | bytes) & 15) {
        memcpy(to, from, bytes);
        return;
    }
    for (size_t at = 0; at < bytes; at += 16)
        _mm_stream_si128((__m128i *)((char *)to + at), _mm_loadu_si128((const __m128i *)((const char *)from + at)));
}
static inline void e3d_stream_end(void) { _mm_sfence(); }

#else

static inline void e3d_stream(void *to, const void *from, size_t bytes) { memcpy(to, from, bytes); }
static inline void e3d_stream_end(void) {}

#endif
