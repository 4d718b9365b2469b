"""Renderer.prepare makes what the first frame would make, and changes no picture."""

import numpy as np
import pytest

import engine3d as e3d
from engine3d import native_handles


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
    return native_handles._meshes[mesh][2], native_handles._textures[texture][1]


@pytest.mark.parametrize("wireframe", [None, "overlay"])
def test_everything_is_made(wireframe):
    scene, mesh = new_scene()
    renderer = e3d.Renderer(64, 48)
    renderer.prepare(scene, wireframe=wireframe)
    native, textures = handles(mesh)
    made = dict(textures)
    assert native.has_normals and native.has_edges == (wireframe is not None) and len(made) == 1
    picture = renderer.render(scene, wireframe=wireframe).color
    assert handles(mesh) == (native, made), "the first frame made something again"
    other, _ = new_scene()
    assert np.array_equal(picture, e3d.Renderer(64, 48).render(other, wireframe=wireframe).color)


def test_identities_need_no_normals():
    scene, mesh = new_scene()
    e3d.Renderer(64, 48).prepare(scene, outputs=("instance_id",))
    native, _ = handles(mesh)
    assert not native.has_normals and not native.has_face_normals


def test_errors():
    renderer = e3d.Renderer(8, 6)
    with pytest.raises(e3d.InvalidArgumentError, match="scene must be a Scene"):
        renderer.prepare(None)
    with pytest.raises(e3d.InvalidArgumentError, match="mode must be one of"):
        renderer.prepare(e3d.Scene(), mode="fast")
    with pytest.raises(e3d.InvalidArgumentError, match="outputs"):
        renderer.prepare(e3d.Scene(), outputs=("colour",))
    renderer.close()
    with pytest.raises(e3d.InvalidArgumentError, match="closed"):
        renderer.prepare(e3d.Scene())
