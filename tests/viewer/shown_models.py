"""Models of all kinds, small, for tests that show them: a folder of files, and built-in scenes."""

import shutil
from importlib.resources import files

import numpy as np
from motion.moving_model import flag

import engine3d as e3d
from engine3d import data
from engine3d.apps.scenes import DEMO_NAMES, load_demo

#: Smaller than by themselves, where they take a number.
_OPTIONS = {"city": {"triangles": 20_000}}


def write_models(folder):
    """Write a file of each kind to a folder, two of them broken; return their paths."""
    models = files(data) / "models"
    for name in ("island.obj", "island.mtl", "island_details.webp", "island_ground.webp"):
        shutil.copy(str(models / name), folder)
    flag(folder / "flag.gltf")
    rng = np.random.default_rng(5)
    points = rng.normal(size=(400, 3))
    colors = rng.uniform(size=(400, 3))
    e3d.Mesh(points, points=np.arange(400), colors=colors).save(folder / "cloud.ply")
    ends = np.arange(400).reshape(-1, 2)
    e3d.Mesh(points, lines=ends).save(folder / "lines.obj")
    e3d.Scene().save(folder / "empty.e3d.json")
    _part().save(folder / "part.stl")
    _many().save(folder / "many.e3d.json")
    (folder / "point.obj").write_text("v 1e30 0 0\nv 1e30 0 0\nv nan 0 0\nf 1 2 3\n")
    (folder / "broken.obj").write_text("v 0 0\n")
    (folder / "cut.glb").write_bytes(b"glTF\2\0\0\0")
    return sorted(folder.glob("*.*"))


def _part():
    """A plate with a pin, in millimetres."""
    scene = e3d.Scene()
    scene.add(e3d.box((80, 10, 60)))
    scene.add(e3d.cylinder(8, 40, 24), translation=(0, 20, 0))
    return scene


def _many():
    """A tree of 300 nodes with three meshes, glass among them."""
    scene, rng = e3d.Scene(), np.random.default_rng(6)
    glass = e3d.box()
    glass.materials = [e3d.Material(color=(0.3, 0.6, 1.0, 0.4), alpha_mode="blend")]
    meshes = e3d.box(), e3d.icosphere(0.5, 1), glass
    parents = [None]
    for number, place in enumerate(rng.uniform(-4, 4, (300, 3))):
        parent = parents[rng.integers(len(parents))]
        node = scene.add(meshes[number % 3], name=f"n {number}", parent=parent, translation=place)
        parents.append(node)
    return scene


def demo(name):
    """A built-in scene, to be viewed."""
    return load_demo(name, **_OPTIONS.get(name, {}))


#: All but the largest, whose pictures alone take seconds.
DEMOS = tuple(name for name in DEMO_NAMES if name != "spheres")
