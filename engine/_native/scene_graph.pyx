# cython: boundscheck=False, wraparound=False, initializedcheck=False
"""The gateway to trees of nodes: csrc/include/e3d_scene.h over arrays that Python owns.

In:  the arrays, by `attach`; then slots, and poses as C-contiguous float64.
Out: the arrays, changed; single values copied.
Always: the GIL is held, so that threads take turns; what is asked of a slot that is not there is an
     error. ``changes`` grows with everything that may show; ``updated`` is what it was at the last update;
     ``links`` grows when a node hangs elsewhere, comes or goes.
"""

from cpython.bytes cimport PyBytes_FromStringAndSize
from libc.math cimport INFINITY
from libc.stdint cimport int32_t, uint8_t, uint32_t, uint64_t
from libc.stdlib cimport calloc, free
from libc.string cimport memcmp, memcpy, memset

from e3d cimport (
    E3D_CULL_NONE, E3D_POSE_MATRIX, E3D_POSE_OFFSET_SCALE, e3d_cull, e3d_pose_kind,
    e3d_thread_count,
)
from e3d_flow cimport *
from e3d_scene cimport *

import numpy as np

from ..errors import InvalidArgumentError, OutOfMemoryError

ALIVE = E3D_NODE_ALIVE
VISIBLE = E3D_NODE_VISIBLE
SHOWN = E3D_NODE_SHOWN
STATIC = E3D_NODE_STATIC
BOX = E3D_BOX
OBJECT_BOX = E3D_OBJECT_BOX

include "lent_arrays.pxi"


cdef bint copy_doubles(double *to, array, Py_ssize_t count) except -1:
    """Copy an array (count,); return whether it is of this length."""
    cdef Py_buffer lent
    cdef const double[::1] checked
    PyObject_GetBuffer(array, &lent, PyBUF_C_CONTIGUOUS | PyBUF_FORMAT)
    cdef bint plain = is_plain(&lent, b"d", 1), fits = plain and lent.shape[0] == count
    if fits:
        memcpy(to, lent.buf, count * sizeof(double))
    PyBuffer_Release(&lent)
    if not plain:
        checked = array
        fits = checked.shape[0] == count
        if fits:
            memcpy(to, &checked[0], count * sizeof(double))
    return fits


cdef extern from "Python.h":
    int PyObject_GenericSetAttr(object, object, object) except -1


cdef class FixedSlots:
    """Base of classes with slots, whose ``_refuse(name)`` may say more of a name that cannot be assigned.

    A ``__setattr__`` in Python would take as long as to assign most attributes.
    """

    def __setattr__(self, name, value):
        try:
            PyObject_GenericSetAttr(self, name, value)
        except AttributeError:
            self._refuse(name)
            raise


include "scene_shapes.pxi"
include "item_boxes.pxi"
include "seen_points.pxi"

cdef int32_t MOST_RAYS = 0x7FFFFF00  # a task has 256


