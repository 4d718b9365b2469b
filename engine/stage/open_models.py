"""Opens several model files as one `ViewedScene`.

In: paths. Out: a scene with all models, placed as in their files or side by side.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any

import numpy as np

from ..base import linalg
from ..base.box_corners import box_corners
from ..choices import ColorLike
from ..errors import warn
from ..io.reading.documents import Document
from ..io.reading.sources import File
from ..model.geometry.mesh import Mesh
from ..model.materials.colors import linear_color
from ..model.materials.linear_colors import LinearColor
from ..model.scene.instances import InstancedMesh
from ..model.scene.lights import LIGHTS
from ..model.scene.orbiting import home_axes
from ..model.scene.scene import Scene
from ..model.scene.shown import placing_pose, shown_object
from .near_origin import moved_near
from .open_model import color_by, read_model
from .overlays.numbers import Numbers
from .viewed_scene import ViewedScene
from .views.viewpoint import UP_DIRECTIONS

#: Gap between models side by side, as a fraction of the widest.
GAP = 0.15
#: Models whose sizes differ by more than this factor can hardly be seen together.
ALIKE = 50.0
_SHOWN = (Mesh, InstancedMesh, *LIGHTS)


def open_models(
    paths: Sequence[File],
    *,
    side_by_side: bool = False,
    up: str | None = None,
    animation: Callable[[ViewedScene], object] | None = None,
    **options: Any,
) -> ViewedScene:
    """Load several files for viewing together.

    Each is read once. All meshes, which the scene needs anyway, and the files' other data are held
    until the last file is read.

    Parameters
    ----------
    paths : sequence of path-like or binary file object
        Each is opened as by `open_model`.
    side_by_side : bool
        Place the models in a row, in the given order, each upright and unscaled, on a common
        ground. Otherwise each keeps its file's position.
    up : str, optional
        A key of `UP_DIRECTIONS`: the up direction of all models, instead of their formats' usual
        ones.
    animation : callable, optional
        As in `open_model`, for each model.
    **options
        Options of `read_model`, for each model.

    Returns
    -------
    ViewedScene

    Raises
    ------
    FileFormatError, FileAccessError
        One of the files cannot be read.
    """
    opened = [read_model(path, **options) for path in paths]
    if len(opened) > 1:
        _share_range(opened, options.get("numbers"))
    viewed_scenes = [viewed for viewed, _ in opened]
    if animation is not None:
        for viewed in viewed_scenes:
            animation(viewed)
    if len(viewed_scenes) == 1:
        return moved_near(viewed_scenes[0])
    for viewed in viewed_scenes:
        viewed.up = up or viewed.up
    first = viewed_scenes[0]
    ambient = brightest([viewed.scene.ambient for viewed in viewed_scenes])
    scene = Scene(first.scene.background, ambient)
    poses = _row(viewed_scenes) if side_by_side else _own_places(viewed_scenes)
    for viewed, pose in zip(viewed_scenes, poses, strict=True):
        _add(scene, viewed, pose)
    viewed = ViewedScene(
        scene,
        ", ".join(viewed.title for viewed in viewed_scenes),
        up=first.up,
        themed=True,
        appearance={**first.appearance, "cull": "auto"},
        details=[line for one in viewed_scenes for line in (one.title, *one.details)],
        warnings=[f"{one.title}: {line}" for one in viewed_scenes for line in one.warnings],
        unit=first.unit if all(one.unit == first.unit for one in viewed_scenes) else "",
        bar=first.bar,
    )
    return moved_near(viewed)


def _share_range(opened: list[tuple[ViewedScene, Document]], numbers: Numbers | None) -> None:
    """Give all models one colour range, which is known only after all are read."""
    ranges = {viewed.bar[1:3] for viewed, _ in opened if viewed.bar is not None}
    if numbers is None or len(ranges) < 2:
        return
    lows, highs = zip(*ranges, strict=True)
    shared = numbers.within(min(lows), max(highs))
    for viewed, document in opened:
        color_by(viewed, document, shared)


def brightest(colors: Iterable[ColorLike]) -> LinearColor:
    """Return the largest of each channel among colours."""
    return LinearColor(np.max([linear_color(color) for color in colors], axis=0).tolist())


def _add(scene: Scene, viewed: ViewedScene, pose: np.ndarray) -> None:
    """Add another scene's nodes below a node with its name."""
    group = scene.add(name=viewed.title, pose=pose)
    viewed.scene.data.update()
    for node in viewed.scene.nodes:
        if isinstance(node.object, _SHOWN) and node.shown:
            thing, pose = shown_object(node), placing_pose(node)
            scene.add(thing, name=node.name, pose=pose, parent=group)


def _own_places(viewed_scenes: list[ViewedScene]) -> list[np.ndarray]:
    first = viewed_scenes[0]
    for viewed in viewed_scenes[1:]:
        if viewed.up != first.up:
            warn(
                f"{viewed.title} counts {viewed.up} as up, {first.title} {first.up}: both keep "
                "their coordinates (--side-by-side stands them upright)"
            )
    return [np.eye(4)] * len(viewed_scenes)


def _row(viewed_scenes: list[ViewedScene]) -> list[np.ndarray]:
    """Return the poses that place the models in a row; the first one's up direction is up."""
    right, up, back = home_axes(UP_DIRECTIONS[viewed_scenes[0].up])
    poses, boxes = [], []
    for viewed in viewed_scenes:
        turn = np.eye(4)
        own = home_axes(UP_DIRECTIONS[viewed.up])
        pairs = zip((right, up, back), own, strict=True)
        turn[:3, :3] = sum(to[:, np.newaxis] * axis for to, axis in pairs)
        poses.append(turn)
        boxes.append(_box(viewed, turn, np.stack([right, up, back])))
    widths = [float(high[0] - low[0]) for low, high in boxes]
    _compare_sizes(viewed_scenes, boxes)
    gap, place = GAP * max(widths), 0.0
    for pose, (low, high), width in zip(poses, boxes, widths, strict=True):
        shift = right * (place - low[0]) - up * low[1] - back * ((low[2] + high[2]) / 2)
        pose[:3, 3] = shift
        place += width + gap
    return poses


def _box(viewed: ViewedScene, turn: np.ndarray, axes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the extent of a rotated model along right, up and back: low and high."""
    points = linalg.transform_points(turn, box_corners(viewed.scene.bounds))
    along = np.stack([linalg.dot(points, axis) for axis in axes], axis=1)
    return along.min(axis=0), along.max(axis=0)


def _compare_sizes(
    viewed_scenes: list[ViewedScene], boxes: list[tuple[np.ndarray, np.ndarray]]
) -> None:
    """Warn if models differ so much in size that one of them is hardly visible."""
    sizes = [float((high - low).max()) for low, high in boxes]
    small, large = sizes.index(min(sizes)), sizes.index(max(sizes))
    if sizes[large] > ALIKE * sizes[small]:
        warn(
            f"{viewed_scenes[large].title} is more than {ALIKE:g} times as large as "
            f"{viewed_scenes[small].title}: side by side, that one hardly shows"
        )
