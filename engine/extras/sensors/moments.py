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
from ...base.validation import Closed
from ...errors import MissingOutputError
from ...model.environments.environment import Environment
from ...model.scene.scene import Scene
from ...rendering.frame import Frame, Output, view_of
from .flow import Flow
from .things import as_seen, known_to_both, things_of


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
        ids = known_to_both(self._things, other._things)
        sky, directions = self._sky_to(other)
        # One array after the other: at this size, fresh memory costs more than the arithmetic.
        points = np.empty((self._frame.width * self._frame.height, 3))
        self._put_in_view_of(self, ids, points)
        points[sky] = directions
        vectors = self._view.places(points)
        self._put_in_view_of(other, ids, points)
        turn = linalg.multiply(
            other._view.view_from_world, linalg.inverse(self._view.view_from_world)
        )
        points[sky] = linalg.transform_directions(turn, directions)
        end = other._view.places(points)
        np.subtract(end, vectors, out=vectors)
        known = np.isfinite(vectors[:, 0]) & np.isfinite(vectors[:, 1])
        at = _pixels_at(end, known, other._frame)
        visible = self._shows_again(other, points, at)
        visible[sky] = (at[sky] >= 0) & (other._frame.object_id.reshape(-1)[at[sky]] < 0)
        np.copyto(vectors, 0.0, where=~known[:, np.newaxis])
        shape = self._frame.height, self._frame.width
        return Flow(
            vectors.astype(np.float32).reshape(*shape, 2),
            known.reshape(shape),
            visible.reshape(shape),
        )

    def _seen(self) -> NativeSeen:
        """Return what each pixel shows."""
        frame = self._frame
        return NativeSeen(
            frame.object_id.reshape(-1),
            frame.instance_id.reshape(-1),
            frame.face_id.reshape(-1),
            frame.barycentric.reshape(-1, 3),
        )

    def _put_in_view_of(self, other: Moment, ids: list[int], points: NDArray[np.float64]) -> None:
        """Write where what the pixels show is for another moment's camera, (N, 3); or NaN."""
        things = as_seen(other._things, ids, other._view.view_from_world)
        seen_points(self._seen(), things, points, 0)

    def _sky_to(self, other: Moment) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
        """Return the pixels of an environment behind everything in both, and their directions."""
        in_perspective = self._view.eye[3] == other._view.eye[3] == 1.0
        if not (self._sky and other._sky and in_perspective):
            return np.empty(0, np.intp), np.empty((0, 3))
        sky = np.flatnonzero(self._frame.object_id.reshape(-1) < 0)
        rows, columns = np.divmod(sky, self._frame.width)
        return sky, self._view.directions(np.stack([columns + 0.5, rows + 0.5], axis=1))

    def _shows_again(
        self, other: Moment, points: NDArray[np.float64], at: NDArray[np.int32]
    ) -> NDArray[np.bool_]:
        """Return which of the points the other picture shows at the pixels that they lie in."""
        visible = np.empty(len(points), np.bool_)
        view = other._view
        things = as_seen(other._things, other._things, view.view_from_world)
        is_near = view.eye[3] == 1.0
        width = other._frame.width
        marks = visible.view(np.uint8)
        seen_again(self._seen(), other._seen(), things, points, at, width, is_near, marks, 0)
        return visible

    def __repr__(self) -> str:
        return f"<Moment {self._frame.width}x{self._frame.height}: {len(self._things)} things>"


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
