/* The process's one thread pool. */
#ifndef E3D_POOL_H
#define E3D_POOL_H

/* Runs work(argument, worker) on up to `threads` threads at once, worker = 0 .. threads - 1, the calling
 * thread being worker 0, and returns when all have returned. While another caller has the pool, or after
 * threads could not be made, fewer run, at least worker 0: the work must be shared out by an atomic
 * counter, not by the worker's number. */
void e3d_pool_run(int threads, void (*work)(void *argument, int worker), void *argument);

/* Runs task(argument, i) for i = 0 .. tasks - 1, each once, shared out over up to `threads` threads. */
void e3d_pool_share(int threads, int tasks, void (*task)(void *argument, int i), void *argument);

#endif
