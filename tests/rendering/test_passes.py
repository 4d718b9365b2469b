"""The list of passes: what one reads is there, whoever else asked for it."""

import numpy as np
import pytest
from plain_picture import Renderer, render

import engine3d as e3d
from engine3d.rendering.passes import all_passes as _passes
from engine3d.rendering.passes.output_passes import ColorPass
from engine3d.rendering.passes.protocol import Pass


def test_each_pass_reads_what_an_earlier_one_writes():
    written = {"scene"}
    for one in _passes.PASSES:
        assert written.issuperset(one.reads), one
        written.update(one.writes)


def test_edges_alone_need_no_pass_that_lights_faces():
    with Renderer((8, 8)) as renderer:
        passes = renderer._painter.passes
        for wireframe in (None, "overlay", "only"):
            options = e3d.RenderOptions(wireframe=wireframe, ambient_occlusion=True)
            plan = passes.plan(options, ("color",), (8, 8))
            assert all(isinstance(one, ColorPass) for one in plan.passes) == (wireframe == "only")


def test_what_needs_arrays_says_what_takes_fewer():
    for one in _passes.PASSES:
        reads_arrays = any(name.startswith("surface_") for name in one.reads)
        if reads_arrays or one.arrays is not Pass.arrays:
            assert one.name and one.advice


class Darker(Pass):
    """Halves colours where surfaces face away from the viewer, by an output that it asks for."""

    reads = ("normal", "color")
    writes = ("color",)
    name, advice = "shade", "no shade"

    def is_in(self, options, wanted):
        return "color" in wanted

    def arrays(self, width, height):
        return {"shade": ((height, width), np.dtype(np.float32))}

    def draw(self, picture):
        shade = picture.arrays["shade"]
        np.maximum(picture.targets["normal"][..., 2], 0.5, out=shade)
        picture.targets["color"][..., :3] = picture.targets["color"][..., :3] * shade[..., None]


@pytest.fixture
def scene():
    scene = e3d.Scene()
    scene.add(e3d.uv_sphere())
    return scene


def test_a_pass_gets_outputs_that_nobody_asked_for(monkeypatch, scene):
    plain = render(scene, size=(40, 30), mode="unlit", outputs=("color", "normal"))
    monkeypatch.setattr(_passes, "PASSES", (ColorPass, Darker))
    with Renderer((40, 30)) as renderer:
        for outputs in (("color",), ("normal", "color"), ("color",)):
            frame = renderer.render(scene, mode="unlit", outputs=outputs)
            assert frame.outputs == outputs
            shade = np.maximum(plain.normal[..., 2:], 0.5)
            assert np.array_equal(
                frame.color[..., :3], (plain.color[..., :3] * shade).astype(np.uint8)
            )
        depth = renderer.render(scene, outputs=("depth",)).depth
    assert np.array_equal(depth, render(scene, size=(40, 30), outputs=("depth",)).depth)


def test_a_pass_that_reads_no_scene_is_not_blamed_on_it(monkeypatch, scene):
    class Wrong(Pass):
        def is_in(self, options, wanted):
            return True

        def draw(self, picture):
            picture.scene.add(e3d.box())
            raise ArithmeticError

    for reads, error in (((), ArithmeticError), (("scene",), e3d.errors.SceneChangedError)):
        monkeypatch.setattr(Wrong, "reads", reads)
        monkeypatch.setattr(_passes, "PASSES", (Wrong, ColorPass))
        with Renderer((8, 8)) as renderer, pytest.raises(error):
            renderer.render(scene)


@pytest.mark.parametrize("shadow", ["map", "exact"])
def test_radiance_beneath_edges_has_its_light(shadow):
    """Edges hide nothing of it: kept and fresh renderers, with them and without, see the same."""
    scene = e3d.Scene()
    scene.add(e3d.box((8, 8, 0.1)), translation=(0, 0, -1))
    box = scene.add(e3d.box())
    light = e3d.DirectionalLight((-1, -1, -1), shadow=shadow)
    scene.add(light)
    view = e3d.PerspectiveCamera(), e3d.look_at((0, 0, 6), (0, 0, 0))
    kept = Renderer((32, 32))
    for x in (0.0, 0.5):
        box.translation = (x, 0, 0)
        with Renderer((32, 32)) as fresh:
            drawn = [
                one.render(scene, view, outputs=("radiance",), wireframe=wireframe).radiance
                for one in (kept, fresh)
                for wireframe in ("only", None, "only")
            ]
            assert all(np.array_equal(one, drawn[1]) for one in drawn)
        light.shadow = "none"
        without = render(scene, view, size=(32, 32), outputs=("radiance",)).radiance
        light.shadow = shadow
        assert not np.array_equal(without, drawn[1])


@pytest.mark.parametrize("backend", e3d.backends())
def test_everything_at_once(backend):
    """The longest list of steps that a batch may take."""
    scene = e3d.Scene(background=(90, 100, 110), ambient=(0.2, 0.2, 0.2))
    scene.fog = e3d.Fog((120, 130, 140), 1.0, 9.0)
    given = {"metallic": 0.0, "roughness": 0.2, "transmission": 0.6, "thickness": 0.1}
    glass = e3d.Material(
        **given, color=(200, 90, 60), mirror=0.5, diffuse_transmission=0.3, clearcoat=0.5
    )
    texture = e3d.Texture(np.random.default_rng(1).integers(0, 256, (8, 8, 4), dtype=np.uint8))
    glass.texture = glass.normal_texture = glass.transmission_texture = texture
    for z in (-1.0, 0.0):
        pane = e3d.box((2, 2, 0.2))
        pane.materials = [glass]
        scene.add(pane, translation=(0.2 * z, 0, z))
    scene.add(e3d.DirectionalLight((-1, -1, -1), shadow="exact"))
    scene.add(e3d.lights.RectangleLight(), translation=(0, 1, 3))
    view = e3d.PerspectiveCamera(), e3d.look_at((1, 1, 4), (0, 0, 0))
    options = {"outputs": ("color", "radiance"), "tone_mapping": "aces", "ambient_occlusion": True}
    drawn = []
    for how in ("scalar", backend):
        with Renderer((48, 40), backend=how, threads=1) as renderer:
            frame = renderer.render(scene, view, **options)
            drawn.append((frame.color.tobytes(), frame.radiance.tobytes()))
    assert drawn[0] == drawn[1]
