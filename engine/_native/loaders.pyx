# cython: boundscheck=False, wraparound=False, initializedcheck=False
"""The gateway to what reads model files in C: checks shapes, releases the GIL, hands over arrays.

In:  the bytes of a file, or arrays.
Out: arrays that own what C allocated; no copies.
"""

import numpy as np

cimport cython
from cpython.bytes cimport PyBytes_FromStringAndSize
from e3d_loaders cimport *
from libc.stdint cimport int32_t, uint8_t, uint32_t
from libc.stdlib cimport free

from ..errors import InvalidArgumentError, OutOfMemoryError

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

SETTER = np.dtype(
    [(name, np.uint32)
     for name in ("kind", "line", "faces", "lines", "points", "name", "name_length")]
    + [("value", np.int32)]
)


cdef object owned(void **data, size_t count, object dtype):
    """An array over what C allocated, which it frees; `data` is taken over."""
    if data[0] == NULL or count == 0:
        return np.empty(0, dtype)
    cdef cython.view.array array = cython.view.array(
        shape=(count * dtype.itemsize,), itemsize=1, format="B", allocate_buffer=False
    )
    array.data = <char *>data[0]
    array.callback_free_data = free
    data[0] = NULL
    return np.frombuffer(array, dtype)


cdef class ObjReader:
    """Reads an OBJ file: `read` until it returns False, then `end`, then `take` what is there."""

    cdef e3d_obj obj
    cdef const uint8_t[::1] data

    def __cinit__(self, const uint8_t[::1] data not None):
        self.data = data
        if not e3d_obj_begin(&self.obj, &data[0] if data.shape[0] else NULL, data.shape[0]):
            raise OutOfMemoryError("no memory to read an OBJ file")

    def __dealloc__(self):
        e3d_obj_free(&self.obj)

    def read(self, size_t size):
        """Read about so many bytes; return whether there is more to read."""
        cdef bint more
        with nogil:
            more = e3d_obj_read(&self.obj, size)
        return more

    @property
    def consumed(self):
        return self.obj.consumed

    def end(self):
        """Check what was read; return the problem, `DONE` for none."""
        with nogil:
            e3d_obj_end(&self.obj)
        return self.obj.error.problem

    @property
    def error(self):
        """(list, count, line, word) of the problem."""
        cdef e3d_obj_error *error = &self.obj.error
        return error.list, error.count, error.place.line, self.word(&error.place)

    cdef object word(self, const e3d_obj_place *place):
        cdef const char *names = <const char *>self.obj.names
        if place.word_length == 0:
            return b""
        return PyBytes_FromStringAndSize(names + place.word, <Py_ssize_t>place.word_length)

    cdef object elements(self, e3d_obj_elements *elements):
        sizes = owned(<void **>&elements.sizes, elements.count, np.dtype(np.int32))
        indices = [
            owned(<void **>&elements.indices[k], elements.corners, np.dtype(np.int32))
            if k == E3D_OBJ_V or elements.indices[k] != NULL else None
            for k in range(<int>E3D_OBJ_LISTS)
        ]
        outside = [
            (elements.outside[k].count, elements.outside[k].first.line,
             self.word(&elements.outside[k].first))
            for k in range(<int>E3D_OBJ_LISTS)
        ]
        small = (elements.small.count, elements.small.first.line)
        return sizes, indices, bool(elements.are_triangles), small, outside

    def take(self):
        """Hand over everything, once: a dict of arrays, and of tuples for the elements.

        ``positions`` (V, 3), ``uvs`` (T, 2) and ``normals`` (N, 3) float64; ``colors`` (V, 4) uint8
        or None; ``faces``, ``lines`` and ``points``: (sizes (E,) int32, indices: three of (C,) int32
        or None, whether all are triangles, (count, line) of small ones, (count, line, word) of
        indices out of range for each list); ``setters`` (S,) `SETTER`; ``names`` bytes.
        """
        cdef e3d_obj *obj = &self.obj
        cdef size_t *counts = obj.counts
        real = np.dtype(np.float64)
        colors = None
        if obj.colors != NULL:
            colors = owned(<void **>&obj.colors, 4 * counts[E3D_OBJ_V], np.dtype(np.uint8))
            colors = colors.reshape(-1, 4)
        # What holds words comes before the names go.
        found = {
            "faces": self.elements(&obj.faces),
            "lines": self.elements(&obj.lines),
            "points": self.elements(&obj.points),
        }
        found["colors"] = colors
        found["positions"] = owned(
            <void **>&obj.positions, 3 * counts[E3D_OBJ_V], real).reshape(-1, 3)
        found["uvs"] = owned(<void **>&obj.uvs, 2 * counts[E3D_OBJ_VT], real).reshape(-1, 2)
        found["normals"] = owned(
            <void **>&obj.normals, 3 * counts[E3D_OBJ_VN], real).reshape(-1, 3)
        found["setters"] = owned(<void **>&obj.setters, obj.setter_count, SETTER)
        found["names"] = owned(<void **>&obj.names, obj.name_bytes, np.dtype(np.uint8)).data
        return found


