"""Files of heights: a line of numbers for each row of a square grid."""

import numpy as np

from engine3d import FileFormatError, Mesh, Values


def read(file):
    """Return the hills of a file; ``file`` is open in binary mode."""
    try:
        heights = np.loadtxt(file, ndmin=2)
    except ValueError as error:
        raise FileFormatError(str(error)) from error
    rows, columns = heights.shape
    if rows < 2 or columns < 2:
        raise FileFormatError("a grid of heights has two rows and two columns at least")
    z, x = np.indices(heights.shape)
    points = np.stack([x - (columns - 1) / 2, heights, z - (rows - 1) / 2], axis=-1)
    corner = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    squares = np.stack([corner, corner + columns, corner + columns + 1, corner + 1], axis=1)
    mesh = Mesh.from_polygons(points.reshape(-1, 3), squares)
    mesh.values["height"] = Values(heights.ravel(), on="vertices")
    return mesh


def write(scene, file, *, digits=3):
    """Write the first hills of a scene to ``file``; return a line for each loss."""
    hills = [node for node in scene.nodes if "height" in getattr(node.object, "values", ())]
    if not hills:
        raise FileFormatError("the scene has no hills: no mesh with values called 'height'")
    mesh = hills[0].object
    heights = np.asarray(mesh.values["height"])
    columns = len(np.unique(mesh.positions[:, 0]))
    np.savetxt(file, heights.reshape(-1, columns), fmt=f"%.{digits}f")
    others = len(scene.nodes) - 1
    return [f"{others} other nodes are left out"] if others else []
