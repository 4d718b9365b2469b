"""Takes and restores the contents of a mesh, material, texture, light or camera.

In: things. Out: their attributes, with lists and dicts of their own; arrays are not copied, since
nobody can write to them. What follows from the rest is left out.
"""

from __future__ import annotations

from typing import Any

from ...base.dirty_tracking import renew
from ...base.held_values import kept, same
from ...base.validation import Closed
from ...model.geometry.mesh import Mesh, own_containers

_DERIVED = {"version", "_derived", "_box_of", "_tree_of"}


def contents(thing: Closed) -> dict[str, Any]:
    """Return what a thing holds."""
    return {key: kept(value) for key, value in vars(thing).items() if key not in _DERIVED}


def put_contents(thing: Closed, held: dict[str, Any]) -> None:
    """Let a thing hold what `contents` returned, if it does not."""
    if same(contents(thing), held):
        return
    thing.__dict__.update({key: kept(value) for key, value in held.items()})
    if isinstance(thing, Mesh):
        own_containers(thing)
    vars(thing).get("_derived", {}).clear()
    renew(thing)
