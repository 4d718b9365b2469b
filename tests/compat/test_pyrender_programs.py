"""Programs in the manner of public ones that use pyrender: what they do, in small."""

import math
import multiprocessing
import sys

import numpy as np
import pytest

import engine3d.compat.pyrender as pyrender

trimesh = pytest.importorskip("trimesh")


def _turn(angle, axis):
    return trimesh.transformations.rotation_matrix(angle, axis)


class BodyRenderer:
    """A mesh over a photograph, by the camera that a network found (the HMR family)."""

    def __init__(self, size=64, focal=100.0):
        self.size, self.focal = size, focal
        self.renderer = pyrender.OffscreenRenderer(
            viewport_width=size, viewport_height=size, point_size=1.0
        )

    def __call__(self, vertices, faces, camera_t, image):
        camera_t = camera_t.copy()
        camera_t[0] *= -1.0
        material = pyrender.MetallicRoughnessMaterial(
            metallicFactor=0.0, alphaMode="OPAQUE", baseColorFactor=(0.3, 0.3, 0.2, 1.0)
        )
        mesh = trimesh.Trimesh(vertices.copy(), faces.copy(), process=False)
        mesh.apply_transform(_turn(math.radians(180), [1, 0, 0]))
        mesh = pyrender.Mesh.from_trimesh(mesh, material=material, smooth=False)
        scene = pyrender.Scene(bg_color=[0.0, 0.0, 0.0, 0.0], ambient_light=(0.3, 0.3, 0.3))
        scene.add(mesh, "mesh")
        camera_pose = np.eye(4)
        camera_pose[:3, 3] = camera_t
        centre = [self.size / 2.0, self.size / 2.0]
        camera = pyrender.IntrinsicsCamera(
            fx=self.focal, fy=self.focal, cx=centre[0], cy=centre[1], zfar=1e12
        )
        scene.add(camera, pose=camera_pose)
        light = pyrender.DirectionalLight(color=[1.0, 1.0, 1.0], intensity=0.8)
        for place in ([0, -1, 1], [0, 1, 1], [1, 1, 2]):
            light_pose = np.eye(4)
            light_pose[:3, 3] = place
            scene.add(light, pose=light_pose)
        for node in create_raymond_lights():
            scene.add_node(node)
        color, _ = self.renderer.render(scene, flags=pyrender.RenderFlags.RGBA)
        color = color.astype(np.float32) / 255.0
        valid = (color[:, :, -1] > 0)[:, :, np.newaxis]
        return color[:, :, :3] * valid + (1 - valid) * image


def create_raymond_lights():
    nodes = []
    for phi in np.pi * np.array([0.0, 2.0 / 3.0, 4.0 / 3.0]):
        z = np.array([0.5 * np.cos(phi), 0.5 * np.sin(phi), np.sqrt(0.75)])
        x = np.array([-z[1], z[0], 0.0])
        x /= np.linalg.norm(x)
        matrix = np.eye(4)
        matrix[:3, :3] = np.c_[x, np.cross(z, x), z]
        light = pyrender.DirectionalLight(color=np.ones(3), intensity=1.0)
        nodes.append(pyrender.Node(light=light, matrix=matrix))
    return nodes


def test_a_body_lies_over_a_photograph():
    body = trimesh.creation.capsule(height=1.0, radius=0.3, count=[16, 16])
    photograph = np.full((64, 64, 3), 0.25, np.float32)
    picture = BodyRenderer()(body.vertices, body.faces, np.array([0.0, 0.0, 3.0]), photograph)
    assert np.allclose(picture[0, 0], 0.25)
    r, g, b = picture[32, 32]
    assert 1.0 > r == g > b > 0.5


class WeakPerspectiveCamera(pyrender.Camera):
    """A camera of programs that fit bodies to pictures: scale and shift."""

    def __init__(self, scale, translation, znear=pyrender.camera.DEFAULT_Z_NEAR, zfar=None):
        super().__init__(znear=znear, zfar=10.0 if zfar is None else zfar)
        self.scale, self.translation = scale, translation

    def get_projection_matrix(self, width=None, height=None):
        matrix = np.eye(4)
        matrix[0, 0], matrix[1, 1] = self.scale
        matrix[0, 3] = self.translation[0] * self.scale[0]
        matrix[1, 3] = -self.translation[1] * self.scale[1]
        matrix[2, 2] = -1
        return matrix


def test_a_weak_perspective_shows_what_is_around_it():
    scene = pyrender.Scene(bg_color=[0.0, 0.0, 0.0, 0.0], ambient_light=(0.3, 0.3, 0.3))
    scene.add(pyrender.Mesh.from_trimesh(trimesh.creation.icosphere(radius=0.5)))
    scene.add(WeakPerspectiveCamera([1.0, 1.0], [0.5, 0.0]), pose=np.eye(4))
    color, depth = pyrender.OffscreenRenderer(64, 64).render(scene, pyrender.RenderFlags.RGBA)
    covered = depth > 0
    assert np.array_equal(covered, color[..., 3] == 255) or covered.sum() > 700
    assert np.flatnonzero(covered.any(axis=0)).mean() == pytest.approx(47.5, abs=1)
    assert abs(covered.sum() - np.pi * 16 * 16) < 40


