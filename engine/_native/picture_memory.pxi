# Part of canvas.pyx and of ui.pyx: a picture's pixels, as C takes them.
#
# In:  (height, width, 4) uint8, rows of any stride.
# Out: an e3d_canvas over them; the caller keeps the pixels alive.


cdef int take_picture(uint8_t[:, :, :] pixels, int most, e3d_canvas *picture) except -1:
    """`most`: the pixels of the longest side that is drawn on."""
    if pixels.shape[2] != 4:
        raise ValueError(f"a pixel has 4 bytes, not {pixels.shape[2]}")
    if pixels.shape[0] > most or pixels.shape[1] > most:
        raise ValueError(f"a side is longer than {most} pixels")
    if pixels.strides[2] != 1 or (pixels.strides[1] != 4 and pixels.shape[1] > 1):
        raise ValueError("the pixels of a row are not contiguous")
    picture.height, picture.width = <int>pixels.shape[0], <int>pixels.shape[1]
    picture.stride = pixels.strides[0]
    picture.pixels = NULL
    if pixels.shape[0] > 0 and pixels.shape[1] > 0:
        picture.pixels = &pixels[0, 0, 0]
    return 0
