/* Functions that each operating system provides in its own way: random bytes, processors, threads that take no signals.
 * base/windows/memory.h and large_pages.c are about memory. */
#pragma once

#include <stddef.h>

/* Fills a few bytes unpredictably; 0 if the system cannot do so yet. */
int e3d_random_bytes(void *bytes, size_t count);

/* The number of CPUs that the process may use; at least 1. */
int e3d_usable_processors(void);

/* Calls `start`, whose threads take no signals: these are left to the program's own threads. */
void e3d_without_signals(void (*start)(int), int argument);
