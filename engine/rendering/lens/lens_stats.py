"""The statistics of a picture through a lens: the sums of those of its faces."""

from __future__ import annotations

from collections.abc import Sequence

from ..._native.rasterizer import NativeStats

#: What all faces share: these count the scene, or name what drew.
_SHARED = ("materials", "lights", "objects", "instances", "clusters", "triangles", "threads")


class LensStats:
    """The statistics of one picture.

    Parameters
    ----------
    faces : sequence of NativeStats
        Those of the pinhole pictures.
    rays : int
        How many rays were cast into the scene.
    """

    def __init__(self, faces: Sequence[NativeStats], rays: int) -> None:
        self._faces, self._rays = list(faces), rays

    def as_dict(self) -> dict[str, int | float | str]:
        """Return the statistics by name."""
        rows = [face.as_dict() for face in self._faces]
        found: dict[str, int | float | str] = {}
        for name in rows[0]:
            values = [row[name] for row in rows]
            if not isinstance(values[0], (int, float)):  # what drew it: the same for all
                found[name] = values[0]
            elif name in _SHARED:
                found[name] = max(values)
            else:
                found[name] = sum(values)  # type: ignore[arg-type]
        return found | {"lens_faces": len(rows), "lens_rays": self._rays}
