"""Moments: what a frame shows, and where everything is at that time.

In: a frame with identities, and its scene as it was drawn. Out: a `Moment`, which keeps poses, bent
vertices and the camera while the scene moves on. Two of them give optical flow: each pixel's
triangle is posed as it is at both moments, and the pixel's barycentric coordinates are taken of
both. In float64 by R182 to R184, rounded once: the same bits everywhere.
"""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from ..._native.scene_graph import NativeSeen, seen_again, seen_points
from ...base import linalg
from ...base.calls import checks_types
from ...base.thread_count import resolve_threads
from ...base.validation import Closed
from ...errors import MissingOutputError
from ...model.environments.environment import Environment
from ...model.scene.scene import Scene
from ...rendering.frame import Frame, Output, view_of
from .flow import Flow
from .things import as_seen, known_to_both, things_of

#: Pixels that are followed together: larger arrays would be fresh memory each time.
_BLOCK = 1 << 14


class Moment(Closed):
    """What a frame shows, and where everything in its scene was when it was drawn.

    Make one of each frame before the scene moves on. Poses and bent vertices are kept.

    Parameters
    ----------
    frame : Frame
        Holds at least the outputs `Moment.OUTPUTS`. It must not be drawn into again (``out=``).
    scene : Scene
        The frame's, as it was drawn.

    Attributes
    ----------
    OUTPUTS : tuple of str
        object_id, instance_id, face_id, barycentric.
    frame : Frame

    Raises
    ------
    MissingOutputError
        The frame lacks one of these outputs.
    InvalidArgumentError
        The frame was not drawn by a `Renderer`.
    """

    OUTPUTS: ClassVar[tuple[Output, ...]] = "object_id", "instance_id", "face_id", "barycentric"

    @checks_types
    def __init__(self, frame: Frame, scene: Scene) -> None:
        missing = [name for name in self.OUTPUTS if name not in frame.outputs]
        if missing:
            raise MissingOutputError(
                f"this frame has no {', '.join(missing)}: a Moment needs "
                "render(..., outputs=(..., *Moment.OUTPUTS))"
            )
        self._frame, self._view = frame, view_of(frame)
        self._sky = isinstance(scene.background, Environment)
        self._things = things_of(scene)

    @property
    def frame(self) -> Frame:
        return self._frame

    @checks_types
    def flow_to(self, other: Moment) -> Flow:
        """Return where what each pixel shows is in the picture of another moment.

        ``before.flow_to(now)`` is the forward flow of the picture before, and
        ``now.flow_to(before)`` the backward flow of the picture now. The other picture may be
        another camera's, of another size: the other eye's of a stereo pair, for example.

        Parameters
        ----------
        other : Moment
            Of the same scene.

        Returns
        -------
        Flow
        """
        way = _Way(self, other)
        shape = self._frame.height, self._frame.width
        count = shape[0] * shape[1]
        vectors = np.empty((count, 2), np.float32)
        known, visible = np.empty(count, np.bool_), np.empty(count, np.bool_)
        for first in range(0, count, _BLOCK):
            rows = slice(first, min(first + _BLOCK, count))
            vectors[rows], known[rows], visible[rows] = way.of(rows)
        return Flow(vectors.reshape(*shape, 2), known.reshape(shape), visible.reshape(shape))

    def _seen(self, rows: slice) -> NativeSeen:
        """Return what some pixels show."""
        frame = self._frame
        return NativeSeen(
            frame.object_id.reshape(-1)[rows],
            frame.instance_id.reshape(-1)[rows],
            frame.face_id.reshape(-1)[rows],
            frame.barycentric.reshape(-1, 3)[rows],
        )

    def __repr__(self) -> str:
        return f"<Moment {self._frame.width}x{self._frame.height}: {len(self._things)} things>"


class _Way:
    """The way from the pixels of one moment's picture to another's."""

    def __init__(self, here: Moment, there: Moment) -> None:
        self._here, self._there = here, there
        ids, view = known_to_both(here._things, there._things), there._view
        self._begin = as_seen(here._things, ids, here._view.view_from_world)
        self._end = as_seen(there._things, ids, view.view_from_world)
        self._others = as_seen(there._things, there._things, view.view_from_world)
        self._shown = there._seen(slice(None))
        self._is_near, self._threads = view.eye[3] == 1.0, resolve_threads()
        self._has_sky = here._sky and there._sky and here._view.eye[3] == view.eye[3] == 1.0
        world_from_here = linalg.inverse(here._view.view_from_world)
        self._turn = linalg.multiply(view.view_from_world, world_from_here)

    def of(self, rows: slice) -> tuple[NDArray[np.float64], NDArray[np.bool_], NDArray[np.bool_]]:
        """Return vectors, known and visible of some pixels."""
        seen, view = self._here._seen(rows), self._there._view
        sky, directions = self._sky(rows)
        points = np.empty((rows.stop - rows.start, 3))
        seen_points(seen, self._begin, points, self._threads)
        points[sky] = directions
        begin = self._here._view.places(points)
        seen_points(seen, self._end, points, self._threads)
        points[sky] = linalg.transform_directions(self._turn, directions)
        end = view.places(points)
        vectors = end - begin
        known = np.isfinite(vectors[:, 0]) & np.isfinite(vectors[:, 1])
        vectors[~known] = 0.0
        frame, visible = self._there._frame, np.empty(len(points), np.bool_)
        at, marks = _pixels_at(end, known, frame), visible.view(np.uint8)
        seen_again(
            seen,
            self._shown,
            self._others,
            points,
            at,
            frame.width,
            self._is_near,
            marks,
            self._threads,
        )
        visible[sky] = (at[sky] >= 0) & (frame.object_id.reshape(-1)[at[sky]] < 0)
        return vectors, known, visible

    def _sky(self, rows: slice) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
        """Return which of the pixels show an environment, and its directions."""
        if not self._has_sky:
            return np.empty(0, np.intp), np.empty((0, 3))
        frame = self._here._frame
        sky = np.flatnonzero(frame.object_id.reshape(-1)[rows] < 0)
        down, across = np.divmod(sky + rows.start, frame.width)
        centres = np.stack([across + 0.5, down + 0.5], axis=1)
        return sky, self._here._view.directions(centres)


def _pixels_at(
    places: NDArray[np.float64], known: NDArray[np.bool_], frame: Frame
) -> NDArray[np.int32]:
    """Return the pixels of a frame that places (N, 2) lie in, -1 for none."""
    x, y = places.T
    with np.errstate(invalid="ignore"):
        inside = known & (x >= 0.0) & (x < frame.width) & (y >= 0.0) & (y < frame.height)
    at = np.full(len(places), -1, np.int32)
    at[inside] = y[inside].astype(np.int32) * frame.width + x[inside].astype(np.int32)
    return at
