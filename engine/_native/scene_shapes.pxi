# Part of scene_graph.pyx: what rays and boxes meet that has no node of its own.
#
# In:  boxes, triangles and poses as C-contiguous arrays, which are held for as long as C reads them.
# Out: trees of boxes, and the shapes of a scene's objects; what a query finds, in the caller's arrays.

cdef class NativeTree:
    """A tree of boxes that stay as they are: of a mesh's triangles, or of instances."""

    def __cinit__(self, const double[:, ::1] boxes not None):
        self.count = boxes.shape[0]
        if boxes.shape[1] != E3D_BOX:
            raise InvalidArgumentError("boxes must be (N, BOX)")
        self.tree = e3d_tree_create()
        if self.tree == NULL or not e3d_tree_build(
            self.tree, &boxes[0, 0] if boxes.shape[0] else NULL, <int32_t>boxes.shape[0], 1
        ):
            raise OutOfMemoryError("no memory for a tree of boxes")

    def __dealloc__(self):
        e3d_tree_destroy(self.tree)

    def boxes_by_level(self) -> list[NDArray[np.float32]]:
        """Return what the tree holds: see the function of this name."""
        return boxes_by_level(self.tree)

    def overlaps(
        self,
        const double[::1] low not None,
        const double[::1] high not None,
        uint64_t[::1] bits not None,
    ):
        """Set the bits of the items whose boxes meet a box."""
        if low.shape[0] != 3 or high.shape[0] != 3 or 64 * bits.shape[0] < self.count:
            raise InvalidArgumentError("a box has two corners, and a selection a bit an item")
        if self.count:
            e3d_tree_overlaps(self.tree, &low[0], &high[0], &bits[0])

    def on_ray(
        self,
        const double[::1] origin not None,
        const double[::1] direction not None,
        double farthest,
        uint64_t[::1] bits not None,
    ):
        """Set the bits of the items whose boxes a ray of unit direction may meet."""
        if origin.shape[0] != 3 or direction.shape[0] != 3 or 64 * bits.shape[0] < self.count:
            raise InvalidArgumentError("a ray has two vectors, and a selection a bit an item")
        if self.count:
            e3d_tree_ray(self.tree, &origin[0], &direction[0], farthest, &bits[0])

    def nearest_triangle(
        self,
        const float[:, ::1] positions not None,
        const int32_t[:, ::1] faces not None,
        const double[:, ::1] pose not None,
        const double[::1] origin not None,
        const double[::1] direction not None,
        double farthest,
    ) -> float:
        """Return how far a ray of unit direction goes to the triangles that this is the tree of.

        They are at a pose (4, 4). Infinite where the ray meets none up to `farthest`.
        """
        cdef e3d_shape shape
        cdef e3d_hit hit
        if pose.shape[0] != 4 or pose.shape[1] != 4:
            raise InvalidArgumentError("a pose is 4x4")
        if origin.shape[0] != 3 or direction.shape[0] != 3:
            raise InvalidArgumentError("a ray has two vectors")
        fill_triangles(&shape, positions, faces, self)
        e3d_shape_ray(
            &shape, &pose[0, 0], &origin[0], &direction[0], farthest, E3D_CULL_NONE, &hit
        )
        return INFINITY if hit.slot < 0 else hit.distance


cdef int fill_triangles(
    e3d_shape *shape,
    const float[:, ::1] positions,
    const int32_t[:, ::1] faces,
    NativeTree triangles,
) except -1:
    """Make a shape of triangles and nothing else, or leave it as it is and raise."""
    if positions.shape[1] != 3 or faces.shape[1] != 3:
        raise InvalidArgumentError("positions and faces must be (N, 3)")
    if triangles.count != faces.shape[0]:
        raise InvalidArgumentError("the tree must be of the faces")
    memset(shape, 0, sizeof(e3d_shape))
    shape.known = 1
    shape.face_count = <int32_t>faces.shape[0]
    shape.positions = &positions[0, 0] if positions.shape[0] else NULL
    shape.faces = &faces[0, 0] if faces.shape[0] else NULL
    shape.triangles = triangles.tree
    return 0


cdef class NativeShapes:
    """What the objects of a scene are to rays, by number; each is known once it was asked for."""

    def __cinit__(self, int32_t count):
        self.held = [None] * count
        self.count = count
        self.shapes = <e3d_shape *>calloc(max(count, 1), sizeof(e3d_shape))
        if self.shapes == NULL:
            raise OutOfMemoryError("no memory for the shapes of a scene")

    def __dealloc__(self):
        free(self.shapes)

    def set(
        self,
        int32_t number,
        const float[:, ::1] positions not None,
        const int32_t[:, ::1] faces not None,
        NativeTree triangles not None,
        const float[:, ::1] poses,
        NativeTree instances,
    ):
        """Tell an object's triangles; its poses, (N, 16) or (N, 4), and their tree if there are any."""
        if not 0 <= number < self.count:
            raise InvalidArgumentError("no such object")
        if poses is not None and instances is not None and instances.count != poses.shape[0]:
            raise InvalidArgumentError("the tree must be of the poses")
        cdef e3d_shape *shape = &self.shapes[number]
        fill_triangles(shape, positions, faces, triangles)
        if poses is not None:
            if poses.shape[1] not in (4, 16) or instances is None:
                raise InvalidArgumentError("poses must be (N, 16) or (N, 4), with a tree")
            shape.pose_kind = E3D_POSE_MATRIX if poses.shape[1] == 16 else E3D_POSE_OFFSET_SCALE
            shape.instances = <int32_t>poses.shape[0]
            shape.poses = &poses[0, 0] if poses.shape[0] else NULL
            shape.instance_tree = instances.tree
        self.held[number] = (positions, faces, triangles, poses, instances)

    def knows(self, int32_t number) -> bool:
        """Return whether an object's triangles were told."""
        return 0 <= number < self.count and self.shapes[number].known != 0
