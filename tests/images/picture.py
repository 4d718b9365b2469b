"""A named picture: a scene, how to look at it, and how to draw it on any backend.

`picture` registers a function that makes one; its name is the picture's. Everything is made from
numbers here, so that a picture changes only when the engine draws it otherwise.
"""

import hashlib
from dataclasses import dataclass, field

import numpy as np
from plain_picture import Renderer

import engine3d as e3d
from engine3d.rendering.frame import OUTPUTS

SCENES = {}
_MAPS = ("metallic_roughness", "emissive", "tangent")
SIZE = (150, 106)  # six tiles, the last column and row of which are not whole


@dataclass
class Picture:
    """What `Renderer` and `Renderer.render` need besides the backend and the threads."""

    scene: e3d.Scene
    camera: object = None
    size: tuple[int, int] = SIZE
    color_space: str = "srgb"
    samples: int = 1
    antialiasing: str = "ssaa"
    options: dict = field(default_factory=dict)

    def renderer(self, backend, threads=1):
        return Renderer(
            self.size,
            backend=backend,
            threads=threads,
            color_space=self.color_space,
            samples=self.samples,
            antialiasing=self.antialiasing,
        )

    def draw(self, backend, threads=1, outputs=tuple(OUTPUTS)):
        """A frame with the outputs asked for: all, if nothing is said."""
        with self.renderer(backend, threads) as renderer:
            return renderer.render(self.scene, self.camera, outputs=outputs, **self.options)


def picture(function):
    """Register a function that returns a Picture."""
    assert function.__name__ not in SCENES, function.__name__
    SCENES[function.__name__] = function
    return function


def variant(name, function, *arguments, **options):
    """Register a picture made by a function with arguments."""
    assert name not in SCENES, name
    SCENES[name] = lambda: function(*arguments, **options)


def digest(arrays):
    """A short hash of the bytes of some arrays."""
    summary = hashlib.sha256()
    for array in arrays:
        summary.update(np.ascontiguousarray(array).tobytes())
    return summary.hexdigest()[:16]


def digests(frame):
    """What the golden file keeps of a frame: a hash of its colours, one of all else; where there
    are physically based materials, another of what these add.
    """
    apart = ("color", "radiance", *_MAPS)  # test_tone.py makes the colour of the radiance
    others = [getattr(frame, name) for name in frame.outputs if name not in apart]
    kept = {"color": digest([frame.color]), "others": digest(others)}
    if (frame.metallic_roughness % 1).any():
        kept["maps"] = digest([getattr(frame, name) for name in _MAPS])
    return kept
