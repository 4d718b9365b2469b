"""The scenes that have names: what ``--scene`` shows, and what ``bench`` measures.

A row of `SCENES` is all there is to write: choices, help, checks and completion follow. Nothing
loads until a scene is asked for. A scene is made anew every time: what one caller changes no other
sees.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import TYPE_CHECKING, NamedTuple

from ..errors import InvalidArgumentError

if TYPE_CHECKING:
    from ..stage.viewed_scene import ViewedScene


class NamedScene(NamedTuple):
    """A row of the list.

    Attributes
    ----------
    about : str
        What the scene shows, in a line.
    viewed, measured : str
        Module and function of this package that make a `ViewedScene` of it, and a `Workload`; empty
        where it isn't for that.
    options : tuple of str
        What of the command line the function takes that makes a `ViewedScene`.
    """

    about: str
    viewed: str = ""
    measured: str = ""
    options: tuple[str, ...] = ()


SCENES = {
    "default": NamedScene("an island by day, turning slowly", "models.showcase"),
    "vertices": NamedScene("a spinning cube as its vertices", "cubes.vertices"),
    "edges": NamedScene("the cube as its edges", "cubes.edges"),
    "faces": NamedScene("the cube as its faces", "cubes.faces"),
    "cube": NamedScene("the cube as its vertices, edges and faces in turn", "cubes.cycle"),
    "shapes": NamedScene(
        "a sphere and a box under three moving lamps", "shapes.shapes", options=("subdivisions",)
    ),
    "textured": NamedScene(
        "a textured model of 6,000 triangles", "models.textured", "workloads.textured"
    ),
    "asc": NamedScene("a train of several objects", "models.asc"),
    "city": NamedScene("a city by day or at dusk", "city.city", options=("triangles", "dusk")),
    "solar": NamedScene("Sun, Earth and Moon", "solar.solar"),
    "mesh": NamedScene("one mesh of 70,200 triangles", measured="workloads.mesh"),
    "grid": NamedScene("144 instances of it: 10 million triangles", measured="workloads.grid"),
    "grid-depth": NamedScene("the same, depth alone", measured="workloads.grid_depth"),
    "grid-ids": NamedScene("the same, numbers of instances alone", measured="workloads.grid_ids"),
    "city-street": NamedScene(
        "a city of a million triangles at street level", measured="workloads.city_street"
    ),
    "city-above": NamedScene("the city from above", measured="workloads.city_above"),
    "city-lights": NamedScene(
        "the street under 256 point lights", measured="workloads.city_lights"
    ),
    "fill-front": NamedScene(
        "32 layers that fill the picture, front to back", measured="workloads.fill_front"
    ),
    "fill-back": NamedScene("the same layers, back to front", measured="workloads.fill_back"),
    "spheres": NamedScene("39,304 spheres, all in view", "crowds.spheres", "workloads.spheres"),
    "spheres-inside": NamedScene(
        "the spheres from among them", measured="workloads.spheres_inside"
    ),
    "lod": NamedScene("3,600 balls in five levels of detail", "crowds.lod"),
    "parcels": NamedScene("1,600 parcels of land, joined to blocks", "crowds.parcels"),
}
DEMO_NAMES = tuple(name for name, scene in SCENES.items() if scene.viewed)
WORKLOAD_NAMES = tuple(name for name, scene in SCENES.items() if scene.measured)


def load_demo(name: str, **options) -> ViewedScene:
    """Return a scene to look at by its name.

    Parameters
    ----------
    name : str
        One of `DEMO_NAMES`.
    **options
        ``triangles`` : int, of ``"city"``: how many, about. ``dusk`` : bool, of the same.
        ``subdivisions`` : int, of ``"shapes"``: into how many parts edges are cut.

    Raises
    ------
    InvalidArgumentError
        There is no such scene.
    """
    if name not in DEMO_NAMES:
        raise InvalidArgumentError(f"no scene {name!r}: there are {', '.join(DEMO_NAMES)}")
    return function_of(SCENES[name].viewed)(**options)


def function_of(place: str) -> Callable:
    """Return the function of this package that a row names."""
    module, _, name = place.partition(".")
    return getattr(import_module(f".{module}", __name__), name)
