"""The forms of primitives: what does not depend on their sizes, kept for the next one.

In: a function from numbers of segments to a form, the mesh of one size. Out: meshes of other
positions that share all other arrays of the form, which nobody can write to.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import TypeVar

import numpy.typing as npt

from ..geometry.mesh import Mesh

Form = TypeVar("Form")
#: Larger forms are made anew, and so are those of other numbers of segments than the latest ones.
_LARGEST, _MOST = 4096, 8


def keeps_forms(make: Callable[..., Form]) -> Callable[..., Form]:
    """Let a function of numbers of segments return the same form for the same numbers."""
    kept = functools.lru_cache(_MOST)(make)

    @functools.wraps(make)
    def form_of(*segments: int) -> Form:
        return kept(*segments) if math.prod(segments) <= _LARGEST else make(*segments)

    return form_of


def shaped(form: Mesh, positions: npt.ArrayLike) -> Mesh:
    """Return a mesh of a form, with other positions."""
    return Mesh(
        positions,
        form.faces,
        normals=form.normals,
        uvs=form.uvs,
        edge_visible=form.edge_visible,
        position_ids=form.position_ids,
        name=form.name,
    )
