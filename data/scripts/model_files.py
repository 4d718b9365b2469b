"""Writing models as Wavefront OBJ and MTL.

In: surfaces and materials. Out: the bytes of the files. Numbers are rounded to few decimals, and
equal positions, texture coordinates and normals are written once, so that files are small and
surfaces stay closed over the seams of their textures.
"""

import numpy as np

DECIMALS = {"v": 4, "vt": 4, "vn": 3}


def number(value, decimals):
    """Format a number with no more digits than it needs."""
    text = f"{value:.{decimals}f}"
    if "." in text:
        text = text.rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


class _Pool:
    """Lines of one kind, each written once; numbered from 1."""

    def __init__(self, keyword):
        self.keyword = keyword
        self.indices = {}

    def index(self, values):
        decimals = DECIMALS[self.keyword]
        text = " ".join(number(float(value), decimals) for value in values)
        return self.indices.setdefault(text, len(self.indices) + 1)

    def lines(self):
        return [f"{self.keyword} {text}" for text in self.indices]


def obj(title, surfaces, library, relative=False):
    """Return an OBJ file of surfaces, grouped by their names.

    Parameters
    ----------
    title : str
        First line, a comment.
    surfaces : list of Surface
    library : str
        Name of the MTL file.
    relative : bool
        Write what a face names just before it, and count back from there: a wheel with such a file
        is smaller.
    """
    pools = [_Pool(keyword) for keyword in ("v", "vt", "vn")]
    body, group, material = [], None, None
    for surface in surfaces:
        if surface.name != group:
            group = surface.name
            body.append(f"g {group}")
        if surface.material != material:
            material = surface.material
            body.append(f"usemtl {material}")
        data = (surface.positions, surface.uvs, surface.normals)
        corners = [
            [pool.index(values[k]) for pool, values in zip(pools, data, strict=True)]
            for k in range(len(surface.positions))
        ]
        body.extend(_face(corners[vertex] for vertex in polygon) for polygon in surface.polygons)
    write = _relative if relative else _absolute
    named = write([pool.lines() for pool in pools], filter(None, body))
    lines = [f"# {title}", f"mtllib {library}", *named]
    return ("\n".join(lines) + "\n").encode("ascii")


def _face(corners):
    """Return a polygon without the corners that rounding has made one; None of fewer than three."""
    by_position = {corner[0]: corner for corner in corners}
    return list(by_position.values()) if len(by_position) > 2 else None


def _absolute(lists, body):
    """Return all lists, then the body, whose faces count from 1."""
    lines = [line for one in lists for line in one]
    return lines + [one if isinstance(one, str) else _line(one, (0, 0, 0)) for one in body]


def _relative(lists, body):
    """Yield the body, and before each face what no face before has named; -1 is the last."""
    ends = [0, 0, 0]
    for one in body:
        if isinstance(one, str):
            yield one
            continue
        for k, numbers in enumerate(zip(*one, strict=True)):
            last = max(ends[k], *numbers)
            yield from lists[k][ends[k] : last]
            ends[k] = last
        yield _line(one, [end + 1 for end in ends])


def _line(face, start):
    """Return the line of a face, with the numbers of its corners counted from `start`."""
    return "f " + " ".join(
        "/".join(str(number - first) for number, first in zip(corner, start, strict=True))
        for corner in face
    )


def mtl(title, materials):
    """Return an MTL file of materials, a dict of name to a dict of keyword to value."""
    lines = [f"# {title}"]
    for name, properties in materials.items():
        lines += ["", f"newmtl {name}"]
        for keyword, value in properties.items():
            text = (
                value
                if isinstance(value, str)
                else " ".join(number(v, 3) for v in np.atleast_1d(value))
            )
            lines.append(f"{keyword} {text}")
    return ("\n".join(lines) + "\n").encode("ascii")
