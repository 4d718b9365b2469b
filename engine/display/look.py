"""How a scene is drawn: what the keys and the command line change of `Renderer.render`'s options.

In: option values. Out: the keyword arguments of one ``render`` call.
"""

from __future__ import annotations

from dataclasses import dataclass

MODES = (
    "lit",
    "unlit",
    "random",
    "depth",
    "normal",
    "triangle_id",
    "object_id",
    "overdraw",
)
WIREFRAMES = (None, "overlay", "only")
CULLS = ("back", "front", "none")
SHADINGS = ("deferred", "forward")
NORMALS = ("auto", "smooth", "flat")
HIDDEN_SURFACES = ("zbuffer", "painter", "none")
LINE_COLORS = {None: (255, 255, 255), "overlay": (22, 24, 28), "only": (225, 229, 236)}


@dataclass
class Look:
    """The drawing options of one frame; the fields are those of `Renderer.render`.

    ``line_color`` is (r, g, b), integers 0 to 255, sRGB; None is dark over faces and light without
    them. Widths and sizes are in pixels.
    """

    mode: str = "lit"
    wireframe: str | None = None
    cull: str = "back"
    shading: str = "deferred"
    normals: str = "auto"
    hidden_surfaces: str = "zbuffer"
    line_width: float = 1.0
    line_color: tuple[int, int, int] | None = None
    hidden_lines: bool = False
    point_size: float = 1.0

    def arguments(self) -> dict:
        """Return the keyword arguments for `Renderer.render`."""
        arguments = dict(vars(self))
        if self.line_color is None:
            arguments["line_color"] = LINE_COLORS[self.wireframe]
        return arguments


def following(value, choices, step: int = 1):
    """Return the choice ``step`` places after ``value``, going round."""
    index = choices.index(value) if value in choices else -1
    return choices[(index + step) % len(choices)]
