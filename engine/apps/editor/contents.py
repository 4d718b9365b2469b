"""Takes and restores the contents of a mesh, material, texture, light or camera.

In: objects. Out: their attributes, with copied lists and dicts; arrays are read-only and not
copied. Derived attributes are left out.
"""

from __future__ import annotations

from typing import Any

from ...base.dirty_tracking import renew
from ...base.held_values import kept, same
from ...base.validation import Closed
from ...model.geometry.mesh import Mesh, own_containers

_DERIVED = {"version", "_derived", "_box_of", "_tree_of"}


def contents(thing: Closed) -> dict[str, Any]:
    """Return the contents of an object."""
    return {key: kept(value) for key, value in vars(thing).items() if key not in _DERIVED}


def put_contents(thing: Closed, held: dict[str, Any]) -> None:
    """Restore the contents that `contents` returned, if they differ."""
    if same(contents(thing), held):
        return
    thing.__dict__.update({key: kept(value) for key, value in held.items()})
    if isinstance(thing, Mesh):
        own_containers(thing)
    vars(thing).get("_derived", {}).clear()
    renew(thing)
