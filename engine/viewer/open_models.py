"""Several model files, opened as one `Subject`.

In: paths. Out: a subject with all of the models, where their files place them or side by side.
"""

from __future__ import annotations

import warnings
from collections.abc import Sequence

import numpy as np

from .. import linalg
from ..errors import Engine3DWarning
from ..geometry.mesh import Mesh
from ..scene.instances import InstancedMesh
from ..scene.lights import DirectionalLight, PointLight
from ..scene.scene import Scene
from .open_model import open_model
from .viewed_scene import Subject
from .viewpoint import UP_DIRECTIONS, home_axes

#: Room between models that stand side by side, as a share of the widest.
GAP = 0.15
#: Models that differ more than this in size can hardly be seen together.
ALIKE = 50.0
_SHOWN = (Mesh, InstancedMesh, DirectionalLight, PointLight)


def open_models(
    paths: Sequence, *, side_by_side: bool = False, up: str | None = None, **options
) -> Subject:
    """Load files to look at together.

    Parameters
    ----------
    paths : sequence of path-like or binary file object
        One is opened as `open_model` opens it.
    side_by_side : bool
        Stand the models in a row, in the order given, upright, all on one ground and in their own
        sizes. Otherwise each is where its file places it.
    up : str, optional
        A key of `UP_DIRECTIONS`: what is up in all of them, whatever is usual for their formats.
    **options
        Those of `open_model`, for each of them.

    Returns
    -------
    Subject

    Raises
    ------
    FileFormatError, FileAccessError
        One of the files cannot be read.
    """
    subjects = [open_model(path, **options) for path in paths]
    if len(subjects) == 1:
        return subjects[0]
    for subject in subjects:
        subject.up = up or subject.up
    first = subjects[0]
    scene = Scene(first.scene.background, _brightest(subjects))
    poses = _row(subjects) if side_by_side else _own_places(subjects)
    for subject, pose in zip(subjects, poses, strict=True):
        _add(scene, subject, pose)
    return Subject(
        scene,
        ", ".join(subject.title for subject in subjects),
        up=first.up,
        details=[line for one in subjects for line in (one.title, *one.details)],
        warnings=[f"{one.title}: {line}" for one in subjects for line in one.warnings],
    )


def _brightest(subjects: list[Subject]) -> tuple[float, ...]:
    """Return the ambient light that is enough for each of the models."""
    return tuple(np.max([subject.scene.ambient for subject in subjects], axis=0).tolist())


def _add(scene: Scene, subject: Subject, pose: np.ndarray) -> None:
    """Add what a subject's scene shows, as children of a node that bears its name."""
    group = scene.add(name=subject.title, pose=pose)
    for node in subject.scene.nodes:
        if isinstance(node.object, _SHOWN) and node.shown:
            scene.add(node.object, name=node.name, pose=node.world_pose, parent=group)


def _own_places(subjects: list[Subject]) -> list[np.ndarray]:
    first = subjects[0]
    for subject in subjects[1:]:
        if subject.up != first.up:
            _warn(
                f"{subject.title} counts {subject.up} as up, {first.title} {first.up}: both keep "
                "their coordinates (--side-by-side stands them upright)"
            )
    return [np.eye(4)] * len(subjects)


def _row(subjects: list[Subject]) -> list[np.ndarray]:
    """Return the poses that stand the models in a row; the first one's up is up."""
    right, up, back = home_axes(UP_DIRECTIONS[subjects[0].up])
    poses, boxes = [], []
    for subject in subjects:
        turn = np.eye(4)
        own = home_axes(UP_DIRECTIONS[subject.up])
        pairs = zip((right, up, back), own, strict=True)
        turn[:3, :3] = sum(to[:, np.newaxis] * axis for to, axis in pairs)
        poses.append(turn)
        boxes.append(_box(subject, turn, np.stack([right, up, back])))
    widths = [float(high[0] - low[0]) for low, high in boxes]
    _compare_sizes(subjects, boxes)
    gap, place = GAP * max(widths), 0.0
    for pose, (low, high), width in zip(poses, boxes, widths, strict=True):
        shift = right * (place - low[0]) - up * low[1] - back * ((low[2] + high[2]) / 2)
        pose[:3, 3] = shift
        place += width + gap
    return poses


def _box(subject: Subject, turn: np.ndarray, axes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return how far a turned model reaches along right, up and back: low and high."""
    low, high = subject.scene.bounds
    corners = np.array([[(low, high)[k >> axis & 1][axis] for axis in range(3)] for k in range(8)])
    points = linalg.transform_points(turn, corners)
    along = np.stack([linalg.dot(points, axis) for axis in axes], axis=1)
    return along.min(axis=0), along.max(axis=0)


def _compare_sizes(subjects: list[Subject], boxes) -> None:
    """Warn of models so different in size that one of them hardly shows."""
    sizes = [float((high - low).max()) for low, high in boxes]
    small, large = sizes.index(min(sizes)), sizes.index(max(sizes))
    if sizes[large] > ALIKE * sizes[small]:
        _warn(
            f"{subjects[large].title} is more than {ALIKE:g} times as large as "
            f"{subjects[small].title}: side by side, that one hardly shows"
        )


def _warn(message: str) -> None:
    warnings.warn(message, Engine3DWarning, stacklevel=4)
