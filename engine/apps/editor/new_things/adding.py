"""What can be added to a scene: objects, where they stand, and what they are called.

In: a scene, a view, the title of an object. Out: a node beside what is there, on the ground.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ....base import linalg
from ....model.geometry.mesh import Mesh
from ....model.scene.ambient_lights import HemisphereLight
from ....model.scene.cameras import PerspectiveCamera
from ....model.scene.lights import DIRECT_LIGHTS, AreaLight, DirectionalLight, PointLight, SpotLight
from ....model.scene.nodes import Node
from ....model.scene.orbiting import home_axes, orbit_axes
from ....model.scene.scene import Scene
from ....stage.views.viewpoint import Viewpoint
from .free_names import FreeNames
from .free_places import free_place, places_without_surface
from .primitive_shapes import PRIMITIVES, new_primitive

#: From this distance of the view to that one, new things have their usual size.
_USUAL = 2.0, 60.0
_DOWN = linalg.rotation_x(-math.pi / 2)
#: A rotation, (4, 4), and a place.
Pose = tuple[NDArray[np.float64], NDArray[np.float64]]
#: A directional light shines down at this angle, from the right and from before.
_SLOPE = linalg.multiply(
    linalg.rotation_y(math.radians(35.0)), linalg.rotation_x(math.radians(-50.0))
)
_LEVEL = np.eye(4)
#: A new camera stands so far aside and above, in radians, and nearer by this factor; farther aside
#: where there is one already.
_ASIDE, _RAISED, _NEARER = 0.22, 0.15, 0.6
_SIDES = (1, -1, 2, -2, 3, -3, 4, -4)


class Standing(NamedTuple):
    """How a thing without a surface is put up.

    Attributes
    ----------
    height : float
        Of its node above the ground, in its size.
    turn : (4, 4) float64
        Its rotation, in axes whose Y is up.
    """

    height: float
    turn: NDArray[np.float64]


_STANDING: dict[type, Standing] = {
    DirectionalLight: Standing(1.8, _SLOPE),
    PointLight: Standing(1.4, _LEVEL),
    SpotLight: Standing(1.8, _DOWN),
    AreaLight: Standing(1.4, _DOWN),
    HemisphereLight: Standing(1.8, _LEVEL),
    type(None): Standing(0.0, _LEVEL),
}
_OTHERS: dict[str, Callable[[], Any]] = {
    "Empty": lambda: None,
    **{f"{name.capitalize()} light": light for name, light in DIRECT_LIGHTS.items()},
    "Hemisphere light": HemisphereLight,
    "Camera": PerspectiveCamera,
}
#: The sizes of area lights, those that they have.
AREA_SIZES = ("width", "height", "length", "radius")
#: The titles of all that can be added, by groups.
GROUPS = (
    ("Empty",),
    tuple(PRIMITIVES),
    tuple(title for title in _OTHERS if title.endswith("light")),
    ("Camera",),
)


def add_new(scene: Scene, title: str, view: Viewpoint, parent: Node | None = None) -> Node:
    """Add a new thing to a scene, in view, on the ground beside what is there.

    Parameters
    ----------
    scene : Scene
    title : str
        One of those in `GROUPS`.
    view : Viewpoint
        Where one looks.
    parent : Node, optional
        The node that it is added below; it stands where it would without.

    Returns
    -------
    node : Node
    """
    size = usual_size(view.distance)
    made = _made(scene, title, size)
    turned, place = _stood(scene, made, view, size)
    node = scene.add(
        made,
        name=FreeNames(scene.data.names()).free(title.lower()),
        translation=place,
        rotation=linalg.matrix_to_quaternion(turned),
    )
    if parent is not None:
        node.reparent(parent, keep_world_pose=True)
    return node


def usual_size(distance: float) -> float:
    """Return the size of new things: 1, or a power of ten that a far or near view shows well."""
    least, most = _USUAL
    if least <= distance <= most:
        return 1.0
    return 10.0 ** math.floor(math.log10(distance / 4.0))


def _stood(scene: Scene, made: Any, view: Viewpoint, size: float) -> Pose:
    """Return the rotation, (4, 4), and the place of a new thing."""
    if isinstance(made, PerspectiveCamera):
        return _camera_in_view(scene, view)
    axes, turned = home_axes(view.up).T, np.eye(4)
    turned[:3, :3] = axes
    if isinstance(made, Mesh):
        low, high = (bound.astype(np.float64) for bound in made.bounds)
        place = free_place(scene, view, high - low)
        return turned, place - axes[:, 1] * float(low[1])
    standing = _standing_of(made)
    # As high as its icon, so that it stands beside what it would stand in.
    room = np.array([1.0, standing.height + 1.0, 1.0]) * size
    place = free_place(scene, view, room)
    place = place + axes[:, 1] * (standing.height * size)
    return linalg.multiply(turned, standing.turn), place


def _camera_in_view(scene: Scene, view: Viewpoint) -> Pose:
    """Return the rotation and the place of a camera before one's own that sees nearly the same."""
    taken, distance = places_without_surface(scene), _NEARER * view.distance
    turned = np.eye(4)
    for side in _SIDES:
        azimuth = view.azimuth - _ASIDE * side
        turned[:3, :3] = orbit_axes(view.up, azimuth, max(view.elevation, _RAISED))
        place = view.target + turned[:3, 2] * distance
        if not (np.abs(taken - place) < _ASIDE / 4.0 * distance).all(axis=1).any():
            break
    return turned, place


def _made(scene: Scene, title: str, size: float) -> Any:
    if title in PRIMITIVES:
        return new_primitive(scene, title, size)
    made = _OTHERS[title]()
    if isinstance(made, PointLight | SpotLight):
        made.intensity *= (_standing_of(made).height * size) ** 2
    for name in AREA_SIZES:
        if isinstance(made, AreaLight) and hasattr(made, name):
            setattr(made, name, getattr(made, name) * size)
    if isinstance(made, AreaLight):
        made.intensity *= 4.0
    return made


def _standing_of(made: Any) -> Standing:
    return next(standing for kind, standing in _STANDING.items() if isinstance(made, kind))
