/* Memory in large pages, where the system gives them: what is read here and there finds its pages at once. */
#ifndef E3D_LARGE_PAGES_H
#define E3D_LARGE_PAGES_H

#include <stddef.h>

/* From so many bytes on they are worth it; less would round up too much. */
#define E3D_LARGE_ROOM ((size_t)4 << 20)

/* Aligned to a line of the cache; free() takes it back. NULL when memory is out. */
void *e3d_large_memory(size_t bytes);

#endif
