# Part of rasterizer.pyx: a lock that is held while a renderer draws.
#
# In:  `with`. Out: the lock, and a note that it is held; or an error.
# Always: no signal handler runs between the two, nor between the end of the block and their end, because this is C.
# What Python has for it takes a microsecond, of the thirty that a small frame takes.

from threading import RLock

WITHIN = (
    "the renderer is drawing already, and this comes from within that frame (a signal handler, or "
    "what a frame calls): leave a note and draw after the frame, or draw with another Renderer"
)


cdef class Turn:
    """Base of the turns of a renderer."""

    cdef public object lock  # reentrant, so that a nested call gets an error instead of a deadlock
    cdef object held  # the lock that was taken: a fork within the block leaves another one
    cdef public bint is_drawing, is_forked

    def __cinit__(self):
        self.lock = RLock()

    def __enter__(self):
        lock = self.lock
        lock.acquire()
        if self.is_drawing or self.is_forked:
            lock.release()
            raise RendererBusyError(FORKED if self.is_forked else WITHIN)
        self.held, self.is_drawing = lock, True

    def __exit__(self, *exception):
        lock, self.held, self.is_drawing = self.held, None, False
        lock.release()
