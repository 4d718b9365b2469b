/* Memory in large pages: Linux gives them to aligned ranges that ask for them. */
#include "base/large_pages.h"

#include <stdint.h>
#include <stdlib.h>
#if defined(__linux__)
#include <sys/mman.h>
#ifndef MADV_POPULATE_WRITE
#define MADV_POPULATE_WRITE 23
#endif
#endif

#define LARGE_PAGE ((size_t)2 << 20)
enum { LINE = 64 };

void *e3d_large_memory(size_t bytes)
{
    void *memory = NULL;
    if (posix_memalign(&memory, bytes < E3D_LARGE_ROOM ? LINE : LARGE_PAGE, bytes))
        return NULL;
    e3d_want_large_pages(memory, bytes);
    return memory;
}

void e3d_want_large_pages(void *memory, size_t bytes)
{
#ifdef MADV_HUGEPAGE
    size_t skip = -(uintptr_t)memory % LARGE_PAGE;
    if (bytes >= E3D_LARGE_ROOM)
        madvise((char *)memory + skip, (bytes - skip) / LARGE_PAGE * LARGE_PAGE, MADV_HUGEPAGE); /* if it fails, pages are small */
#else
    (void)memory, (void)bytes;
#endif
}

void e3d_populate(void *memory, size_t bytes)
{
#ifdef MADV_POPULATE_WRITE
    madvise(memory, bytes, MADV_POPULATE_WRITE);
#else
    (void)memory, (void)bytes;
#endif
}
