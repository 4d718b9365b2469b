"""Hidden lines: no edge loses to its own face, few edges show through the faces before them.

On a convex mesh the edges of the faces that look at the camera show, and no others: these drawn
alone, with nothing to hide them, are what the depth test must leave of all edges.
"""

import numpy as np
import pytest
from plain_picture import render

import engine3d as e3d

SIZE = 256
MESHES = {
    "sphere": e3d.uv_sphere(0.5, (40, 20)),
    "icosphere": e3d.icosphere(0.5, 3),
    "box": e3d.box((1, 1, 1)),
}


def cameras():
    """Cameras around the origin, with near and far planes tight and wide."""
    random = np.random.default_rng(5)
    for distance in (1.2, 2.0, 5.0, 40.0):
        for znear in (0.01, 0.1, distance - 0.9):
            x, y, z = random.normal(size=3)
            eye = np.array([x, 0.5 * y, z])
            eye *= distance / np.sqrt((eye * eye).sum())
            zfar = distance + random.choice([1.0, 100.0, 10000.0])
            lens = e3d.PerspectiveCamera(min(1.0, 1.2 / distance), znear=znear, zfar=zfar)
            yield eye, (lens, e3d.look_at(eye, (0, 0, 0)))


def edges(mesh, camera, **options):
    """Return which pixels show an edge."""
    scene = e3d.Scene(background=(0, 0, 0))
    scene.add(mesh)
    options |= {"wireframe": "only", "mode": "unlit", "line_color": (255, 255, 255)}
    return render(scene, camera, size=(SIZE, SIZE), **options).color[:, :, 0] > 0


def front_part(mesh, eye):
    """Return the faces that look at a point."""
    a, b, c = (mesh.positions[mesh.faces[:, k]].astype(np.float64) for k in range(3))
    front = (np.cross(b - a, c - a) * (eye - a)).sum(axis=1) > 1e-6
    shown = None if mesh.edge_visible is None else mesh.edge_visible[front]
    faces = mesh.faces[front]
    return e3d.Mesh(mesh.positions, faces, edge_visible=shown, position_ids=mesh.position_ids)


@pytest.mark.parametrize("width", [1.0, 3.0])
@pytest.mark.parametrize("name", MESHES)
def test_edges_of_front_faces_show(name, width):
    mesh = MESHES[name]
    expected = extra = 0
    for eye, camera in cameras():
        seen = edges(mesh, camera, line_width=width)
        front = edges(front_part(mesh, eye), camera, line_width=width, hidden_lines=True)
        assert not (front & ~seen).any(), "an edge lost to its own face"
        expected += front.sum()
        extra += (seen & ~front).sum()
    assert extra < 0.05 * expected, "edges of the back show through"


def random_scene(random):
    """Faces with lines and points before, among and behind them; now and then without either."""
    scene = e3d.Scene(background=(20, 24, 30))
    for _ in range(random.integers(1, 4)):
        positions = random.uniform(-1, 1, (12, 3))
        lines = random.integers(0, 12, (random.choice([0, 6]), 2))
        points = random.integers(0, 12, random.choice([0, 6]))
        scene.add(e3d.Mesh(positions, random.integers(0, 12, (5, 3)), lines=lines, points=points))
    return scene, (e3d.PerspectiveCamera(0.9), e3d.look_at(random.normal(size=3) * 2, (0, 0, 0)))


@pytest.mark.parametrize("hidden_lines", [False, True])
@pytest.mark.parametrize("backend", [backend for backend in e3d.backends() if backend != "scalar"])
def test_edges_alone_beside_lines_and_points(backend, hidden_lines):
    """What faces hide depends neither on the backend nor on what else is asked for."""
    random = np.random.default_rng(11)
    for turn in range(24):
        scene, camera = random_scene(random)
        options = {"hidden_surfaces": ("zbuffer", "painter", "none")[turn % 3]}
        options |= {"line_width": (1.0, 3.5)[turn % 2], "point_size": 5.0, "size": (90, 70)}
        options |= {"wireframe": "only", "hidden_lines": hidden_lines}
        wanted = render(scene, camera, backend="scalar", **options).color
        for more in ((), ("face_id",), ("depth", "normal")):
            frame = render(
                scene, camera, backend=backend, threads=2, outputs=("color", *more), **options
            )
            assert np.array_equal(frame.color, wanted), (turn, more)
