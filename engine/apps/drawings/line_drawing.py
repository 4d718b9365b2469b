"""`line_drawing` draws a scene as lines, `LineDrawing` holds and writes them.

In: whatever `engine3d.render` draws, and a camera. Out: strokes in millimetres, as SVG or PDF.
"""

from __future__ import annotations

import os
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..._native.loaders import frozen
from ...base.angles import limited_angle
from ...base.calls import checks_types, hints_keywords
from ...base.files.atomic_write import atomic_write, checked_path
from ...base.image_size import check_size
from ...base.thread_count import resolve_threads
from ...base.validation import choose, positive
from ...choices import LengthUnit, LineKind
from ...errors import InvalidArgumentError, warn
from ...model.geometry.creases import CREASE_ANGLE
from ...model.scene.cameras import Camera
from ...rendering.camera_choice import CameraChoice, find_camera
from ...stage.near_origin import pose_from_file
from ...stage.viewed_scene import ViewedScene
from ...stage.viewed_thing import comes_from_file, viewed_of
from ...stage.views.framing import frame_scene
from .chains import chained
from .line_kinds import KINDS
from .paper import Group, Page, Strokes
from .pdf import pdf_of
from .pieces import Pieces, find_pieces
from .projections import matrix_of, projection_onto
from .styles import Layer, layers
from .surfaces import surfaces_of
from .svg import svg_of
from .units import SUFFIXES, millimetres

#: Millimetres per pixel: an inch has 96.
PIXEL = 25.4 / 96.0


@hints_keywords
class LineDrawing:
    """The lines of a scene as a camera sees them; made by `line_drawing`.

    Attributes
    ----------
    size : (float, float)
        Width and height of the frame in millimetres.
    pieces : Pieces
        Straight pieces with their kinds, parts and whether they are hidden.
    parts : tuple of str
        The names of the parts: nodes, and instances.
    title : str
    """

    def __init__(
        self, size: tuple[float, float], pieces: Pieces, parts: list[str], title: str
    ) -> None:
        columns = (frozen(np.ascontiguousarray(column)) for column in pieces)
        self.pieces = Pieces(*columns)
        self.size, self.parts, self.title = size, tuple(parts), title

    @checks_types
    def strokes(self, kind: LineKind, hidden: bool = False) -> list[Strokes]:
        """Return the polylines of a kind, part by part, in thousandths of a millimetre."""
        choose(kind, KINDS, "kind")
        found = self.pieces.of(kind, hidden)
        order = np.argsort(found.parts, kind="stable")
        numbers, starts = np.unique(found.parts[order], return_index=True)
        runs = zip(numbers.tolist(), np.split(found.ends[order], starts[1:]), strict=False)
        strokes = (Strokes(self.parts[number], chained(ends)) for number, ends in runs)
        return [one for one in strokes if one.polylines]

    def _page(self, hidden: bool, line_width: float) -> Page:
        width = positive(line_width, "line_width")
        view = Group("view", "", layers_of(self, hidden, width), clip=self.size)
        return Page(*self.size, self.title, [view])

    @checks_types
    def svg(self, *, hidden: bool = False, line_width: float = 1.0) -> str:
        """Return the drawing as SVG, in millimetres.

        Parameters
        ----------
        hidden : bool
            Whether hidden lines are drawn, dashed.
        line_width : float
            Factor on the widths of lines; at 1, edges have 0.5 mm and hidden lines 0.25 mm.
        """
        return svg_of(self._page(hidden, line_width))

    @checks_types
    def pdf(self, *, hidden: bool = False, line_width: float = 1.0) -> bytes:
        """Return the drawing as PDF; parameters as for `svg`."""
        return pdf_of(self._page(hidden, line_width))

    @checks_types
    def save(
        self,
        path: str | os.PathLike[str],
        *,
        hidden: bool = False,
        line_width: float = 1.0,
    ) -> None:
        """Write the drawing as .svg or .pdf, whole or not at all; parameters as for `svg`.

        Raises
        ------
        InvalidArgumentError
            The suffix is another one.
        FileAccessError
        """
        write_page(path, self._page(hidden, line_width))

    def _repr_svg_(self) -> str:
        return self.svg()

    def __repr__(self) -> str:
        width, height = self.size
        return f"<LineDrawing {width:.6g} x {height:.6g} mm: {len(self.pieces.ends)} pieces>"


def layers_of(
    drawing: LineDrawing, hidden: bool, line_width: float
) -> list[tuple[Layer, list[Strokes]]]:
    """Return the layers of a drawing that are not empty."""
    found = (
        (layer, drawing.strokes(kind, state)) for kind, state, layer in layers(hidden, line_width)
    )
    return [(layer, strokes) for layer, strokes in found if strokes]


