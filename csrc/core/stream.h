/* Non-temporal stores: they pass the caches, 16 bytes at a time. */
#ifndef E3D_STREAM_H
#define E3D_STREAM_H

#include <stdint.h>
#include <string.h>

#if defined(__SSE2__)
#include <emmintrin.h>

static inline void e3d_stream(void *to, const void *from, size_t bytes)
{
    if (((uintptr_t)to | bytes) & 15) {
        memcpy(to, from, bytes);
        return;
    }
    for (size_t at = 0; at < bytes; at += 16)
        _mm_stream_si128((__m128i *)((char *)to + at), _mm_loadu_si128((const __m128i *)((const char *)from + at)));
}

/* Fences non-temporal stores: to be called before other threads are told of them. */
static inline void e3d_stream_end(void) { _mm_sfence(); }

#else

static inline void e3d_stream(void *to, const void *from, size_t bytes) { memcpy(to, from, bytes); }
static inline void e3d_stream_end(void) {}

#endif

#endif
