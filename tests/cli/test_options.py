"""The values of options, and how options become settings."""

import argparse
import inspect

import pytest
from PIL import Image

import engine3d as e3d
from engine3d.apps.cli import main, values
from engine3d.apps.cli.arguments import join_values
from engine3d.apps.cli.options import appearance_options
from engine3d.apps.cli.options import shared_options as options
from engine3d.apps.cli.parser import make_parser
from engine3d.apps.cli.usage import UsageError
from engine3d.apps.scenes import DEMO_NAMES, SCENES, function_of
from engine3d.extras.worlds.city import LEAST, MOST
from engine3d.rendering.options import MODES
from engine3d.stage.appearance import CHOICES


def parse(*arguments):
    return make_parser().parse_args(join_values(list(arguments)))


@pytest.mark.parametrize("text", ["1280x720", "1280,720", "1280X720", " 1280 x 720 "])
def test_resolution(text):
    assert values.size(text) == (1280, 720)


@pytest.mark.parametrize(
    "text", ["", "1280", "0x5", "5x0", "-5x5", "1x16385", "axb", "1.5x2", "1x2x3"]
)
def test_bad_resolution(text):
    with pytest.raises(argparse.ArgumentTypeError):
        values.size(text)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("1,1,1", (255, 255, 255)),
        ("0,0,0", (0, 0, 0)),
        ("0.2,0.4,0.6", (51, 102, 153)),
        ("255,128,0", (255, 128, 0)),
        ("#336699", (51, 102, 153)),
        ("red", (255, 0, 0)),
    ],
)
def test_color(text, expected):
    assert values.color(text) == expected


@pytest.mark.parametrize(
    "text", ["", "1,2", "-1,0,0", "256,0,0", "nan,0,0", "no such colour", "#12"]
)
def test_bad_color(text):
    with pytest.raises(argparse.ArgumentTypeError):
        values.color(text)


@pytest.mark.parametrize("text", ["1,2", "1,2,x", "1,2,3,4", "inf,0,0", ""])
def test_bad_vector(text):
    with pytest.raises(argparse.ArgumentTypeError):
        values.vector(text)


@pytest.mark.parametrize(("text", "name"), [("+Y", "+Y"), ("-z", "-Z"), ("X", "+X")])
def test_up_direction(text, name):
    assert values.up_direction(text) == name


@pytest.mark.parametrize("text", ["", "W", "+-Y", "YY"])
def test_bad_up_direction(text):
    with pytest.raises(argparse.ArgumentTypeError):
        values.up_direction(text)


@pytest.mark.parametrize("text", ["0", "-1", "1.5", "x", "", "99999999999"])
def test_bad_count(text):
    with pytest.raises(argparse.ArgumentTypeError):
        values.count(text)


@pytest.mark.parametrize("text", ["0", "-1", "256.5", "nan", "wide"])
def test_bad_width(text):
    with pytest.raises(argparse.ArgumentTypeError):
        values.width(text)


@pytest.mark.parametrize("text", ["0", "19999", "50000001", "2e5"])
def test_bad_city_triangles(text):
    with pytest.raises(argparse.ArgumentTypeError):
        values.city_triangles(text)


@pytest.mark.parametrize("text", ["1", "2,1", "-1,1", "0,x", "0,1,2"])
def test_bad_limits(text):
    with pytest.raises(argparse.ArgumentTypeError):
        values.limits(text)


@pytest.mark.parametrize("text", ["90", "-1", "steep"])
def test_bad_slope(text):
    with pytest.raises(argparse.ArgumentTypeError):
        values.slope(text)


def test_names_limits_and_slopes():
    assert values.names("grass, path,,") == ("grass", "path")
    assert values.limits("0.1,1") == (0.1, 1.0)
    assert values.slope("30") == 30.0


def test_a_scene_without_materials_takes_a_colour_and_all_options_of_light(tmp_path):
    path = tmp_path / "faces.png"
    size = ["--size", "64x64", "--samples", "1"]
    look = ["--color", "#ff0000", "--light-direction=0,0,-1", "--light-clamp", "1,1"]
    planes = ["--near", "0.1", "--far", "50", "--culling", "frustum", "--no-texture"]
    assert main(["render", "--scene", "faces", "-o", str(path), *size, *look, *planes]) == 0
    with Image.open(path) as image:
        colors = {color for _, color in image.convert("RGB").getcolors()}
    assert colors == {(18, 20, 26), (255, 0, 0)}


def test_limits_are_those_of_what_draws():
    assert values.CITY_TRIANGLES == (LEAST, MOST)
    assert values.width("256") == values.MAX_WIDTH
    assert values.city_triangles("20000") == LEAST
    with e3d.Renderer((8, 8)) as renderer:
        renderer.render(e3d.Scene(), line_width=values.MAX_WIDTH, point_size=values.MAX_WIDTH)
        for name in ("line_width", "point_size"):
            with pytest.raises(e3d.InvalidArgumentError):
                renderer.render(e3d.Scene(), **{name: values.MAX_WIDTH + 1})


