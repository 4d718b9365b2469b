# Part of rasterizer.pyx: meshes that joints and morph targets move.
#
# In:  a mesh at rest, what moves it; poses of nodes and weights, as often as they change.
# Out: handles of posed meshes. Each pose has two, and writes into the one that nobody else holds, so that what
#      a thread is drawing stays as it is.

cdef extern from "Python.h":
    Py_ssize_t references "Py_REFCNT"(PyObject *held)  # without a reference of the call's own


cdef class NativeRest:
    """What moves the vertices of a mesh. It borrows the arrays given, which must never change."""

    cdef e3d_rest *handle
    cdef readonly NativeMesh mesh
    cdef list borrowed
    cdef readonly int32_t joints, targets

    def __cinit__(
        self,
        NativeMesh mesh not None,
        const float[:, ::1] normals,
        const float[:, ::1] tangents,
        const uint16_t[:, ::1] joints,
        const float[:, ::1] weights,
        const float[:, :, ::1] target_positions,
        const float[:, :, ::1] target_normals,
        const float[:, :, ::1] target_tangents,
    ):
        cdef e3d_pose_desc desc
        cdef int32_t count = mesh.vertices
        memset(&desc, 0, sizeof(desc))
        self.mesh = mesh
        self.borrowed = [normals, tangents, joints, weights]
        if normals is not None and count:
            require(normals.shape[0] == count and normals.shape[1] == 3, "normals: (V, 3)")
            desc.normals = &normals[0, 0]
        if tangents is not None and count:
            require(tangents.shape[0] == count and tangents.shape[1] == 4, "tangents: (V, 4)")
            desc.tangents = &tangents[0, 0]
        if joints is not None and count:
            require(weights is not None and joints.shape[0] == weights.shape[0] == count, "joints: (V, n)")
            require(joints.shape[1] == weights.shape[1] > 0, "joints and weights have equal columns")
            desc.influences = <int32_t>joints.shape[1]
            desc.joints, desc.weights = &joints[0, 0], &weights[0, 0]
        desc.target_positions = self.take_targets(&desc, target_positions)
        desc.target_normals = self.take_targets(&desc, target_normals)
        desc.target_tangents = self.take_targets(&desc, target_tangents)
        self.targets = desc.targets
        check(e3d_rest_create(mesh.handle, &desc, &self.handle))
        self.joints = e3d_rest_joints(self.handle)

    def __dealloc__(self):
        e3d_rest_destroy(self.handle)

    cdef const float *take_targets(self, e3d_pose_desc *desc, const float[:, :, ::1] deltas) except? NULL:
        """What targets add to one kind of array: rows of as many targets as of other kinds."""
        if deltas is None or deltas.shape[0] == 0 or deltas.shape[1] == 0:
            return NULL
        require(deltas.shape[1] == self.mesh.vertices and deltas.shape[2] == 3, "targets: (T, V, 3)")
        require(desc.targets in (0, deltas.shape[0]), "as many targets of one kind as of another")
        desc.targets = <int32_t>deltas.shape[0]
        self.borrowed.append(deltas)
        return &deltas[0, 0, 0]

    cdef NativeMesh new_posed(self, bint face_normals):
        cdef NativeMesh posed = NativeMesh.__new__(NativeMesh)
        check(e3d_posed_create(self.handle, face_normals, &posed.handle))
        posed.borrowed = [self]
        posed.attributes = self.mesh.attributes | {"normals"}
        posed.has_face_normals = face_normals
        posed.has_edges = self.mesh.has_edges
        posed.vertices, posed.faces_count = self.mesh.vertices, self.mesh.faces_count
        return posed


