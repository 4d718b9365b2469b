"""The layers of clear surfaces, each lit as a solid one: for light that the core does not know.

In: clear parts. Out: `Fragments`, what each layer of them shows at each pixel. A part is cut into
sheets until no sheet shows two layers at a pixel; each sheet is drawn alone.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...errors import warn
from ...rendering.frame import Frame
from ._parts import Part

_MOST_SHEETS = 32  # of a part: each is a picture of its own


class Fragments(NamedTuple):
    """What layers show, N of them.

    Attributes
    ----------
    pixels : (N,) intp
        Row times width plus column.
    depths, alphas : (N,) float32
    colors : (N, 3) float32
        0 to 1, not times the alpha.
    """

    pixels: NDArray[np.intp]
    depths: NDArray[np.float32]
    alphas: NDArray[np.float32]
    colors: NDArray[np.float32]


def fragments_of(
    parts: list[Part],
    is_parallel: bool,
    most_layers: Callable[[Part], int],
    alphas: Callable[[Part], NDArray[np.float32]],
    shaded: Callable[[Part], Frame],
) -> Fragments:
    """Return what parts show.

    Parameters
    ----------
    most_layers : callable
        Tells how many layers of a part show at the pixel where most do.
    alphas : callable
        Tells the alpha of a part with one layer at each pixel, (H, W); 0 where it is hidden.
    shaded : callable
        Draws a solid part.
    """
    found = []
    for part in parts:
        whole = part.with_own_corners().standing_apart()
        for sheet in _sheets(whole, is_parallel, most_layers, shaded):
            alpha = alphas(sheet).reshape(-1)
            rows = np.flatnonzero(alpha > 0.0)
            if not len(rows):
                continue
            frame = shaded(sheet.opaque())
            colors = frame.color.reshape(-1, 4)[rows, :3].astype(np.float32) / np.float32(255.0)
            found.append(Fragments(rows, frame.depth.reshape(-1)[rows], alpha[rows], colors))
    if not found:
        none = np.zeros(0, np.float32)
        return Fragments(np.zeros(0, np.intp), none, none, np.zeros((0, 3), np.float32))
    return Fragments(*map(np.concatenate, zip(*found, strict=True)))


def _sheets(
    part: Part,
    is_parallel: bool,
    most_layers: Callable[[Part], int],
    shaded: Callable[[Part], Frame],
) -> Iterator[Part]:
    """Yield sheets of a part with one layer each."""
    waiting, count = [part], 0
    while waiting:
        sheet = waiting.pop()
        if len(sheet.faces) <= 1 or most_layers(sheet) <= 1:
            yield sheet
            count += 1
            continue
        if count + len(waiting) >= _MOST_SHEETS:
            warn("of clear faces in very many layers, engine3d draws only the nearest ones")
            yield from (sheet, *waiting)
            return
        waiting += reversed(_cut(sheet, is_parallel, shaded))


def _cut(part: Part, is_parallel: bool, shaded: Callable[[Part], Frame]) -> list[Part]:
    """Return two halves of a part, the nearer one first, that have fewer layers."""
    towards, away = (part.facing(front, is_parallel) for front in (True, False))
    if len(towards.faces) and len(away.faces):
        return [towards, away]
    frame = shaded(part.opaque())
    shows = np.zeros(len(part.faces), bool)
    shows[frame.face_id[frame.face_id >= 0]] = True
    if shows.all() or not shows.any():
        distance = -part.places[part.faces].sum(1)[:, 2]
        shows[:] = False
        shows[np.argsort(distance, kind="stable")[: len(shows) // 2]] = True
    return [part.of_faces(shows), part.of_faces(~shows)]


def add_fragments(
    found: Fragments, color: NDArray[np.float32], weight: NDArray[np.float32], factor: float
) -> None:
    """Add fragments to sums of colours, (H, W, 3), and of alphas, (H, W, 1)."""
    share = (found.alphas * np.float32(factor))[:, None]
    np.add.at(color.reshape(-1, 3), found.pixels, found.colors * share)
    np.add.at(weight.reshape(-1, 1), found.pixels, share)


def blended(found: Fragments, shape: tuple[int, int]) -> NDArray[np.float32]:
    """Return fragments over each other from far to near, (H, W, 3), times their alphas."""
    count = len(found.pixels)
    # Of those equally far, the first one is the nearest, as everywhere.
    order = np.lexsort((-np.arange(count), -found.depths, found.pixels))
    pixels, _, alphas, colors = (column[order] for column in found)
    starts = np.flatnonzero(np.diff(pixels, prepend=-1))
    rank = np.arange(count) - np.repeat(starts, np.diff(starts, append=count))
    out = np.zeros((shape[0] * shape[1], 3), np.float32)
    for layer in range(int(rank.max(initial=-1)) + 1):
        rows = rank == layer
        alpha = alphas[rows, None]
        out[pixels[rows]] = out[pixels[rows]] * (1.0 - alpha) + colors[rows] * alpha
    return out.reshape(*shape, 3)
