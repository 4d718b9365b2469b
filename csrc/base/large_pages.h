/* Memory in large pages, if the system has them: scattered reads then seldom miss the TLB. A frame of tens of thousands of
 * spheres takes 3 to 4 % less time. */
#pragma once

#include <stddef.h>

/* The least size that asks for large pages. Rounding up a smaller one to whole pages would waste too much. */
#define E3D_LARGE_ROOM ((size_t)4 << 20)

/* Memory that is aligned to a cache line; free() takes it back. NULL when memory is out. */
void *e3d_large_memory(size_t bytes);

/* Asks for large pages for memory that exists already: those that lie in it as a whole. */
void e3d_want_large_pages(void *memory, size_t bytes);

/* Has all small pages of a range mapped at once, if the system can. One by one, on first use, takes longer. */
void e3d_populate(void *memory, size_t bytes);
