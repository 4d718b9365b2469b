"""The world, the light and the memory of each physics client.

In: the number of a client. Out: its `Client`, the same one until it disconnects or is reset.
"""

from __future__ import annotations

from threading import Lock
from typing import Any

import numpy as np

from ...base.system import after_fork
from ._light import Light
from ._shading import Painter
from ._world import World


class Client:
    """What is kept of a physics client between pictures.

    Attributes
    ----------
    world : World
    light : Light
    near, far : float
        Of the last camera, for calls without one.
    lock : Lock
        Held while a picture is drawn: threads of a program take turns.
    """

    def __init__(self, bullet: Any, number: int) -> None:
        self.world = World(bullet, number)
        self.painter = Painter()
        self.light = Light()
        self.near, self.far = 0.01, 1000.0
        self.lock = Lock()

    def note_lens(self, projection: np.ndarray) -> None:
        """Note where near and far are of a perspective, (4, 4) float64."""
        with np.errstate(all="ignore"):
            near, far = projection[2, 3] / (projection[2, 2] + np.array([-1.0, 1.0]))
        if 0.0 < near < far < np.inf:
            self.near, self.far = float(near), float(far)

    def usual_camera(self, bullet: Any) -> tuple[np.ndarray, np.ndarray]:
        """Return the projection and view of TinyRenderer without a camera, (4, 4) float64 each."""
        near = self.near
        wide = near * 640 / 480
        projection = bullet.computeProjectionMatrix(-wide, wide, -near, near, near, self.far)
        view = bullet.computeViewMatrixFromYawPitchRoll((0, 0, 0), 1.5, -80, -10, 0, 2)
        return matrix_of(projection), matrix_of(view)


_clients: dict[int, Client] = {}


def _unlock() -> None:
    """Take new locks in a forked process, where nobody would release the old ones."""
    for client in _clients.values():
        client.lock = Lock()


after_fork(_unlock)


def client_of(number: int) -> Client:
    """Return what is kept of a client."""
    import pybullet

    if number not in _clients:
        _clients[number] = Client(pybullet, number)
    return _clients[number]


def forget(number: int) -> None:
    """Forget a client that disconnected: another one gets its number."""
    _clients.pop(number, None)


def matrix_of(numbers: Any) -> np.ndarray:
    """Return a matrix of pybullet, 16 numbers column by column, as (4, 4) float64."""
    held = np.asarray(numbers, np.float32).reshape(4, 4)
    return held.T.astype(np.float64)
