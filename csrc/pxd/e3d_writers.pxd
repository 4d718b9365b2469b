# Mirrors csrc/include/e3d_writers.h.

from libc.stdint cimport int32_t, int64_t, uint8_t


cdef extern from "e3d_writers.h" nogil:
    enum:
        E3D_FLOAT_LETTERS
        E3D_INTEGER_LETTERS

    ctypedef enum e3d_corner_form:
        E3D_CORNER_V
        E3D_CORNER_V_VT
        E3D_CORNER_V_VN
        E3D_CORNER_V_VT_VN

    size_t e3d_write_float_rows(
        const float *numbers, size_t rows, size_t width, const uint8_t *const *between,
        const size_t *lengths, uint8_t *text)
    size_t e3d_write_faces(
        const int32_t *sizes, size_t faces, const int32_t *positions, const int32_t *others,
        e3d_corner_form form, uint8_t *text, int64_t *ends)
