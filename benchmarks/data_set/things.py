"""The scenes of a data set: a few things on a ground, in a light, seen from somewhere.

Everything follows from the task's seed: which things there are, where they lie, what they are made
of, where the light and the camera are. `things.json` lists the thousand pictures;
docs/batches.md tells how to draw them and what comes out.
"""

from importlib.resources import as_file, files

import engine3d as e3d
from engine3d.batch import load_mesh
from engine3d.datasets import (
    random_camera,
    random_light,
    random_material,
    random_pose,
    random_texture,
    scatter,
)

CATEGORIES = ("ball", "box", "can", "ring", "teapot")
HALF = 2.0  # of the ground's side


def build(scene, generator, most=6):
    """Fill a scene; return which node is what, and the camera."""
    scene.background = e3d.Gradient((150, 180, 215), (225, 230, 235))
    scene.ambient = e3d.linear(0.25, 0.25, 0.25)
    add_ground(scene, generator.fork("ground"))
    count = generator.fork("count").integer(3, most + 1)
    radii = [generator.fork("size", number).uniform(0.25, 0.55) for number in range(count)]
    labels = {}
    for number, place in enumerate(scatter(generator.fork("places"), radii, HALF)):
        if place is not None:
            thing = generator.fork("thing", number)
            category = thing.choice(CATEGORIES)
            labels[add_thing(scene, thing, category, radii[number], place)] = category
    scene.add(random_light(generator.fork("light"), shadow="exact"))
    camera = random_camera(generator.fork("camera"), scene, distance=(0.55, 0.8), yfov=(0.6, 0.8))
    return {"labels": labels, "camera": camera}


def add_ground(scene, generator):
    """Add a square with a pattern."""
    ground = e3d.plane((2 * HALF, 2 * HALF))
    texture = random_texture(generator)
    ground.materials = (e3d.Material(texture=texture, metallic=0.0, roughness=0.9),)
    scene.add(ground, name="ground")


def add_thing(scene, generator, category, radius, place):
    """Add a thing that fills a ball of some radius which lies on the ground; return its node."""
    x, z = place
    if category == "teapot":
        with as_file(files("engine3d.data") / "models" / "teapot.obj") as path:
            mesh = load_mesh(path)
        low, high = mesh.bounds
        scale = 2.0 * radius / max(high - low)
        pose = random_pose(generator, upright=True)
        node = scene.add(mesh, pose=pose, name=category)
        node.scale = scale
        node.translation = (x, -low[1] * scale, z)
        return node
    mesh = {
        "ball": lambda: e3d.icosphere(radius),
        "box": lambda: e3d.box(1.1 * radius),
        "can": lambda: e3d.cylinder(0.6 * radius, 1.4 * radius),
        "ring": lambda: e3d.torus(0.7 * radius, 0.25 * radius),
    }[category]()
    mesh.materials = (random_material(generator),)
    return scene.add(mesh, pose=random_pose(generator, *2 * [(x, radius, z)]), name=category)