def test_masks_and_visible_shares_of_objects():
    """Depth, masks and shares of what is visible, as data sets of poses have them."""
    intrinsics = {"fx": 80.0, "fy": 80.0, "cx": 32.0, "cy": 24.0}
    scene = pyrender.Scene(bg_color=[0, 0, 0])
    scene.add(pyrender.IntrinsicsCamera(**intrinsics, znear=0.05, zfar=10.0), pose=np.eye(4))
    from_opencv = np.diag([1.0, -1.0, -1.0, 1.0])
    nodes = []
    for place in ((0.0, 0.0, 1.0), (0.15, 0.0, 1.4)):
        pose = np.eye(4)
        pose[:3, 3] = place
        mesh = pyrender.Mesh.from_trimesh(trimesh.creation.box((0.2, 0.2, 0.2)), smooth=False)
        nodes.append(scene.add(mesh, pose=from_opencv @ pose))
    renderer = pyrender.OffscreenRenderer(64, 48)
    flags = pyrender.RenderFlags.SEG
    ids = {node: number + 1 for number, node in enumerate(nodes)}
    labels, depth = renderer.render(scene, flags=flags, seg_node_map=ids)
    labels = labels[:, :, 0].copy()
    assert set(np.unique(labels)) == {0, 1, 2}
    assert np.isclose(depth[24, 32], 0.9, rtol=1e-5)
    alone, _ = renderer.render(scene, flags=flags, seg_node_map={nodes[1]: 2})
    share = (labels == 2).sum() / (alone[:, :, 0] == 2).sum()
    assert 0.1 < share < 0.6
    nodes[0].mesh.is_visible = False
    labels, _ = renderer.render(scene, flags=flags, seg_node_map=ids)
    assert set(np.unique(labels)) == {0, 2}
    renderer.delete()


def test_a_touch_sensor_follows_objects_in_its_scene():
    """Coloured point lights around a gel, objects moved by `set_pose` (TACTO)."""
    scene = pyrender.Scene(ambient_light=[0.1, 0.1, 0.1], bg_color=[0.0, 0.0, 0.0])
    gel = trimesh.creation.box((2.0, 2.0, 0.02))
    scene.add_node(pyrender.Node(mesh=pyrender.Mesh.from_trimesh(gel, smooth=False)))
    camera = pyrender.PerspectiveCamera(yfov=np.deg2rad(60), znear=0.001)
    camera_node = pyrender.Node(camera=camera, matrix=_turn(0, (0, 0, 1)))
    camera_node.translation = [0.0, 0.0, 2.0]
    scene.add_node(camera_node)
    for place, color in (((1, 0), (1.0, 0.0, 0.0)), ((-1, 0), (0.0, 0.0, 1.0))):
        pose = np.eye(4)
        pose[:3, 3] = (*place, 0.6)
        scene.add_node(pyrender.Node(light=pyrender.PointLight(color, 2.0), matrix=pose))
    tip = trimesh.creation.icosphere(subdivisions=2, radius=0.2)
    node = pyrender.Node(mesh=pyrender.Mesh.from_trimesh(tip), matrix=np.eye(4), name="tip")
    scene.add_node(node)
    renderer = pyrender.OffscreenRenderer(48, 36)
    seen = []
    for height in (1.0, 0.3, -0.5):
        pose = np.eye(4)
        pose[2, 3] = height
        scene.set_pose(node, pose=pose)
        color, depth = renderer.render(scene)
        seen.append(float(depth[18, 24]))
    assert seen == pytest.approx([0.8, 1.5, 1.99], rel=5e-3)
    assert color[18, 36, 0] > color[18, 36, 2] and color[18, 12, 2] > color[18, 12, 0]
    assert scene.get_nodes(name="tip") == {node}


def test_scans_give_points_on_the_surface():
    """Depths from around become points of the surface (mesh_to_sdf, without its shader)."""
    mesh = trimesh.creation.icosphere(subdivisions=4, radius=0.5)
    scene = pyrender.Scene()
    scene.add(pyrender.Mesh.from_trimesh(mesh))
    camera = pyrender.PerspectiveCamera(yfov=1.0472, aspectRatio=1.0, znear=0.5, zfar=2.0)
    node = pyrender.Node(camera=camera)
    scene.add_node(node)
    size = 40
    renderer = pyrender.OffscreenRenderer(size, size)
    for angle in (0.0, 2.0, 4.0):
        pose = _turn(angle, (0.3, 1.0, 0.1))
        pose[:3, 3] = pose[:3, 2] * 1.2
        scene.set_pose(node, pose)
        depth = renderer.render(scene, flags=pyrender.RenderFlags.DEPTH_ONLY)
        rows, columns = np.nonzero(depth)
        projection = camera.get_projection_matrix(size, size)
        x = ((columns + 0.5) / size * 2 - 1) / projection[0, 0]
        y = (1 - (rows + 0.5) / size * 2) / projection[1, 1]
        z = depth[rows, columns]
        points = np.c_[x * z, y * z, -z] @ pose[:3, :3].T + pose[:3, 3]
        assert len(points) > 300
        assert np.abs(np.linalg.norm(points, axis=1) - 0.5).max() < 0.005


def _picture(number):
    scene = pyrender.Scene(ambient_light=[0.2, 0.2, 0.2])
    scene.add(pyrender.Mesh.from_trimesh(trimesh.creation.box(), smooth=False))
    pose = np.eye(4)
    pose[2, 3] = 3.0
    scene.add(pyrender.PerspectiveCamera(yfov=1.0), pose=pose)
    scene.add(pyrender.DirectionalLight(), pose=pose)
    return pyrender.OffscreenRenderer(32, 32).render(scene)[0].tobytes()


@pytest.mark.skipif(sys.platform == "win32", reason="needs fork")
def test_processes_draw_the_same():
    with multiprocessing.get_context("fork").Pool(2) as pool:
        found = pool.map(_picture, range(4))
    assert set(found) == {_picture(0)}
