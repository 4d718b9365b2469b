# Part of scene_graph.pyx: the boxes of triangles, of instances and of trees, as arrays of rows.

def move_boxes(table, room: NDArray[np.float64]):
    """Copy ``table.boxes`` to the first rows of an array that takes their place, as one step."""
    cdef const double[:, ::1] boxes = table.boxes
    cdef double[:, ::1] rows = room
    if boxes.shape[1] != rows.shape[1] or boxes.shape[0] > rows.shape[0]:
        raise InvalidArgumentError("no room for the boxes")
    if boxes.shape[0]:
        memcpy(&rows[0, 0], &boxes[0, 0], boxes.shape[0] * boxes.shape[1] * sizeof(double))
    table.boxes = room


def instance_boxes(const float[:, ::1] poses not None, const double[::1] box not None,
                   double[:, ::1] boxes not None):
    """Write the boxes (N, BOX) of poses (N, 16) or (N, 4) of an object's box, (OBJECT_BOX,)."""
    if poses.shape[1] not in (4, 16) or box.shape[0] != E3D_OBJECT_BOX:
        raise InvalidArgumentError("poses must be (N, 16) or (N, 4), and a box as told")
    if boxes.shape[0] != poses.shape[0] or boxes.shape[1] != E3D_BOX:
        raise InvalidArgumentError("boxes must be (N, BOX)")
    cdef e3d_pose_kind kind = E3D_POSE_MATRIX if poses.shape[1] == 16 else E3D_POSE_OFFSET_SCALE
    if poses.shape[0]:
        e3d_instance_boxes(&poses[0, 0], kind, <int32_t>poses.shape[0], &box[0], &boxes[0, 0])


def triangle_boxes(const float[:, ::1] positions not None, const int32_t[:, ::1] faces not None,
                   double[:, ::1] boxes not None):
    """Write the boxes (F, BOX) of faces (F, 3), whose indices are in range."""
    if positions.shape[1] != 3 or faces.shape[1] != 3:
        raise InvalidArgumentError("positions and faces must be (N, 3)")
    if boxes.shape[0] != faces.shape[0] or boxes.shape[1] != E3D_BOX:
        raise InvalidArgumentError("boxes must be (F, BOX)")
    if faces.shape[0]:
        e3d_triangle_boxes(&positions[0, 0], &faces[0, 0], <int32_t>faces.shape[0], &boxes[0, 0])


def union(const double[:, ::1] boxes not None, double[::1] out not None) -> bool:
    """Write the box (OBJECT_BOX,) around boxes (N, BOX); return whether there is one."""
    if boxes.shape[1] != E3D_BOX or out.shape[0] != E3D_OBJECT_BOX:
        raise InvalidArgumentError("boxes must be (N, BOX), and the box around them as told")
    return e3d_boxes_union(&boxes[0, 0] if boxes.shape[0] else NULL, <int32_t>boxes.shape[0], &out[0]) != 0


cdef list boxes_by_level(const e3d_tree *tree):
    """Return what a tree holds: for each level, from the items up, boxes (N, 6) float32."""
    cdef list levels = []
    cdef float[:, ::1] rows
    cdef int32_t count
    for level in range(e3d_tree_levels(tree)):
        count = e3d_tree_level_boxes(tree, level, NULL)
        boxes = np.empty((count, 6), np.float32)
        rows = boxes
        if count:
            e3d_tree_level_boxes(tree, level, &rows[0, 0])
        levels.append(boxes)
    return levels
