"""The drawings of docs/drawings.md, as SVG: text that is the same on every machine."""

from __future__ import annotations

import math

from places import MODELS

import engine3d as e3d

SIZE = (960, 540)


def clamp() -> e3d.Scene:
    """A clamp of several parts: a plate with a boss, a shaft through it, bolts, a ring."""
    scene = e3d.Scene()
    level = (math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5))
    scene.add(e3d.box((60.0, 8.0, 40.0)), name="plate")
    scene.add(e3d.cylinder(14.0, 24.0, segments=72), name="boss", translation=(0, 16, 0))
    scene.add(
        e3d.cylinder(6.0, 76.0, segments=48), name="shaft", translation=(0, 18, 0), rotation=level
    )
    for number, (x, z) in enumerate(((-23, -13), (23, -13), (-23, 13), (23, 13))):
        bolt = e3d.cylinder(4.0, 6.0, segments=6)
        scene.add(bolt, name=f"bolt {number + 1}", translation=(x, 7, z))
        scene.add(e3d.cylinder(2.0, 16.0, segments=24), name="shank", translation=(x, 0, z))
    ring = e3d.torus(16.0, 2.0, (96, 24))
    scene.add(ring, name="ring", translation=(0, 28, 0), rotation=level)
    return scene


def line_drawing() -> str:
    """Return the train as lines."""
    return e3d.drawings.line_drawing(MODELS / "train.asc", size=SIZE).svg(line_width=0.6)


def drawing_sheet() -> str:
    """Return a page with the clamp."""
    sheet = e3d.drawings.drawing_sheet(
        clamp(),
        page="A4",
        title="Clamp",
        hidden=True,
        sections="z",
        unit="mm",
        line_width=0.7,
    )
    return sheet.svg()


VECTORS = {"line_drawing": line_drawing, "drawing_sheet": drawing_sheet}
