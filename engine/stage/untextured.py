"""Materials without their textures, for a while."""

from __future__ import annotations

from ..materials.material import Material, textures_of
from ..scene.scene import Scene
from .visibility import DRAWABLE, mesh_of


class Textures:
    """The textures of a scene's materials, which can be taken off and put on again.

    Parameters
    ----------
    scene : Scene
    """

    def __init__(self, scene: Scene):
        self._scene = scene
        self._taken: list[tuple[Material, dict]] = []

    def take_off(self) -> None:
        """Leave the materials without textures."""
        things = [node.object for node in self._scene.nodes if isinstance(node.object, DRAWABLE)]
        materials = {id(m): m for thing in things for m in mesh_of(thing).materials}
        for material in materials.values():
            textures = {slot: getattr(material, slot) for slot in textures_of(material)}
            if textures:
                self._taken.append((material, textures))
                for slot in textures:
                    setattr(material, slot, None)

    def put_on(self) -> None:
        """Give the materials their textures back."""
        while self._taken:
            material, textures = self._taken.pop()
            for slot, texture in textures.items():
                setattr(material, slot, texture)
