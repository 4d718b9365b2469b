/* What each operating system gives in its own way: random bytes, processors, threads that take no signals. base/windows/memory.h and
 * large_pages.c have what concerns memory.
 */
#ifndef E3D_SYSTEM_H
#define E3D_SYSTEM_H

#include <stddef.h>

/* Fills a few bytes with what nobody can guess; 0 where the system has none yet. */
int e3d_random_bytes(void *bytes, size_t count);

/* CPUs that the process may use; at least 1. */
int e3d_usable_processors(void);

/* Threads that `start` makes in between take no signals: those stay with the program's own threads. */
void e3d_without_signals(void (*start)(int), int argument);

#endif
