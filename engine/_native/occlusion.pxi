# Part of rasterizer.pyx: ambient occlusion of a picture of depths and normals.


def occlusion_scratch(int width, int height) -> int:
    """How many floats `find_occlusion` needs."""
    return e3d_occlusion_scratch(width, height)


def find_occlusion(
    const float[:, ::1] depth not None,
    const float[:, :, ::1] normal not None,
    across: tuple[float, float],
    down: tuple[float, float],
    bint is_perspective,
    float radius,
    int backend,
    int threads,
    float[::1] scratch not None,
    float[:, ::1] visibility not None,
):
    """Find what of the light from all around reaches each pixel (e3d_find_occlusion): pictures are (height, width)."""
    cdef e3d_depth_picture picture
    cdef e3d_status status
    picture.width, picture.height = <int32_t>depth.shape[1], <int32_t>depth.shape[0]
    require(picture.width > 0 and picture.height > 0, "an image has at least one pixel")
    require(normal.shape[0] == picture.height and normal.shape[1] == picture.width and normal.shape[2] == 3,
            "normal must be (height, width, 3)")
    floats_of(visibility, picture.width, picture.height)
    require(0 < <size_t>scratch.shape[0] >= e3d_occlusion_scratch(picture.width, picture.height), "scratch is too small")
    picture.depth, picture.normal = &depth[0, 0], &normal[0, 0, 0]
    picture.across[0], picture.across[1] = across
    picture.down[0], picture.down[1] = down
    picture.is_perspective = is_perspective
    with nogil:
        status = e3d_find_occlusion(
            <e3d_backend>backend, threads, &picture, radius, &scratch[0], &visibility[0, 0]
        )
    check(status)
