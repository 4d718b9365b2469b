# Part of rasterizer.pyx: triangles in clip space, without scene and camera.


def draw_clip(
    const float[:, ::1] clip not None,
    const uint8_t[:, ::1] colors not None,
    const int32_t[:, ::1] faces not None,
    const int32_t[::1] looks not None,
    const float[:, ::1] uvs,
    list textures not None,
    int samples,
    int backend,
    int threads,
    uint8_t[:, :, ::1] rgba not None,
):
    """Draw clip-space triangles of colours on nothing; the size is that of the output.

    `looks` of the faces: 0 opaque, 1 blended, 2 + k blended, times the k-th NativeTexture of `textures`.
    """
    cdef e3d_clip_triangles drawn
    cdef int32_t height = <int32_t>rgba.shape[0], width = <int32_t>rgba.shape[1]
    cdef const e3d_texture **handles = NULL
    cdef e3d_status status
    require(clip.shape[1] == 4 and colors.shape[1] == 4 and colors.shape[0] == clip.shape[0], "(vertices, 4)")
    require(faces.shape[1] == 3 and looks.shape[0] == faces.shape[0], "faces must be (faces, 3), looks (faces,)")
    require(uvs is None or uvs.shape[0] == clip.shape[0] and uvs.shape[1] == 2, "uvs must be (vertices, 2)")
    require(width > 0 and height > 0 and rgba.shape[2] == 4, "rgba must be (height, width, 4)")
    memset(&drawn, 0, sizeof(drawn))
    drawn.vertices, drawn.faces_count = <int32_t>clip.shape[0], <int32_t>faces.shape[0]
    drawn.texture_count = <int32_t>len(textures)
    if drawn.vertices:
        drawn.clip, drawn.colors = &clip[0, 0], &colors[0, 0]
        drawn.uvs = NULL if uvs is None else &uvs[0, 0]
    if drawn.faces_count:
        drawn.faces, drawn.looks = &faces[0, 0], &looks[0]
    handles = <const e3d_texture **>resized(NULL, len(textures) + 1, sizeof(void *))
    try:
        for k in range(len(textures)):
            handles[k] = (<NativeTexture?>textures[k]).handle
        drawn.textures = handles
        with nogil:
            status = e3d_draw_clip(&drawn, width, height, samples, <e3d_backend>backend, threads, &rgba[0, 0, 0])
        check(status)
    finally:
        free(handles)


def rasterize(
    const float[:, ::1] clip not None,
    const int32_t[:, ::1] faces not None,
    int cull,
    int backend,
    int threads,
    int32_t[:, ::1] face_id not None,
    float[:, ::1] depth not None,
    float[:, :, ::1] barycentric not None,
):
    """Draw clip-space triangles; the size is that of the output arrays."""
    cdef int32_t height = <int32_t>face_id.shape[0], width = <int32_t>face_id.shape[1]
    require(clip.shape[1] == 4, "clip must be (vertices, 4)")
    require(faces.shape[1] == 3, "faces must be (faces, 3)")
    require(width > 0 and height > 0, "an image has at least one pixel")
    floats_of(depth, width, height)
    vectors_of(barycentric, width, height, 3)
    cdef const float *positions = &clip[0, 0] if clip.shape[0] else NULL
    cdef const int32_t *indices = &faces[0, 0] if faces.shape[0] else NULL
    cdef e3d_status status
    with nogil:
        status = e3d_rasterize(
            positions, <int32_t>clip.shape[0], indices, <int32_t>faces.shape[0], width, height,
            <e3d_cull>cull, <e3d_backend>backend, threads, &face_id[0, 0], &depth[0, 0],
            &barycentric[0, 0, 0],
        )
    check(status)
