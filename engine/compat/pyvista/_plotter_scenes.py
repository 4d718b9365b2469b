"""A plotter as a scene of engine3d.

In: a renderer of VTK. Out: a `Scene` in the plotter's coordinates, with its lights and its camera.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ...base.linalg import inverse
from ...errors import InvalidArgumentError, warn
from ...model.materials.linear_colors import linear
from ...model.materials.material import Material
from ...model.materials.textures import Texture
from ...model.scene.cameras import Camera
from ...model.scene.scene import Scene
from ._lights import add_lights, lamps_of
from ._material_maps import make_physical
from ._parts import Part
from ._props import content_of
from ._renderer_view import view_of
from ._surroundings import surroundings_of


def scene_of(renderer: Any) -> Scene:
    """Return what stands in space as a scene.

    Raises
    ------
    InvalidArgumentError
        Nothing does.
    """
    width, height = renderer.GetSize()
    view = view_of(renderer, (max(width, 1), max(height, 1)))
    found = [] if view is None else content_of(renderer, view).parts
    parts = [part.with_own_corners() for part in found]
    if view is None or not parts:
        raise InvalidArgumentError("nothing in this plotter stands in space")
    scene = Scene(background=tuple(renderer.GetBackground()), ambient=(0, 0, 0))
    scene.add(Camera(view.projection), pose=inverse(view.view), name="camera")
    for part in parts:
        node = part.added(scene, _material(part))
        node.pose = inverse(view.view)
    around = surroundings_of(renderer, view)
    if around is not None and around.is_upright:
        scene.environment = around.environment
    elif around is not None:
        warn("the scene is without its environment texture, which is turned")
    lights, lamps = len(list(scene.nodes)), lamps_of(renderer, view)
    if not all(lamp.is_plain for lamp in lamps):
        warn("the scene is without the cones and the attenuation of lights")
    add_lights(scene, lamps)
    for light in list(scene.nodes)[lights:]:
        light.pose = np.asarray(inverse(view.view)) @ np.asarray(light.pose)
    return scene


def _material(part: Part) -> Material:
    """Return the material of a part, whose colours are display values."""
    look, material = part.look, part.material()
    color = np.ones(3) if part.has_colors else np.clip(look.color, 0.0, 1.0)
    material.color = (*(float(v) for v in color), look.opacity)
    image = part.paint.image
    if image is not None:
        material.texture = Texture(image.pixels, filter=image.filter, wrap=image.wrap)
    if look.is_physical:
        make_physical(material, part)
        if part.maps is not None:
            material.occlusion_texture = part.maps.material
            material.occlusion_strength = look.occlusion
            if part.maps.emissive is not None:
                material.emissive_texture = part.maps.emissive
                material.emissive = linear(look.emissive)
    elif look.specular:
        material.specular = tuple(
            float(v) for v in np.clip(look.specular * look.specular_color, 0, 1)
        )
        material.shininess = 4.0 * look.power
    return material
