"""A model before and after a change: two pictures by one camera, and figures.

In: two paths, of which one may be missing. Out: what is told of the model, as JSON could hold it.
Whatever fails is told, too, and raises nothing: one model must not end the comparison of all.
"""

import re
import warnings
from dataclasses import dataclass, field

import numpy as np

import engine3d as e3d
from engine3d import measuring

MOST_COMPARED = 50_000  # triangles, for how far apart the surfaces are: some seconds
ROUNDING = 1e-12  # of the largest coordinate: surfaces that are no farther apart are the same
LFS_POINTER = b"version https://git-lfs.github.com/spec/"


@dataclass
class Side:
    """A model as it was, or as it is.

    error: why it cannot be shown; empty where it can. warnings: what the reader left out.
    triangles, size, volume: None if unknown.
    """

    scene: e3d.Scene | None = None
    error: str = ""
    warnings: list[str] = field(default_factory=list)
    pixels: np.ndarray | None = None
    triangles: int | None = None
    size: tuple[float, ...] | None = None
    volume: float | None = None

    def figures(self):
        return self.triangles, self.size, self.volume


@dataclass
class Change:
    """What became of a model.

    deviation: how far the surfaces are apart at most; None if unknown. reason: of the status, where
    figures do not tell it.
    """

    name: str
    status: str
    before: Side = field(default_factory=Side)
    after: Side = field(default_factory=Side)
    deviation: float | None = None

    @property
    def reason(self):
        before, after = self.before, self.after
        if after.error or before.error:
            return after.error or f"could not be shown before: {before.error}"
        same = self.deviation == 0 and before.figures() == after.figures()
        return "the picture alone" if same else ""


def compare(name, before, after, size):
    """Return the `Change` of a model.

    before, after: paths, or None where there is no such file. size: of the pictures.
    """
    change = Change(name, "changed", loaded(before, name), loaded(after, name))
    draw([change.before, change.after], size)
    change.status = status_of(change, before, after)
    if change.status == "changed":
        change.deviation = deviation(change.before, change.after)
    return change


def loaded(path, name):
    """Read one side. name: the end of its path, as the repository has it."""
    if path is None:
        return Side()
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", e3d.Engine3DWarning)
        try:
            side = read(path)
        except Exception as error:
            side = Side(error=said(error, path, name))
    side.warnings = [said(one.message, path, name) for one in caught]
    return side


def read(path):
    """Return a model with its figures."""
    with open(path, "rb") as file:
        if file.read(len(LFS_POINTER)) == LFS_POINTER:
            return Side(error="a pointer of Git LFS: check out with lfs: true")
    scene = e3d.load(path)
    low, high = scene.bounds
    side = Side(scene, size=tuple((high - low).tolist()), triangles=triangles_of(scene))
    side.volume = measuring.measure(scene).volume if side.triangles else None
    return side


def said(error, path, name):
    """Return what an error says: of other files, where they are in the repository."""
    own = rf"{re.escape(str(path))}(?::(\d+))?: "
    text = re.sub(f"^{own}", lambda found: f"line {found[1]}: " if found[1] else "", str(error))
    return text.replace(str(path).removesuffix(name), "") or type(error).__name__


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
    same = change.before.figures() == change.after.figures() and np.array_equal(
        change.before.pixels, change.after.pixels
    )
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
    if not np.isfinite(found):
        return None
    reach = max(np.abs(side.scene.bounds).max() for side in (before, after))
    return found if found > ROUNDING * reach else 0.0
