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


def obj(title, surfaces, library):
    """Return an OBJ file of surfaces, grouped by their names.

    Parameters
    ----------
    title : str
        First line, a comment.
    surfaces : list of Surface
    library : str
        Name of the MTL file.
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
            "/".join(str(pool.index(values[k])) for pool, values in zip(pools, data, strict=True))
            for k in range(len(surface.positions))
        ]
        body.extend(_face(corners[vertex] for vertex in polygon) for polygon in surface.polygons)
    header = [f"# {title}", f"mtllib {library}"]
    lines = header + [line for pool in pools for line in pool.lines()] + list(filter(None, body))
    return ("\n".join(lines) + "\n").encode("ascii")


def _face(corners):
    """Return the line of a polygon, without the corners that rounding has made one."""
    by_position = {corner.split("/")[0]: corner for corner in corners}
    return "f " + " ".join(by_position.values()) if len(by_position) > 2 else None


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
