"""What passes before the picture read is what the picture shows."""

import pytest

import engine3d as e3d
from engine3d import linalg
from engine3d.rendering._surface_pass import SurfacePass

OUTPUTS = ("ndc_depth", "depth", "world_position", "normal", "triangle_id", "object_id")


def scene_of_two() -> e3d.Scene:
    scene = e3d.Scene()
    scene.add(e3d.primitives.box())
    glass = e3d.primitives.uv_sphere()
    glass.materials = [e3d.Material(color=(1.0, 0.0, 0.0, 0.5), alpha_mode="blend")]
    scene.add(glass, pose=linalg.translation((0.2, 0.1, 0.9)))
    scene.add(e3d.primitives.uv_sphere(), pose=linalg.translation((0.8, 0.4, -0.3)))
    return scene


def surfaces(renderer: e3d.Renderer, scene: e3d.Scene) -> dict:
    """Draw a picture, then what it shows, as passes do."""
    options = e3d.RenderOptions(outputs=("color",))
    renderer.render(scene, options=options)
    drawn = SurfacePass().draw(
        renderer._native,
        renderer._draw_list,
        renderer._options.get(scene, options, renderer.height),
        renderer._viewpoint.look(scene, None, renderer.width, renderer.height),
        (renderer.width, renderer.height),
        OUTPUTS,
    )
    return {name: array.copy() for name, array in drawn.items()}


@pytest.mark.parametrize("backend", e3d.backends())
def test_one_sample_a_pixel_is_what_the_outputs_hold(backend):
    scene = scene_of_two()
    with e3d.Renderer(90, 70, backend=backend) as renderer:
        expected = renderer.render(scene, outputs=("color", *OUTPUTS))
        drawn = surfaces(renderer, scene)
    assert (drawn["object_id"] >= 0).any()
    for name in OUTPUTS:
        assert drawn[name].tobytes() == getattr(expected, name).tobytes(), name


def test_arrays_are_used_again():
    scene = scene_of_two()
    with e3d.Renderer(40, 30) as renderer:
        options = e3d.RenderOptions()
        renderer.render(scene, options=options)
        one = SurfacePass()
        view = renderer._viewpoint.look(scene, None, 40, 30)
        given = (
            renderer._native,
            renderer._draw_list,
            renderer._options.get(scene, options, renderer.height),
            view,
            (40, 30),
            ("depth",),
        )
        first = one.draw(*given)["depth"].ctypes.data
        assert one.draw(*given)["depth"].ctypes.data == first
