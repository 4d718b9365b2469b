/* Memory in large pages: Linux gives them to aligned ranges that ask for them. */
#include "core/large_pages.h"

#include <stdlib.h>
#include <sys/mman.h>

#define LARGE_PAGE ((size_t)2 << 20)
enum { LINE = 64 };

void *e3d_large_memory(size_t bytes)
{
    void *memory = NULL;
    if (posix_memalign(&memory, bytes < E3D_LARGE_ROOM ? LINE : LARGE_PAGE, bytes))
        return NULL;
#ifdef MADV_HUGEPAGE
    if (bytes >= E3D_LARGE_ROOM)
        madvise(memory, bytes / LARGE_PAGE * LARGE_PAGE, MADV_HUGEPAGE); /* if it fails, pages are small */
#endif
    return memory;
}
