# The Cython mirror of csrc/core/helping.h, for its test.

from libc.stdint cimport int64_t

cdef extern from "core/helping.h" nogil:
    ctypedef struct e3d_helping:
        int alone

    void e3d_helping_note(e3d_helping *h, int64_t used, int64_t passed, int64_t now)
