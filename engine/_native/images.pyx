# cython: boundscheck=False, wraparound=False, initializedcheck=False
"""The gateway to the loops over image files in C: checks shapes, releases the GIL, makes one call.

In:  pixels, or the bytes of a file.
Out: the bytes of a file, or pixels.
"""

from cpython.bytes cimport PyBytes_FromStringAndSize
from e3d_images cimport *
from libc.stdint cimport int32_t, uint8_t
from libc.stdlib cimport free

from ..errors import InvalidArgumentError, OutOfMemoryError

cdef int32_t MAX_SIDE = 16384
cdef dict RGBE_FAULTS = {
    E3D_RGBE_WHOLE: "",
    E3D_RGBE_CUT_SHORT: "the file ends",
    E3D_RGBE_RUN_TOO_LONG: "a run does not fit its line",
    E3D_RGBE_NOTHING_TO_REPEAT: "a line begins with a repetition",
    E3D_RGBE_OTHER_WIDTH: "a line has another width",
}


def encode_png(const uint8_t[:, :, :] pixels not None, int32_t bits=8) -> bytes:
    """Return a PNG file of pixels, each side from 1 to 16384.

    Parameters
    ----------
    pixels : (H, W, C) uint8
        The bytes of a pixel: 1 to 4 channels are grey, grey with alpha, RGB, RGBA.
    bits : {8, 16}
        Of a channel; of 16, the higher byte is the first.
    """
    cdef int32_t height = <int32_t>pixels.shape[0], width = <int32_t>pixels.shape[1]
    cdef int32_t pixel_bytes = <int32_t>pixels.shape[2]
    if bits not in (8, 16) or pixel_bytes * 8 not in (bits, 2 * bits, 3 * bits, 4 * bits):
        raise InvalidArgumentError("pixels must be (height, width, 1 to 4), of 8 or 16 bits a channel")
    if not (0 < pixels.shape[0] <= MAX_SIDE and 0 < pixels.shape[1] <= MAX_SIDE):
        raise InvalidArgumentError(f"a side is from 1 to {MAX_SIDE} pixels")
    if pixels.strides[2] != 1 or pixels.strides[1] != pixel_bytes:
        raise InvalidArgumentError("each row of pixels must be contiguous")
    cdef uint8_t *file = NULL
    cdef size_t size = 0
    cdef bint done
    with nogil:
        done = e3d_png_encode(
            &pixels[0, 0, 0], width, height, pixels.strides[0], pixel_bytes * 8 // bits, bits, &file, &size
        )
    if not done:
        raise OutOfMemoryError("no memory for a PNG file")
    try:
        return PyBytes_FromStringAndSize(<const char *>file, <Py_ssize_t>size)
    finally:
        free(file)


def unpack_tga(const uint8_t[::1] data not None, uint8_t[:, ::1] pixels not None) -> int:
    """Unpack run-length packets into (N, 1 to 4) uint8 pixels; return how many were there."""
    cdef size_t count = pixels.shape[0], length = data.shape[0], done
    if not 0 < pixels.shape[1] <= 4:
        raise InvalidArgumentError("a pixel has 1 to 4 bytes")
    if count == 0 or length == 0:
        return 0
    cdef int32_t pixel_bytes = <int32_t>pixels.shape[1]
    with nogil:
        done = e3d_tga_unpack(&data[0], length, pixel_bytes, &pixels[0, 0], count)
    return done


def unpack_rgbe(const uint8_t[::1] data not None, uint8_t[:, :, ::1] pixels not None) -> tuple[int, int, str]:
    """Unpack scan lines of a Radiance picture into (lines, width, 4) uint8.

    Returns how many are whole, the place of the fault in the data, and what it is: "" for none.
    """
    cdef size_t length = data.shape[0], lines = pixels.shape[0], used = 0, done
    cdef int32_t width = <int32_t>pixels.shape[1]
    cdef e3d_rgbe_fault fault
    cdef uint8_t none = 0
    cdef const uint8_t *start = &data[0] if length else &none
    if not (0 < pixels.shape[0] <= MAX_SIDE and 0 < pixels.shape[1] <= MAX_SIDE and pixels.shape[2] == 4):
        raise InvalidArgumentError(f"pixels must be (lines, width, 4), each side from 1 to {MAX_SIDE}")
    with nogil:
        done = e3d_rgbe_unpack(start, length, width, lines, &pixels[0, 0, 0], &used, &fault)
    return done, used, RGBE_FAULTS[fault]
