"""Writing 3D Studio ASCII files (.asc), as 3D Studio R2 to R4 did.

In: named groups of surfaces (z up), lights, a camera. Out: bytes of the file, with the texture
coordinates, the edge flags that hide the diagonals of polygons, materials by their colour
("r200g30b20a0") and smoothing groups, which stand for the surfaces' creases.
"""

import numpy as np
from model_files import number

from engine3d import linalg

LINE_END = "\r\n"
CREASE = 0.80  # cosine of the angle between faces from which an edge is sharp


def asc(objects, lights=(), camera=None, ambient=(0.3, 0.3, 0.3)):
    """Return an ASC file.

    Parameters
    ----------
    objects : dict of str to list of Surface
        Names of at most 10 characters, as 3D Studio allowed.
    lights : sequence of (name, position, colour)
    camera : (name, position, target, millimetres) or None
    ambient : colour
    """
    lines = [f"Ambient light color: {_color(ambient)}", ""]
    for name, surfaces in objects.items():
        lines += [f'Named object: "{name}"', *_mesh(surfaces), ""]
    for name, position, color in lights:
        lines += [f'Named object: "{name}"', "Direct light", f"Position:  {_xyz(position)}"]
        lines += [f"Light color: {_color(color)}", ""]
    if camera:
        name, position, target, lens = camera
        lines += [f'Named object: "{name}"', f"Camera ({lens:.6f}mm)"]
        lines += [f"Position:  {_xyz(position)}", f"Target:  {_xyz(target)}"]
        lines += ["Bank angle: 0 degrees", ""]
    return LINE_END.join(lines).encode("ascii")


def _color(color):
    return " ".join(
        f"{n}={number(c, 3)}" for n, c in zip(("Red", "Green", "Blue"), color, strict=True)
    )


def _xyz(point):
    return " ".join(f"{axis}:{number(float(c), 3)}" for axis, c in zip("XYZ", point, strict=True))


def _mesh(surfaces):
    """Lines of one object: header, vertices, faces."""
    vertices, polygons, materials = {}, [], []
    for surface in surfaces:
        texts = [_vertex(p, uv) for p, uv in zip(surface.positions, surface.uvs, strict=True)]
        index = [vertices.setdefault(text, len(vertices)) for text in texts]
        for polygon in surface.polygons:
            corners = list(dict.fromkeys(index[k] for k in polygon))
            if len(corners) > 2:
                polygons.append(corners)
                materials.append(surface.material)
    positions = np.array([_position(text) for text in vertices])
    groups = smoothing_groups(positions, polygons)
    faces = []
    for polygon, material, group in zip(polygons, materials, groups, strict=True):
        for triangle, edges in _triangles(polygon):
            corners = " ".join(f"{n}:{k}" for n, k in zip("ABC", triangle, strict=True))
            flags = " ".join(f"{n}:{e:d}" for n, e in zip(("AB", "BC", "CA"), edges, strict=True))
            faces.append((f"{corners} {flags}", material, group))
    lines = [
        f"Tri-mesh, Vertices: {len(vertices)}     Faces: {len(faces)}",
        "Mapped",
        "Vertex list:",
    ]
    lines += [f"Vertex {k}:  {text}" for k, text in enumerate(vertices)]
    lines.append("Face list:")
    for k, (text, material, group) in enumerate(faces):
        lines += [f"Face {k}:    {text}", f'Material:"{material}"', f"Smoothing:  {group}"]
    return lines


def _vertex(position, uv):
    x, y, z = (number(float(c), 3) for c in position)
    u, v = (number(float(c), 3) for c in uv)
    return f"X:{x}     Y:{y}     Z:{z}     U:{u}     V:{v}"


def _position(text):
    return [float(word[2:]) for word in text.split()[:3]]


def _triangles(polygon):
    """Cut a polygon into a fan; only its own sides are visible."""
    last = len(polygon) - 2
    for k in range(1, last + 1):
        yield (polygon[0], polygon[k], polygon[k + 1]), (k == 1, True, k == last)


def smoothing_groups(positions, polygons):
    """Number polygons from 1 so that two share a number where the edge between them is smooth.

    Polygons that are joined by smooth edges make a patch; patches that touch get different
    numbers.
    """
    _, spot = np.unique(positions, axis=0, return_inverse=True)
    spot = spot.reshape(-1).tolist()
    normals = [_normal(positions[polygon]) for polygon in polygons]
    patch = list(range(len(polygons)))

    def root(k):
        while patch[k] != k:
            k = patch[k]
        return k

    edges = {}
    for k, polygon in enumerate(polygons):
        corners = [spot[vertex] for vertex in polygon]
        for a, b in zip(corners, corners[1:] + corners[:1], strict=True):
            edges.setdefault((min(a, b), max(a, b)), []).append(k)
    for sharers in edges.values():
        for other in sharers[1:]:
            if linalg.dot(normals[sharers[0]], normals[other]) > CREASE:
                low, high = sorted((root(sharers[0]), root(other)))
                patch[high] = low
    patches = [root(k) for k in range(len(polygons))]
    return _colored(patches, [[spot[vertex] for vertex in polygon] for polygon in polygons])


def _colored(patches, corners):
    """Give each patch the least number that no touching patch has."""
    around = {}
    for patch, spots in zip(patches, corners, strict=True):
        for spot in spots:
            around.setdefault(spot, set()).add(patch)
    touching = {patch: set() for patch in patches}
    for neighbours in around.values():
        for patch in neighbours:
            touching[patch] |= neighbours - {patch}
    numbers = {}
    for patch in sorted(touching):
        taken = {numbers.get(other) for other in touching[patch]}
        numbers[patch] = next(n for n in range(1, len(touching) + 2) if n not in taken)
    return [numbers[patch] for patch in patches]


def _normal(corners):
    area = np.zeros(3)
    for k in range(len(corners)):
        area = area + linalg.cross(corners[k - 1], corners[k])
    return linalg.normalize(area)
