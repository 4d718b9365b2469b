"""What lenses draw otherwise: the options of their faces, and what is not drawn as elsewhere.

In: the options and outputs of a picture. Out: those of the pinhole pictures around the lens, and
warnings that name what a lens cannot show as a pinhole does.
"""

from __future__ import annotations

import functools
from collections.abc import Iterable
from dataclasses import replace

from ...errors import InvalidArgumentError, warn
from ...model.scene.staged_scene import AnyScene
from ..options import MAX_LINE, RenderOptions

#: Outputs that are found by rays; the others are those of the nearest pixel that shows the face.
IDENTITIES = ("object_id", "instance_id", "face_id")
#: Outputs in camera space, which each face has in its own axes.
TURNED = ("normal", "tangent")
#: Outputs without meaning where there is no clip space.
REFUSED = {"ndc_depth": "it has no clip space; depth is the distance from the camera"}
#: Modes that colour depths and directions, which are the lens's and not those of its faces.
OF_VALUES = {"depth": "depth", "normal": "normal"}
#: How far around a face effects that look beside a pixel are drawn, over its focal length.
_BORDER = 0.25


def check_outputs(outputs: Iterable[str]) -> None:
    """Raise an error for outputs that no lens has."""
    for name in outputs:
        if name in REFUSED:
            raise InvalidArgumentError(f"a lens camera has no {name}: {REFUSED[name]}")


def faces_outputs(options: RenderOptions, outputs: tuple[str, ...]) -> tuple[str, ...]:
    """Return what the faces are drawn with, for a picture of the lens with these outputs."""
    wanted = dict.fromkeys(outputs)
    if options.bloom > 0 and options.mode in ("lit", "unlit") and "color" in wanted:
        wanted["radiance"] = None
    if "color" in wanted and options.mode in OF_VALUES:
        wanted[OF_VALUES[options.mode]] = None
    if any(name != "color" for name in outputs) or options.mode in OF_VALUES:
        wanted |= dict.fromkeys((*IDENTITIES, "depth"))
    for name in ("position", "world_position", "range"):
        wanted.pop(name, None)  # found by rays
    return tuple(wanted)


@functools.lru_cache(16)
def faces_options(options: RenderOptions, scale: float) -> RenderOptions:
    """Return the options of the faces: the same object each time.

    Parameters
    ----------
    options : RenderOptions
    scale : float
        Pixels of the faces over those of the lens.
    """
    wide = scale if options.size_unit == "pixels" else 1.0
    sizes = [min(size * wide, MAX_LINE) for size in (options.line_width, options.point_size)]
    return replace(options, bloom=0.0, line_width=sizes[0], point_size=sizes[1])


def border_of(options: RenderOptions) -> float:
    """Return how far around the faces is drawn, over their focal length."""
    return _BORDER if options.mode == "lit" and options.ambient_occlusion else 0.0


def warn_of_scene(scene: AnyScene, options: RenderOptions, refracts: bool) -> None:
    """Name what a picture of several faces does not show as a pinhole does.

    Parameters
    ----------
    scene : Scene or StagedScene
    options : RenderOptions
    refracts : bool
        Whether the faces show what is behind glass bent or blurred.
    """
    told: list[str] = []
    if scene.fog is not None:
        told.append("fog is as thick as along the axes of a cube around the camera")
    if options.wireframe is not None:
        told.append("edges are drawn as wide as at the middle of each side of a cube")
    if options.ambient_occlusion and options.mode == "lit":
        told.append("ambient occlusion may show where sides of a cube meet")
    if refracts:
        told.append("glass that lies across an edge of the cube may show it")
    if told:
        warn("through a lens that sees more than a pinhole, " + ", and ".join(told))