def page_bytes(page: Page, suffix: str) -> bytes:
    """Return a page as the content of a file."""
    return pdf_of(page) if suffix == ".pdf" else svg_of(page).encode()


def write_page(path: str | os.PathLike[str], page: Page) -> None:
    """Write a page as .svg or .pdf."""
    suffix = os.path.splitext(checked_path(path))[1].lower()
    if suffix not in SUFFIXES:
        raise InvalidArgumentError(
            f"a line drawing is written as .svg or .pdf, not {checked_path(path)!r}"
        )
    with atomic_write(path) as file:
        file.write(page_bytes(page, suffix))


@checks_types
def line_drawing(
    scene: Any,
    camera: CameraChoice = None,
    *,
    size: tuple[int, int] = (1280, 720),
    scale: float | None = None,
    unit: LengthUnit | None = None,
    crease_angle: float = CREASE_ANGLE,
    intersections: bool = True,
    threads: int = 0,
) -> LineDrawing:
    """Draw the lines of a file, a scene, a node or a mesh, without hidden ones or with them.

    Parameters
    ----------
    scene : path-like, Scene, Node, Mesh, InstancedMesh, or another library's object
        As for `render`.
    camera : None, Node or (Camera, pose)
        By default a scene's first camera, else one that shows everything.
    size : (int, int)
        Width and height of the frame in pixels, as for `render`; an inch has 96.
    scale : float, optional
        The drawing's scale, such as ``1 / 2``, of a parallel projection; the frame then has the
        size that the camera's view has at this scale.
    unit : {"mm", "cm", "m", "µm", "in", "ft"}, optional
        The unit of coordinates; by default that of the file, or millimetres.
    crease_angle : float
        Radians. Faces that meet at more than this angle have an edge between them, unless the mesh
        has normals that are smooth there.
    intersections : bool
        Whether bodies that run through each other have lines there: parts, or what hangs together
        within a mesh.
    threads : int
        0 means all.

    Returns
    -------
    LineDrawing
        The same for any number of threads.

    Raises
    ------
    InvalidArgumentError, FileFormatError, FileAccessError, OutOfMemoryError

    Examples
    --------
    >>> drawing = line_drawing("part.stl")
    >>> drawing.save("part.svg", hidden=True)
    """
    viewed = viewed_of(scene)
    if viewed is None:
        raise InvalidArgumentError(
            f"scene must be a path, a scene, a node or a mesh, not {type(scene).__name__}"
        )
    width, height = check_size(size)
    viewed.scene.data.update()
    found = None if camera is None and comes_from_file(scene) else find_camera(viewed.scene, camera)
    if found is None:
        found = frame_scene(viewed, aspect=width / height)
    if comes_from_file(scene):
        found = found[0], pose_from_file(viewed, found[1])
    return draw_lines(
        viewed,
        found,
        (width, height),
        scale=scale,
        unit=unit,
        crease_angle=crease_angle,
        intersections=intersections,
        threads=threads,
    )


def draw_lines(
    viewed: ViewedScene,
    view: tuple[Camera, np.ndarray],
    size: tuple[int, int],
    *,
    scale: float | None = None,
    unit: str | None = None,
    crease_angle: float = CREASE_ANGLE,
    intersections: bool = True,
    threads: int = 0,
) -> LineDrawing:
    """Return the drawing of a viewed scene for a camera and its pose, as `line_drawing` does."""
    angle = limited_angle(crease_angle, "crease_angle", np.pi, "from 0 to pi radians")
    camera, pose = view
    matrix = matrix_of(camera, size)
    frame = _frame(matrix, size, scale, unit or viewed.unit)
    surfaces, omitted = surfaces_of(viewed.scene, angle)
    for sentence in omitted:
        warn(sentence)
    pieces = find_pieces(
        surfaces,
        projection_onto(frame, matrix, pose),
        intersections=intersections,
        threads=resolve_threads(threads),
    )
    if not len(pieces.ends):
        warn(f"{viewed.title}: the drawing shows no lines")
    return LineDrawing(frame, pieces, surfaces.names, viewed.title)


def _frame(
    projection: NDArray[np.float64], size: tuple[int, int], scale: float | None, unit: str | None
) -> tuple[float, float]:
    """Return the size of the frame in millimetres."""
    if scale is None:
        return size[0] * PIXEL, size[1] * PIXEL
    if projection[3, :3].any():
        raise InvalidArgumentError("scale: only a parallel projection has one")
    factor = 2.0 * positive(scale, "scale") * millimetres(unit) * float(projection[3, 3])
    return factor / abs(float(projection[0, 0])), factor / abs(float(projection[1, 1]))
