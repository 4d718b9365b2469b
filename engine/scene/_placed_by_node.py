"""What lights and cameras have in common: their place is their node's."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .._support.validation import Closed

_PLACES = {"position", "translation", "location", "pose", "rotation", "euler", "eye", "target"}


class PlacedByNode(Closed):
    """Base of lights and cameras, which have no place of their own: a node gives them theirs."""

    if not TYPE_CHECKING:  # to a type checker, __init__ says what there is

        def __new__(cls, *args, **kwargs):
            for name in _PLACES.intersection(kwargs):
                thing = "camera" if cls.__name__.endswith("Camera") else "light"
                how = "pose=engine3d.look_at(eye, target)"
                how = how if thing == "camera" else "translation=(x, y, z)"
                raise TypeError(
                    f"{cls.__name__}() takes no {name!r}: it is placed by its node, "
                    f"scene.add({thing}, {how})"
                )
            return super().__new__(cls)