cdef class NativeGraph:
    """Nodes in slots 0, 1, 2 … of the attached arrays."""

    def __dealloc__(self):
        e3d_tree_destroy(self.tree)

    def attach(
        self,
        *,
        int32_t[::1] parent,
        int32_t[::1] first_child,
        int32_t[::1] last_child,
        int32_t[::1] next,
        int32_t[::1] previous,
        int32_t[::1] object,
        int32_t[::1] id,
        uint8_t[::1] flags,
        double[:, ::1] pose,
        double[:, ::1] rotation,
        double[:, ::1] scale,
        double[:, ::1] world,
        double[:, ::1] bounds,
        uint32_t[::1] pose_version,
        uint32_t[::1] world_version,
        int32_t[::1] changed,
        int32_t[::1] stack,
        int32_t[::1] anchor,
    ):
        """Work on these arrays from now on: equally long, at least 1, and holding all that was."""
        cdef e3d_graph *g = &self.graph
        arrays = [
            parent, first_child, last_child, next, previous, object, id, flags, pose, rotation,
            scale, world, bounds, pose_version, world_version, changed, stack, anchor,
        ]
        if len({len(array) for array in arrays}) != 1 or len(flags) < max(g.count, 1):
            raise InvalidArgumentError("the arrays of a scene are equally long")
        if [pose.shape[1], rotation.shape[1], scale.shape[1], world.shape[1], bounds.shape[1]] != [
            12, 4, 3, 12, BOX,
        ]:
            raise InvalidArgumentError("the arrays of a scene have rows of fixed lengths")
        self.held = arrays
        self.room = <int32_t>len(flags)
        g.parent = &parent[0]
        g.first_child = &first_child[0]
        g.last_child = &last_child[0]
        g.next = &next[0]
        g.previous = &previous[0]
        g.object = &object[0]
        g.id = &id[0]
        g.flags = &flags[0]
        g.pose = &pose[0, 0]
        g.rotation = &rotation[0, 0]
        g.scale = &scale[0, 0]
        g.world = &world[0, 0]
        g.bounds = &bounds[0, 0]
        g.pose_version = &pose_version[0]
        g.world_version = &world_version[0]
        g.changed = &changed[0]
        g.stack = &stack[0]
        g.anchor = &anchor[0]

    cdef int check(self, int32_t slot) except -1:
        if not 0 <= slot < self.graph.count:
            raise InvalidArgumentError("no such slot")
        return 0

    @property
    def count(self) -> int:
        return self.graph.count

    @property
    def room(self) -> int:
        return self.room

    def add(self, int32_t parent, int32_t object, int32_t id) -> int:
        """Make a node in a new slot, for which there must be room; return it."""
        if self.graph.count >= self.room or not -1 <= parent < self.graph.count:
            raise InvalidArgumentError("no room for a node")
        self.changes += 1
        self.links += 1
        return e3d_graph_add(&self.graph, parent, object, id)

    def adopt(self, int32_t count):
        """Say that the first slots of the arrays hold nodes, of which nothing derived is known."""
        if not 0 <= count <= self.room:
            raise InvalidArgumentError("no room for the nodes")
        e3d_graph_adopt(&self.graph, count)
        self.changes += 1
        self.links += 1

    def link(self, int32_t slot, int32_t parent, int32_t before) -> bool:
        """Hang a node under another, or under none (-1); False if that is itself or below it.

        It comes before another child of that parent, or last (-1).
        """
        self.check(slot)
        if parent != -1:
            self.check(parent)
        if before != -1:
            self.check(before)
            if before == slot or parent == -1 or self.graph.parent[before] != parent:
                raise InvalidArgumentError("before must be another child of the parent")
        self.changes += 1
        self.links += 1
        return e3d_graph_link(&self.graph, slot, parent, before) != 0

    def remove(self, int32_t slot) -> list[int]:
        """Take out a node; return the slots of it and of all below."""
        self.check(slot)
        self.changes += 1
        self.links += 1
        e3d_graph_remove(&self.graph, slot)
        return self.below(slot)

    def restore(self, int32_t slot) -> list[int]:
        """Put a removed node back, under none, with all below; return their slots."""
        self.check(slot)
        self.changes += 1
        self.links += 1
        e3d_graph_restore(&self.graph, slot)
        return self.below(slot)

    def place_by(self, const int32_t[::1] slots not None, const int32_t[::1] anchors not None):
        """Let other nodes' world poses place what these nodes draw, and all others' their own.

        An anchor of -1 is the node itself; the node's own slot says that it is in the world already.
        """
        cdef Py_ssize_t i
        self.check_all(slots, anchors.shape[0])
        for i in range(anchors.shape[0]):
            if not -1 <= anchors[i] < self.graph.count:
                raise InvalidArgumentError("no such slot")
        for i in range(self.graph.count):
            self.graph.anchor[i] = -1
        for i in range(slots.shape[0]):
            self.graph.anchor[slots[i]] = anchors[i]
            e3d_graph_touch(&self.graph, slots[i])
        self.anchored = slots

    def below(self, int32_t slot) -> list[int]:
        """Return the slots of a node and of all below it, parents first."""
        self.check(slot)
        cdef list slots = []
        cdef int32_t at = slot
        while at >= 0:
            slots.append(at)
            at = e3d_graph_walk(&self.graph, at, slot)
        return slots

    def children(self, int32_t slot) -> list[int]:
        """Return the slots of a node's children."""
        self.check(slot)
        cdef list slots = []
        cdef int32_t at = self.graph.first_child[slot]
        while at >= 0:
            slots.append(at)
            at = self.graph.next[at]
        return slots

    def parent_of(self, int32_t slot) -> int:
        """Return the slot of a node's parent, or -1."""
        self.check(slot)
        return self.graph.parent[slot]

    def get_flag(self, int32_t slot, int flag) -> bool:
        self.check(slot)
        return bool(self.graph.flags[slot] & flag)

    def set_flag(self, int32_t slot, int flag, bint on):
        self.check(slot)
        if bool(self.graph.flags[slot] & flag) != on:
            self.changes += 1
            e3d_graph_set_flag(&self.graph, slot, flag, on)

    def shown(self, int32_t slot) -> bool:
        """Whether a node and all above it are visible."""
        self.check(slot)
        e3d_graph_find_world(&self.graph, slot)
        return bool(self.graph.flags[slot] & E3D_NODE_SHOWN)

    def set_pose(self, int32_t slot, pose: NDArray[np.float64]) -> int:
        """Set parent-from-node, (4, 4), of which the last row is not read; return its version."""
        cdef double numbers[16]
        self.check(slot)
        if not copy_matrix(numbers, pose):
            raise InvalidArgumentError("a pose is 4x4")
        self.changes += 1
        e3d_graph_set_pose(&self.graph, slot, numbers)
        return self.graph.pose_version[slot]

    def set_translation(self, int32_t slot, translation: NDArray[np.float64]):
        cdef double numbers[3]
        self.check(slot)
        if not copy_doubles(numbers, translation, 3):
            raise InvalidArgumentError("a translation has 3 numbers")
        self.changes += 1
        e3d_graph_set_translation(&self.graph, slot, numbers)

    def set_parts(self, int32_t slot, rotation: NDArray[np.float64] | None, scale: NDArray[np.float64] | None):
        """Set rotation and scale; None keeps one."""
        cdef double quaternion[4]
        cdef double factors[3]
        cdef const double *new_rotation = NULL
        cdef const double *new_scale = NULL
        self.check(slot)
        if rotation is not None:
            if not copy_doubles(quaternion, rotation, 4):
                raise InvalidArgumentError("a rotation has 4 numbers")
            new_rotation = quaternion
        if scale is not None:
            if not copy_doubles(factors, scale, 3):
                raise InvalidArgumentError("a scale has 3 numbers")
            new_scale = factors
        self.changes += 1
        if not e3d_graph_set_parts(&self.graph, slot, new_rotation, new_scale):
            raise InvalidArgumentError("a quaternion must have a finite length greater than zero")

    cdef int check_all(self, const int32_t[::1] slots, Py_ssize_t rows) except -1:
        if slots.shape[0] != rows:
            raise InvalidArgumentError("a row a slot")
        for i in range(slots.shape[0]):
            self.check(slots[i])
        self.changes += 1
        return 0

    def set_poses(self, const int32_t[::1] slots not None, const double[:, :, ::1] poses not None):
        """As `set_pose`, poses (N, 4, 4)."""
        self.check_all(slots, poses.shape[0])
        if poses.shape[1] != 4 or poses.shape[2] != 4:
            raise InvalidArgumentError("a pose is 4x4")
        for i in range(slots.shape[0]):
            e3d_graph_set_pose(&self.graph, slots[i], &poses[i, 0, 0])

    def set_translations(
        self, const int32_t[::1] slots not None, const double[:, ::1] translations not None
    ):
        """As `set_translation`, translations (N, 3)."""
        self.check_all(slots, translations.shape[0])
        if translations.shape[1] != 3:
            raise InvalidArgumentError("a translation has 3 numbers")
        for i in range(slots.shape[0]):
            e3d_graph_set_translation(&self.graph, slots[i], &translations[i, 0])

    def set_many_parts(
        self,
        const int32_t[::1] slots not None,
        const double[:, ::1] rotations,
        const double[:, ::1] scales,
    ):
        """As `set_parts`, of rotations (N, 4) that have a length, and scales (N, 3)."""
        cdef const double *rotation = NULL
        cdef const double *scale = NULL
        self.check_all(slots, slots.shape[0])
        if rotations is not None and (
            rotations.shape[0] != slots.shape[0] or rotations.shape[1] != 4
        ):
            raise InvalidArgumentError("rotations must be (N, 4)")
        if scales is not None and (scales.shape[0] != slots.shape[0] or scales.shape[1] != 3):
            raise InvalidArgumentError("scales must be (N, 3)")
        for i in range(slots.shape[0]):
            if rotations is not None:
                rotation = &rotations[i, 0]
            if scales is not None:
                scale = &scales[i, 0]
            e3d_graph_set_parts(&self.graph, slots[i], rotation, scale)

    def set_flags(
        self, const int32_t[::1] slots not None, int flag, const uint8_t[::1] on not None
    ):
        """As `set_flag`, on or off (N,)."""
        self.check_all(slots, on.shape[0])
        for i in range(slots.shape[0]):
            if bool(self.graph.flags[slots[i]] & flag) != bool(on[i]):
                e3d_graph_set_flag(&self.graph, slots[i], flag, on[i])

    def find_parts(self, const int32_t[::1] slots not None):
        """Make the rows of rotation and scale true."""
        for i in range(slots.shape[0]):
            self.check(slots[i])
            e3d_graph_find_parts(&self.graph, slots[i])

    def pose_version(self, int32_t slot) -> int:
        self.check(slot)
        return self.graph.pose_version[slot]

    def world_version(self, int32_t slot) -> int:
        """Return the version of the world pose, which is made true first."""
        self.check(slot)
        e3d_graph_find_world(&self.graph, slot)
        return self.graph.world_version[slot]

    # What follows are copies, over bytes: nobody can write to them.

    def pose(self, int32_t slot) -> NDArray[np.float64]:
        """parent-from-node, (4, 4)."""
        self.check(slot)
        return affine(self.graph.pose + 12 * <size_t>slot)

    def world_pose(self, int32_t slot) -> NDArray[np.float64]:
        """world-from-node, (4, 4)."""
        self.check(slot)
        e3d_graph_find_world(&self.graph, slot)
        return affine(self.graph.world + 12 * <size_t>slot)

    def rotation(self, int32_t slot) -> NDArray[np.float64]:
        """Quaternion, (4,)."""
        self.check(slot)
        e3d_graph_find_parts(&self.graph, slot)
        return sealed((4,), self.graph.rotation + 4 * <size_t>slot, 4)

    def scale(self, int32_t slot) -> NDArray[np.float64]:
        """(3,)."""
        self.check(slot)
        e3d_graph_find_parts(&self.graph, slot)
        return sealed((3,), self.graph.scale + 3 * <size_t>slot, 3)

    def update(self, boxes: NDArray[np.float64], int threads):
        """Make every world pose, SHOWN and bounds true; boxes: (objects, OBJECT_BOX).

        On so many threads, or on all that this process may use (0). Boxes are looked at where something changed.
        """
        if self.graph.changed_count == 0:
            self.updated = self.changes
        else:
            self.update_changed(boxes, threads)

    cdef int update_changed(self, const double[:, ::1] boxes, int threads) except -1:
        cdef e3d_graph *g = &self.graph
        if boxes.shape[1] != E3D_OBJECT_BOX:
            raise InvalidArgumentError("boxes must be (objects, OBJECT_BOX)")
        cdef const int32_t[::1] anchored
        self.updated = self.changes
        if self.anchored is not None:
            anchored = self.anchored
            if anchored.shape[0]:
                e3d_graph_follow(g, &anchored[0], <int32_t>anchored.shape[0])
        cdef int32_t objects = <int32_t>boxes.shape[0]
        threads = threads if threads else e3d_thread_count()
        e3d_graph_update(g, &boxes[0, 0] if objects else NULL, objects, threads)
        cdef int32_t moved = g.changed_count
        g.changed_count = 0
        if self.tree != NULL:
            self.require_memory(
                e3d_tree_refit(self.tree, g.bounds, g.count, g.changed, moved, threads)
            )
        return 0

    cdef int require_memory(self, bint done) except -1:
        """Without memory for its tree, a graph has none."""
        if not done:
            e3d_tree_destroy(self.tree)
            self.tree = NULL
            raise OutOfMemoryError("no memory for the tree of a scene's boxes")
        return 0

    cdef int need_tree(self) except -1:
        if self.tree == NULL:
            self.tree = e3d_tree_create()
            self.require_memory(self.tree != NULL)
            self.require_memory(e3d_tree_build(self.tree, self.graph.bounds, self.graph.count, 1))
        return 0

    def select(self, clip_from_world: NDArray[np.float64], double widen, bint flat, uint64_t[::1] bits not None) -> int:
        """Set the bits of the slots that may show, as of the last update, and clear the others.

        Returns how many boxes were tested: those of nodes and, unless ``flat``, of the tree's
        branches.
        """
        cdef e3d_view_volume view
        if not copy_matrix(&view.clip_from_world[0], clip_from_world):
            raise InvalidArgumentError("a matrix is 4x4")
        if 64 * bits.shape[0] < self.graph.count:
            raise InvalidArgumentError("a selection has a bit a slot")
        self.need_tree()
        if bits.shape[0] == 0:
            return 0
        memset(&bits[0], 0, bits.shape[0] * sizeof(uint64_t))
        view.widen, view.flat = widen, flat
        return e3d_tree_select(self.tree, self.graph.bounds, &view, &bits[0])

    def boxes_by_level(self) -> list[NDArray[np.float32]]:
        """Return what the tree holds, as of the last update: see the function of this name."""
        self.need_tree()
        return boxes_by_level(self.tree)

    def cast(
        self,
        NativeShapes shapes not None,
        const double[:, ::1] origins not None,
        const double[:, ::1] directions not None,
        double farthest,
        int cull,
        int32_t[:, ::1] ids not None,
        double[:, ::1] values not None,
        int32_t[::1] lacks not None,
        int threads,
    ) -> bool:
        """Cast rays (N, 3) of unit length, as of the last update; return whether all are cast.

        Writes slot (-1: none), instance and face into ids (N, 3); distance, position, normal and
        barycentric into values (N, 10). Casts the rays whose element of lacks (N,) is not -1, and
        writes there -1, or the number of an object that has to be told to the shapes first.
        """
        cdef Py_ssize_t count = origins.shape[0]
        if origins.shape[1] != 3 or directions.shape[1] != 3 or directions.shape[0] != count:
            raise InvalidArgumentError("rays must be (N, 3) and (N, 3)")
        if ids.shape[0] != count or ids.shape[1] != 3 or lacks.shape[0] != count:
            raise InvalidArgumentError("ids must be (N, 3), and lacks (N,)")
        if values.shape[0] != count or values.shape[1] != 10:
            raise InvalidArgumentError("values must be (N, 10)")
        if count > MOST_RAYS:
            raise InvalidArgumentError("too many rays: cast them in several calls")
        if count == 0:
            return True
        self.need_tree()
        cdef e3d_rays rays
        rays.count, rays.farthest, rays.cull = <int32_t>count, farthest, <e3d_cull>cull
        rays.origins, rays.directions = &origins[0, 0], &directions[0, 0]
        rays.ids, rays.values, rays.lacks = &ids[0, 0], &values[0, 0], &lacks[0]
        threads = threads if threads else e3d_thread_count()
        return e3d_graph_rays(
            &self.graph, self.tree, shapes.shapes, shapes.count, &rays, threads
        ) != 0

    def renew_boxes(
        self,
        table,
        const int32_t[::1] numbers not None,
        const double[:, ::1] fresh not None,
    ):
        """Write rows of ``table.boxes`` and touch the nodes of those that are others, as one step."""
        cdef double[:, ::1] boxes = table.boxes
        if boxes.shape[1] != E3D_OBJECT_BOX or fresh.shape[1] != E3D_OBJECT_BOX:
            raise InvalidArgumentError("boxes must be (objects, OBJECT_BOX)")
        if fresh.shape[0] != numbers.shape[0]:
            raise InvalidArgumentError("a box a number")
        cdef size_t size = E3D_OBJECT_BOX * sizeof(double)
        cdef Py_ssize_t i
        cdef bint any_dirty = False
        cdef uint8_t *dirty = <uint8_t *>calloc(max(boxes.shape[0], 1), 1)
        if dirty == NULL:
            raise OutOfMemoryError("no memory for the boxes of a scene")
        for i in range(numbers.shape[0]):
            if not 0 <= numbers[i] < boxes.shape[0]:
                continue
            if memcmp(&boxes[numbers[i], 0], &fresh[i, 0], size):
                memcpy(&boxes[numbers[i], 0], &fresh[i, 0], size)
                dirty[numbers[i]] = any_dirty = True
        if any_dirty:
            self.changes += 1
            e3d_graph_touch_objects(&self.graph, dirty, <int32_t>boxes.shape[0])
        free(dirty)

    def set_object(self, int32_t slot, int32_t object):
        """Say what a node draws."""
        self.check(slot)
        self.changes += 1
        self.graph.object[slot] = object
        e3d_graph_touch(&self.graph, slot)


