"""The selection: its name in a corner, and its outline in the picture.

In: a `RayHit`, and frames with object and instance IDs. Out: lines of text; the same pixels, with
an outline around the visible part of the selected object.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...base.language import translated
from ...model.geometry.mesh import Mesh
from ...model.scene.instances import InstancedMesh
from ...model.spatial.rays import RayHit
from ...rendering.frame import Frame, Output

#: The outputs that a frame needs for clicks, and for an outline.
CLICK_OUTPUTS: tuple[Output, ...] = ("color", "object_id", "instance_id", "face_id")
OUTLINE_OUTPUTS: tuple[Output, ...] = ("color", "object_id", "instance_id")
OUTLINE = (255, 160, 40, 255)
WIDTH = 2


def selection_lines(hit: RayHit, origin: Sequence[float] = (0.0, 0.0, 0.0)) -> list[str]:
    """Return the description of the clicked object.

    Parameters
    ----------
    hit : RayHit
    origin : (3,) sequence of float
        The scene's origin in the file's coordinates, which are shown.
    """
    thing = hit.node.object
    lines = [hit.node.name or translated("object {number}", number=hit.node.id)]
    if isinstance(thing, InstancedMesh):
        count = len(thing.poses)
        lines.append(
            translated("instance {number:,} of {count:,}", number=hit.instance_id, count=count)
        )
    mesh = thing.mesh if isinstance(thing, InstancedMesh) else thing
    if not isinstance(mesh, Mesh) or hit.face_id < 0:
        return lines
    count = len(mesh.faces)
    lines.append(translated("face {number:,} of {count:,}", number=hit.face_id, count=count))
    if mesh.materials:
        number = 0 if mesh.material_ids is None else int(mesh.material_ids[hit.face_id])
        name = mesh.materials[number].name or number
        lines.append(translated("material {name}", name=name))
    x, y, z = (value + moved for value, moved in zip(hit.position, origin, strict=True))
    place = translated(
        "at {x:.10g}, {y:.10g}, {z:.10g}" if any(origin) else "at {x:.4g}, {y:.4g}, {z:.4g}",
        x=x,
        y=y,
        z=z,
    )
    return [*lines, place]


def draw_outline(frame: Frame, hit: RayHit, width: int = WIDTH) -> None:
    """Draw an outline around the visible part of the selected object or instance."""
    inside = frame.object_id == hit.node.id
    if isinstance(hit.node.object, InstancedMesh):
        inside &= frame.instance_id == hit.instance_id
    outline_pixels(frame, inside, width)


def outline_pixels(frame: Frame, inside: np.ndarray, width: int = WIDTH) -> None:
    """Draw an outline around pixels of a frame, (H, W) of bool."""
    part = _part_around(inside, width)
    if part is not None:
        inside = inside[part]
        frame.color[part][_grown(inside, width) & ~inside] = OUTLINE


def closed(inside: np.ndarray, gaps: np.ndarray, width: int = WIDTH) -> np.ndarray:
    """Return pixels, (H, W) of bool, with those gaps that have them on opposite sides.

    So lines that are drawn over an object, such as a grid's, do not part its outline.
    """
    part = _part_around(inside, width)
    if part is None:
        return inside
    filled = inside.copy()
    for _ in range(2):  # the second time where lines cross
        filled[part] |= gaps[part] & _between(filled[part], width)
    return filled


def _part_around(inside: np.ndarray, width: int) -> tuple[slice, slice] | None:
    """Return the rows and columns that hold all set pixels, and ``width`` more; None if none is."""
    rows, columns = (np.flatnonzero(inside.any(axis=axis)) for axis in (1, 0))
    if not rows.size:
        return None
    top, bottom, left, right = (int(places[k]) for places in (rows, columns) for k in (0, -1))
    down = slice(max(0, top - width), bottom + width + 1)
    return down, slice(max(0, left - width), right + width + 1)


def _between(inside: np.ndarray, width: int) -> np.ndarray:
    """Return the pixels that have set ones within ``width`` rows or columns on both sides."""
    between = np.zeros_like(inside)
    for axis in (0, 1):
        before, after = np.zeros_like(inside), np.zeros_like(inside)
        for step in range(1, width + 1):
            near, far = [slice(None)] * 2, [slice(None)] * 2
            near[axis], far[axis] = slice(step, None), slice(None, -step)
            before[tuple(near)] |= inside[tuple(far)]
            after[tuple(far)] |= inside[tuple(near)]
        between |= before & after
    return between


def _grown(inside: np.ndarray, width: int) -> np.ndarray:
    """Return the pixels within ``width`` rows and columns of a set pixel."""
    for axis in (0, 1):
        grown = inside.copy()
        for step in range(1, width + 1):
            near, far = [slice(None)] * 2, [slice(None)] * 2
            near[axis], far[axis] = slice(step, None), slice(None, -step)
            grown[tuple(near)] |= inside[tuple(far)]
            grown[tuple(far)] |= inside[tuple(near)]
        inside = grown
    return inside
