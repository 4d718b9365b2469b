# Part of rasterizer.pyx: environments and how a frame uses them.


cdef class NativeEnvironment:
    """An environment of the core, with all its levels; the pixels are not kept."""

    cdef e3d_environment *handle

    def __cinit__(self, const float[:, :, ::1] pixels not None, int threads):
        require(pixels.shape[2] == 3, "pixels must have 3 channels")
        require(0 < pixels.shape[0] <= 32768 and 0 < pixels.shape[1] <= 32768, "pixels: wrong size")
        cdef e3d_status status
        cdef int used = threads if threads else e3d_thread_count()
        with nogil:
            status = e3d_environment_create(
                &pixels[0, 0, 0], <int32_t>pixels.shape[1], <int32_t>pixels.shape[0], used, &self.handle
            )
        check(status)

    def __dealloc__(self):
        e3d_environment_destroy(self.handle)

    def level(self, int number) -> LevelTexels:
        """The faces of a level: (6, size + 2, size + 2, 4) float32, a view of the core's memory."""
        require(0 <= number < E3D_ENVIRONMENT_LEVELS, "no such level")
        cdef const e3d_environment_level *level = &e3d_environment_get_view(self.handle).levels[number]
        return LevelTexels.of(self, level.texels, level.size + 2)


cdef class LevelTexels:
    """The texels of a level, for ``numpy.asarray``; it keeps the environment."""

    cdef NativeEnvironment owner
    cdef const float *texels
    cdef Py_ssize_t shape[4]
    cdef Py_ssize_t strides[4]

    @staticmethod
    cdef LevelTexels of(NativeEnvironment owner, const float *texels, Py_ssize_t pitch):
        cdef LevelTexels self = LevelTexels.__new__(LevelTexels)
        self.owner, self.texels = owner, texels
        self.shape[0], self.shape[1], self.shape[2], self.shape[3] = 6, pitch, pitch, 4
        self.strides[3] = sizeof(float)
        for k in range(2, -1, -1):
            self.strides[k] = self.strides[k + 1] * self.shape[k + 1]
        return self

    def __getbuffer__(self, Py_buffer *buffer, int flags):
        buffer.buf = <void *>self.texels
        buffer.obj = self
        buffer.len = self.strides[0] * self.shape[0]
        buffer.itemsize = sizeof(float)
        buffer.readonly = 1
        buffer.ndim = 4
        buffer.format = b"f"
        buffer.shape = self.shape
        buffer.strides = self.strides
        buffer.suboffsets = NULL
        buffer.internal = NULL

