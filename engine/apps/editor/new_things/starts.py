"""Scenes to start from: an empty one, a studio, a street, Sun and Earth and Moon.

Out: scenes of primitives, lights and a camera, which can be changed like any other.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

from ....base import linalg
from ....model import primitives
from ....model.environments.environment import Environment, named_environment
from ....model.geometry.mesh import Mesh
from ....model.materials.material import Material
from ....model.scene.cameras import PerspectiveCamera
from ....model.scene.lights import (
    WHITE_INTENSITY,
    DirectionalLight,
    PointLight,
    RectangleLight,
)
from ....model.scene.nodes import Node
from ....model.scene.scene import Scene
from ....stage.overlays.theme import DARK, LIGHT
from ...scenes.solar import EARTH_ORBIT, solar

#: Towards the sun of the street, which is in the afternoon.
_SUN = (0.55, 0.6, 0.45)
_HOUSES = (
    ((2.6, 5.0, 2.6), (176, 92, 70)),
    ((3.2, 3.6, 2.6), (214, 190, 150)),
    ((2.4, 6.2, 2.6), (150, 160, 172)),
    ((3.0, 4.4, 2.6), (202, 158, 96)),
)
_STREET = 26.0  # its length


class Start(NamedTuple):
    """A scene to start from.

    Attributes
    ----------
    title, hint : str
    make : callable
        Returns the scene.
    is_seen_through : bool
        Whether the view begins at its camera.
    """

    title: str
    hint: str
    make: Callable[[], Scene]
    is_seen_through: bool = True


def empty() -> Scene:
    """Return a scene with a key light and a camera."""
    scene = Scene(DARK.background, ambient=(76, 80, 88))
    key = linalg.look_at((-0.9, 1.6, 0.7), (0.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    light = DirectionalLight(intensity=0.75 * WHITE_INTENSITY, shadow="map")
    scene.add(light, name="key light", pose=key)
    _add_camera(scene, (-2.6, 1.4, 2.2), (0.0, 0.4, 0.0))
    return scene


def studio() -> Scene:
    """Return a ball on a pedestal, lit as products are photographed."""
    scene = Scene(LIGHT.gradient)
    scene.environment, scene.environment_intensity = named_environment("studio"), 0.5
    _add(
        scene,
        primitives.plane((24.0, 24.0)),
        "floor",
        Material(color=(205, 205, 205), roughness=0.6),
    )
    pedestal = primitives.cylinder(0.8, 0.4, 64)
    _add(
        scene, pedestal, "pedestal", Material(color=(235, 235, 235), roughness=0.4), (0.0, 0.2, 0.0)
    )
    ball = Material(color=(200, 60, 40), roughness=0.25, metallic=0.0)
    _add(scene, primitives.uv_sphere(0.5, (64, 32)), "ball", ball, (0.0, 0.9, 0.0))
    for name, eye, size, strength in (
        ("key light", (2.4, 3.0, 2.2), 1.4, 9.0),
        ("fill light", (-3.0, 1.8, 1.6), 2.0, 1.5),
        ("rim light", (-0.8, 2.6, -3.0), 1.2, 6.0),
    ):
        light = RectangleLight(intensity=strength, width=size, height=size)
        light.shadow = "map" if name == "key light" else "none"
        pose = linalg.look_at(eye, (0.0, 0.7, 0.0), (0.0, 1.0, 0.0))
        scene.add(light, name=name, pose=pose)
    _add_camera(scene, (1.6, 1.5, 3.8), (0.0, 0.75, 0.0))
    return scene


def street() -> Scene:
    """Return a street with houses, trees and lamps on an afternoon."""
    scene = Scene()
    scene.environment = Environment.sky(_SUN, sun_disc=False)
    scene.background = scene.environment
    sun = DirectionalLight.sun(_SUN)
    sun.shadow = "map"
    scene.add(sun, name="sun", translation=(0.0, 9.0, 0.0))
    ground = Material(color=(108, 132, 84))
    _add(scene, primitives.plane((60.0, 60.0)), "ground", ground, (0.0, -0.02, 0.0))
    road = primitives.box((5.0, 0.02, _STREET))
    _add(scene, road, "road", Material(color=(70, 72, 76)))
    for side, name in ((-1.0, "left side"), (1.0, "right side")):
        _add_side(scene, scene.add(name=name), side)
    _add_camera(scene, (0.3, 1.7, 15.0), (0.0, 2.2, 0.0))
    return scene


def _add_side(scene: Scene, group: Node, side: float) -> None:
    """Add a pavement with its houses, trees and lamps."""
    stone = primitives.box((1.8, 0.14, _STREET))
    stone.materials = [Material(name="stone", color=(160, 158, 152))]
    scene.add(stone, name="pavement", parent=group, translation=(side * 3.4, 0.07, 0.0))
    for number, ((width, height, depth), color) in enumerate(_HOUSES):
        house = primitives.box((depth, height, width))
        house.materials = [Material(name="wall", color=color)]
        along = side * (number - 1.5) * 5.6
        place = (side * 6.2, height / 2, along)
        scene.add(house, name=f"house {number + 1}", parent=group, translation=place)
    trunk, crown = primitives.cylinder(0.12, 1.6, 12), primitives.icosphere(0.8, 2)
    trunk.materials = [Material(name="bark", color=(96, 70, 50))]
    crown.materials = [Material(name="leaves", color=(70, 120, 58))]
    pole, lamp = primitives.cylinder(0.05, 3.4, 12), primitives.uv_sphere(0.16, (16, 8))
    pole.materials = [Material(name="iron", color=(52, 56, 60))]
    lamp.materials = [Material(name="glass", color=(255, 240, 210), emissive=(255, 214, 150))]
    for number in range(3):
        along = (number - 1) * 8.0
        tree = scene.add(name=f"tree {number + 1}", parent=group)
        tree.translation = (side * 3.4, 0.14, along + 2.0)
        scene.add(trunk, name="trunk", parent=tree, translation=(0.0, 0.8, 0.0))
        scene.add(crown, name="crown", parent=tree, translation=(0.0, 2.1, 0.0))
        post = scene.add(name=f"street lamp {number + 1}", parent=group)
        post.translation = (side * 2.8, 0.14, along - 2.0)
        scene.add(pole, name="pole", parent=post, translation=(0.0, 1.7, 0.0))
        scene.add(lamp, name="lamp", parent=post, translation=(0.0, 3.5, 0.0))
        light = PointLight((255, 214, 150), 0.6 * WHITE_INTENSITY, 6.0, "gltf")
        scene.add(light, name="light", parent=post, translation=(0.0, 3.2, 0.0))


def solar_system() -> Scene:
    """Return Sun, Earth and Moon, which turn when time plays."""
    scene = solar().scene
    _add_camera(scene, (0.5 * EARTH_ORBIT, 0.9 * EARTH_ORBIT, 2.4 * EARTH_ORBIT), (0.0, 0.0, 0.0))
    return scene


def _add(
    scene: Scene,
    mesh: Mesh,
    name: str,
    material: Material,
    place: tuple[float, float, float] = (0.0, 0.0, 0.0),
) -> None:
    material.name = name
    mesh.materials = [material]
    scene.add(mesh, name=name, translation=place)


def _add_camera(
    scene: Scene, eye: tuple[float, float, float], target: tuple[float, float, float]
) -> None:
    pose = linalg.look_at(eye, target, (0.0, 1.0, 0.0))
    scene.add(PerspectiveCamera(math.radians(40.0)), name="camera", pose=pose)


#: What the editor offers, the first one without asking.
STARTS = (
    Start("Empty", "a light and a camera", empty, is_seen_through=False),
    Start("Studio", "a ball on a pedestal, three lights", studio),
    Start("Street", "houses, trees and lamps under the sky", street),
    Start("Solar system", "Sun, Earth and Moon, which turn", solar_system),
)
