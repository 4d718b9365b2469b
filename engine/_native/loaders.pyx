# cython: boundscheck=False, wraparound=False, initializedcheck=False
"""The gateway to what reads model files in C: checks shapes, releases the GIL, hands over arrays.

In:  the bytes of a file, or arrays.
Out: arrays that own what C allocated; no copies. Its parts are .pxi files, one an idea.
"""

import numpy as np

from cpython.bytes cimport PyBytes_AsString, PyBytes_FromStringAndSize
from cpython.buffer cimport PyBUF_SIMPLE, PyBUF_WRITE, PyBuffer_FillInfo, PyBuffer_Release, PyObject_GetBuffer
from cpython.memoryview cimport PyMemoryView_FromMemory
from e3d_loaders cimport *
from libc.stdint cimport int32_t, int64_t, uint8_t, uint32_t
from libc.stdlib cimport calloc, free

from ..errors import InvalidArgumentError, OutOfMemoryError

PLY_DONE = E3D_PLY_DONE
PLY_SHORT = E3D_PLY_SHORT
PLY_BAD_LIST = E3D_PLY_BAD_LIST

NO_COMMENTS = E3D_NO_COMMENTS
HASH_COMMENTS = E3D_HASH_COMMENTS
PLY_COMMENTS = E3D_PLY_COMMENTS

DONE = E3D_OBJ_DONE
NO_MEMORY = E3D_OBJ_NO_MEMORY
TOO_LARGE = E3D_OBJ_TOO_LARGE
NO_VERTICES = E3D_OBJ_NO_VERTICES
FEW_NUMBERS = E3D_OBJ_FEW_NUMBERS
NOT_A_NUMBER = E3D_OBJ_NOT_A_NUMBER
NOT_AN_INDEX = E3D_OBJ_NOT_AN_INDEX
NO_INDEX = E3D_OBJ_NO_INDEX
MANY_INDICES = E3D_OBJ_MANY_INDICES
OUT_OF_RANGE = E3D_OBJ_OUT_OF_RANGE

OBJECT = E3D_OBJ_OBJECT
GROUP = E3D_OBJ_GROUP
SMOOTHING = E3D_OBJ_SMOOTHING
MATERIAL = E3D_OBJ_MATERIAL
LIBRARY = E3D_OBJ_LIBRARY
UNKNOWN = E3D_OBJ_UNKNOWN

ROW = E3D_FORM_ROW
MARKED = E3D_FORM_MARK
SKIPPED = E3D_FORM_SKIPPED

SETTER: np.dtype = np.dtype(
    [(name, np.uint32)
     for name in ("kind", "line", "faces", "lines", "points", "name", "name_length")]
    + [("value", np.int32)]
)


MARK: np.dtype = np.dtype([(name, np.int64) for name in ("form", "rows", "start", "end")])

include "owned_memory.pxi"
include "obj_reader.pxi"
include "row_welding.pxi"
include "surfaces.pxi"
include "ply_bodies.pxi"
include "text_readers.pxi"
include "meshopt.pxi"
