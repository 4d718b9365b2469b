# Part of rasterizer.pyx: the glow of what is brighter than 1.


def bloom_scratch(int width, int height, int threads) -> int:
    """How many floats `add_bloom` needs."""
    return e3d_bloom_scratch(width, height, threads if threads else e3d_thread_count())


def add_bloom(
    const float[:, :, ::1] radiance not None,
    uint8_t[:, :, ::1] color not None,
    float strength,
    bint srgb,
    int backend,
    int threads,
    float[::1] scratch not None,
):
    """Lay the glow of what is above 1 over colours."""
    cdef e3d_bloom bloom
    cdef e3d_status status
    cdef int used = threads if threads else e3d_thread_count()
    bloom.height, bloom.width = <int32_t>color.shape[0], <int32_t>color.shape[1]
    bytes_of(color, bloom.width, bloom.height)
    require(radiance.shape[0] == bloom.height and radiance.shape[1] == bloom.width and radiance.shape[2] == 3,
            "radiance must be (height, width, 3)")
    require(0 < bloom.width <= 16384 and 0 < bloom.height <= 16384, "an image has at least one pixel")
    require(<size_t>scratch.shape[0] >= e3d_bloom_scratch(bloom.width, bloom.height, used), "scratch is too small")
    bloom.radiance, bloom.color = &radiance[0, 0, 0], &color[0, 0, 0]
    bloom.strength, bloom.srgb = strength, srgb
    with nogil:
        status = e3d_add_bloom(&bloom, <e3d_backend>backend, used, &scratch[0])
    check(status)
