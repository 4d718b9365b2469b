# Part of rasterizer.pyx: the core's side of a mesh and of a texture.
#
# In:  C-contiguous arrays, which are checked here and held for as long as the core reads them.
# Out: handles that a draw list borrows.

cdef const void *rows_of(array, int number, int count, list held) except? NULL:
    """The rows of an array of vertex attribute `number`, which `held` keeps; NULL if there are none."""
    cdef const e3d_array_format *format = &E3D_VERTEX_FORMATS[number]
    cdef const float[:, ::1] floats
    cdef const uint8_t[:, ::1] octets
    if format.is_float:
        floats = array
        rows, columns = floats.shape[0], floats.shape[1]
        held.append(floats)
    else:
        octets = array
        rows, columns = octets.shape[0], octets.shape[1]
        held.append(octets)
    require(rows == count and columns == format.channels,
            f"{format.name.decode()} must be (vertices, {format.channels})")
    if count == 0:
        return NULL
    return <const void *>&floats[0, 0] if format.is_float else <const void *>&octets[0, 0]


cdef class NativeMesh:
    """A mesh of the core. It borrows the arrays given, which must never change."""

    cdef e3d_mesh *handle
    cdef list borrowed
    cdef readonly set attributes  # their names
    cdef readonly bint has_face_normals, has_edges
    cdef readonly int32_t vertices, faces_count

    def __init__(
        self,
        const float[:, ::1] positions not None,
        const int32_t[:, ::1] faces not None,
        dict attributes not None,
        *,
        const int32_t[::1] material_ids=None,
        const int32_t[:, ::1] lines=None,
        const int32_t[::1] points=None,
        const int32_t[::1] movers=None,
        int threads=0,
    ):
        cdef e3d_mesh_desc desc
        require(self.handle == NULL, "a mesh is made once")
        memset(&desc, 0, sizeof(desc))
        cdef int32_t count = <int32_t>positions.shape[0]
        require(positions.shape[1] in (3, 4), "positions must have 3 or 4 columns")
        require(faces.shape[1] == 3, "faces must have 3 columns")
        self.borrowed = [positions, faces, material_ids, lines, points, movers]
        self.attributes = set(attributes)
        self.vertices = desc.vertices = count
        desc.components = <int32_t>positions.shape[1]
        self.faces_count = desc.faces_count = <int32_t>faces.shape[0]
        if count:
            desc.positions = &positions[0, 0]
        if desc.faces_count:
            desc.faces = &faces[0, 0]
        for name, array in attributes.items():
            number = VERTEX_NUMBERS[name]
            e3d_mesh_desc_set(&desc, number, rows_of(array, number, count, self.borrowed))
        if material_ids is not None and desc.faces_count:
            require(material_ids.shape[0] == desc.faces_count, "material_ids must be (faces,)")
            desc.material_ids = &material_ids[0]
        if lines is not None and lines.shape[0]:
            require(lines.shape[1] == 2, "lines must have 2 columns")
            desc.lines_count = <int32_t>lines.shape[0]
            desc.lines = &lines[0, 0]
        if points is not None and points.shape[0]:
            desc.points_count = <int32_t>points.shape[0]
            desc.points = &points[0]
        if movers is not None and count:
            require(movers.shape[0] == count, "movers must be (vertices,)")
            desc.movers = &movers[0]
        cdef e3d_status status
        with nogil:
            status = e3d_mesh_create(&desc, threads, &self.handle)
        check(status)

    def __dealloc__(self):
        if self.handle != NULL:
            e3d_mesh_destroy(self.handle)

    # The first array stays: a thread may be drawing by it when another brings its own.

    def set_attribute(self, str name, array: NDArray[np.float32] | NDArray[np.uint8]):
        """Add an array of `VERTEX_ATTRIBUTES`."""
        number = VERTEX_NUMBERS[name]
        if name in self.attributes:
            return
        e3d_mesh_set_attribute(
            self.handle, number, rows_of(array, number, self.vertices, self.borrowed)
        )
        self.attributes.add(name)

    def set_face_normals(self, const float[:, ::1] normals not None):
        require(
            normals.shape[0] == self.faces_count and normals.shape[1] == 3, "face_normals: (faces, 3)"
        )
        if self.has_face_normals:
            return
        if self.faces_count:
            e3d_mesh_set_face_normals(self.handle, &normals[0, 0])
        self.borrowed.append(normals)
        self.has_face_normals = True

    def set_edges(self, const int32_t[:, ::1] edges not None):
        require(edges.shape[1] == 2, "edges must have 2 columns")
        if self.has_edges:
            return
        if edges.shape[0]:
            check(e3d_mesh_set_edges(self.handle, &edges[0, 0], <int32_t>edges.shape[0]))
        self.borrowed.append(edges)
        self.has_edges = True


cdef class NativeTexture:
    """A texture of the core, with its mip levels; the pixels are copied."""

    cdef e3d_texture *handle

    def __cinit__(self, const uint8_t[:, :, ::1] pixels not None, bint decode_srgb, int filter, int wrap_u,
                  int wrap_v, int anisotropy, float lod_bias, bint holds_normals):
        require(pixels.shape[2] == 4, "pixels must have 4 channels")
        require(0 < pixels.shape[0] <= 32768 and 0 < pixels.shape[1] <= 32768, "pixels: wrong size")
        cdef e3d_status status
        cdef e3d_sampling sampling
        sampling.filter = <e3d_filter>filter
        sampling.wrap[0], sampling.wrap[1] = <e3d_wrap>wrap_u, <e3d_wrap>wrap_v
        sampling.anisotropy, sampling.lod_bias = anisotropy, lod_bias
        sampling.holds_normals = holds_normals
        with nogil:
            status = e3d_texture_create(
                &pixels[0, 0, 0], <int32_t>pixels.shape[1], <int32_t>pixels.shape[0], decode_srgb,
                &sampling, &self.handle,
            )
        check(status)

    def __dealloc__(self):
        if self.handle != NULL:
            e3d_texture_destroy(self.handle)
