# Part of rasterizer.pyx: between which depths the comparisons of a shadow map lie.


cdef int require_ranges(const uint32_t[:, ::1] ranges, int size) except -1:
    """Raise unless a map of that size has such ranges."""
    cdef int side = e3d_shadow_ranges_side(size)
    return require(ranges.shape[0] == side and ranges.shape[1] == side, f"ranges must be ({side}, {side})")


def shadow_ranges_side(int size) -> int:
    """How many words of ranges a map of that size has a side."""
    return e3d_shadow_ranges_side(size)


def find_shadow_ranges(const float[:, ::1] depths not None, int taps, int step, uint32_t[:, ::1] ranges not None):
    """Find between which depths lies what comparisons touch, of a map that will be looked up again."""
    cdef e3d_status status
    cdef int size = <int>depths.shape[0]
    require(depths.shape[1] == size > 0, "a map is a square")
    require(taps in (1, 3, 5) and 0 <= step * (taps - 1) <= 256 * size - 512, "comparisons leave the map")
    require_ranges(ranges, size)
    with nogil:
        status = e3d_find_shadow_ranges(&depths[0, 0], size, taps, step, &ranges[0, 0])
    check(status)


def find_soft_ranges(
    const float[:, ::1] depths not None, int taps, int step, float widest, uint32_t[:, :, ::1] ranges not None
):
    """Find the least depths around each block, of a map of a soft light that will be looked up again."""
    cdef e3d_status status
    cdef int size = <int>depths.shape[0]
    require(depths.shape[1] == size > 0, "a map is a square")
    require(taps in (1, 3, 5) and 0 <= step * (taps - 1) <= 256 * size - 512, "comparisons leave the map")
    require(1.0 <= widest <= 64.0, "lookups are too wide")
    require(ranges.shape[0] == 2, "there are two words")
    require_ranges(ranges[0], size)
    with nogil:
        status = e3d_find_soft_ranges(&depths[0, 0], size, taps, step, widest, &ranges[0, 0, 0])
    check(status)
