"""The choices that type checkers know are those that are accepted at run time."""

import inspect
from dataclasses import fields
from itertools import permutations
from typing import get_args, get_type_hints

import pytest

import engine3d as e3d
from engine3d import choices
from engine3d._native import rasterizer as native
from engine3d.apps.drawings import line_kinds, units
from engine3d.apps.viewer import pixels
from engine3d.apps.viewer.window import POINTERS
from engine3d.io.formats.urdf import urdf_joints
from engine3d.io.reading import robot_options
from engine3d.model.environments import environment
from engine3d.model.geometry import values
from engine3d.model.geometry.vertex_attributes import vertex_attributes
from engine3d.model.materials import colors, textures
from engine3d.model.materials.material import TEXTURE_SLOTS
from engine3d.model.motion import clips, paths, player
from engine3d.model.scene import lights, shadow_casting
from engine3d.rendering import frame
from engine3d.rendering import options as render_options
from engine3d.rendering.renderer import _SAMPLES
from engine3d.stage import lighting, look

ACCEPTED = {
    "Backend": ["auto", *native.BACKENDS],
    "ColorSpace": colors.COLOR_SPACES,
    "Samples": {samples for numbers in _SAMPLES.values() for samples in numbers},
    "Antialiasing": _SAMPLES,
    "Mode": native.MODES,
    # The other outputs are shown by modes: colours by those that colour, both depths by "depth".
    "OutputMode": {*frame.OUTPUTS} - {*native.MODES, "color", "ndc_depth"},
    "Wireframe": [name for name in native.WIREFRAMES if name is not None],
    "Cull": native.CULLS,
    "FrameCull": [*native.CULLS, "auto"],
    "Shading": native.SHADINGS,
    "Normals": native.NORMALS,
    "HiddenSurfaces": native.HIDDEN_SURFACES,
    "LineShape": native.LINE_SHAPES,
    "PointShape": native.POINT_SHAPES,
    "SizeUnit": render_options.SIZE_UNITS,
    "ValuesOn": values.KINDS,
    "Culling": native.CULLINGS,
    "ToneMapping": native.TONE_MAPPINGS,
    "Filter": native.FILTERS,
    "Wrap": native.WRAPS,
    "Falloff": native.FALLOFFS,
    "AlphaMode": native.ALPHA_MODES,
    "LightShadow": shadow_casting.SHADOWS,
    "ShadowTaps": shadow_casting.TAPS,
    "MotionPath": clips.PATHS,
    "Interpolation": clips.INTERPOLATIONS,
    "PathEnd": paths.ENDS,
    "Forward": paths.FORWARDS,
    "JointKind": urdf_joints.KINDS,
    "Loop": player.LOOPS,
    "BuiltInEnvironment": environment.BUILT_IN,
    "ImageFormat": frame._FORMATS,
    "PixelFormat": pixels.FORMATS,
    "PointerShape": POINTERS,
    "LightSetup": lighting.SETUPS,
    "ShapesOf": robot_options.SHAPES_OF,
    "LookName": look.LOOKS,
    "Backdrop": [*look.THEMED, "scene"],
    "LineKind": line_kinds.KINDS,
    "PageSize": units.PAGES,
    "LengthUnit": units.UNITS,
    "EulerOrder": ["".join(order) for order in permutations("XYZ")],
}


@pytest.mark.parametrize("name", ACCEPTED)
def test_a_type_lists_what_is_accepted(name):
    assert sorted(get_args(getattr(choices, name)), key=repr) == sorted(ACCEPTED[name], key=repr)


def test_every_type_is_compared():
    literals = {name for name, value in vars(choices).items() if "Literal[" in str(value)}
    assert literals == set(ACCEPTED)


def test_outputs_are_those_of_the_core():
    assert sorted(get_args(frame.Output)) == sorted(frame.OUTPUTS)
    properties = [name for name, value in vars(e3d.Frame).items() if type(value) is frame._Output]
    assert properties == list(frame.OUTPUTS)


def test_what_vertices_carry_is_what_the_core_knows():
    core = {name.removesuffix("_u8").removesuffix("_f32") for name in native.VERTEX_ATTRIBUTES}
    assert {"normals", *vertex_attributes(e3d.Mesh)} == core


def test_the_textures_of_materials_are_those_of_the_core():
    assert list(TEXTURE_SLOTS) == list(native.TEXTURE_SLOTS)


def test_lists_of_modules_are_the_types():
    assert get_args(choices.Falloff) == lights.FALLOFFS
    assert get_args(choices.Filter) == textures.FILTERS
    assert get_args(choices.Wrap) == textures.WRAPS


def passed_on(function):
    """The annotations of the keyword arguments of a function."""
    parameters = inspect.signature(function).parameters.values()
    return {p.name: p.annotation for p in parameters if p.kind is p.KEYWORD_ONLY}


def test_options_that_functions_pass_on_are_those_of_the_function():
    declared = render_options.RenderKeywords.__annotations__
    names = {one.name for one in fields(render_options.RenderOptions)}
    assert render_options.OptionKeywords.__annotations__.keys() == names
    assert declared.keys() == passed_on(e3d.Renderer.render).keys()
    for name, annotation in passed_on(e3d.Renderer.render).items():
        assert declared[name].__forward_arg__ == annotation, name
    assert get_type_hints(textures.TextureOptions).keys() == passed_on(e3d.Texture.__init__).keys()
