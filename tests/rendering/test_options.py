"""`RenderOptions`: options of a picture that are made once, checked, and used for any frames."""

import copy
import inspect
import pickle
from dataclasses import FrozenInstanceError, fields, replace

import numpy as np
import pytest
from plain_picture import Renderer, render

import engine3d as e3d

OWN = {"mode": "unlit", "wireframe": "overlay", "line_width": 3.0, "line_color": (255, 128, 0)}


@pytest.fixture
def scene():
    scene = e3d.Scene(background=(30, 40, 50))
    scene.add(e3d.box())
    return scene


def test_fields_are_arguments_of_render_with_the_same_defaults_and_types():
    parameters = inspect.signature(e3d.Renderer.render).parameters
    held = {field.name: (field.default, field.type) for field in fields(e3d.RenderOptions)}
    of_a_frame = {"self", "scene", "camera", "out", "culling_camera", "options"}
    assert held.keys() == parameters.keys() - of_a_frame
    assert held == {name: (parameters[name].default, parameters[name].annotation) for name in held}


def test_a_frame_is_that_of_the_same_keyword_arguments(scene):
    outputs = ("color", "depth", "object_id")
    options = e3d.RenderOptions(outputs=list(outputs), **OWN)
    with Renderer((64, 48)) as renderer:
        expected = renderer.render(scene, outputs=outputs, **OWN)
        renderer.prepare(scene, options=options)
        for frame in (
            renderer.render(scene, options=options),
            renderer.render(scene, options=replace(options, batching=False)),
            render(scene, size=(64, 48), options=options),
        ):
            assert frame.outputs == outputs
            for name in outputs:
                assert np.array_equal(getattr(frame, name), getattr(expected, name))
        assert not np.array_equal(renderer.render(scene).color, expected.color)


def test_options_and_keyword_arguments_do_not_mix(scene):
    options = e3d.RenderOptions()
    with Renderer((8, 8)) as renderer:
        for draw in (renderer.render, renderer.prepare):
            draw(scene, options=options, mode="lit")
            with pytest.raises(e3d.InvalidArgumentError, match="not both"):
                draw(scene, options=options, mode="depth")
            with pytest.raises(e3d.InvalidArgumentError, match="must be RenderOptions, not dict"):
                draw(scene, options={})
        out = renderer.render(scene, options=options)
        assert renderer.render(scene, options=options, out=out) is out


def test_options_are_values():
    options = e3d.RenderOptions(**OWN)
    assert options == e3d.RenderOptions(**OWN) != e3d.RenderOptions()
    assert len({options, e3d.RenderOptions(**OWN), e3d.RenderOptions()}) == 2
    assert options == copy.deepcopy(options) == pickle.loads(pickle.dumps(options))
    assert replace(options, mode="depth").mode == "depth"
    assert replace(options, line_width=1).line_color == OWN["line_color"]
    with pytest.raises(FrozenInstanceError):
        options.mode = "lit"


def test_what_could_change_in_place_is_copied():
    color, outputs = np.array((1.0, 0.5, 0.0)), ["color", "depth"]
    options = e3d.RenderOptions(line_color=color, outputs=outputs)
    color[0] = 0.0
    outputs.clear()
    assert options.line_color == (1.0, 0.5, 0.0) and options.outputs == ("color", "depth")
    hash(options)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"mode": "x"}, "mode must be one of 'lit', 'unlit'"),
        ({"wireframe": "x"}, "wireframe must be one of"),
        ({"cull": None}, "cull must be one of"),
        ({"shading": []}, "shading must be one of"),
        ({"normals": "x"}, "normals must be one of"),
        ({"hidden_surfaces": "x"}, "hidden_surfaces must be one of"),
        ({"culling": "x"}, "culling must be one of"),
        ({"outputs": "color"}, "outputs must be a tuple of names"),
        ({"outputs": ()}, "outputs must name at least one"),
        ({"outputs": ("x",)}, "outputs must be one of"),
        ({"outputs": ([],)}, "outputs must be one of"),
        ({"line_width": 0}, "line_width must be more than 0"),
        ({"point_size": 257}, "point_size must be more than 0 and at most 256"),
        ({"line_color": (1, 2)}, "line_color needs 3 or 4 components"),
    ],
)
def test_what_is_wrong_is_an_error_when_it_is_made(wrong, message):
    with pytest.raises(e3d.InvalidArgumentError, match=message):
        e3d.RenderOptions(**wrong)
    with pytest.raises(e3d.InvalidArgumentError, match=message), Renderer((8, 8)) as renderer:
        renderer.render(e3d.Scene(), **wrong)


def test_8_bit_colors_are_not_floats_of_the_same_number(scene):
    """They are equal to Python, so that options with either are, too."""
    with Renderer((64, 48)) as renderer:
        frames = [
            renderer.render(scene, options=e3d.RenderOptions(wireframe="only", line_color=color))
            for color in ((np.uint8(1),) * 3, (1.0, 1.0, 1.0))
        ]
    assert not np.array_equal(frames[0].color, frames[1].color)
