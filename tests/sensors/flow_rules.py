"""R182 to R184 in NumPy, written from the rules: the oracle of csrc/scene/flow.c, to the bit."""

import numpy as np

from engine3d import linalg
from engine3d.model.scene.instances import InstancedMesh, instance_matrices
from engine3d.model.scene.shown import placing_pose, shown_object


def rows(matrix, points):
    """Three rows of a matrix, or of many, times points (..., 3)."""
    x, y, z = (points[..., k] for k in range(3))
    m = np.asarray(matrix)
    return np.stack(
        [
            ((m[..., r, 0] * x + m[..., r, 1] * y) + m[..., r, 2] * z) + m[..., r, 3]
            for r in range(3)
        ],
        axis=-1,
    )


def dot(a, b):
    return (a[..., 0] * b[..., 0] + a[..., 1] * b[..., 1]) + a[..., 2] * b[..., 2]


def corners(frame, scene, pose):
    """The corners (H, W, 3, 3) of what pixels show, where it is now, for a camera; NaN for none."""
    view_from_world = linalg.inverse(pose)
    found = np.full((*frame.object_id.shape, 3, 3), np.nan)
    for node in scene.nodes:
        at = (frame.object_id == node.id) & (frame.face_id >= 0)
        obj = shown_object(node)
        if obj is None or not at.any():
            continue
        mesh = obj.mesh if isinstance(obj, InstancedMesh) else obj
        points = mesh.positions[mesh.faces[frame.face_id[at]]].astype(np.float64)
        if isinstance(obj, InstancedMesh):
            poses = instance_matrices(obj.poses)[frame.instance_id[at]]
            points = rows(poses[:, np.newaxis], points)
        found[at] = rows(linalg.multiply(view_from_world, placing_pose(node)), points)
    return found


def points(frame, found):
    """R182: the points (H, W, 3) between corners."""
    b = frame.barycentric.astype(np.float64)[..., np.newaxis, :]
    first, second, third = (found[..., k, :] for k in range(3))
    return (first + b[..., 1] * (second - first)) + b[..., 2] * (third - first)


def places(camera, size, where):
    """R183: pixels (H, W, 2) of points of view space."""
    width, height = size
    p = camera.projection(size)
    matrix = np.stack([(p[0] + p[3]) * (width / 2), (p[3] - p[1]) * (height / 2), p[3]])
    x, y, w = np.moveaxis(rows(matrix, where), -1, 0)
    with np.errstate(all="ignore"):
        w = np.where(w > 0, w, np.nan)
        return np.stack([x / w, y / w], axis=-1)


def side(found, where, in_perspective):
    """R184: on which side of the planes of triangles points are, 1 towards the eye."""
    one, two = found[..., 1, :] - found[..., 0, :], found[..., 2, :] - found[..., 0, :]
    turn = ((1, 2), (2, 0), (0, 1))
    normal = np.stack([one[..., i] * two[..., j] - one[..., j] * two[..., i] for i, j in turn], -1)
    offset = dot(normal, found[..., 0, :])
    eye = np.sign(0 - offset if in_perspective else normal[..., 2])
    away = (dot(normal, where) - offset) * eye
    close = 2.0**-16 * (np.sqrt(dot(normal, normal)) * np.sqrt(dot(where, where)))
    return np.where(away > close, 1, np.where(away < 0 - close, -1, 0))


def visible(first, second, own, other, where, at, in_perspective):
    """R184 of faces: own and other are the corners of both pictures at the second moment."""
    height, width = second.object_id.shape
    shows = np.zeros(first.object_id.shape, bool)
    mine, shown = (first.object_id, first.instance_id), (second.object_id, second.instance_id)
    seen = points(second, other)
    for y, x in np.argwhere(np.isfinite(at).all(axis=-1)):
        column, row = (int(v) for v in np.floor(at[y, x]))
        if not (0 <= column < width and 0 <= row < height) or mine[0][y, x] < 0:
            continue
        q = row, column
        near = slice(max(row - 1, 0), row + 2), slice(max(column - 1, 0), column + 2)
        same = (shown[0] == mine[0][y, x]) & (shown[1] == mine[1][y, x])
        if same[q] and second.face_id[q] == first.face_id[y, x]:
            shows[y, x] = True
        elif shown[0][q] < 0:
            shows[y, x] = same[near].any()
        else:
            behind = side(other[q], where[y, x], in_perspective) < 0
            before = side(own[y, x], seen[q], in_perspective) > 0
            shows[y, x] = not (behind and before)
    return shows
