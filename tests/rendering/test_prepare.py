"""Renderer.prepare makes what the first frame would make, and changes no picture."""

import subprocess
import sys

import numpy as np
import pytest

import engine3d as e3d
from engine3d.rendering.draw_list import native_handles as native_handles


def new_scene():
    """A scene never drawn, and its mesh: without normals, with a texture."""
    pixels = np.random.default_rng(5).integers(0, 256, (32, 32, 3), np.uint8)
    sphere = e3d.uv_sphere()
    mesh = e3d.Mesh(
        sphere.positions,
        sphere.faces,
        uvs=sphere.uvs,
        materials=[e3d.Material(texture=e3d.Texture(pixels))],
    )
    scene = e3d.Scene()
    scene.add(mesh)
    return scene, mesh


def handles(mesh):
    texture = mesh.materials[0].texture
    return native_handles._meshes[mesh][-1], native_handles._textures[texture]


@pytest.mark.parametrize("wireframe", [None, "overlay"])
def test_everything_is_made(wireframe):
    scene, mesh = new_scene()
    renderer = e3d.Renderer((64, 48))
    renderer.prepare(scene, wireframe=wireframe)
    native, textures = handles(mesh)
    made = dict(textures)
    assert "normals" in native.attributes and len(made) == 1
    assert native.has_edges == (wireframe is not None)
    picture = renderer.render(scene, wireframe=wireframe).color
    assert handles(mesh) == (native, made), "the first frame made something again"
    other, _ = new_scene()
    assert np.array_equal(picture, e3d.Renderer((64, 48)).render(other, wireframe=wireframe).color)


def test_identities_need_no_normals():
    scene, mesh = new_scene()
    e3d.Renderer((64, 48)).prepare(scene, outputs=("instance_id",))
    native, _ = handles(mesh)
    assert "normals" not in native.attributes and not native.has_face_normals


def test_errors():
    renderer = e3d.Renderer((8, 6))
    with pytest.raises(e3d.InvalidArgumentError, match="can be drawn, not NoneType"):
        renderer.prepare(None)
    with pytest.raises(e3d.InvalidArgumentError, match="mode must be one of"):
        renderer.prepare(e3d.Scene(), mode="fast")
    with pytest.raises(e3d.InvalidArgumentError, match="outputs"):
        renderer.prepare(e3d.Scene(), outputs=("colour",))
    renderer.close()
    with pytest.raises(e3d.InvalidArgumentError, match="closed"):
        renderer.prepare(e3d.Scene())


FIRST_FRAME = """
import resource, sys
import numpy as np
import engine3d as e3d

poses = np.tile(np.eye(4), (40, 1, 1))
poses[:, 2, 3] = np.arange(40)
scene = e3d.Scene()
scene.add(e3d.InstancedMesh(e3d.uv_sphere(segments=(64, 32)), poses))
scene.add(e3d.DirectionalLight())
e3d.Renderer((64, 48), threads=1).prepare(scene)
renderer = e3d.Renderer((1280, 720), threads=1)
if sys.argv[1] == "prepared":
    renderer.prepare(scene)
before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
renderer.render(scene)
print(resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before)
"""


def first_faults(how):
    """Page faults of a process's first frame: 40 models one behind the other."""
    command = [sys.executable, "-c", FIRST_FRAME, how]
    return int(subprocess.run(command, capture_output=True, check=True, text=True).stdout)


def test_memory_is_ready():
    """The picture alone has 900 pages; after it none of them comes while one draws."""
    pytest.importorskip("resource", reason="page faults are counted on POSIX")
    assert first_faults("prepared") + 500 < first_faults("not prepared")
