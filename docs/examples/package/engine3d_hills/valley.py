"""A scene, and a look for it."""

import engine3d

EVENING = engine3d.Look.studio(
    lights="two colours", background=engine3d.Gradient("#1b1f2b", "#4a3a55"), ground=False
)


def valley():
    """Return a new scene: a ball in a valley."""
    ends = [(x / 4 - 4, z) for z in (-4, 4) for x in range(33)]
    points = [(x, 0.15 * x * x, z) for x, z in ends]
    squares = [(n, n + 33, n + 34, n + 1) for n in range(32)]
    scene = engine3d.Scene()
    scene.add(engine3d.Mesh.from_polygons(points, squares), name="valley")
    scene.add(engine3d.uv_sphere(0.5), name="ball", translation=(0, 0.5, 0))
    return scene
