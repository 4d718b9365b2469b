# cython: boundscheck=False, wraparound=False, initializedcheck=False
"""The gateway to what writes numbers as text in C.

In:  arrays of numbers. Out: arrays of bytes.
"""

import numpy as np

from e3d_writers cimport *
from libc.stdint cimport int32_t, int64_t, uint8_t

from ..errors import InvalidArgumentError

cdef enum:
    MOST_NUMBERS = 16  # an STL facet, the widest of rows, is twelve

V = E3D_CORNER_V
V_VT = E3D_CORNER_V_VT
V_VN = E3D_CORNER_V_VN
V_VT_VN = E3D_CORNER_V_VT_VN


def float_rows(const float[:, ::1] rows not None, between: list[bytes]) -> NDArray[np.uint8]:
    """Return rows (N, K) of up to 16 floats as text: (M,) uint8.

    ``between`` are K + 1 byte strings: what stands before each number, and behind the last. Floats
    have the fewest digits that read back as the same.
    """
    cdef size_t count = rows.shape[0], width = rows.shape[1], k, used = 0, literals = 0
    cdef const uint8_t *starts[MOST_NUMBERS + 1]
    cdef size_t lengths[MOST_NUMBERS + 1]
    if not 0 < width <= MOST_NUMBERS or len(between) != width + 1:
        raise InvalidArgumentError("a row of text has 1 to 16 numbers, and as many words and one")
    for k in range(width + 1):
        starts[k], lengths[k] = <const uint8_t *><char *>between[k], len(between[k])
        literals += lengths[k]
    text = np.empty(count * (width * E3D_FLOAT_LETTERS + literals), np.uint8)
    cdef uint8_t[::1] view = text
    if count:
        with nogil:
            used = e3d_write_float_rows(&rows[0, 0], count, width, starts, lengths, &view[0])
    return text[:used]


def face_lines(const int32_t[::1] sizes not None, const int32_t[::1] positions not None,
               const int32_t[::1] others, int form) -> tuple[NDArray[np.uint8], NDArray[np.int64]]:
    """Return the lines ``f ...`` of faces (P,): (M,) uint8, and the end of each line (P,) int64.

    Of all corners (C,), face after face, the numbers of ``v``, and those of ``vt`` and ``vn``.
    """
    cdef size_t count = sizes.shape[0], corners = positions.shape[0], used = 0
    if np.sum(sizes, dtype=np.int64) != corners or np.min(sizes, initial=0) < 0 or (
            form != V and (others is None or others.shape[0] != positions.shape[0])):
        raise InvalidArgumentError("the lists of corners must be of one length")
    text = np.empty(corners * 3 * (E3D_INTEGER_LETTERS + 1) + 2 * count, np.uint8)
    ends = np.empty(count, np.int64)
    cdef uint8_t[::1] view = text
    cdef int64_t[::1] end_view = ends
    cdef const int32_t *position = &positions[0] if corners else NULL
    cdef const int32_t *other = NULL if others is None or corners == 0 else &others[0]
    if count:
        with nogil:
            used = e3d_write_faces(&sizes[0], count, position, other, <e3d_corner_form>form,
                                   &view[0], &end_view[0])
    return text[:used], ends
