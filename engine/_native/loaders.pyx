# cython: boundscheck=False, wraparound=False, initializedcheck=False
"""The gateway to what reads model files in C: checks shapes, releases the GIL, hands over arrays.

In:  the bytes of a file, or arrays.
Out: arrays that own what C allocated; no copies.
"""

import numpy as np

cimport cython
from cpython.bytes cimport PyBytes_AS_STRING, PyBytes_FromStringAndSize
from cpython.buffer cimport PyBUF_WRITE
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

SETTER = np.dtype(
    [(name, np.uint32)
     for name in ("kind", "line", "faces", "lines", "points", "name", "name_length")]
    + [("value", np.int32)]
)


MARK = np.dtype([(name, np.int64) for name in ("form", "rows", "start", "end")])


cdef extern from *:
    """
    #include <sys/mman.h>
    #ifndef MADV_POPULATE_WRITE
    #define MADV_POPULATE_WRITE 23
    #endif
    """
    int madvise(void *start, size_t size, int advice) nogil
    int MADV_HUGEPAGE, MADV_POPULATE_WRITE

# Where large pages begin, and from how many bytes on they are worth it.
cdef size_t LARGE_PAGE = 1 << 21, MANY_BYTES = 1 << 22


def read_bytes(readinto, Py_ssize_t size):
    """Read at most ``size`` bytes by ``readinto(view) -> count`` until it says 0.

    As `io.FileIO.read` does, but into large pages: many small ones take longer to come than the
    bytes of a file.
    """
    data = PyBytes_FromStringAndSize(NULL, size)
    cdef char *start = PyBytes_AS_STRING(data)
    cdef size_t skip = -<size_t>start % LARGE_PAGE
    if <size_t>size >= MANY_BYTES:
        madvise(start + skip, (<size_t>size - skip) // LARGE_PAGE * LARGE_PAGE, MADV_HUGEPAGE)
    cdef Py_ssize_t done = 0, count
    while done < size:
        count = readinto(PyMemoryView_FromMemory(start + done, size - done, PyBUF_WRITE))
        if count == 0:
            return data[:done]
        done += count
    return data


def large_array(shape, dtype):
    """Return an array of any content, in large pages where it is large."""
    dtype = np.dtype(dtype)
    cdef size_t size = dtype.itemsize * int(np.prod(shape, dtype=object)), skip
    if size < LARGE_PAGE:
        return np.empty(shape, dtype)
    # It owns the memory: a mesh takes over what nobody can write to.
    owner = np.empty(size + LARGE_PAGE, np.uint8)
    cdef uint8_t[::1] view = owner
    skip = -<size_t>&view[0] % LARGE_PAGE
    cdef size_t large = size // LARGE_PAGE * LARGE_PAGE
    madvise(&view[skip], large, MADV_HUGEPAGE)
    # Small pages come faster all at once; where the system cannot, they come one by one.
    madvise(&view[skip + large], size - large, MADV_POPULATE_WRITE)
    return np.ndarray(shape, dtype, owner, skip)


def frozen(array):
    """Make an array read-only, and what owns its memory; return it."""
    array.setflags(write=False)
    if array.base is not None:
        array.base.setflags(write=False)
    return array


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


cdef int check_row_count(size_t count) except -1:
    if count > 2**31 - 1:
        raise InvalidArgumentError("more rows than 32 bits number")
    return 0


cdef int check_rows(const e3d_rows *rows) except -1:
    if not 0 < rows.width <= E3D_ROW_WORDS:
        raise InvalidArgumentError("rows that are too wide")
    return check_row_count(rows.count)


def number_rows(const uint32_t[:, ::1] rows not None, bint are_floats):
    """Number rows (N, up to 8), equal ones alike: numbers (N,) int32 and first rows (M,) int32.

    They are in the order of first appearance; of floats, -0 equals 0.
    """
    cdef size_t count = rows.shape[0], width = rows.shape[1], made
    numbers, first = np.empty(count, np.int32), np.empty(count, np.int32)
    if count == 0:
        return numbers, first
    cdef int32_t[::1] number_view = numbers, first_view = first
    cdef e3d_rows given = e3d_rows(
        <const uint8_t *>&rows[0, 0], count, width, 1, width * sizeof(uint32_t), are_floats)
    check_rows(&given)
    with nogil:
        made = e3d_number_rows(&given, &number_view[0], &first_view[0], NULL)
    if made == <size_t>-1:
        raise OutOfMemoryError("no memory to weld the rows of a mesh")
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


def weld_facets(pieces, size_t offset, size_t stride, size_t facets):
    """Weld the corners of records of ``stride`` bytes that hold nine floats from ``offset`` on.

    ``pieces`` are (number of a record, bytes of some from there on), in order. Returns the faces
    (facets, 3) int32 and the positions (M, 3) float32, in the order of their first appearance.
    """
    cdef size_t done = 0, count
    if stride < offset + 36:
        raise InvalidArgumentError("the facets are not inside their records")
    check_row_count(3 * facets)
    faces = large_array((facets, 3), np.int32)
    cdef int32_t[:, ::1] face_view = faces
    cdef const uint8_t[::1] piece
    cdef e3d_rows given = e3d_rows(NULL, 0, 3, 3, stride, True)
    cdef e3d_row_numbers *numbers = e3d_row_numbers_begin(3, True, 3 * facets)
    cdef uint32_t *found = NULL
    cdef bint fits = numbers != NULL
    try:
        for first, piece in pieces:
            count = piece.shape[0] // stride
            if first != done or count > facets - done:
                raise InvalidArgumentError("the pieces do not follow each other")
            if not fits or count == 0:
                break
            given.bytes, given.count = &piece[offset], 3 * count
            with nogil:
                fits = e3d_row_numbers_add(numbers, &given, &face_view[done, 0], NULL)
            done += count
        if fits and done == facets:
            count = e3d_row_numbers_take(numbers, &found)
    finally:
        e3d_row_numbers_free(numbers)
    if not fits:
        raise OutOfMemoryError("no memory to weld the rows of a mesh")
    if done != facets:
        raise InvalidArgumentError("the facets are not inside the data")
    positions = large_array((count, 3), np.float32)
    positions[:] = owned(<void **>&found, 3 * count, np.dtype(np.float32)).reshape(-1, 3)
    return frozen(faces), frozen(positions)


def smooth_sums(positions, const int32_t[:, ::1] faces not None,
                const int32_t[:, ::1] groups not None, size_t count, size_t block):
    """Add up the angle-weighted normals of corners (F, 3) by group: (count, 3) float64.

    ``positions`` (V, 3) are float64 or float32; ``block`` triangles are added up at a time.
    """
    cdef const double[:, ::1] doubles
    cdef const float[:, ::1] floats
    cdef e3d_surface surface
    sums = np.zeros((count, 3), np.float64)
    if faces.shape[0] == 0 or count == 0:
        return sums
    if len(positions) == 0 or faces.shape[1] != 3 or groups.shape[1] != 3 or (
            groups.shape[0] != faces.shape[0]) or positions.shape[1] != 3 or block == 0:
        raise InvalidArgumentError("the triangles have no positions or no groups")
    surface.are_doubles = positions.dtype == np.float64
    if surface.are_doubles:
        doubles = positions
        surface.positions = &doubles[0, 0]
    else:
        floats = positions
        surface.positions = &floats[0, 0]
    surface.faces, surface.groups = &faces[0, 0], &groups[0, 0]
    surface.position_count, surface.face_count = len(positions), faces.shape[0]
    surface.group_count = count
    cdef double[:, ::1] view = sums
    cdef e3d_sums_problem problem
    with nogil:
        problem = e3d_smooth_sums(&surface, block, &view[0, 0])
    if problem == E3D_SUMS_NO_MEMORY:
        raise OutOfMemoryError("no memory for the normals of a mesh")
    if problem != E3D_SUMS_DONE:
        raise InvalidArgumentError("a face holds an index that is out of range")
    return sums


def find_edges(const int32_t[:, ::1] faces not None, const int32_t[::1] points,
               const uint8_t[::1] wanted, size_t count):
    """Mark the first of all sides between two points: (3 F,) uint8.

    ``points`` (V,) are the vertices' points, below ``count``, or None if each vertex is its own;
    ``wanted`` (3 F,) leaves out sides where it is 0.
    """
    cdef e3d_sides sides = e3d_sides(NULL, NULL, NULL, faces.shape[0], count)
    first = np.zeros(3 * faces.shape[0], np.uint8)
    cdef uint8_t[::1] view = first
    cdef bint done = True
    if faces.shape[0] == 0:
        return first
    if faces.shape[1] != 3 or (wanted is not None and wanted.shape[0] != view.shape[0]):
        raise InvalidArgumentError("faces must be (F, 3), wanted (3 F,)")
    vertices = count if points is None else points.shape[0]
    low, high = np.min(faces), np.max(faces)
    if low < 0 or high >= vertices:
        raise InvalidArgumentError("a face holds an index that is out of range")
    if points is not None and (np.min(points) < 0 or np.max(points) >= count):
        raise InvalidArgumentError("a vertex is a point that is out of range")
    sides.faces = &faces[0, 0]
    if points is not None:
        sides.points = &points[0]
    if wanted is not None:
        sides.wanted = &wanted[0]
    with nogil:
        done = e3d_find_edges(&sides, &view[0])
    if not done:
        raise OutOfMemoryError("no memory for the edges of a mesh")
    return first


def cut_polygons(const int32_t[::1] sizes not None, positions, const int32_t[::1] indices,
                 size_t corners, size_t triangles, int64_t tests):
    """Cut polygons (P,) of so many corners each into so many triangles.

    ``indices`` (C,) are the corners' positions; None if they are the first of ``positions`` (V, 3),
    float64 or float32. Returns corner numbers (T, 3) int32, the polygon of each triangle (T,)
    int32, which edges are the polygons' (T, 3) bool or None, whether no concave polygon was cut as
    a fan, and how many tests are left.
    """
    cdef e3d_polygons given = e3d_polygons(NULL, NULL, NULL, False, sizes.shape[0], corners, 0)
    cdef const double[:, ::1] doubles
    cdef const float[:, ::1] floats
    cdef e3d_cut made
    cdef e3d_cut_problem problem
    cut = large_array((triangles, 3), np.int32)
    polygons = large_array((triangles,), np.int32)
    visible = large_array((triangles, 3), np.bool_)
    if triangles == 0:
        return cut, polygons, None, True, tests
    given.position_count = len(positions)
    if given.position_count == 0 or positions.shape[1] != 3 or (
            (np.maximum(sizes, 2) - 2).sum() != triangles) or (
            indices is not None and <size_t>indices.shape[0] != corners):
        raise InvalidArgumentError("the corners of polygons do not match")
    given.are_doubles = positions.dtype == np.float64
    if given.are_doubles:
        doubles = positions
        given.positions = &doubles[0, 0]
    else:
        floats = positions
        given.positions = &floats[0, 0]
    given.sizes = &sizes[0]
    if indices is not None:
        given.indices = &indices[0]
    cdef int32_t[:, ::1] cut_view = cut
    cdef int32_t[::1] polygon_view = polygons
    cdef uint8_t[:, ::1] visible_view = visible.view(np.uint8)
    made.corners, made.polygons = &cut_view[0, 0], &polygon_view[0]
    made.visible = &visible_view[0, 0]
    with nogil:
        problem = e3d_cut_polygons(&given, &tests, &made)
    if problem == E3D_CUT_NO_MEMORY:
        raise OutOfMemoryError("no memory to cut the polygons of a mesh")
    if problem != E3D_CUT_DONE:
        raise InvalidArgumentError("a polygon has an index that is out of range")
    edges = None if made.all_visible else frozen(visible)
    return cut, polygons, edges, bool(made.is_complete), tests


cdef e3d_ply_body ply_body(const uint8_t[::1] data, size_t start, bint is_big_endian):
    cdef e3d_ply_body body = e3d_ply_body(NULL, start, data.shape[0], is_big_endian)
    if data.shape[0]:
        body.bytes = &data[0]
    return body


def walk_ply_rows(const uint8_t[::1] data not None, size_t start, bint is_big_endian, lists,
                  size_t tail, size_t rows):
    """Go along ``rows`` rows of a PLY body from byte ``start`` on.

    ``lists`` are (bytes before, bytes of the length, whether it is signed, bytes of an item) of the
    lists in a row; ``tail`` bytes stand behind the last. Returns the problem, `PLY_DONE` for none,
    the places of rows (N,), of lists (N, K), their lengths (N, K), all int64, the place behind, and
    the row that has a problem.
    """
    cdef size_t count = len(lists), k
    if start > <size_t>data.shape[0] or rows > <size_t>data.shape[0]:
        raise InvalidArgumentError("more rows than bytes")
    places = np.empty(rows, np.int64)
    starts, sizes = np.empty((rows, count), np.int64), np.empty((rows, count), np.int64)
    cdef int64_t[::1] place_view = places
    cdef int64_t[::1] start_view = starts.reshape(-1), size_view = sizes.reshape(-1)
    cdef e3d_ply_body body = ply_body(data, start, is_big_endian)
    cdef e3d_ply_rows found = e3d_ply_rows(NULL, NULL, NULL, start, 0)
    cdef e3d_ply_problem problem
    cdef e3d_ply_list *steps = <e3d_ply_list *>calloc(count + 1, sizeof(e3d_ply_list))
    if steps == NULL:
        raise OutOfMemoryError("no memory to read a PLY file")
    try:
        for k in range(count):
            steps[k].skip, steps[k].count_size, steps[k].is_signed, steps[k].item_size = lists[k]
        if rows:
            found.places = &place_view[0]
        if rows and count:
            found.starts, found.sizes = &start_view[0], &size_view[0]
        with nogil:
            problem = e3d_ply_walk(&body, steps, count, tail, rows, &found)
    finally:
        free(steps)
    return problem, places, starts, sizes, found.end, found.row


cdef int check_rows_inside(size_t size, size_t start, size_t stride, size_t rows,
                           size_t width) except -1:
    """Raise unless rows of `width` bytes, `stride` bytes apart, are inside of so many bytes."""
    if rows and (size < start or size - start < width or (
            stride and (size - start - width) // stride < rows - 1)):
        raise InvalidArgumentError("the rows are not inside the data")
    return 0


def ply_lengths_are(const uint8_t[::1] data not None, bint is_big_endian, size_t start,
                    size_t stride, size_t rows, size_t count_size, size_t length):
    """Tell whether the lists of all rows have a length; that of the first begins at ``start``."""
    check_rows_inside(data.shape[0], start, stride, rows, count_size)
    if rows == 0:
        return True
    cdef e3d_ply_body body = ply_body(data, start, is_big_endian)
    cdef bint same
    with nogil:
        same = e3d_ply_lengths_are(&body, stride, rows, count_size, length)
    return bool(same)


def copy_ply_lists(const uint8_t[::1] data not None, bint is_big_endian,
                   const int64_t[:, ::1] starts not None, const int64_t[:, ::1] sizes not None,
                   size_t number, dtype):
    """Copy the items of one list of each row (N, K), as `walk_ply_rows` found them, to (M,)."""
    cdef size_t rows = starts.shape[0], step = starts.shape[1], row, total = 0
    cdef size_t item_size = dtype.itemsize
    cdef e3d_ply_body body = ply_body(data, 0, is_big_endian)
    if <size_t>sizes.shape[0] != rows or <size_t>sizes.shape[1] != step or number >= step:
        raise InvalidArgumentError("the lists of PLY rows do not match")
    total = np.asarray(sizes)[:, number].sum()
    items = np.empty(total, dtype)
    cdef uint8_t[::1] view = items.view(np.uint8)
    if total:
        with nogil:
            e3d_ply_copy_lists(&body, &starts[0, number], &sizes[0, number], step, rows, item_size,
                               &view[0])
    return items


def copy_ply_rows(const uint8_t[::1] data not None, bint is_big_endian, size_t start,
                  size_t stride, items not None):
    """Copy neighbouring numbers of each row, ``stride`` bytes apart, into ``items`` (rows, width)."""
    cdef size_t rows = items.shape[0], width = items.shape[1], item_size = items.dtype.itemsize
    if rows == 0 or width == 0:
        return
    check_rows_inside(data.shape[0], start, stride, rows, width * item_size)
    cdef uint8_t[::1] view = items.reshape(-1).view(np.uint8)
    cdef e3d_ply_body body = ply_body(data, start, is_big_endian)
    with nogil:
        e3d_ply_copy_rows(&body, stride, rows, width, item_size, &view[0])


cdef int check_text_end(const uint8_t[::1] text) except -1:
    """Raise unless the last byte is a blank or ends a line."""
    if text.shape[0] and text[text.shape[0] - 1] not in b" \t\n\v\f\r":
        raise InvalidArgumentError("the text does not end with a blank or a line's end")
    return 0


def read_numbers(const uint8_t[::1] text not None, int comments, rows=None,
                 bint with_widths=False):
    """Read a text of numbers, whose last byte is a blank or ends a line; ``rows`` lines, or all.

    Returns the numbers (N,) float64, how many each line that holds any has (R,) int64 or None, the
    place behind the last line, and that of a word that is no number or None.
    """
    cdef e3d_numbers found
    cdef e3d_numbers_problem problem
    cdef size_t size = text.shape[0], most = size if rows is None else min(rows, size)
    check_text_end(text)
    if size == 0:
        return np.empty(0), np.empty(0, np.int64) if with_widths else None, 0, None
    with nogil:
        problem = e3d_read_numbers(
            &text[0], size, <e3d_comments>comments, most, with_widths, &found)
    try:
        if problem == E3D_NUMBERS_NO_MEMORY:
            raise OutOfMemoryError("no memory for the numbers of a file")
        values = owned(<void **>&found.values, found.count, np.dtype(np.float64))
        widths = None
        if with_widths:
            widths = owned(<void **>&found.widths, found.rows, np.dtype(np.int64))
        wrong = found.place if problem == E3D_NUMBERS_NOT_A_NUMBER else None
        return values, widths, found.place, wrong
    finally:
        e3d_numbers_free(&found)


def walk_number_rows(const double[::1] values not None, size_t start, skips, size_t tail,
                     size_t rows):
    """Go along ``rows`` rows of numbers as `walk_ply_rows` does; places are those of numbers.

    ``skips`` are how many numbers stand before each list of a row.
    """
    cdef size_t count = len(skips), end = values.shape[0]
    if start > end or rows > end:
        raise InvalidArgumentError("more rows than numbers")
    places = np.empty(rows, np.int64)
    starts, sizes = np.empty((rows, count), np.int64), np.empty((rows, count), np.int64)
    if rows == 0:
        return PLY_DONE, places, starts, sizes, start, 0
    cdef int64_t[::1] place_view = places
    cdef int64_t[::1] start_view = starts.reshape(-1), size_view = sizes.reshape(-1)
    given = np.array([*skips, 0], np.uintp)
    cdef size_t[::1] skip_view = given
    cdef e3d_number_body body = e3d_number_body(&values[0], start, end)
    cdef e3d_ply_rows found = e3d_ply_rows(&place_view[0], NULL, NULL, start, 0)
    cdef e3d_ply_problem problem
    if count:
        found.starts, found.sizes = &start_view[0], &size_view[0]
    with nogil:
        problem = e3d_walk_numbers(&body, &skip_view[0], count, tail, rows, &found)
    return problem, places, starts, sizes, found.end, found.row


def copy_numbers(const double[::1] values not None, const int64_t[:, ::1] starts not None,
                 const int64_t[:, ::1] sizes not None, size_t number):
    """Copy the items of one list of each row (N, K), as `walk_number_rows` found them, to (M,)."""
    cdef size_t rows = starts.shape[0], step = starts.shape[1]
    if <size_t>sizes.shape[0] != rows or <size_t>sizes.shape[1] != step or number >= step:
        raise InvalidArgumentError("the lists of rows do not match")
    items = large_array(int(np.asarray(sizes)[:, number].sum()), np.float64)
    cdef double[::1] view = items
    if len(items):
        with nogil:
            e3d_copy_numbers(&values[0], &starts[0, number], &sizes[0, number], step, rows,
                             &view[0])
    return items


def indices_of(const double[:, :] values not None, size_t limit):
    """Return numbers (N, K), rows at any distance, as int32; and which is none from 0 to limit - 1.

    The second is counted along the rows; None if all are indices.
    """
    cdef size_t rows = values.shape[0], width = values.shape[1], done
    indices = large_array((rows, width), np.int32)
    if rows == 0 or width == 0:
        return indices, None
    if values.strides[1] != sizeof(double) or values.strides[0] % sizeof(double):
        raise InvalidArgumentError("the numbers of a row must lie beside each other")
    cdef size_t stride = values.strides[0] // sizeof(double)
    cdef int32_t[:, ::1] view = indices
    with nogil:
        done = e3d_numbers_to_indices(&values[0, 0], width, stride, rows, limit, &view[0, 0])
    return indices, None if done == rows * width else done


cdef class FormReader:
    """Reads a text whose lines have forms, up to the next line that has none.

    ``forms`` are (pattern, kind, width, most, missing, of), as e3d_loaders.h tells of them; the
    last byte of ``text`` is a blank or ends a line.
    """

    cdef e3d_form_text read_text
    cdef e3d_form *forms
    cdef const uint8_t[::1] text
    cdef list patterns

    def __cinit__(self, const uint8_t[::1] text not None, forms, bint any_case=False):
        cdef size_t count = len(forms), k
        check_text_end(text)
        self.text = text
        self.patterns = [form[0] for form in forms]
        self.forms = <e3d_form *>calloc(count, sizeof(e3d_form))
        self.read_text.rows = <e3d_form_rows *>calloc(count, sizeof(e3d_form_rows))
        if self.forms == NULL or self.read_text.rows == NULL:
            raise OutOfMemoryError("no memory to read a text")
        self.read_text.forms, self.read_text.form_count = self.forms, count
        self.read_text.any_case = any_case
        for k, (pattern, kind, width, most, missing, of) in enumerate(forms):
            if not sum(map(pattern.count, (b"%", b"@", b"?"))) == width <= E3D_FORM_WIDTH or (
                    not 0 <= of < count):
                raise InvalidArgumentError("a form does not fit its pattern")
            self.forms[k] = e3d_form(
                PyBytes_AS_STRING(self.patterns[k]), <e3d_form_kind><int>kind, width, most, missing, of)

    def __dealloc__(self):
        cdef size_t k
        if self.read_text.rows != NULL:
            for k in range(self.read_text.form_count):
                free(self.read_text.rows[k].values)
        free(self.read_text.rows)
        free(self.read_text.marks)
        free(self.forms)

    def read(self, size_t place):
        """Read lines from a place on; return where one begins that has no form, or the end."""
        cdef bint fits = True
        if place < <size_t>self.text.shape[0]:
            with nogil:
                fits = e3d_read_forms(
                    &self.read_text, &self.text[0], self.text.shape[0], &place)
        if not fits:
            raise OutOfMemoryError("no memory for the numbers of a file")
        return place

    def add(self, size_t form, numbers, bint is_whole=True):
        """Add a row to a form's."""
        given = np.array(numbers, np.float64)
        cdef double[::1] view = given
        if form >= self.read_text.form_count or (
                <size_t>view.shape[0] != self.forms[form].width) or not len(given):
            raise InvalidArgumentError("a row does not fit its form")
        if not e3d_add_form_row(&self.read_text, form, &view[0], is_whole):
            raise OutOfMemoryError("no memory for the numbers of a file")

    def count(self, size_t form):
        """Return how many rows of a form there are, and how many of them lack nothing."""
        if form >= self.read_text.form_count:
            raise InvalidArgumentError("there is no such form")
        return self.read_text.rows[form].rows, self.read_text.rows[form].whole

    def take_rows(self, size_t form):
        """Hand over the rows of a form, once: (N, width) float64."""
        rows, _ = self.count(form)
        cdef size_t width = self.forms[form].width
        cdef e3d_form_rows *taken = &self.read_text.rows[form]
        taken.rows = taken.whole = taken.room = 0
        values = owned(<void **>&taken.values, rows * width, np.dtype(np.float64))
        return values.reshape(rows, width)

    def take_marks(self):
        """Hand over the marks since the last time: (N,) `MARK`."""
        cdef size_t count = self.read_text.mark_count * MARK.itemsize
        marks = owned(<void **>&self.read_text.marks, count, np.dtype(np.uint8)).view(MARK)
        if count:
            self.read_text.mark_count = self.read_text.mark_room = 0
        return marks
