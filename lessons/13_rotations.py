"""Rotations with 12, 9 and 6 multiplications for each point: equal, and timed."""

import subprocess
import tempfile
from fractions import Fraction
from pathlib import Path

import engine3d as e3d
from lesson import DIFFER, FOLDER, MODELS, blank, earlier, main, told

lists = earlier("01_lists")
points = earlier("02_points")
TEAPOT = MODELS / "teapot.obj"
COLORS = ((255, 200, 0), (90, 170, 250), (120, 220, 130))


def rotate_12(point, turns):
    """Turn about x, then y, then z; turns: (cosine, sine) of each. 12 multiplications."""
    x, y, z = point
    (cx, sx), (cy, sy), (cz, sz) = turns
    y, z = y * cx - z * sx, y * sx + z * cx
    x, z = x * cy + z * sy, z * cy - x * sy
    x, y = x * cz - y * sz, x * sz + y * cz
    return x, y, z


def matrix_of(turns):
    """Return the matrix of the three turns: made once for all points."""
    (cx, sx), (cy, sy), (cz, sz) = turns
    return (
        (cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx),
        (sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx),
        (-sy, cy * sx, cy * cx),
    )


def rotate_9(point, m):
    """Multiply by a matrix. 9 multiplications."""
    x, y, z = point
    return tuple(a * x + b * y + c * z for a, b, c in m)


def rotate_6(point, m, row_products, point_product):
    """The same with 6: ax + by = (a + y)(b + x) - ab - xy.

    ab is known once for each row of the matrix, xy once for each point of the model.
    """
    x, y, z = point
    return tuple(
        (a + y) * (b + x) + c * z - (ab + point_product)
        for (a, b, c), ab in zip(m, row_products, strict=True)
    )


def all_three(point, turns):
    """Return a point turned in the three ways."""
    m = matrix_of(turns)
    row_products = [a * b for a, b, _ in m]
    x, y, _ = point
    return rotate_12(point, turns), rotate_9(point, m), rotate_6(point, m, row_products, x * y)


def compare():
    """Check that the three ways are equal: exactly in fractions, nearly in floating point."""
    exact = [(Fraction(3, 5), Fraction(4, 5)), (Fraction(5, 13), Fraction(12, 13))]
    exact.append((Fraction(8, 17), Fraction(15, 17)))
    for k in range(200):
        point = Fraction(k, 7), Fraction(3 * k - 50, 11), Fraction(40 - k, 13)
        one, two, three = all_three(point, exact)
        assert one == two == three
    print("in fractions: equal, all 200 points")
    rounded = [(float(c), float(s)) for c, s in exact]
    worst = [0.0, 0.0]
    for k in range(200):
        point = k / 7, (3 * k - 50) / 11, (40 - k) / 13
        one, *others = all_three(point, rounded)
        for way, other in enumerate(others):
            errors = [abs(a - b) for a, b in zip(one, other, strict=True)]
            worst[way] = max(worst[way], *errors)
    print(f"in floating point: 9 differs from 12 by {worst[0]:.1e} at most, 6 by {worst[1]:.1e}")


def measure():
    """Time the three ways in C."""
    with tempfile.TemporaryDirectory() as folder:
        program = Path(folder) / "rotations"
        for flags in ("-O1", "-O3", "-O3 -march=native"):
            source = FOLDER / "13_rotations.c"
            subprocess.run(["cc", *flags.split(), "-o", program, source, "-lm"], check=True)
            print(flags)
            print(subprocess.check_output([program], text=True), end="")


def steps(width=240, height=180, model=TEAPOT, yaw=0.7):
    vertices = lists.read_lists(model)["v"]
    turns = [(e3d.linalg.cos(angle), e3d.linalg.sin(angle)) for angle in (0.4, yaw, 0.25)]
    turned = [all_three(vertex, turns) for vertex in vertices]
    scale, middle = points.fit([way[0] for way in turned], width, height)
    sets = []
    for way, (name, color) in enumerate(zip((12, 9, 6), COLORS, strict=True)):
        picture = blank(width, height)
        for vertex in turned:
            place = points.to_screen(vertex[way], scale, middle, width, height)
            points.put_point(picture, *place, color)
        sets.append((picture != blank(width, height)).any(axis=2))
        other = int((sets[0] != sets[-1]).sum())
        caption = "{number} multiplications: " + DIFFER + " from the first"
        yield told(caption, number=name, differ=other), picture


if __name__ == "__main__":
    main(__file__, steps, compare=compare, time=measure)