cdef object NDARRAY = np.ndarray
cdef object DOUBLE = np.dtype(np.float64)


cdef object sealed(tuple shape, const double *numbers, int count):
    """A copy of numbers as an array over bytes."""
    return NDARRAY(shape, DOUBLE, PyBytes_FromStringAndSize(<const char *>numbers, count * sizeof(double)))


cdef object affine(const double *pose):
    """A copy of three rows, with the fourth."""
    cdef double matrix[16]
    memcpy(matrix, pose, 12 * sizeof(double))
    matrix[12] = matrix[13] = matrix[14] = 0.0
    matrix[15] = 1.0
    return sealed((4, 4), matrix, 16)


def invert(const double[:, ::1] m not None, double[:, ::1] out not None) -> bool:
    """Fill the inverse of a 4x4 matrix; return whether it has one."""
    if m.shape[0] != 4 or m.shape[1] != 4 or out.shape[0] != 4 or out.shape[1] != 4:
        raise InvalidArgumentError("a matrix is 4x4")
    return bool(e3d_invert(&m[0, 0], &out[0, 0]))


def camera_view(
    clip_from_view: NDArray[np.float64], world_from_view: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64], tuple[float, ...], tuple[float, ...]] | None:
    """Return what a camera at a pose sees by: view_from_world, clip_from_world, direction to the viewer, eye.

    None where the pose has no inverse.
    """
    cdef e3d_camera camera
    cdef double projection[16]
    cdef double pose[16]
    if not (copy_matrix(projection, clip_from_view) and copy_matrix(pose, world_from_view)):
        raise InvalidArgumentError("a matrix is 4x4")
    if not e3d_camera_view(projection, pose, &camera):
        return None
    cdef double *t = camera.towards_viewer
    cdef double *e = camera.eye
    return (
        sealed((4, 4), &camera.view_from_world[0], 16),
        sealed((4, 4), &camera.clip_from_world[0], 16),
        (t[0], t[1], t[2]),
        (e[0], e[1], e[2], e[3]),
    )
