"""Resources that are loaded once, transforms, and a tree of nodes: Sun, Earth and Moon."""

import math
import weakref
from pathlib import Path

import numpy as np

import engine3d as e3d
from lesson import MODELS, main, told

multiply = e3d.linalg.multiply
TEAPOT = MODELS / "teapot.obj"
#: Four whole samples a pixel, of the scene as it is.
EXACT = {"look": "plain", "samples": 4, "antialiasing": "ssaa", "cull": "back"}


class Resources:
    """Files that are loaded once: asked for again, the same object comes back."""

    def __init__(self, load):
        self.load, self.known, self.loads = load, weakref.WeakValueDictionary(), 0

    def get(self, path):
        """Return what a file holds; it is forgotten when nobody holds it any more."""
        key = Path(path).resolve()
        resource = self.known.get(key)
        if resource is None:
            resource = self.known[key] = self.load(key)
            self.loads += 1
        return resource


class Transform:
    """Where something is in the space of its parent: scale, then turn about y, then move."""

    def __init__(self, place=(0.0, 0.0, 0.0), turn=0.0, scale=1.0):
        self.place, self.turn, self.scale = place, turn, scale

    def matrix(self):
        return multiply(
            e3d.linalg.translation(self.place),
            e3d.linalg.rotation_y(self.turn),
            e3d.linalg.scaling(self.scale),
        )


class Node:
    """A transform, a parent, children; the world matrix is kept until something above changes."""

    products = 0  # of matrices, by all nodes

    def __init__(self, parent=None, **transform):
        self.transform, self.parent, self.children = Transform(**transform), parent, []
        self.world = None
        if parent:
            parent.children.append(self)

    def set(self, **changes):
        """Change the transform; this node and all below it are out of date."""
        for name, value in changes.items():
            setattr(self.transform, name, value)
        self.outdate()

    def outdate(self):
        if self.world is not None:
            self.world = None
            for child in self.children:
                child.outdate()

    def world_matrix(self):
        """Return world-from-node: the parent's, times one's own."""
        if self.world is None:
            own = self.transform.matrix()
            if self.parent:
                Node.products += 1
                own = multiply(self.parent.world_matrix(), own)
            self.world = own
        return self.world


def make_system():
    """Return the nodes by name. Orbits turn; what hangs below them is carried along."""
    system = {"sun": Node()}
    system["sun ball"] = Node(system["sun"], scale=1.0)
    system["earth orbit"] = Node(system["sun"])
    system["earth"] = Node(system["earth orbit"], place=(3.2, 0.0, 0.0))
    system["earth ball"] = Node(system["earth"], scale=0.45)
    system["moon orbit"] = Node(system["earth"])
    system["moon"] = Node(system["moon orbit"], place=(0.9, 0.0, 0.0), scale=0.16)
    return system


def seek(system, days):
    """Put everything where it is on a day."""
    full = 2 * 3.141592653589793
    system["earth orbit"].set(turn=full * days / 365.25)
    system["earth ball"].set(turn=full * (days % 1.0))
    system["moon orbit"].set(turn=full * (days / 27.3 % 1.0))


BALLS = {
    "sun ball": e3d.linear(1.0, 0.75, 0.2),
    "earth ball": e3d.linear(0.25, 0.5, 1.0),
    "moon": e3d.linear(0.75, 0.75, 0.72),
}


def draw(poses, width, height):
    """Return the engine's picture of balls at the given world matrices."""
    scene = e3d.Scene(background=(8, 9, 16), ambient=e3d.linear(0.05, 0.05, 0.08))
    scene.add(e3d.PointLight(intensity=9.0 * math.pi), translation=(0.0, 0.0, 0.0))
    for name, pose in poses.items():
        ball = e3d.uv_sphere(1.0, (24, 12))
        glow = BALLS[name] if name == "sun ball" else (0, 0, 0)
        ball.materials = [e3d.Material(color=BALLS[name], emissive=glow)]
        scene.add(ball, pose=pose)
    camera = e3d.PerspectiveCamera(0.6, znear=1.0, zfar=40.0), e3d.look_at((0, 7, 10), (0, 0, 0))
    return e3d.render(scene, camera, size=(width, height), **EXACT).color[:, :, :3]


def engine_poses(days):
    """Return the world matrices of the engine's own tree of nodes."""
    scene, nodes = e3d.Scene(), {}
    full = 2 * 3.141592653589793
    sun = scene.add()
    nodes["sun ball"] = scene.add(parent=sun)
    orbit = scene.add(parent=sun, euler=(0, full * days / 365.25, 0))
    earth = scene.add(parent=orbit, translation=(3.2, 0, 0))
    nodes["earth ball"] = scene.add(parent=earth, euler=(0, full * (days % 1.0), 0), scale=0.45)
    moon_orbit = scene.add(parent=earth, euler=(0, full * (days / 27.3 % 1.0), 0))
    nodes["moon"] = scene.add(parent=moon_orbit, translation=(0.9, 0, 0), scale=0.16)
    return {name: node.world_pose for name, node in nodes.items()}


def share():
    """Load a model three times through the resources."""
    resources = Resources(e3d.load_mesh)
    one, two, three = (resources.get(TEAPOT) for _ in range(3))
    assert one is two is three
    print(f"asked for 3 times, loaded {resources.loads} time")
    del one, two, three
    print(f"kept when nobody holds it: {len(resources.known)}")


def steps(width=240, height=150, days=40):
    """Show the system on five days; days: from one to the next."""
    system, apart = make_system(), days
    for days in (0.0, 1.0 * apart, 2.0 * apart, 3.0 * apart, 5.0 * apart):
        Node.products = 0
        seek(system, days)
        poses = {name: system[name].world_matrix() for name in BALLS}
        worst = max(np.abs(poses[name] - pose).max() for name, pose in engine_poses(days).items())
        caption = "day {day:.0f}: {count} products of matrices; the engine's poses {agree}"
        agrees = "agree" if worst < 1e-12 else "differ"
        caption = told(caption, day=days, count=Node.products, agree=agrees)
        yield caption, draw(poses, width, height)
    Node.products = 0
    system["moon orbit"].set(turn=1.0)
    poses = {name: system[name].world_matrix() for name in BALLS}
    caption = told("only the moon moved: {count} products", count=Node.products)
    yield caption, draw(poses, width, height)


if __name__ == "__main__":
    main(__file__, steps, share=share)