def test_values_may_start_with_a_minus_sign():
    args = parse("render", "a.obj", "--camera-position", "-1,2,3", "--up", "-Z", "-o", "-")
    assert args.camera_position == (-1.0, 2.0, 3.0)
    assert args.up == "-Z"
    assert args.output == "-"


def test_choices_are_those_of_the_display_package():
    assert appearance_options.MODES == MODES
    parser = argparse.ArgumentParser()
    appearance_options.add_appearance(parser)
    choices = {action.dest: action.choices for action in parser._actions}
    given = {name: CHOICES[name] for name in CHOICES.keys() & choices.keys() if choices[name]}
    assert len(given) >= 8
    for name, known in given.items():
        assert tuple(choices[name]) == tuple(one for one in known if one is not None)


def test_settings_hold_only_what_was_given():
    assert options.settings(parse("render", "a.obj", "-o", "a.png")).appearance == {}
    given = options.settings(
        parse(
            "run", "a.obj", "--edges", "--unlit", "--normals", "flat", "--line-width", "2.5", "-gxm"
        )
    )
    assert given.appearance == {
        "mode": "unlit",
        "wireframe": "overlay",
        "normals": "flat",
        "line_width": 2.5,
    }
    assert given.grid and given.axes and given.metadata


@pytest.mark.parametrize(
    "arguments",
    [
        ("--unlit", "--mode", "depth"),
        ("--edges", "--wireframe", "only"),
        ("--near", "2", "--far", "1"),
        ("--light-position", "1,1,1", "--light-direction", "1,1,1"),
    ],
)
def test_options_that_contradict_each_other(arguments):
    with pytest.raises(UsageError):
        options.settings(parse("run", "a.obj", *arguments))


def test_wireframe_without_a_value_is_only():
    assert parse("run", "--wireframe").wireframe == "only"
    assert parse("run", "--wireframe", "overlay").wireframe == "overlay"
    before_model = parse("run", "--wireframe", "a.obj")
    assert (before_model.wireframe, before_model.models) == ("only", ["a.obj"])
    assert parse("run", "--wireframe=overlay", "a.obj").wireframe == "overlay"
    assert parse("run", "--wireframe", "--edges").wireframe == "only"


def commands():
    """The parser of each command, by its name."""
    actions = make_parser()._actions
    return next(action.choices for action in actions if isinstance(action.choices, dict))


def test_every_option_has_a_help():
    for name, command in commands().items():
        for action in command._actions:
            assert action.help, f"{name} {action.option_strings or action.dest}"


def test_without_a_command_all_are_named():
    with pytest.raises(UsageError) as error:
        parse().load_command()
    assert all(name in str(error.value) for name in commands())


def test_filters_of_textures_and_shapes_of_lines():
    given = options.settings(
        parse("run", "a.obj", "--anisotropy", "3", "--lod-bias", "-0.5", "--line-shape", "round")
    )
    assert (given.filtering.anisotropy, given.filtering.lod_bias) == (3, -0.5)
    assert given.appearance == {"line_shape": "round"}


def test_what_is_on_by_default_can_be_switched_off():
    off = ("--no-specular-antialiasing", "--no-alpha-to-coverage")
    given = options.settings(parse("render", "a.obj", *off))
    assert given.appearance == {"specular_antialiasing": False, "alpha_to_coverage": False}
    assert options.settings(parse("render", "a.obj")).appearance == {}


@pytest.mark.parametrize("text", ["0", "17", "2.5", "many"])
def test_bad_anisotropy(text):
    with pytest.raises(argparse.ArgumentTypeError):
        values.anisotropy(text)


@pytest.mark.parametrize("text", ["17", "-16.5", "nan", "low"])
def test_bad_lod_bias(text):
    with pytest.raises(argparse.ArgumentTypeError):
        values.lod_bias(text)


def test_ambient_occlusion_is_asked_for_as_by_f3d():
    assert options.settings(parse("render", "x.obj")).appearance == {}
    asked = options.settings(parse("render", "x.obj", "-q", "--ambient-occlusion-radius", "0.5"))
    assert asked.appearance == {"ambient_occlusion": True, "ambient_occlusion_radius": 0.5}
    long = options.settings(parse("run", "x.obj", "--ambient-occlusion"))
    assert long.appearance == {"ambient_occlusion": True}
    with pytest.raises(SystemExit):
        parse("render", "x.obj", "--ambient-occlusion-radius", "0")


def test_ambient_occlusion_shows_in_a_picture(tmp_path):
    def drawn(*more):
        path = tmp_path / "out.png"
        arguments = ("render", "--scene", "shapes", "--size", "120x90", "-o", str(path))
        assert main([*arguments, *more]) == 0
        with Image.open(path) as picture:
            return picture.convert("RGB").tobytes()

    assert drawn() != drawn("-q")


def test_scenes_take_the_options_that_their_rows_have():
    for name in DEMO_NAMES:
        scene = SCENES[name]
        assert set(inspect.signature(function_of(scene.viewed)).parameters) == set(scene.options)
        assert scene.about
    for row in ("--triangles=20000", "--dusk", "--subdivisions=2"):
        assert main(["render", "--scene", "solar", row, "-o", "a.png"]) == 2
