/* Clocks, for measurements and for short waits. */
#pragma once

#include <stdint.h>
#include <time.h>

static inline int64_t e3d_read_clock(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (int64_t)t.tv_sec * 1000000000 + t.tv_nsec;
}

/* Nanoseconds since some fixed moment. */
static inline int64_t e3d_now_ns(void) { return e3d_read_clock(CLOCK_MONOTONIC); }

/* Nanoseconds of CPU time that the calling thread has had. WebAssembly has no such clock, and one thread. */
#if defined(__wasi__)
static inline int64_t e3d_thread_ns(void) { return e3d_now_ns(); }
#else
static inline int64_t e3d_thread_ns(void) { return e3d_read_clock(CLOCK_THREAD_CPUTIME_ID); }
#endif
