# What engine/_native/scene_graph.pyx shows to the other modules of that folder.

from e3d_scene cimport e3d_graph, e3d_shape, e3d_tree
from libc.stdint cimport int32_t, uint64_t


cdef class NativeTree:
    cdef e3d_tree *tree
    cdef readonly Py_ssize_t count


cdef class NativeShapes:
    cdef e3d_shape *shapes
    cdef int32_t count
    cdef list held


cdef class NativeGraph:
    cdef e3d_graph graph
    cdef e3d_tree *tree
    cdef int32_t room
    cdef list held
    cdef object anchored  # slots whose anchor is another
    cdef public uint64_t changes
    cdef readonly uint64_t updated, links
    cdef int check(self, int32_t slot) except -1
    cdef int check_all(self, const int32_t[::1] slots, Py_ssize_t rows) except -1
    cdef int update_changed(self, const double[:, ::1] boxes, int threads) except -1
    cdef int require_memory(self, bint done) except -1
    cdef int need_tree(self) except -1
