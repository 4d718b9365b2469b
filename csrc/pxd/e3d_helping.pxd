# The Cython mirror of csrc/core/helping.h, for its test.

from libc.stdint cimport int64_t

cdef extern from "core/helping.h" nogil:
    ctypedef struct e3d_job_times:
        int64_t own
        int64_t all
        int64_t working
        int64_t passed

    ctypedef struct e3d_helping:
        int alone

    void e3d_helping_note(e3d_helping *h, const e3d_job_times *job, int64_t now)
