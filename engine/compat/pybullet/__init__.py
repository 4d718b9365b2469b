"""PyBullet's pictures, drawn by this engine: `getCameraImage`, as TinyRenderer draws, but faster.

``engine3d.compat.pybullet.install()`` is all that a program has to add. docs/pybullet.md tells what
works and what differs. The package pybullet is imported when a picture is drawn.
"""

from .camera_image import getCameraImage
from .noted_calls import install

__all__ = ["getCameraImage", "install"]
