"""One rule for colours: however a colour is spelled, every place that takes one draws the same."""

import numpy as np
import pytest

import engine3d as e3d
from engine3d.apps.cli.values import color as option
from engine3d.model.materials.colors import linear_color
from engine3d.model.materials.material import PARAMETERS, Material
from engine3d.model.scene.lights import DIRECT_LIGHTS

CODES = (255, 140, 0)  # darkorange
SPELLINGS = {
    "name": "darkorange",
    "another case": "DarkOrange",
    "hex": "#ff8c00",
    "hex with alpha": "#ff8c00ff",
    "uint8": np.array(CODES, np.uint8),
    "floats": tuple(code / 255 for code in CODES),
    "float32": np.float32(CODES) / np.float32(255),
    "RGBA of a colormap": (1.0, 140 / 255, 0.0, 1.0),
    "linear": e3d.linear(linear_color(CODES)),
    "linear array": e3d.linear(linear_color(CODES).astype(np.float64)),
    "linear RGBA": e3d.linear(*linear_color(CODES).tolist(), 1.0),
}
VIEW = e3d.PerspectiveCamera(0.8), e3d.look_at((0.8, 0.9, 2), (0, 0, 0))


def drawn(thing=None, light=None, options=None, **scene):
    """The bytes of a small picture of a ball, or of another thing."""
    made = e3d.Scene(**{"background": "gray", **scene})
    made.add(e3d.icosphere(0.6, 2) if thing is None else thing)
    lamp = e3d.DirectionalLight((-0.3, -0.5, -1), intensity=0.8) if light is None else light
    made.add(lamp, translation=(0, 0, 1.2))
    frame = e3d.render(made, VIEW, size=(24, 18), **(options or {}))
    return frame.color.tobytes()


def with_material(**values):
    ball = e3d.icosphere(0.6, 2)
    ball.materials = [e3d.Material(**values)]
    return drawn(ball)


def with_fog(fog):
    scene = e3d.Scene()
    scene.fog = fog
    scene.add(e3d.icosphere(0.6, 2))
    return e3d.render(scene, VIEW, size=(24, 18)).color.tobytes()


def with_keys(color):
    ball = e3d.icosphere(0.6, 2)
    channel = e3d.motion.PropertyChannel(ball.materials[0], "emissive", [0, 1], [color, color])
    return np.asarray(channel.values).tobytes()


def with_array(color):
    """A colour for each vertex, unlit: bytes of arrays are decoded by 16 bits."""
    ball = e3d.icosphere(0.6, 2)
    ball.colors = [color] * len(ball.positions)
    return drawn(ball, options={"mode": "unlit"})


def with_instances(color):
    balls = e3d.InstancedMesh(e3d.icosphere(0.4, 2), [(0, 0, 0, 1)] * 2, colors=[color] * 2)
    return drawn(balls, options={"mode": "unlit"})


def with_canvas(color):
    canvas = e3d.Canvas((24, 18))
    canvas.clear(color)
    canvas.line(0, 0, 9, 9, color, width=2)
    canvas.text(1, 1, "a", "white", background=color)
    return canvas.pixels.tobytes()


def with_points(color):
    canvas = e3d.Canvas((24, 18))
    canvas.points([(3, 3), (5, 5)], [color] * 2)
    return canvas.pixels.tobytes()


GLASS = {"transmission": 1.0, "attenuation_distance": 0.5, "thickness": 0.4}
PHYSICAL = {
    name: {"roughness": 0.3, "metallic": 0.0, **values}
    for name, values in (
        ("sheen_color", {"sheen_roughness": 0.4}),
        ("specular_color", {"ior": 1.6}),
        ("attenuation_color", GLASS),
        ("diffuse_transmission_color", {"diffuse_transmission": 0.5}),
    )
}
#: Each place that takes a colour.
PLACES = {
    **{
        f"Material.{name}": lambda color, name=name: with_material(
            **{name: color}, **PHYSICAL.get(name, {})
        )
        for name, row in PARAMETERS.items()
        if row.kind.is_color
    },
    **{
        f"{kind} light": lambda color, light=light: drawn(light=light(color=color))
        for kind, light in DIRECT_LIGHTS.items()
    },
    "sky_color": lambda color: drawn(light=e3d.HemisphereLight(color, "black")),
    "ground_color": lambda color: drawn(light=e3d.HemisphereLight("black", color)),
    "background": lambda color: drawn(background=color),
    "ambient": lambda color: drawn(ambient=color),
    "top of a gradient": lambda color: drawn(background=e3d.Gradient(color, "black")),
    "bottom of a gradient": lambda color: drawn(background=e3d.Gradient("black", color)),
    "fog": lambda color: with_fog(e3d.Fog(color, 0.5, 3.0)),
    "exponential fog": lambda color: with_fog(e3d.ExponentialFog(color, 0.5)),
    "line_color": lambda color: drawn(options={"wireframe": "only", "line_color": color}),
    "Mesh.colors": with_array,
    "InstancedMesh.colors": with_instances,
    "keys": with_keys,
    "canvas": with_canvas,
    "points of a canvas": with_points,
}


