"""Contact sheets: `contact_sheet` draws one, `Sheet` holds it.

In: models and what to show of them. Out: pixels, and a report with the cameras, so that what is at
a pixel can be told, and where a point of the world is. Same input, same bytes.
"""

from __future__ import annotations

import operator
import os
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..._native.images import encode_png
from ...base import linalg
from ...base.calls import checks_types, keywords_of, refuse_unknown
from ...base.files.atomic_write import AtomicFiles, checked_path
from ...base.linalg.vectors import as_vectors
from ...choices import Backend, ShapesOf
from ...errors import InvalidArgumentError
from ...model.materials.material import Material
from ...model.scene.cameras import Camera
from ...rendering.canvas import Canvas
from ...rendering.frame import Frame
from ...stage.look import LookChoice, check_look
from ...stage.overlays.numbers import MarkKeywords
from ...stage.painting import check_material
from .opening import open_sources
from .page import Dress, draw_pages
from .panels import Panel
from .report import VERSION, report_text
from .views import DEFAULT_VIEWS, check_views

if TYPE_CHECKING:
    from typing_extensions import Unpack


class Sheet:
    """One picture of models from several sides, and a report of it; made by `contact_sheet`.

    Attributes
    ----------
    picture : Canvas
        The pixels; ``np.asarray(sheet)`` is ``sheet.picture.pixels``.
    report : dict
        What the picture shows, in types that JSON takes: docs/sheet.md tells all keys.
    """

    def __init__(self, picture: Canvas, report: dict[str, Any], panels: list[list[Panel]]) -> None:
        self.picture = picture
        self.report = report
        self._panels = panels

    @checks_types
    def save(
        self,
        path: str | os.PathLike[str],
        report: str | os.PathLike[str] | None = None,
    ) -> None:
        """Write the picture as PNG, and the report as JSON if it has a path.

        Both appear whole, or neither does.

        Raises
        ------
        InvalidArgumentError
            The picture's suffix is not .png.
        FileAccessError
        """
        if not checked_path(path).lower().endswith(".png"):
            raise InvalidArgumentError(f"a sheet is written as .png, not {checked_path(path)!r}")
        with AtomicFiles() as files:
            files.create(path).write(self.encode())
            if report is not None:
                files.create(report).write(self.json().encode("ascii"))

    def encode(self) -> bytes:
        """Return the picture as the bytes of a PNG file."""
        return encode_png(self.picture.pixels)

    def json(self) -> str:
        """Return the report as JSON."""
        return report_text(self.report)

    @checks_types
    def at(self, x: int, y: int) -> dict[str, Any] | None:
        """Return what a pixel of the sheet shows.

        Parameters
        ----------
        x, y : int
            Column and row of the sheet.

        Returns
        -------
        dict or None
            ``model`` (its number) and ``view`` (its name); where a surface shows also ``object_id``
            and ``name`` of its node, ``face_id``, ``instance_id``, ``material_id`` (its number in
            the mesh), ``depth`` and ``position`` in the file's coordinates. None between the
            panels.
        """
        x, y = operator.index(x), operator.index(y)
        for model, panels in enumerate(self._panels):
            for panel in panels:
                left, top, width, height = panel.rectangle
                if left <= x < left + width and top <= y < top + height:
                    return _at(panel, model, x, y, self.report)
        return None

    @checks_types
    def project(self, view: str, points: ArrayLike, model: int = 0) -> NDArray[np.float64]:
        """Return the positions of points on the sheet.

        Parameters
        ----------
        view : str
            The view's name.
        points : (3,) or (N, 3) float
            In the file's coordinates.
        model : int
            Which of the models.

        Returns
        -------
        (2,) or (N, 2) float64
            Pixels of the sheet, perhaps outside of the panel; NaN behind a perspective camera.

        Raises
        ------
        InvalidArgumentError
            There is no such view or model.
        """
        points = as_vectors("points", points)
        panel = self._panel(view, model)
        x, y, _, w = (
            linalg.dot(points, row[:3]) + row[3] for row in panel.matrices.pixel_from_world
        )
        with np.errstate(all="ignore"):
            w = np.where(w > 0.0, w, np.nan)
            return np.stack([x / w, y / w], axis=-1)

    @checks_types
    def frame(self, view: str, model: int = 0) -> Frame:
        """Return a view as it was drawn, without texts over it.

        Parameters
        ----------
        view : str
            The view's name.
        model : int
            Which of the models.

        Returns
        -------
        Frame
            Of a picture it has the bytes of `render` with the camera of `camera`. It has the
            outputs ``depth``, ``object_id`` and others beside ``color``.

        Raises
        ------
        InvalidArgumentError
            There is no such view or model.
        """
        return self._panel(view, model).frame

    @checks_types
    def camera(self, view: str, model: int = 0) -> tuple[Camera, NDArray[np.float64]]:
        """Return the camera of a view and its pose, for `render`.

        Parameters
        ----------
        view : str
            The view's name.
        model : int
            Which of the models.

        Returns
        -------
        camera : Camera
        pose : (4, 4) float64
            world-from-camera, in the file's coordinates.

        Raises
        ------
        InvalidArgumentError
            There is no such view or model.
        """
        panel = self._panel(view, model)
        return panel.camera, panel.pose_in_file

    def _panel(self, view: str, model: int) -> Panel:
        if not 0 <= operator.index(model) < len(self._panels):
            raise InvalidArgumentError(f"the sheet has no model {model}")
        for panel in self._panels[model]:
            if panel.spec.name == view:
                return panel
        names = ", ".join(panel.spec.name for panel in self._panels[model])
        raise InvalidArgumentError(f"the sheet has no view {view!r}; it has {names}")

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        if copy is False and dtype is not None and np.dtype(dtype) != np.uint8:
            raise ValueError("a sheet is uint8: another dtype needs a copy")
        if copy:
            return np.array(self.picture.pixels, dtype)
        return np.asarray(self.picture.pixels, dtype)

    def _repr_png_(self) -> bytes:
        return self.encode()

    def __repr__(self) -> str:
        views = [panel.spec.name for panel in self._panels[0]]
        return f"<Sheet {self.picture.width}x{self.picture.height}: {', '.join(views)}>"