cdef class NativePose:
    """A mesh as one node shows it: its joints' matrices, its weights, and what follows from them."""

    cdef readonly NativeRest rest
    cdef readonly NativeMesh current
    cdef NativeMesh spare
    cdef readonly bint face_normals
    cdef bint stale
    cdef object edges
    cdef e3d_skeleton skeleton
    cdef list borrowed
    cdef float *matrices  # as posed, then as found now
    cdef float *weights
    cdef double *ways
    cdef double box[9]
    cdef int32_t room

    def __cinit__(self, NativeRest rest not None, bint face_normals):
        self.rest = rest
        self.face_normals = face_normals
        self.stale = True
        self.weights = <float *>calloc(max(rest.targets, 1), sizeof(float))
        if self.weights == NULL:
            raise OutOfMemoryError("no memory for a pose")

    def __dealloc__(self):
        free(self.matrices)
        free(self.weights)
        free(self.ways)

    def set_skeleton(
        self,
        const int32_t[::1] slots not None,
        const int32_t[::1] above not None,
        const int32_t[::1] ends not None,
        const double[:, ::1] inverse_binds not None,
    ):
        """Say which nodes the joints are: links on the ways to them, those above first."""
        cdef int32_t links = <int32_t>slots.shape[0], joints = <int32_t>ends.shape[0]
        cdef Py_ssize_t k
        require(above.shape[0] == links, "a link a slot")
        require(inverse_binds.shape[0] == joints and inverse_binds.shape[1] == 12, "inverse_binds: (J, 12)")
        require(joints >= self.rest.joints and joints > 0 and links > 0, "the mesh needs more joints")
        for k in range(links):
            require(-1 <= above[k] < k and slots[k] >= 0, "links above come first")
        for k in range(joints):
            require(0 <= ends[k] < links, "a joint is a link")
        free(self.matrices)
        free(self.ways)
        self.matrices = <float *>calloc(2 * joints, E3D_JOINT_MATRIX * sizeof(float))
        self.ways = <double *>calloc(links, 12 * sizeof(double))
        if self.matrices == NULL or self.ways == NULL:
            raise OutOfMemoryError("no memory for a skeleton")
        self.borrowed = [slots, above, ends, inverse_binds]
        self.skeleton = e3d_skeleton(
            links, &slots[0], &above[0], joints, &ends[0], &inverse_binds[0, 0]
        )
        self.stale = True

    def forget_skeleton(self):
        """Let no joints move the mesh."""
        self.stale = self.stale or self.skeleton.joints > 0
        memset(&self.skeleton, 0, sizeof(e3d_skeleton))

    def set_weights(self, const float[::1] weights not None):
        """Set the weights of the morph targets."""
        require(weights.shape[0] == self.rest.targets, "a weight a target")
        if weights.shape[0] and memcmp(self.weights, &weights[0], weights.shape[0] * sizeof(float)):
            memcpy(self.weights, &weights[0], weights.shape[0] * sizeof(float))
            self.stale = True

    def want_face_normals(self):
        self.face_normals = True
        self.current = self.spare = None
        self.stale = True

    @property
    def has_edges(self) -> bool:
        """Whether the handles carry edges."""
        return self.edges is not None

    def want_edges(self, edges not None):
        """Have the handles carry edges, (E, 2) int32."""
        self.edges = edges
        if self.current is not None:
            self.current.set_edges(edges)

    cdef bint look(self, const double[:, ::1] node_poses) except -1:
        """Find the joints' matrices; return whether the mesh has to be posed."""
        cdef Py_ssize_t k
        cdef size_t size = <size_t>self.skeleton.joints * E3D_JOINT_MATRIX
        if size == 0:
            return self.stale
        for k in range(self.skeleton.links):
            require(self.skeleton.slots[k] < node_poses.shape[0], "no such slot")
        e3d_skeleton_matrices(&self.skeleton, &node_poses[0, 0], self.ways, self.matrices + size)
        if not self.stale and memcmp(self.matrices, self.matrices + size, size * sizeof(float)) == 0:
            return False
        memcpy(self.matrices, self.matrices + size, size * sizeof(float))
        return True

    cdef int begin(self, e3d_pose_job *job) except -1:
        """Say what is to be posed into a handle that nobody else holds."""
        if self.spare is None or references(<PyObject *>self.spare) > 1:
            self.spare = self.rest.new_posed(self.face_normals)
        if self.edges is not None:
            self.spare.set_edges(self.edges)
        job.rest = self.rest.handle
        job.matrices = self.matrices if self.skeleton.joints else NULL
        job.weights = self.weights if self.rest.targets else NULL
        job.out = self.spare.handle
        return 0

    cdef void end(self, const e3d_pose_job *job) noexcept:
        self.current, self.spare = self.spare, self.current
        memcpy(self.box, job.box, sizeof(self.box))
        self.stale = False

    def copy_box(self, double[::1] box not None):
        """Copy the box, (OBJECT_BOX,)."""
        require(box.shape[0] == E3D_POSED_BOX, "box: (OBJECT_BOX,)")
        memcpy(&box[0], self.box, sizeof(self.box))

    def copy_matrices(self, float[:, ::1] matrices not None):
        """Copy the joints' matrices as posed last, (J, 16): columns of x y z 0."""
        require(matrices.shape[0] == self.skeleton.joints and matrices.shape[1] == E3D_JOINT_MATRIX,
                "matrices: (J, 16)")
        if self.skeleton.joints:
            memcpy(&matrices[0, 0], self.matrices, self.skeleton.joints * E3D_JOINT_MATRIX * sizeof(float))

    def copy_vertices(self, float[:, ::1] positions not None, float[:, ::1] normals, float[:, ::1] tangents):
        """Copy what was posed last."""
        cdef size_t size = 3 * <size_t>self.rest.mesh.vertices * sizeof(float)
        require(self.current is not None, "nothing was posed")
        require(positions.shape[0] == self.rest.mesh.vertices and positions.shape[1] == 3, "positions: (V, 3)")
        if size == 0:
            return
        memcpy(&positions[0, 0], e3d_posed_positions(self.current.handle), size)
        if normals is not None and e3d_posed_normals(self.current.handle) != NULL:
            require(normals.shape[0] == positions.shape[0] and normals.shape[1] == 3, "normals: (V, 3)")
            memcpy(&normals[0, 0], e3d_posed_normals(self.current.handle), size)
        if tangents is not None and e3d_posed_tangents(self.current.handle) != NULL:
            require(tangents.shape[0] == positions.shape[0] and tangents.shape[1] == 4, "tangents: (V, 4)")
            memcpy(&tangents[0, 0], e3d_posed_tangents(self.current.handle), size // 3 * 4)


def pose_meshes(list poses not None, const double[:, ::1] node_poses, int threads) -> list[int]:
    """Pose what moved, by the poses of nodes (slots, 12); return the numbers in the list.

    Without nodes, joints are where they were found last.
    """
    cdef Py_ssize_t count = 0, k
    cdef NativePose pose
    cdef list moved = []
    require(node_poses is None or node_poses.shape[1] == 12, "a pose is three rows of four")
    for k in range(len(poses)):
        pose = poses[k]
        if pose.stale if node_poses is None else pose.look(node_poses):
            pose.stale = True  # until it is posed, whatever happens
            moved.append(k)
    if not moved:
        return moved
    cdef e3d_pose_job *jobs = <e3d_pose_job *>calloc(len(moved), sizeof(e3d_pose_job))
    if jobs == NULL:
        raise OutOfMemoryError("no memory for poses")
    try:
        for k in range(len(moved)):
            (<NativePose>poses[moved[k]]).begin(&jobs[k])
        count = len(moved)
        e3d_pose_meshes(jobs, <int32_t>count, threads if threads else e3d_thread_count())
        for k in range(count):
            (<NativePose>poses[moved[k]]).end(&jobs[k])
    finally:
        free(jobs)
    return moved
