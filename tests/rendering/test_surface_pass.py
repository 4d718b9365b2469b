"""What passes before the picture read is what the picture shows."""

import pytest

import engine3d as e3d
from engine3d import linalg
from engine3d.rendering.passes import all_passes as _passes
from engine3d.rendering.passes.output_passes import ColorPass, SurfacePass
from engine3d.rendering.passes.protocol import Pass

OUTPUTS = ("ndc_depth", "depth", "world_position", "normal", "face_id", "object_id")


def scene_of_two() -> e3d.Scene:
    scene = e3d.Scene()
    scene.add(e3d.primitives.box())
    glass = e3d.primitives.uv_sphere()
    glass.materials = [e3d.Material(color=(1.0, 0.0, 0.0, 0.5), alpha_mode="blend")]
    scene.add(glass, pose=linalg.translation((0.2, 0.1, 0.9)))
    scene.add(e3d.primitives.uv_sphere(), pose=linalg.translation((0.8, 0.4, -0.3)))
    return scene


class Reader(Pass):
    """A pass that keeps what it reads."""

    reads = tuple(f"surface_{name}" for name in OUTPUTS)

    def is_in(self, options, wanted):
        return True

    def draw(self, picture):
        Reader.read = {name: picture.arrays[f"surface_{name}"].copy() for name in OUTPUTS}
        Reader.places = {array.ctypes.data for array in picture.arrays.values()}


@pytest.fixture(autouse=True)
def reader(monkeypatch):
    """Let each renderer have a pass that reads, before the colours."""
    monkeypatch.setattr(_passes, "PASSES", (SurfacePass, Reader, ColorPass))


@pytest.mark.parametrize("backend", e3d.backends())
def test_one_sample_a_pixel_is_what_the_outputs_hold(backend):
    scene = scene_of_two()
    with e3d.Renderer((90, 70), backend=backend) as renderer:
        expected = renderer.render(scene, outputs=("color", *OUTPUTS))
        renderer.render(scene)
    drawn = Reader.read
    assert (drawn["object_id"] >= 0).any()
    for name in OUTPUTS:
        assert drawn[name].tobytes() == getattr(expected, name).tobytes(), name


def test_arrays_are_used_again():
    scene = scene_of_two()
    with e3d.Renderer((40, 30)) as renderer:
        renderer.render(scene)
        first = Reader.places
        renderer.render(scene)
        assert Reader.places == first
