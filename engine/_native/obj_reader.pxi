# Part of loaders.pyx: OBJ files.
#
# In:  the bytes of a file, read in steps.
# Out: arrays that own what C allocated, and the words that the file holds.

cdef class ObjReader:
    """Reads an OBJ file: `read` until it returns False, then `end`, then `take` what is there."""

    cdef e3d_obj obj
    cdef const uint8_t[::1] data

    def __cinit__(self, const uint8_t[::1] data not None):
        self.data = data
        if not e3d_obj_begin(&self.obj, &data[0] if data.shape[0] else NULL, data.shape[0]):
            raise OutOfMemoryError("no memory to read an OBJ file")

    def __dealloc__(self):
        e3d_obj_free(&self.obj)

    def read(self, size_t size) -> bool:
        """Read about so many bytes; return whether there is more to read."""
        cdef bint more
        with nogil:
            more = e3d_obj_read(&self.obj, size)
        return more

    @property
    def consumed(self) -> int:
        return self.obj.consumed

    def end(self) -> int:
        """Check what was read; return the problem, `DONE` for none."""
        with nogil:
            e3d_obj_end(&self.obj)
        return self.obj.error.problem

    @property
    def error(self) -> tuple[int, int, int, bytes]:
        """(list, count, line, word) of the problem."""
        cdef e3d_obj_error *error = &self.obj.error
        return error.list, error.count, error.place.line, self.word(&error.place)

    cdef object word(self, const e3d_obj_place *place):
        cdef const char *names = <const char *>self.obj.names
        if place.word_length == 0:
            return b""
        return PyBytes_FromStringAndSize(names + place.word, <Py_ssize_t>place.word_length)

    cdef object elements(self, e3d_obj_elements *elements):
        sizes = owned(<void **>&elements.sizes, elements.count, np.dtype(np.int32))
        indices = [
            owned(<void **>&elements.indices[k], elements.corners, np.dtype(np.int32))
            if k == E3D_OBJ_V or elements.indices[k] != NULL else None
            for k in range(<int>E3D_OBJ_LISTS)
        ]
        outside = [
            (elements.outside[k].count, elements.outside[k].first.line,
             self.word(&elements.outside[k].first))
            for k in range(<int>E3D_OBJ_LISTS)
        ]
        small = (elements.small.count, elements.small.first.line)
        return sizes, indices, bool(elements.are_triangles), small, outside

    def take(self) -> dict[str, Any]:
        """Hand over everything, once: a dict of arrays, and of tuples for the elements.

        ``positions`` (V, 3), ``uvs`` (T, 2) and ``normals`` (N, 3) float64; ``colors`` (V, 4) uint8
        or None; ``faces``, ``lines`` and ``points``: (sizes (E,) int32, indices: three of (C,) int32
        or None, whether all are triangles, (count, line) of small ones, (count, line, word) of
        indices out of range for each list); ``setters`` (S,) `SETTER`; ``names`` bytes.
        """
        cdef e3d_obj *obj = &self.obj
        cdef size_t *counts = obj.counts
        real = np.dtype(np.float64)
        colors = None
        if obj.colors != NULL:
            colors = owned(<void **>&obj.colors, 4 * counts[<int>E3D_OBJ_V], np.dtype(np.uint8))
            colors = colors.reshape(-1, 4)
        # What holds words comes before the names go.
        found = {
            "faces": self.elements(&obj.faces),
            "lines": self.elements(&obj.lines),
            "points": self.elements(&obj.points),
        }
        found["colors"] = colors
        found["positions"] = owned(
            <void **>&obj.positions, 3 * counts[<int>E3D_OBJ_V], real).reshape(-1, 3)
        found["uvs"] = owned(<void **>&obj.uvs, 2 * counts[<int>E3D_OBJ_VT], real).reshape(-1, 2)
        found["normals"] = owned(
            <void **>&obj.normals, 3 * counts[<int>E3D_OBJ_VN], real).reshape(-1, 3)
        found["setters"] = owned(<void **>&obj.setters, obj.setter_count, SETTER)
        found["names"] = owned(<void **>&obj.names, obj.name_bytes, np.dtype(np.uint8)).data
        return found
