# Part of loaders.pyx: buffer views of glTF files that meshopt packed.
#
# In:  bytes, the mode, the filter, the count and size of elements.
# Out: the elements as bytes.

_MESHOPT_FILTERS = {
    "OCTAHEDRAL": E3D_MESHOPT_OCTAHEDRAL,
    "QUATERNION": E3D_MESHOPT_QUATERNION,
    "EXPONENTIAL": E3D_MESHOPT_EXPONENTIAL,
    "COLOR": E3D_MESHOPT_COLOR,
}
_MESHOPT_STRIDES = {"OCTAHEDRAL": (4, 8), "QUATERNION": (8,), "COLOR": (4, 8)}


def unpack_meshopt(const uint8_t[::1] data not None, str mode, str filter, size_t count,
                   size_t stride) -> NDArray[np.uint8] | None:
    """Return the elements of a packed view, (count * stride,) uint8; None if it is damaged."""
    if mode == "ATTRIBUTES":
        sound = stride % 4 == 0 and 0 < stride <= E3D_MESHOPT_MAX_STRIDE
        sound = sound and (filter == "NONE" or filter in _MESHOPT_FILTERS)
        sound = sound and stride in _MESHOPT_STRIDES.get(filter, (stride,))
    else:
        sound = stride in (2, 4) and filter == "NONE" and mode in ("TRIANGLES", "INDICES")
        sound = sound and (mode == "INDICES" or count % 3 == 0)
    if not sound or not count or not data.shape[0]:
        return None
    elements = np.empty(count * stride, np.uint8)
    cdef uint8_t[::1] view = elements
    cdef size_t size = data.shape[0]
    cdef int kind = ("ATTRIBUTES", "TRIANGLES", "INDICES").index(mode)
    cdef e3d_meshopt_filter undone = _MESHOPT_FILTERS.get(filter, E3D_MESHOPT_OCTAHEDRAL)
    cdef bint is_filtered = filter != "NONE", done
    with nogil:
        if kind == 0:
            done = e3d_meshopt_attributes(&data[0], size, &view[0], count, stride)
        elif kind == 1:
            done = e3d_meshopt_triangles(&data[0], size, &view[0], count, stride)
        else:
            done = e3d_meshopt_indices(&data[0], size, &view[0], count, stride)
        if done and is_filtered:
            e3d_meshopt_undo_filter(&view[0], count, stride, undone)
    return elements if done else None
