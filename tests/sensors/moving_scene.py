"""A scene of everything that moves in its own way, and its vertices by plain arithmetic."""

import numpy as np

import engine3d as e3d
from engine3d.model.scene.instances import instance_matrices
from engine3d.sensors import Moment

SIZE = 120, 90
LENS = e3d.PerspectiveCamera(0.8, znear=0.1, zfar=60.0)


def strip():
    """A strip of a skin of two joints, 20 x 2 quads, along Y."""
    x, y = np.meshgrid(np.linspace(-0.3, 0.3, 3), np.linspace(0.0, 2.0, 21))
    positions = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1)
    first = np.arange(20)[:, np.newaxis] * 3 + np.arange(2)
    quads = np.stack([first, first + 1, first + 4, first + 3], axis=-1).reshape(-1, 4)
    faces = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    share = np.clip(positions[:, 1] - 0.5, 0.0, 1.0)
    return e3d.Mesh(
        positions,
        faces,
        materials=[e3d.Material(two_sided=True)],
        joints=np.tile([0, 1], (len(positions), 1)),
        weights=np.stack([1.0 - share, share], axis=1),
    )


class MovingScene:
    """Things that move, each in another way, by a time."""

    def __init__(self, **settings):
        settings = {"background": (40, 60, 90), "ambient": (0.6, 0.6, 0.6), **settings}
        self.scene = scene = e3d.Scene(**settings)
        self.floor = scene.add(e3d.plane(9.0), translation=(0, -1.2, 0))
        self.ball = scene.add(e3d.uv_sphere(0.6, (24, 12)))
        grid = e3d.InstancedMesh(e3d.box(0.4), np.ones((3, 4)))
        self.boxes = scene.add(grid, translation=(-1.6, 0, -0.5))
        turned = e3d.InstancedMesh(e3d.torus(0.35, 0.15), np.tile(np.eye(4), (2, 1, 1)))
        self.rings = scene.add(turned, translation=(1.7, 0.8, -0.6))
        self.root = scene.add(translation=(1.4, -1.0, 0.8))
        self.joints = [scene.add(parent=self.root)]
        self.joints.append(scene.add(parent=self.joints[0], translation=(0, 1, 0)))
        binds = np.tile(np.eye(4), (2, 1, 1))
        binds[1, 1, 3] = -1.0
        self.strip = scene.add(strip(), parent=self.root)
        self.strip.skin = e3d.motion.Skin(self.joints, binds)
        self.binds = binds
        soft = e3d.icosphere(0.5, 3)
        soft.morph_targets = [e3d.motion.MorphTarget(positions=soft.positions * (0.6, -0.3, 0.2))]
        self.soft = scene.add(soft, translation=(-0.5, 0.9, -1.0))

    def at(self, time):
        """Move all things to where they are at a time."""
        turn = e3d.linalg.euler_to_quaternion((0.3 * time, 0.9 * time, 0.0))
        self.ball.rotation, self.ball.translation = turn, (0.4 * time - 0.2, 0.1 * time, 0.6)
        offsets = np.array(
            [(0, 0.5 * k - 0.5 + 0.1 * time, 0.2 * time, 1 - 0.1 * k) for k in range(3)]
        )
        self.boxes.object.poses = offsets
        self.rings.object.poses = [
            e3d.linalg.compose((0, -0.8 * k, 0), e3d.linalg.euler_to_quaternion((time, k, 0)), 1.0)
            for k in range(2)
        ]
        self.joints[1].rotation = e3d.linalg.euler_to_quaternion((0.2 * time, 0.0, 0.9 * time))
        self.joints[0].rotation = e3d.linalg.euler_to_quaternion((0.0, 0.4 * time, 0.0))
        self.soft.morph_weights = [0.2 + 0.7 * time]
        return self

    def vertices(self):
        """World positions of all vertices as they are now, by ID: (N, 3), or (I, N, 3)."""
        found = {}
        for node in (self.floor, self.ball):
            found[node.id] = moved(node.world_pose, node.object.positions)
        for node in (self.boxes, self.rings):
            poses = instance_matrices(node.object.poses)
            mesh = node.object.mesh
            found[node.id] = np.stack(
                [moved(node.world_pose @ pose, mesh.positions) for pose in poses]
            )
        mesh, poses = self.strip.object, [joint.world_pose for joint in self.joints]
        parts = [moved(p @ b, mesh.positions) for p, b in zip(poses, self.binds, strict=True)]
        found[self.strip.id] = sum(
            mesh.weights[:, k : k + 1].astype(float) * part for k, part in enumerate(parts)
        )
        mesh = self.soft.object
        shape = mesh.positions + self.soft.morph_weights[0] * mesh.morph_targets[0].positions
        found[self.soft.id] = moved(self.soft.world_pose, shape)
        return found


def moved(pose, positions):
    return positions.astype(np.float64) @ pose[:3, :3].T + pose[:3, 3]


def view_at(time):
    return LENS, e3d.look_at((0.5 * time, 0.6 + 0.2 * time, 5.5), (0.1 * time, 0, 0))


def moment(moving, time, *, renderer=None, view=None, outputs=()):
    """The moment of a time."""
    moving.at(time)
    renderer = renderer or e3d.Renderer(SIZE, samples=1)
    outputs = (*Moment.OUTPUTS, *outputs)
    frame = renderer.render(moving.scene, view or view_at(time), outputs=outputs)
    return Moment(frame, moving.scene)


def points_of(frame, vertices, faces_of):
    """World points (H, W, 3) of what a frame shows, if its vertices are as given; NaN for none."""
    points = np.full((*frame.object_id.shape, 3), np.nan)
    for row, column in np.argwhere(frame.face_id >= 0):
        identity = int(frame.object_id[row, column])
        corners = vertices[identity]
        if corners.ndim == 3:
            corners = corners[frame.instance_id[row, column]]
        corners = corners[faces_of[identity][frame.face_id[row, column]]]
        points[row, column] = frame.barycentric[row, column].astype(np.float64) @ corners
    return points


def project(camera, pose, size, points):
    """Pixels of world points, by the definition of OpenGL's clip space."""
    clip = np.concatenate([points, np.ones_like(points[..., :1])], axis=-1)
    clip = clip @ (camera.projection(size) @ np.linalg.inv(pose)).T
    ndc = clip[..., :2] / clip[..., 3:]
    return (ndc * (1, -1) + 1) * 0.5 * np.array(size)