@pytest.mark.parametrize("place", PLACES)
def test_every_spelling_gives_the_same_bytes(place):
    expected = PLACES[place](CODES)
    assert expected != PLACES[place]((0, 90, 255))
    for spelling, color in SPELLINGS.items():
        assert PLACES[place](color) == expected, spelling


@pytest.mark.parametrize("spelling", SPELLINGS)
def test_what_is_read_can_be_assigned(spelling):
    given = SPELLINGS[spelling]
    material = Material(color=given)
    assert linear_color(material.rgb).tolist() == linear_color(CODES).tolist()
    again = Material(color=material.color)
    assert again.color == material.color and type(again.color) is type(material.color)
    mesh = e3d.box()
    mesh.colors = [given] * len(mesh.positions)
    copy = e3d.box()
    copy.colors = mesh.colors
    assert copy.colors.tobytes() == mesh.colors.tobytes()
    copy.colors = mesh.colors[::-1] * 1
    assert copy.colors.tobytes() == mesh.colors.tobytes()


@pytest.mark.parametrize("extension", ["e3d.json", "glb"])
@pytest.mark.parametrize("spelling", SPELLINGS)
def test_files_keep_colours(spelling, extension, tmp_path):
    color, path = SPELLINGS[spelling], tmp_path / f"a.{extension}"
    ball = e3d.icosphere(0.6, 2)
    ball.colors = [color] * len(ball.positions)
    ball.materials = [e3d.Material(color=color, metallic=0.0, roughness=1.0, emissive=color)]
    scene = e3d.Scene(background=color, ambient=color)
    scene.add(ball)
    scene.add(e3d.PointLight(color))
    e3d.save_scene(scene, path)
    pictures = [e3d.render(one, VIEW, size=(24, 18)) for one in (scene, e3d.load_scene(path))]
    assert np.array_equal(pictures[0].color, pictures[1].color) or extension == "glb"
    lights = [
        next(node.object for node in one.nodes if isinstance(node.object, e3d.PointLight))
        for one in (scene, e3d.load_scene(path))
    ]
    assert linear_color(lights[0].color).tolist() == linear_color(lights[1].color).tolist()


@pytest.mark.parametrize("text", ["darkorange", "#ff8c00", "255,140,0", "1,0.549019608,0"])
def test_the_command_line_takes_the_same_words(text):
    assert option(text) == CODES


@pytest.mark.parametrize("word", ["#010100", "#000001", "#000000", "#010101ff"])
def test_hex_digits_are_codes_however_small(word):
    codes = np.uint8(list(bytes.fromhex(word[1:7])))
    assert linear_color(word).tolist() == linear_color(codes).tolist()


def test_marks_last_as_long_as_the_type():
    light = e3d.linear(0.5, 0.25, 1.0, 0.5)
    assert repr(light) == "linear(0.5, 0.25, 1.0, 0.5)" and light[:3] == e3d.linear(0.5, 0.25, 1)
    assert light != (0.5, 0.25, 1.0, 0.5) and e3d.linear(1, 0, 1) == (1, 0, 1)
    array = e3d.linear(np.full((4, 3), 0.5))
    for same in (array[1:], array * 0.5, np.concatenate([array, array]), array.copy()):
        assert type(same) is type(array)
    with pytest.raises(e3d.InvalidArgumentError, match="8-bit|uint8"):
        e3d.linear(np.zeros((4, 3), np.uint8))
    for wrong in ((1, 2), (-1.0, 0, 0), ("red",), (1, 2, float("nan")), (3.0,)):
        with pytest.raises(e3d.InvalidArgumentError):
            e3d.linear(*wrong)


def test_only_linear_light_is_brighter_than_white():
    assert e3d.Material(emissive=e3d.linear(4, 2, 1)).emissive == e3d.linear(4, 2, 1)
    for brighter in ((4.0, 2.0, 1.0), (1.5, 0, 0), (255.0, 140.0, 0.0)):
        with pytest.raises(e3d.InvalidArgumentError, match=r"e3d\.linear"):
            e3d.Material(emissive=brighter)
    with pytest.raises(e3d.InvalidArgumentError, match=r"e3d\.linear"):
        e3d.Mesh(np.eye(3), colors=np.full((3, 3), 2.0))
    for wrong in (-0.5, np.nan):
        with pytest.raises(e3d.InvalidArgumentError, match="colors"):
            e3d.Mesh(np.eye(3), colors=np.full((3, 3), wrong))
