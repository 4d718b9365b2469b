"""Shows things in notebooks as pictures.

In: a scene, a mesh, or what one of them is made of. Out: a PNG, drawn in the room of rendering.
"""

from __future__ import annotations

from typing import Any


class ShownInNotebooks:
    """Base of what notebooks show as a picture."""

    def _repr_png_(self: Any) -> bytes | None:
        """Return a picture for notebooks; see `thumbnail`."""
        from ..stage.thumbnail import thumbnail

        return thumbnail(self)
