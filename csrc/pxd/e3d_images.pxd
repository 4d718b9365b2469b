# Mirrors csrc/include/e3d_images.h.

from libc.stddef cimport ptrdiff_t
from libc.stdint cimport int32_t, uint8_t


cdef extern from "e3d_images.h" nogil:
    bint e3d_png_encode(
        const uint8_t *pixels, int32_t width, int32_t height, ptrdiff_t stride,
        int32_t channels, int32_t bits, uint8_t **file, size_t *size,
    )
    size_t e3d_tga_unpack(
        const uint8_t *data, size_t length, int32_t pixel_bytes, uint8_t *pixels, size_t count,
    )

    ctypedef enum e3d_rgbe_fault:
        E3D_RGBE_WHOLE
        E3D_RGBE_CUT_SHORT
        E3D_RGBE_RUN_TOO_LONG
        E3D_RGBE_NOTHING_TO_REPEAT
        E3D_RGBE_OTHER_WIDTH

    size_t e3d_rgbe_unpack(
        const uint8_t *data, size_t length, int32_t width, size_t lines, uint8_t *pixels,
        size_t *used, e3d_rgbe_fault *fault,
    )
