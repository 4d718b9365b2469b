"""The named scenes, for ``--scene`` and ``bench``.

A new scene needs only a row in `SCENES`: choices, help, checks and completion follow. Scenes that
packages add have no row, but are chosen likewise. Nothing is loaded until a scene is requested, and
each request creates a new scene.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import TYPE_CHECKING, NamedTuple

from ...base.plugins.open_choices import OpenChoices
from ...base.plugins.plugin import Plugin, fault
from ...base.plugins.registry import find_plugin
from ...errors import InvalidArgumentError

if TYPE_CHECKING:
    from ...stage.viewed_scene import ViewedScene


class Named(NamedTuple):
    """A row of the table of scenes.

    Attributes
    ----------
    about : str
        What the scene shows, in a line.
    viewed : str
        Module and function of this package that make a `ViewedScene` of it; empty: none is made.
    measured : str
        Function of `workloads` that makes what is measured of it; empty: nothing is.
    options : tuple of str
        What of the command line the function takes that makes a `ViewedScene`.
    plain : bool
        Whether there is a plain picture of what is measured, which other renderers draw alike.
    """

    about: str
    viewed: str = ""
    measured: str = ""
    options: tuple[str, ...] = ()
    plain: bool = True


SCENES = {
    "default": Named("an island by day, turning slowly", "models.showcase"),
    "vertices": Named("a spinning cube as its vertices", "cubes.vertices"),
    "edges": Named("the cube as its edges", "cubes.edges"),
    "faces": Named("the cube as its faces", "cubes.faces"),
    "cube": Named("the cube as its vertices, edges and faces in turn", "cubes.cycle"),
    "shapes": Named(
        "a sphere and a box under three moving lamps", "shapes.shapes", options=("subdivisions",)
    ),
    "textured": Named("a textured model of 6,000 triangles", "models.textured", "textured"),
    "asc": Named("a train of several objects", "models.asc"),
    "city": Named("a city by day or at dusk", "city_scene.city", options=("triangles", "dusk")),
    "solar": Named("Sun, Earth and Moon", "solar.solar"),
    "mesh": Named("one mesh of 70,200 triangles", measured="mesh"),
    "grid": Named("144 instances of it: 10 million triangles", measured="grid"),
    "grid-depth": Named("the same, depth alone", measured="grid_depth"),
    "grid-ids": Named("the same, numbers of instances alone", measured="grid_ids"),
    "city-street": Named("a city of a million triangles at street level", measured="city_street"),
    "city-above": Named("the city from above", measured="city_above"),
    "city-lights": Named("the street under 256 point lights", measured="city_lights"),
    "city-occlusion": Named(
        "the street with ambient occlusion", measured="city_occlusion", plain=False
    ),
    "glass": Named("a vase, a candle holder and 64 panes of glass", measured="glass", plain=False),
    "fill-front": Named("32 layers that fill the picture, front to back", measured="fill_front"),
    "fill-back": Named("the same layers, back to front", measured="fill_back"),
    "spheres": Named("39,304 spheres, all in view", "crowds.spheres", "spheres"),
    "spheres-inside": Named("the spheres from among them", measured="spheres_inside"),
    "lod": Named("3,600 balls in five levels of detail", "crowds.lod"),
    "parcels": Named("1,600 parcels of land, joined to blocks", "crowds.parcels"),
}
DEMO_NAMES = tuple(name for name, scene in SCENES.items() if scene.viewed)
#: What `load_demo` takes: these, and the scenes of plug-ins.
DEMO_CHOICES = OpenChoices("scenes", DEMO_NAMES)
WORKLOAD_NAMES = tuple(name for name, scene in SCENES.items() if scene.measured)
PLAIN_NAMES = tuple(name for name in WORKLOAD_NAMES if SCENES[name].plain)


def load_demo(name: str, **options) -> ViewedScene:
    """Return a scene for viewing by its name.

    Parameters
    ----------
    name : str
        One of `DEMO_CHOICES`.
    **options
        ``triangles`` : int, of ``"city"``: how many, about. ``dusk`` : bool, of the same.
        ``subdivisions`` : int, of ``"shapes"``: into how many parts edges are cut.

    Raises
    ------
    InvalidArgumentError
        There is no such scene.
    PluginError
        The scene is a plug-in's, which is broken.
    """
    if name in DEMO_NAMES:
        return function_of(SCENES[name].viewed)(**options)
    if (plugin := find_plugin("scenes", name)) is None:
        raise InvalidArgumentError(f"no scene {name!r}: there are {', '.join(DEMO_CHOICES)}")
    return _of_plugin(plugin)


def shipped_names() -> set[str]:
    """Return the names of the scenes that engine3d itself has."""
    return set(SCENES)


def _of_plugin(plugin: Plugin) -> ViewedScene:
    """Return the scene that a plug-in makes, for viewing."""
    from ...base.numbers import shown
    from ...model.scene.scene import Scene
    from ...stage.viewed_thing import viewed_of

    make = plugin.use()
    with plugin.named_in_errors():
        scene = make()
    if not isinstance(scene, Scene):
        raise fault(plugin, f"returned {shown(scene)}, not a Scene")
    viewed = viewed_of(scene)
    assert viewed is not None
    viewed.title = plugin.name
    if scene.animator is not None:
        viewed.update, viewed.plays = scene.animator.seek, True
    return viewed


def function_of(place: str) -> Callable:
    """Return the function of this package that a row refers to."""
    module, _, name = place.partition(".")
    return getattr(import_module(f".{module}", __name__), name)
