# Part of rasterizer.pyx and scene_graph.pyx: small arrays that callers lend for one call.
#
# In:  any array. Out: its numbers, or its address, if it is of the wanted dtype, shape and order.
# Typed memoryviews check the same and take more than twice as long, since each is an object. The calls of every frame
# look at the buffers themselves; what they don't know is given to a memoryview, which takes it or says what is wrong.

from cpython.buffer cimport PyBUF_C_CONTIGUOUS, PyBUF_FORMAT, PyBUF_WRITABLE, PyBuffer_Release, PyObject_GetBuffer


cdef inline bint is_plain(const Py_buffer *lent, char letter, int ndim) noexcept:
    """Whether a buffer has so many dimensions, and this dtype: one of the letters of Python's struct."""
    return lent.ndim == ndim and lent.format != NULL and lent.format[0] == letter and lent.format[1] == 0


cdef bint copy_matrix(double *to, array) except -1:
    """Copy an array (4, 4); return whether it has this shape."""
    cdef Py_buffer lent
    cdef const double[:, ::1] checked
    PyObject_GetBuffer(array, &lent, PyBUF_C_CONTIGUOUS | PyBUF_FORMAT)
    cdef bint plain = is_plain(&lent, b"d", 2), fits = plain and lent.shape[0] == 4 and lent.shape[1] == 4
    if fits:
        memcpy(to, lent.buf, 16 * sizeof(double))
    PyBuffer_Release(&lent)
    if not plain:
        checked = array
        fits = checked.shape[0] == 4 and checked.shape[1] == 4
        if fits:
            memcpy(to, &checked[0, 0], 16 * sizeof(double))
    return fits
