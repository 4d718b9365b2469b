"""A model before and after a change: two pictures by one camera, and figures.

In: two paths, of which one may be missing. Out: what is told of the model, as JSON could hold it.
Whatever fails is told, too, and raises nothing: one model must not end the comparison of all.
"""

from dataclasses import dataclass, field

import numpy as np

import engine3d as e3d
from engine3d import measuring

MOST_COMPARED = 50_000  # triangles, for how far apart the surfaces are: some seconds


@dataclass
class Side:
    """A model as it was, or as it is.

    error: why it cannot be shown; empty where it can. triangles, size, volume: None if unknown.
    """

    scene: e3d.Scene | None = None
    error: str = ""
    pixels: np.ndarray | None = None
    triangles: int | None = None
    size: tuple[float, ...] | None = None
    volume: float | None = None


@dataclass
class Change:
    """What became of a model.

    deviation: how far the surfaces are apart at most; None if unknown.
    """

    name: str
    status: str
    before: Side = field(default_factory=Side)
    after: Side = field(default_factory=Side)
    deviation: float | None = None


def compare(name, before, after, size):
    """Return the `Change` of a model.

    before, after: paths, or None where there is no such file. size: of the pictures.
    """
    change = Change(name, "changed", loaded(before), loaded(after))
    draw([change.before, change.after], size)
    change.status = status_of(change, before, after)
    if change.status == "changed":
        change.deviation = deviation(change.before, change.after)
    return change


def loaded(path):
    """Read one side, with its figures."""
    if path is None:
        return Side()
    try:
        scene = e3d.load(path)
        low, high = scene.bounds
        side = Side(scene, size=tuple((high - low).tolist()), triangles=triangles_of(scene))
        side.volume = measuring.measure(scene).volume if side.triangles else None
        return side
    except Exception as error:
        return Side(error=str(error).removeprefix(f"{path}: ") or type(error).__name__)


def triangles_of(scene):
    meshes = (getattr(node.object, "mesh", node.object) for node in scene.nodes)
    return sum(len(mesh.faces) for mesh in meshes if isinstance(mesh, e3d.Mesh))


def draw(sides, size):
    """Draw those that could be read, by one camera that shows both whole."""
    shown = [side for side in sides if side.scene is not None]
    boxes = [side.scene.bounds for side in shown]
    for side in shown:
        draw_side(side, boxes, size)


def draw_side(side, boxes, size):
    """Draw one side by a camera that shows boxes whole."""
    try:
        side.pixels = e3d.render(side.scene, camera(boxes, size), size=size).color
    except Exception as error:
        side.error = str(error) or type(error).__name__


def camera(boxes, size):
    """Return a camera that shows all boxes whole; None where they hold nothing."""
    if not any(np.any(low < high) for low, high in boxes):
        return None
    low, high = np.min(boxes, axis=(0, 1)), np.max(boxes, axis=(0, 1))
    return e3d.frame_bounds((low, high), aspect=size[0] / size[1])


def status_of(change, before, after):
    if change.after.error:
        return "broken"
    if before is None or after is None:
        return "gone" if after is None else "new"
    if change.before.error:
        return "changed"
    told = [(side.triangles, side.size, side.volume) for side in (change.before, change.after)]
    same = told[0] == told[1] and np.array_equal(change.before.pixels, change.after.pixels)
    return "same" if same else "changed"


def deviation(before, after):
    """Return how far two surfaces are apart at most; None if that is unknown or takes too long."""
    counts = [side.triangles or 0 for side in (before, after)]
    if not min(counts) or max(counts) > MOST_COMPARED:
        return None
    try:
        found = measuring.hausdorff(before.scene, after.scene).distance
    except Exception:  # such as for faces of which none has finite corners
        return None
    return found if np.isfinite(found) else None
