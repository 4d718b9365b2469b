# Part of scene_graph.pyx: csrc/include/e3d_flow.h over arrays that Python owns.
#
# In:  the identities of a picture's pixels, and things at a moment, which are held.
# Out: points and marks, in arrays of the caller.

cdef class NativeSeen:
    """What a picture shows at each pixel: IDs (N,) and barycentric coordinates (N, 3)."""

    cdef e3d_seen seen
    cdef object held

    def __cinit__(
        self,
        const int32_t[::1] object_id not None,
        const int32_t[::1] instance_id not None,
        const int32_t[::1] face_id not None,
        const float[:, ::1] barycentric not None,
    ):
        cdef Py_ssize_t count = object_id.shape[0]
        if instance_id.shape[0] != count or face_id.shape[0] != count:
            raise InvalidArgumentError("IDs must be equally many")
        if barycentric.shape[0] != count or barycentric.shape[1] != 3 or not 0 < count < MOST_RAYS:
            raise InvalidArgumentError("barycentric must be (N, 3)")
        self.held = object_id, instance_id, face_id, barycentric
        self.seen.pixels = <int32_t>count
        self.seen.object_id, self.seen.instance_id = &object_id[0], &instance_id[0]
        self.seen.face_id, self.seen.barycentric = &face_id[0], &barycentric[0, 0]


cdef class NativeThings:
    """The things of a moment, as a camera has them: a row each, by object_id (IDs,)."""

    cdef e3d_thing *rows
    cdef e3d_things things
    cdef int32_t count
    cdef list held
    cdef object by_id

    def __cinit__(self, int32_t count, const int32_t[::1] thing_of not None):
        for i in range(thing_of.shape[0]):
            if not -1 <= thing_of[i] < count:
                raise InvalidArgumentError("no such thing")
        self.rows = <e3d_thing *>calloc(max(count, 1), sizeof(e3d_thing))
        if self.rows == NULL:
            raise OutOfMemoryError("no memory for the things of a moment")
        self.held, self.by_id, self.count = [None] * count, thing_of, count
        self.things.rows, self.things.ids = self.rows, <int32_t>thing_of.shape[0]
        self.things.thing_of = &thing_of[0] if thing_of.shape[0] else NULL

    def __dealloc__(self):
        free(self.rows)

    def set(
        self,
        int32_t number,
        const float[:, ::1] positions not None,
        const int32_t[:, ::1] faces not None,
        const double[:, ::1] view_from_thing not None,
        const float[:, ::1] poses,
    ):
        """Tell a thing's triangles, whose indices are in range, and its poses, (N, 16) or (N, 4)."""
        if not 0 <= number < self.count or positions.shape[1] != 3 or faces.shape[1] != 3:
            raise InvalidArgumentError("positions and faces must be (N, 3)")
        if view_from_thing.shape[0] != 4 or view_from_thing.shape[1] != 4:
            raise InvalidArgumentError("a pose is 4x4")
        cdef e3d_thing *thing = &self.rows[number]
        memset(thing, 0, sizeof(e3d_thing))
        self.held[number] = positions, faces, poses
        thing.positions = &positions[0, 0] if positions.shape[0] else NULL
        thing.faces = &faces[0, 0] if faces.shape[0] else NULL
        thing.face_count = <int32_t>faces.shape[0]
        memcpy(thing.view_from_thing, &view_from_thing[0, 0], 12 * sizeof(double))
        if poses is not None:
            if poses.shape[1] not in (4, 16):
                raise InvalidArgumentError("poses must be (N, 16) or (N, 4)")
            thing.pose_kind = E3D_POSE_MATRIX if poses.shape[1] == 16 else E3D_POSE_OFFSET_SCALE
            thing.instances = <int32_t>poses.shape[0]
            thing.poses = &poses[0, 0] if poses.shape[0] else NULL


def seen_points(
    NativeSeen seen not None, NativeThings things not None, double[:, ::1] points not None, int threads
):
    """Write where the points (N, 3) that a picture shows are at a moment, in its camera's space.

    NaN where a pixel shows nothing that is there.
    """
    if points.shape[0] != seen.seen.pixels or points.shape[1] != 3:
        raise InvalidArgumentError("points must be (N, 3)")
    threads = threads if threads else e3d_thread_count()
    e3d_seen_points(&seen.seen, &things.things, &points[0, 0], threads)


def points_to_pixels(
    const double[:, ::1] screen_from_view not None,
    const double[:, ::1] points not None,
    double[:, ::1] pixels not None,
    int threads,
):
    """Write the places (N, 2) of points (N, 3), by rows (3, 4) of x, y and w."""
    cdef Py_ssize_t count = points.shape[0]
    if screen_from_view.shape[0] != 3 or screen_from_view.shape[1] != 4:
        raise InvalidArgumentError("screen_from_view must be (3, 4)")
    if points.shape[1] != 3 or pixels.shape[0] != count or pixels.shape[1] != 2 or count > MOST_RAYS:
        raise InvalidArgumentError("points must be (N, 3), and pixels (N, 2)")
    threads = threads if threads else e3d_thread_count()
    if count:
        e3d_points_to_pixels(
            &screen_from_view[0, 0], &points[0, 0], <int32_t>count, &pixels[0, 0], threads
        )


def seen_again(
    NativeSeen first not None,
    NativeSeen second not None,
    NativeThings things not None,
    const double[:, ::1] points not None,
    const int32_t[::1] at not None,
    int32_t width,
    bint in_perspective,
    uint8_t[::1] visible not None,
    int threads,
):
    """Mark the points of a first picture that a second one shows, visible (N,).

    In: the things of the second moment, the points (N, 3) in its camera's space, and the pixels of
    its picture that they lie in, -1 for none.
    """
    cdef e3d_seen_again job
    cdef int32_t pixels = second.seen.pixels
    if points.shape[0] != first.seen.pixels or points.shape[1] != 3:
        raise InvalidArgumentError("points must be (N, 3)")
    if at.shape[0] != points.shape[0] or visible.shape[0] != points.shape[0]:
        raise InvalidArgumentError("a place and a mark a point")
    if width < 1 or pixels % width:
        raise InvalidArgumentError("the picture has whole rows")
    for i in range(at.shape[0]):
        if at[i] >= pixels:
            raise InvalidArgumentError("no such pixel")
    job.first, job.second, job.things = &first.seen, &second.seen, &things.things
    job.points, job.at = &points[0, 0], &at[0]
    job.width, job.height, job.in_perspective = width, pixels // width, in_perspective
    threads = threads if threads else e3d_thread_count()
    e3d_find_seen_again(&job, &visible[0], threads)
