"""A solution of the checked exercise of lesson 6, random colors."""

from importlib.resources import files

import engine3d as e3d


def color(number):
    bits = number * 2654435761 % 2**32
    return [64 + (bits >> shift) % 192 for shift in (24, 16, 8)]


path = files("engine3d.data") / "models" / "teapot.obj"
mesh = e3d.load_mesh(path)


def draw(numbers):
    canvas = e3d.Canvas((240, 180))
    for number in numbers:
        corners = mesh.positions[mesh.faces[number]].tolist()
        places = [(120 + 34 * x, 141 - 34 * y) for x, y, z in corners]
        canvas.triangle(*places, color(number))
    return canvas.pixels


count = len(mesh.faces)
one, other = draw(range(count)), draw(reversed(range(count)))
print((one != other).any(axis=2).sum())
