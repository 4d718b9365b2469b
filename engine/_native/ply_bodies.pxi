# Part of loaders.pyx: the rows of binary PLY bodies.
#
# In:  bytes, and what a header says of a row.
# Out: where rows and lists stand, and the numbers in them.

cdef e3d_ply_body ply_body(const uint8_t[::1] data, size_t start, bint is_big_endian):
    cdef e3d_ply_body body = e3d_ply_body(NULL, start, data.shape[0], is_big_endian)
    if data.shape[0]:
        body.bytes = &data[0]
    return body


def walk_ply_rows(const uint8_t[::1] data not None, size_t start, bint is_big_endian, lists: list[tuple[int, int, bool, int]],
                  size_t tail, size_t rows) -> tuple[int, NDArray[np.int64], NDArray[np.int64], NDArray[np.int64], int, int]:
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
                    size_t stride, size_t rows, size_t count_size, size_t length) -> bool:
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
                   size_t number, dtype: np.dtype[Any]) -> NDArray[Any]:
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


def copy_even_ply_lists(const uint8_t[::1] data not None, bint is_big_endian, size_t count_size,
                        items not None) -> bool:
    """Copy the lists of rows that are nothing else into ``items`` (rows, length).

    False, and the items mean nothing, if the length of one is another.
    """
    cdef size_t rows = items.shape[0], length = items.shape[1], item_size = items.dtype.itemsize
    cdef size_t stride = count_size + length * item_size
    check_rows_inside(data.shape[0], 0, stride, rows, stride)
    if rows == 0:
        return True
    cdef uint8_t[::1] view = items.reshape(-1).view(np.uint8)
    cdef e3d_ply_body body = ply_body(data, 0, is_big_endian)
    cdef void *to = &view[0] if view.shape[0] else NULL
    cdef bint same
    with nogil:
        same = e3d_ply_copy_even_lists(&body, rows, count_size, length, item_size, to)
    return bool(same)


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