def weld_corners(const int32_t[::1] positions not None, const int32_t[::1] uvs,
                 const int32_t[::1] normals, size_t position_count):
    """Weld corners (C,) into vertices.

    Returns faces (C,) int32, and of each vertex the position, uv and normal (M,) int32; None for
    lists that are None. Vertices stand in the order of (position, uv, normal).
    """
    cdef size_t count = positions.shape[0], made
    if (uvs is not None and uvs.shape[0] != positions.shape[0]) or (
            normals is not None and normals.shape[0] != positions.shape[0]):
        raise InvalidArgumentError("the lists of corners must be of one length")
    if count == 0:
        none = np.empty(0, np.int32)
        return none, none, None if uvs is None else none, None if normals is None else none
    faces = np.empty(count, np.int32)
    vertices = [
        None if absent else np.empty(count, np.int32)
        for absent in (False, uvs is None, normals is None)
    ]
    cdef int32_t[::1] face_view = faces
    cdef int32_t[::1] of_position = vertices[0], of_uv = vertices[1], of_normal = vertices[2]
    cdef const int32_t *uv = NULL if uvs is None else &uvs[0]
    cdef const int32_t *normal = NULL if normals is None else &normals[0]
    cdef int32_t *made_uv = NULL if uvs is None else &of_uv[0]
    cdef int32_t *made_normal = NULL if normals is None else &of_normal[0]
    with nogil:
        made = e3d_weld_corners(&positions[0], uv, normal, count, position_count, &face_view[0],
                                &of_position[0], made_uv, made_normal)
    if made == <size_t>-1:
        raise OutOfMemoryError("no memory to weld the corners of a mesh")
    faces.setflags(write=False)
    return faces, *(None if array is None else array[:made] for array in vertices)


def used_or_all(const int32_t[::1] indices not None, size_t total):
    """Return which of 0..total-1 are among the indices, (total,) bool; None if all are."""
    used = np.zeros(total, np.bool_)
    cdef uint8_t[::1] view = used.view(np.uint8)
    cdef size_t count = indices.shape[0], marked = 0
    if count and total:
        with nogil:
            marked = e3d_mark_used(&indices[0], count, &view[0], total)
    return None if marked == total else used


cdef int check_rows(const e3d_rows *rows) except -1:
    if rows.count > 2**31 - 1 or not 0 < rows.width <= E3D_ROW_WORDS:
        raise InvalidArgumentError("more rows than 32 bits number, or too wide ones")
    return 0


cdef size_t numbered(const e3d_rows *rows, int32_t *numbers, int32_t *first,
                     uint32_t *found) except? 0:
    cdef size_t made
    check_rows(rows)
    with nogil:
        made = e3d_number_rows(rows, numbers, first, found)
    if made == <size_t>-1:
        raise OutOfMemoryError("no memory to weld the rows of a mesh")
    return made


def number_rows(const uint32_t[:, ::1] rows not None, bint are_floats):
    """Number rows (N, up to 8), equal ones alike: numbers (N,) int32 and first rows (M,) int32.

    They are in the order of first appearance; of floats, -0 equals 0.
    """
    cdef size_t count = rows.shape[0], width = rows.shape[1], made
    numbers, first = np.empty(count, np.int32), np.empty(count, np.int32)
    if count == 0:
        return numbers, first
    cdef int32_t[::1] number_view = numbers, first_view = first
    cdef uint32_t[::1] found = np.empty(count * width, np.uint32)
    cdef e3d_rows given = e3d_rows(
        <const uint8_t *>&rows[0, 0], count, width, 1, width * sizeof(uint32_t), are_floats)
    made = numbered(&given, &number_view[0], &first_view[0], &found[0])
    return numbers, first[:made]


def rows_repeat(const uint32_t[:, ::1] rows not None, bint are_floats):
    """Tell whether any two rows (N, up to 8) are equal; of floats, -0 equals 0."""
    cdef size_t width = rows.shape[1]
    if rows.shape[0] == 0:
        return False
    cdef e3d_rows given = e3d_rows(
        <const uint8_t *>&rows[0, 0], rows.shape[0], width, 1, width * sizeof(uint32_t), are_floats)
    cdef int repeat
    check_rows(&given)
    with nogil:
        repeat = e3d_rows_repeat(&given)
    if repeat < 0:
        raise OutOfMemoryError("no memory to compare the rows of a mesh")
    return bool(repeat)


def weld_facets(const uint8_t[::1] data not None, size_t offset, size_t stride, size_t facets):
    """Weld the corners of records that hold nine floats from ``offset`` on, ``stride`` bytes apart.

    Returns the faces (facets, 3) int32 and the positions (M, 3) float32, in the order of their
    first appearance.
    """
    if facets == 0 or stride < 36 or <size_t>data.shape[0] < offset + 36 or (
            facets - 1 > (data.shape[0] - offset - 36) // stride):
        raise InvalidArgumentError("the facets are not inside the data")
    faces = np.empty((facets, 3), np.int32)
    positions = np.empty((3 * facets, 3), np.float32)
    cdef int32_t[:, ::1] face_view = faces
    cdef float[:, ::1] position_view = positions
    cdef e3d_rows given = e3d_rows(&data[offset], 3 * facets, 3, 3, stride, True)
    cdef size_t made = numbered(&given, &face_view[0, 0], NULL, <uint32_t *>&position_view[0, 0])
    positions = positions[:made].copy()
    faces.setflags(write=False)
    positions.setflags(write=False)
    return faces, positions
