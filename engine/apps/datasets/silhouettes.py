"""Amodal masks: the pixels of a thing without occlusion, inside and around the picture.

In: a thing, and its picture. Out: its mask as if nothing were in front of it, at the same samples,
and the pixel count of its silhouette, on a canvas three times the size.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...errors import InvalidArgumentError
from ...model.scene.cameras import Camera
from ...model.scene.scene import Scene
from ...model.scene.staged_scene import StagedScene
from ...rendering.options import RenderOptions
from .samples import Sample, Thing, box_of


class Silhouette(NamedTuple):
    """The amodal mask of a thing: its pixels if nothing else were there.

    Attributes
    ----------
    mask : (H, W) bool
        Within the picture.
    count : int
        Pixels, those around the picture included.
    box : (x, y, width, height)
        Around them; x and y may be negative.
    """

    mask: NDArray[np.bool_]
    count: int
    box: tuple[int, int, int, int]


def silhouette_of(thing: Thing, sample: Sample) -> Silhouette:
    """Return the silhouette of a thing, drawn alone.

    Raises
    ------
    InvalidArgumentError
        It is bent by a skin or by morph targets, and so has no pose.
    """
    alone = _scene_of(thing)
    options = replace(sample.options, outputs=("object_id",), wireframe=None)
    camera = sample.camera, sample.pose
    mask = sample.renderer.render(alone, camera, options=options).object_id >= 0
    if mask.any() and not _reaches_the_edge(mask):
        return Silhouette(mask, int(mask.sum()), box_of(mask))
    height, width = mask.shape
    around = _around(alone, sample, options)
    around[height : 2 * height, width : 2 * width] = mask
    x, y, wide, high = box_of(around)
    count = int(around.sum())
    return Silhouette(mask, count, (x - width, y - height, wide, high) if count else (0, 0, 0, 0))


def _scene_of(thing: Thing) -> StagedScene:
    """Return the scene of a thing; being staged, it wears no look."""
    alone = Scene()
    for part in thing.parts:
        if part.skin is not None or part.morph_weights is not None:
            raise InvalidArgumentError(
                f"{part.name!r} is bent by a skin or morph targets: BOP has rigid objects"
            )
        alone.add(part.object, pose=part.world_pose)
    return StagedScene(alone)


def _reaches_the_edge(mask: NDArray[np.bool_]) -> bool:
    return bool(mask[[0, -1]].any() or mask[:, [0, -1]].any())


def _around(alone: StagedScene, sample: Sample, options: RenderOptions) -> NDArray[np.bool_]:
    """Return the silhouette on a canvas of three times the picture's size, centred."""
    renderer = sample.renderer
    width, height = size = renderer.size
    projection = np.array(sample.camera.projection(size))
    projection[:2] /= 3.0
    renderer.resize((3 * width, 3 * height))
    try:
        frame = renderer.render(alone, (Camera(projection), sample.pose), options=options)
    finally:
        renderer.resize(size)
    return frame.object_id >= 0
