/* Memory on Windows, where free() takes back only what malloc() gave: all functions of this kind align allocations to a cache
 * line. There, the build includes this file before all others. */
#pragma once

#if defined __x86_64__ && !defined __clang__
#error "gcc does not align the stack for vectors of AVX on Windows: build with clang or zig"
#endif

#define _CRT_RAND_S /* rand_s, for system.c: stdlib.h is read here first */
#include <malloc.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { E3D_WINDOWS_LINE = 64 };

static inline void *e3d_windows_calloc(size_t count, size_t size)
{
    if (size && count > SIZE_MAX / size)
        return NULL;
    void *memory = _aligned_malloc(count * size, E3D_WINDOWS_LINE);
    return memory ? memset(memory, 0, count * size) : NULL;
}

/* As in POSIX, but an alignment of more than a cache line is not guaranteed. */
static inline int e3d_windows_memalign(void **memory, size_t alignment, size_t bytes)
{
    (void)alignment;
    *memory = _aligned_malloc(bytes, E3D_WINDOWS_LINE);
    return *memory == NULL;
}

#define malloc(bytes) _aligned_malloc(bytes, E3D_WINDOWS_LINE)
#define calloc(count, size) e3d_windows_calloc(count, size)
#define realloc(memory, bytes) _aligned_realloc(memory, bytes, E3D_WINDOWS_LINE)
#define free(memory) _aligned_free(memory)
#define posix_memalign(memory, alignment, bytes) e3d_windows_memalign(memory, alignment, bytes)
