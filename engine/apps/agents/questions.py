"""Answers an agent's questions: what is at a pixel, how large, how far, what is wrong.

In: a session and names. Out: records of JSON types.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ...errors import InvalidArgumentError
from ...measuring import Faults, check, distance, hausdorff, measure
from .pictures import Request
from .session import Session
from .shown_scene import shown_scene
from .things import Part, Thing
from .view_cameras import rounded

#: How many faces and places of a fault are listed.
_LISTED = 20
#: The kinds of faults: how many there are, and a sentence.
_FAULTS: dict[str, tuple[Callable[[Faults], int], str]] = {
    "degenerate": (lambda f: len(f.degenerate), "faces have no area"),
    "duplicate": (lambda f: len(f.duplicate), "faces are there twice"),
    "flipped": (lambda f: len(f.flipped), "faces show another side than their neighbours"),
    "open_edges": (lambda f: len(f.open_edges), "edges have only one face: there are holes"),
    "non_manifold": (lambda f: len(f.non_manifold_edges), "edges have more than two faces"),
    "not_finite": (lambda f: f.not_finite, "faces have coordinates that are not finite"),
}


def pick(session: Session, x: int, y: int, request: Request | None) -> dict[str, Any]:
    """Return what a pixel of the last picture shows, or of one that a request describes.

    Raises
    ------
    InvalidArgumentError
        There is no picture, or no such pixel.
    """
    picture = session.last if request is None else session.studio.draw(session.things, request)
    if picture is None:
        raise InvalidArgumentError("pick: there is no picture yet: call render, or give a view")
    return picture.at(x, y)


def measured(session: Session, objects: Any) -> dict[str, Any]:
    """Return bounds, area, volume and inertia of objects, measured as one body."""
    parts = session.things.find(objects) if objects else session.things.all_parts()
    if not parts:
        raise InvalidArgumentError("measure: there is no object yet: load a file first")
    shown = shown_scene(parts)
    found = measure(shown.viewed.scene)
    bounds = found.bounds + shown.origin
    inertia = found.inertia
    return {
        "bounds": rounded(bounds),
        "size": rounded(bounds[1] - bounds[0]),
        "center": rounded(found.center + shown.origin),
        "area": found.area,
        "volume": found.volume,
        "watertight": found.watertight,
        "components": found.components,
        "inertia": None if inertia is None else rounded(inertia),
        "unit": shown.viewed.unit,
    }


def gap_between(session: Session, a: str, b: str) -> dict[str, Any]:
    """Return how far two objects are apart, and where."""
    both = [session.things.find(a, "a"), session.things.find(b, "b")]
    if {id(part) for _, part in both[0]} & {id(part) for _, part in both[1]}:
        raise InvalidArgumentError(f"distance: {a!r} and {b!r} have a part in common")
    shown = shown_scene([*both[0], *both[1]])
    found = distance(*(shown.nodes_of(parts) for parts in both))
    return {
        "distance": found.distance,
        "points": rounded(np.stack([found.point_a, found.point_b]) + shown.origin),
        "touching": found.touching,
        "inside": found.inside,
        "unit": shown.viewed.unit,
    }


def deviation(a: list[tuple[Thing, Part]], b: list[tuple[Thing, Part]]) -> dict[str, Any] | None:
    """Return the Hausdorff distance of parts; None if one of them has no faces."""
    if not (sum(part.triangles for _, part in a) and sum(part.triangles for _, part in b)):
        return None
    shown = shown_scene([*a, *b])
    found = hausdorff(shown.nodes_of(a), shown.nodes_of(b))
    return {
        "distance": found.distance,
        "at_most": found.at_most,
        "point": rounded(found.point + shown.origin),
        "nearest": rounded(found.nearest + shown.origin),
    }


def checked(session: Session, name: str) -> dict[str, Any]:
    """Return the faults of an object."""
    parts = session.things.find(name, "check") if name else session.things.all_parts()
    shown = shown_scene(parts)
    found = check(shown.viewed.scene)
    told = [line for thing in dict.fromkeys(t for t, _ in parts) for line in thing.warnings]
    textures = [line for line in told if "texture" in line or "image" in line]
    counts = {key: count(found) for key, (count, _) in _FAULTS.items()}
    volume = measure(shown.viewed.scene).volume
    places = np.concatenate([found.open_edges[:_LISTED], found.non_manifold_edges[:_LISTED]])
    return {
        **counts,
        "inside_out": volume is not None and volume < 0.0,
        "missing_textures": textures,
        "faces": np.concatenate([found.degenerate, found.duplicate, found.flipped])[
            :_LISTED
        ].tolist(),
        "edges": [rounded(edge) for edge in places[:_LISTED] + shown.origin],
        "reasons": [*_sentences(counts, volume), *told],
    }


def _sentences(counts: dict[str, int], volume: float | None) -> list[str]:
    said = [f"{counts[key]:,} {said}" for key, (_, said) in _FAULTS.items() if counts[key]]
    if volume is not None and volume < 0.0:
        said.append("all faces look inward")
    return said
