"""Pointers to properties that clips animate besides poses, in a written glTF file.

In: the clips of a `TreeRecord`, and the JSON of all else. Out: the targets of their channels; the
JSON gets explicit values for all pointed properties, even default ones.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ...scenes.document_trees import ClipRecord, PropertyRecord, TreeRecord
from .gltf_pointers import POINTER, pointer_of
from .written_materials import GltfMaterialList

# Keys without a default: if missing, they cannot be animated.
_WITHOUT_DEFAULT = ("zfar", "range")


class GltfPointers:
    """The pointers of a file's clips.

    Parameters
    ----------
    tree : TreeRecord
    materials : GltfMaterialList

    Attributes
    ----------
    extensions : set of str
        The extensions that the pointers go through.
    """

    def __init__(self, tree: TreeRecord, materials: GltfMaterialList) -> None:
        self._tree, self._materials = tree, materials
        self._pointers: dict[str, None] = {}
        self._told: list[str] = []
        self.extensions: set[str] = set()

    def targets(self, clip: ClipRecord) -> Iterator[tuple[PropertyRecord, dict[str, Any]]]:
        """Yield each animated property and its channel's target; each pointer once."""
        seen = set()
        for held in clip.properties:
            pointer = self._pointer(held)
            if pointer is None or self._is_lacking(held):
                what = f"{held.path} of a {held.kind}"
                self._told.append(f"gltf files do not hold how {what} changes")
            elif pointer not in seen:
                seen.add(pointer)
                self._pointers[pointer] = None
                keys = pointer.split("/")
                self.extensions.update(
                    after for key, after in zip(keys, keys[1:], strict=False) if key == "extensions"
                )
                yield held, {"path": "pointer", "extensions": {POINTER: {"pointer": pointer}}}

    def _pointer(self, held: PropertyRecord) -> str | None:
        number: int | None = held.number
        lens = ""
        if held.kind == "material":
            number = self._materials.number(self._tree.materials[held.number])
        elif held.kind == "camera":
            lens = self._tree.cameras[held.number].kind
        return None if number is None else pointer_of(held.kind, number, held.path, lens)

    def _is_lacking(self, held: PropertyRecord) -> bool:
        """Return whether the file omits an animated property, because it is infinite at first."""
        things = {"camera": self._tree.cameras, "light": self._tree.lights}.get(held.kind)
        if things is None or held.path not in _WITHOUT_DEFAULT:
            return False
        return getattr(things[held.number], held.path) == float("inf")

    def define(self, json: dict[str, Any]) -> list[str]:
        """Add the objects that pointers go through to the JSON; return warnings."""
        for pointer in self._pointers:
            place: Any = json
            for key in pointer.split("/")[1:-1]:
                place = place[int(key)] if isinstance(place, list) else place.setdefault(key, {})
        return self._told
