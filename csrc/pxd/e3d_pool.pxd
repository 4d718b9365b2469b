# The Cython mirror of csrc/core/pool.h, as far as extension modules share the pool.

cdef extern from "core/pool.h" nogil:
    ctypedef void (*e3d_pool_runner)(int threads, void (*work)(void *, int), void *argument)
    void e3d_pool_run(int threads, void (*work)(void *, int), void *argument)
    void e3d_pool_borrow(e3d_pool_runner runner)
