# cython: boundscheck=False, wraparound=False, initializedcheck=False
"""The gateway to pictures in TinyRenderer's manner: csrc/include/e3d_pybullet.h.

In:  what shows at each pixel, a light, a lens; for shadows, depths from the light.
Out: colours, depths and masks, in the caller's arrays.
"""

from libc.stdint cimport int32_t, uint8_t
from libc.string cimport memset

from e3d_pybullet cimport *

from ..errors import InvalidArgumentError


cdef int require(bint condition) except -1:
    if not condition:
        raise InvalidArgumentError("arrays of a picture differ in size")
    return 0


cdef int copy_numbers(float *to, const float[::1] numbers, Py_ssize_t count) except -1:
    require(numbers.shape[0] == count)
    for k in range(count):
        to[k] = numbers[k]
    return 0


def shade(
    const uint8_t[:, :, ::1] own not None,
    const float[:, :, ::1] normals not None,
    const float[:, ::1] depths not None,
    const int32_t[:, ::1] shown not None,
    const int32_t[::1] masks not None,
    const float[::1] light not None,
    const float[::1] lens not None,
    uint8_t[:, :, ::1] colors not None,
    float[:, ::1] window_depths not None,
    int32_t[:, ::1] shown_masks not None,
    const float[:, :, ::1] positions=None,
    const float[:, ::1] shadows=None,
    const float[::1] clip=None,
):
    """Fill in colours, depths and masks.

    Light: direction, colour, ambient, diffuse, specular. Lens: whether it is parallel, scale and
    offset. The last three are given together, or not at all: without them, there are no shadows.
    """
    cdef e3d_tiny_picture p
    memset(&p, 0, sizeof(p))
    cdef Py_ssize_t height = shown.shape[0], width = shown.shape[1]
    require(height > 0 and width > 0 and masks.shape[0] > 0)
    require(light.shape[0] == 9 and lens.shape[0] == 3)
    require(own.shape[0] == height and own.shape[1] == width and own.shape[2] == 4)
    require(normals.shape[0] == height and normals.shape[1] == width and normals.shape[2] == 3)
    require(depths.shape[0] == height and depths.shape[1] == width)
    require(colors.shape[0] == height and colors.shape[1] == width and colors.shape[2] == 4)
    require(window_depths.shape[0] == height and window_depths.shape[1] == width)
    require(shown_masks.shape[0] == height and shown_masks.shape[1] == width)
    p.width, p.height, p.mask_count = <int32_t>width, <int32_t>height, <int32_t>masks.shape[0]
    p.own, p.normals, p.depths = &own[0, 0, 0], &normals[0, 0, 0], &depths[0, 0]
    p.shown, p.masks = &shown[0, 0], &masks[0]
    copy_numbers(p.light.direction, light[:3], 3)
    copy_numbers(p.light.color, light[3:6], 3)
    p.light.ambient, p.light.diffuse, p.light.specular = light[6], light[7], light[8]
    p.lens.is_parallel, p.lens.scale, p.lens.offset = <int32_t>lens[0], lens[1], lens[2]
    if shadows is not None:
        require(positions is not None and clip is not None)
        require(positions.shape[0] == height and positions.shape[1] == width and positions.shape[2] == 3)
        require(shadows.shape[0] == height and shadows.shape[1] == width)
        p.shadows.positions, p.shadows.depths = &positions[0, 0, 0], &shadows[0, 0]
        copy_numbers(p.shadows.clip, clip, 16)
    p.colors, p.window_depths, p.shown_masks = &colors[0, 0, 0], &window_depths[0, 0], &shown_masks[0, 0]
    with nogil:
        e3d_tiny_shade(&p, 0)
