"""Draws the picture of docs/cad.md: an assembly of build123d.

    python docs/pictures/cad.py

It is no part of make.py: triangles are those of the installed Open CASCADE. Needs build123d.
"""

from pathlib import Path

import build123d as b
from PIL import Image

import engine3d as e3d


def bearing() -> b.Compound:
    """Return a plate with a flanged bush, a shaft in it and four screws."""
    plate = b.Box(80, 60, 12) - b.Cylinder(14, 12)
    plate = b.fillet(plate.edges().filter_by(b.Axis.Z).group_by(b.SortBy.LENGTH)[-1], 6)
    places = [b.Location((x, y, 6)) for x in (-30, 30) for y in (-20, 20)]
    for place in places:
        plate -= b.Cylinder(3.2, 40).moved(place)
    bush = b.Cylinder(14, 26) + b.Cylinder(20, 4).moved(b.Location((0, 0, 10))) - b.Cylinder(9, 60)
    bush = b.fillet(bush.edges().filter_by(b.GeomType.CIRCLE).sort_by(b.Axis.Z)[-1], 1)
    shaft = b.chamfer(b.Cylinder(8.8, 80).edges(), 1.5)
    screw = b.Cylinder(5.5, 4).moved(b.Location((0, 0, 2))) - b.extrude(
        b.RegularPolygon(3, 6).moved(b.Location((0, 0, 1.5))), 5
    )
    parts = [(plate, "plate", "#8d99a6"), (bush, "bush", "#c98a3a"), (shaft, "shaft", "#d4d8dc")]
    children = []
    for part, label, color in parts:
        part.label, part.color = label, b.Color(color)
        children.append(part)
    for place in places:
        one = screw.moved(place)
        one.label, one.color = "screw", b.Color("#30343a")
        children.append(one)
    return b.Compound(label="bearing", children=children)


def main() -> None:
    camera, pose = e3d.frame_scene(
        made := bearing(), aspect=1.6, direction=(-0.6, 0.7, -0.55), up=(0, 0, 1)
    )
    frame = e3d.render(made, (camera, pose), size=(960, 600), samples=16)
    picture = Image.fromarray(frame.color[:, :, :3])
    picture.save(Path(__file__).with_name("cad.webp"), quality=85, method=6)


if __name__ == "__main__":
    main()
