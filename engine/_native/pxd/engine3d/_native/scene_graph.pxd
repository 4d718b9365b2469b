# What engine/_native/scene_graph.pyx shows to the other modules of that folder.

from e3d_scene cimport e3d_tree


cdef class NativeTree:
    cdef e3d_tree *tree
    cdef readonly Py_ssize_t count
