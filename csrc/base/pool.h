/* The process's one thread pool. */
#pragma once

#include <stdint.h>

/* Runs work(argument, worker) on up to `threads` threads at once, and returns when all have returned. worker is 0 .. threads
 * - 1; the calling thread is worker 0. If another caller has the pool, or threads could not be made, fewer run, but at least
 * worker 0. So an atomic counter must share out the work, not the worker's number. */
void e3d_pool_run(int threads, void (*work)(void *argument, int worker), void *argument);

/* Runs task(argument, i) for i = 0 .. tasks - 1, each once, shared among up to `threads` threads. */
void e3d_pool_share(int threads, int tasks, void (*task)(void *argument, int i), void *argument);

/* Nanoseconds in which two threads or more have worked on the jobs that the calling thread has run. */
int64_t e3d_pool_together_ns(void);
