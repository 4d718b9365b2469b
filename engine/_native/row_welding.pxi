# Part of loaders.pyx: equal corners and rows found.
#
# In:  corners as indices, rows of words, records of STL.
# Out: the number of each, in the order of their first appearance, and what they stand for.

def weld_corners(
    const int32_t[::1] positions not None, const int32_t[::1] uvs, const int32_t[::1] normals, size_t position_count,
) -> tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.int32] | None, NDArray[np.int32] | None]:
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
    return frozen(faces), *(None if array is None else array[:made] for array in vertices)


def used_or_all(const int32_t[::1] indices not None, size_t total) -> NDArray[np.bool_] | None:
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


def number_rows(const uint32_t[:, ::1] rows not None, bint are_floats) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
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


def rows_repeat(const uint32_t[:, ::1] rows not None, bint are_floats) -> bool:
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


def weld_facets(
    pieces: Iterable[tuple[int, memoryview]], size_t offset, size_t stride, size_t facets,
) -> tuple[NDArray[np.int32], NDArray[np.float32]]:
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
    positions = owned(<void **>&found, 3 * count, np.dtype(np.float32)).reshape(-1, 3)
    return frozen(faces), frozen(positions)
