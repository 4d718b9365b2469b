# Part of rasterizer.pyx: what is behind glass.


def behind_floats(int width, int height) -> int:
    """How many floats `find_behind` fills."""
    return e3d_behind_floats(width, height)


def find_behind(
    const float[:, :, ::1] radiance not None,
    const uint8_t[:, :, ::1] color not None,
    bint srgb,
    bint is_transparent,
    int tone_mapping,
    int backend,
    int threads,
    float[::1] levels not None,
):
    """Find what glass shows bent and blurred, of a picture without what is blended."""
    cdef e3d_behind picture
    cdef e3d_status status
    cdef int used = threads if threads else e3d_thread_count()
    picture.height, picture.width = <int32_t>color.shape[0], <int32_t>color.shape[1]
    require(color.shape[2] == 4, "color must be (height, width, 4)")
    require(radiance.shape[0] == picture.height and radiance.shape[1] == picture.width and radiance.shape[2] == 3,
            "radiance must be (height, width, 3)")
    require(0 < picture.width <= 16384 and 0 < picture.height <= 16384, "an image has at least one pixel")
    require(<size_t>levels.shape[0] >= e3d_behind_floats(picture.width, picture.height), "levels are too small")
    picture.radiance, picture.color = &radiance[0, 0, 0], &color[0, 0, 0]
    picture.srgb, picture.is_transparent = srgb, is_transparent
    picture.tone_mapping = <e3d_tone_mapping>tone_mapping
    with nogil:
        status = e3d_find_behind(&picture, <e3d_backend>backend, used, &levels[0])
    check(status)