def _at(panel: Panel, model: int, x: int, y: int, report: dict[str, Any]) -> dict[str, Any]:
    column, row = x - panel.rectangle.x, y - panel.rectangle.y
    found: dict[str, Any] = {"model": model, "view": panel.spec.name}
    if not panel.shown[row, column]:
        return found
    frame = panel.frame
    node, depth = int(frame.object_id[row, column]), float(frame.depth[row, column])
    names = {entry["id"]: entry["name"] for entry in report["models"][model]["nodes"]}
    place = (x + 0.5, y + 0.5, depth, 1.0)
    if panel.scale is None and not _is_parallel(panel):
        place = (place[0] * depth, place[1] * depth, 1.0, depth)
    position = [
        sum(float(a) * b for a, b in zip(matrix_row, place, strict=True))
        for matrix_row in panel.matrices.world_from_pixel[:3]
    ]
    return found | {
        "object_id": node,
        "name": names[node],
        "face_id": int(frame.face_id[row, column]),
        "instance_id": int(frame.instance_id[row, column]),
        "material_id": int(frame.material_id[row, column]),
        "depth": depth,
        "position": position,
    }


def _is_parallel(panel: Panel) -> bool:
    return bool(panel.matrices.pixel_from_world[3, :3].tolist() == [0.0, 0.0, 0.0])


@checks_types
def contact_sheet(
    models: Any,
    *,
    views: str | Iterable[str] = DEFAULT_VIEWS,
    sections: str | Iterable[str] = (),
    size: tuple[int, int] | None = None,
    up: str | None = None,
    unit: str | None = None,
    root: str | os.PathLike[str] | None = None,
    joints: Mapping[str, Any] | None = None,
    shapes: ShapesOf = "visual",
    look: LookChoice = "studio",
    material: Material | None = None,
    backend: Backend = "auto",
    threads: int = 0,
    **marks: Unpack[MarkKeywords],
) -> Sheet:
    """Draw models from several sides on one sheet, with dimensions and a report.

    Parameters
    ----------
    models : what `render` takes, or several of these
        A path or file object, a scene, a node, a mesh, instances, points, or what trimesh, PyVista,
        meshio or Open3D hold.
        Each gets a part of the sheet, one below another. Scenes are not changed.
    views : str or iterable of str
        Comma-separated names: ``front``, ``right``, ``back``, ``left``, ``top``, ``bottom``,
        ``iso``, ``camera0`` (the file's first camera, and so on), and ``NAME=X,Y,Z`` (the way the
        camera looks) or ``NAME=AZIMUTH,ELEVATION`` (degrees, where the camera stands). They are
        arranged in rows, in this order.
    sections : str or iterable of str
        Cuts, each in two views, straight and aslant: ``"x=0.5"`` (a coordinate of the file),
        ``"x=50%"`` (of the model) or ``"x"`` (the middle) cuts off what has greater coordinates;
        ``"-x=0.5"`` the rest.
    size : (int, int), optional
        Width and height in pixels, of the part of each model: 1600 x 1200, or 1600 x 480 where
        there are several.
    up : {"+X", "-X", "+Y", "-Y", "+Z", "-Z"}, optional
        The up direction; by default the usual one of the file's format.
    unit : str, optional
        The unit of lengths; by default the file's unit, if its format has one.
    root, joints, shapes : optional
        As in `load_mesh`, for models that are files.
    look : {"studio", "plain"} or Look
        Of the pictures, which are those of `render` with the same camera; drawings stand on paper.
    material, backend, threads
        As for `Renderer`.
    **marks
        ``color_by``, ``colormap``, ``clim``, ``component``, ``on``, ``bar`` and ``axes_grid``: see
        `render`. Bars and grids are in pictures, not in drawings.

    Returns
    -------
    Sheet

    Raises
    ------
    InvalidArgumentError, FileFormatError, FileAccessError, BackendError, OutOfMemoryError

    Examples
    --------
    >>> sheet = contact_sheet("part.stl", sections="x=50%", unit="mm")
    >>> sheet.save("part.png", report="part.json")
    """
    refuse_unknown(
        "contact_sheet", marks, (*keywords_of(contact_sheet), *MarkKeywords.__annotations__)
    )
    specs = check_views(views, sections)
    opened = open_sources(models, root=root, joints=joints, shapes=shapes)
    drawing = {"backend": backend, "threads": threads}
    dress = Dress(drawing, check_look(look), check_material(material), dict(marks))
    pages = draw_pages(opened, specs, size, up, unit, dress)
    report = {
        "version": VERSION,
        "size": [pages.canvas.width, pages.canvas.height],
        "models": pages.reports,
    }
    return Sheet(pages.canvas, report, pages.panels)
