"""The tools of the server: what agents can call, and what they are told about it.

In: JSON arguments. Out: an `Answer`: numbers, and perhaps a picture. `server` publishes the
functions by their annotations and docstrings, which are therefore short: agents pay for each word.
What the first picture does not need is imported when it is called, so that the server starts fast.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

from pydantic import Field

from ..._native.images import encode_png
from ...base.system import usable_processors
from ...base.thread_count import resolve_threads
from ...base.validation import choose
from ...io.reading.reader_registry import formats as readable_formats
from ...model.primitives import box
from ...stage.renderer import Renderer
from ...version import __version__
from . import answers
from .pictures import LOOKS, SIZE, Picture, Request
from .questions import checked, gap_between, measured, pick
from .session import Session

if TYPE_CHECKING:
    from .grids import GridPicture

_FORMATS = ("png", "webp")
_GRID, _PANE = (1200, 900), (500, 375)
Size = Annotated[tuple[int, int], Field(description="[width, height] in pixels")]
Names = Annotated[list[str] | str, Field(description="names; empty: all")]
View = Annotated[
    str | dict[str, Any],
    Field(
        description="front|right|back|left|top|bottom|iso, an object's name (fills the picture), "
        "or {azimuth, elevation, distance, fit: [names]}, angles in degrees"
    ),
]
Look = Annotated[str, Field(json_schema_extra={"enum": list(LOOKS)})]
Vector = list[float]


class Answer(NamedTuple):
    """What a tool returns: numbers, and perhaps a picture with its media type."""

    record: Any
    picture: bytes | None = None
    kind: str = "image/png"


class Tool(NamedTuple):
    """A row of the table: the function, the type of its record, and whether it only reads."""

    call: Callable[..., Answer]
    record: Any
    reads: bool = True


def tools_of(session: Session) -> list[Tool]:
    """Return the tools that work on a session, those of scripts only if they are allowed."""

    def kept(picture: Picture | GridPicture) -> Answer:
        """Answer with a picture, and keep it for questions about its pixels."""
        answer = Answer(picture.record, picture.encode())
        session.last = picture
        return answer

    def load(
        path: Annotated[str, Field(description="below the root folder")],
        name: str = "",
        up: Annotated[str, Field(description="auto, or +Y, +Z, ...")] = "auto",
    ) -> Answer:
        """Load a model file into the scene. Its nodes become parts, named object/part."""
        return Answer(session.load(path, name, up))

    def script(code: str = "", path: str = "", function: str = "build", name: str = "") -> Answer:
        """Run Python; add what its function returns: a mesh, a scene, a CadQuery, build123d or
        trimesh object, or a dict or list of these."""
        from .made_by_scripts import run_script

        return Answer(run_script(session, code, path, function, name))

    def scene() -> Answer:
        """List the objects of the scene with bounds, triangles, materials; lights, last camera."""
        return Answer(session.record())

    def render(
        view: View = "iso",
        size: Size = SIZE,
        objects: Names = "",
        hide: Annotated[list[str] | str, Field(description="names to leave out")] = "",
        look: Look = "studio",
        transparent: bool = False,
        labels: Annotated[bool, Field(description="write names on objects")] = False,
        section: Annotated[
            dict[str, Any] | None,
            Field(description='cut by a plane: {axis: x|y|z, at: coordinate or "50%"}'),
        ] = None,
        highlight: Annotated[
            list[dict[str, Any]] | None,
            Field(description="[{object, faces?: [triangle numbers]}]"),
        ] = None,
    ) -> Answer:
        """Draw the scene. Tells which objects show, where, and why a picture is blank."""
        request = Request(view, size, objects, hide, look, transparent, labels, section, highlight)
        return kept(session.studio.draw(session.things, request))

    def views(
        names: Annotated[
            list[str] | str,
            Field(description="as of render, or NAME=AZIMUTH,ELEVATION"),
        ] = "front,right,top,iso",
        size: Size = _GRID,
        objects: Names = "",
        sections: Annotated[
            list[str] | str, Field(description='cuts such as "x=50%", each in two views')
        ] = "",
    ) -> Answer:
        """Draw several views in one grid with captions, dimensions and scale."""
        from .grids import draw_views

        cuts = sections.split(",") if isinstance(sections, str) and sections else sections or ()
        asked = names if isinstance(names, str) else ",".join(names)
        return kept(draw_views(session.studio, session.things, asked, size, objects, cuts))

    def turntable(
        frames: int = 8,
        elevation: float = 20.0,
        size: Size = _GRID,
        objects: Names = "",
        format: Annotated[str, Field(json_schema_extra={"enum": list(_FORMATS)})] = "png",
    ) -> Answer:
        """Draw a turn around the scene: a grid of frames, or an animation as webp."""
        from .grids import animate_turntable, draw_turntable

        turn = session.studio, session.things, frames, elevation, size, objects
        if choose(format, _FORMATS, "format") == "webp":
            animation, record = animate_turntable(*turn)
            return Answer(record, animation, "image/webp")
        return kept(draw_turntable(*turn))

    def pick_(x: int, y: int, view: View | None = None, size: Size = SIZE) -> Answer:
        """Tell what is at a pixel of the last picture, or of a view that is drawn for it."""
        request = None if view is None else Request(view, size)
        return Answer(pick(session, x, y, request))

    def measure(objects: Names = "") -> Answer:
        """Measure objects as one body. Without a closed surface volume and inertia are null."""
        return Answer(measured(session, objects))

    def distance(a: str, b: str) -> Answer:
        """Tell how far two objects are apart, the nearest points, whether they touch or cross."""
        return Answer(gap_between(session, a, b))

    def check(name: Annotated[str, Field(description="empty: everything")] = "") -> Answer:
        """Find faults of a mesh: holes, flipped or double faces, missing textures."""
        return Answer(checked(session, name))

    def compare(a: str, b: str, view: View = "iso", size: Size = _PANE) -> Answer:
        """Compare two objects, model files, or pictures (.png): the pixels that differ, how far
        surfaces deviate, and a picture of a, b and the difference."""
        from .comparing import compared

        pixels, record = compared(session, a, b, view, size)
        return Answer(record, encode_png(pixels))

    def edit(
        name: str,
        translate: Vector | None = None,
        rotate: Annotated[
            dict[str, Any] | None, Field(description="{axis: x|y|z|[x,y,z], degrees}")
        ] = None,
        scale: float | Vector | None = None,
        color: Annotated[str | None, Field(description="name or #rrggbb")] = None,
        visible: bool | None = None,
        delete: bool = False,
    ) -> Answer:
        """Change an object or a part. Scaling and turning are about its centre."""
        changes = {
            "translate": translate,
            "rotate": rotate,
            "scale": scale,
            "color": color,
            "visible": visible,
            "delete": delete or None,
        }
        return Answer(session.edit(name, changes))

    def undo() -> Answer:
        """Take back the last load, script or edit."""
        return Answer(session.undo())

    def export_(
        path: Annotated[str, Field(description="below the root folder; .png: the last picture")],
        objects: Names = "",
        format: str = "",
        overwrite: bool = False,
    ) -> Answer:
        """Write objects as a model file."""
        from .exporting import export

        return Answer(export(session, path, objects, format, overwrite))

    def formats() -> Answer:
        """List the file extensions that can be read and written."""
        from .exporting import written_formats

        read = {end for one in readable_formats("mesh") for end in one.extensions}
        return Answer({"read": sorted(read), "write": written_formats()})

    def health() -> Answer:
        """Draw a box; tell the version, the time that took, and what the server allows."""
        return Answer(health_of(session))

    pick_.__name__, export_.__name__ = "pick", "export"
    scripts = [Tool(script, answers.Scripted, False)] if session.limits.allow_scripts else []
    return [
        Tool(load, answers.Loaded, False),
        *scripts,
        Tool(scene, answers.SceneRecord),
        Tool(render, answers.Rendered),
        Tool(views, answers.Grid),
        Tool(turntable, answers.Grid),
        Tool(pick_, answers.Picked),
        Tool(measure, answers.Measured),
        Tool(distance, answers.Gap),
        Tool(check, answers.Checked),
        Tool(compare, answers.Compared),
        Tool(edit, answers.Edited, False),
        Tool(undo, answers.Undone, False),
        Tool(export_, answers.Exported, False),
        Tool(formats, answers.Formats),
        Tool(health, answers.Health),
    ]


def health_of(session: Session) -> dict[str, Any]:
    """Return the state of a server; see the tool ``health``."""
    began = time.perf_counter()
    with Renderer((64, 64)) as renderer:
        renderer.render(box())
        backend = renderer.backend
    limits = session.limits
    return {
        "version": __version__,
        "backend": backend,
        "threads": resolve_threads() or usable_processors(),
        "milliseconds": round((time.perf_counter() - began) * 1000.0, 2),
        "scripts": limits.allow_scripts,
        "limits": {
            "root": limits.root,
            "seconds": limits.seconds,
            "bytes": limits.most_bytes,
            "triangles": limits.most_triangles,
            "side": limits.most_side,
        },
    }
