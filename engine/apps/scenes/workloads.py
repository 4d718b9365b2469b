"""The benchmark scenes, with cameras that move slightly every frame.

In:  a name of `SCENES`, and whether the picture is plain.
Out: a `Workload`. The plain picture is what every renderer can draw alike: 8-bit values as they
     are, bilinear textures without mip levels, matte surfaces. Meshes stand in world coordinates,
     instances are offsets and scales, so that a peer needs no tree of nodes.
"""

from __future__ import annotations

import functools
from dataclasses import dataclass, field
from importlib.resources import files
from pathlib import Path

import numpy as np

from ...base import linalg
from ...errors import InvalidArgumentError
from ...extras.worlds import city
from ...io.loaders import load_mesh, load_texture
from ...model.geometry.mesh import Mesh
from ...model.materials.linear_colors import linear
from ...model.materials.material import Material
from ...model.materials.textures import Texture
from ...model.primitives import cylinder, plane, quad, torus, uv_sphere
from ...model.scene.cameras import PerspectiveCamera
from ...model.scene.instances import InstancedMesh
from ...model.scene.lights import DirectionalLight
from ...model.scene.scene import Scene
from . import SCENES, city_views

MODELS = Path(str(files("engine3d.data"))) / "models"
CITY_TRIANGLES = 1_000_000
LIGHTS = 256
LAYERS = 32
GRID_SIDE = 12
SPHERES_SIDE = 34
#: Maximum motion of the camera, as a fraction of its distance from the target.
HAIR = 1e-4


@dataclass
class Workload:
    """A scene and how to draw it.

    Attributes
    ----------
    name : str
    scene : Scene
    camera : PerspectiveCamera
    eye, target : (3,) float64
    options : dict
        For `Renderer.render`; ``outputs`` names one output.
    color_space : str
        For `Renderer`.
    """

    name: str
    scene: Scene
    camera: PerspectiveCamera
    eye: np.ndarray
    target: np.ndarray
    options: dict = field(default_factory=dict)
    color_space: str = "srgb"

    def view(self, frame: int) -> tuple[PerspectiveCamera, np.ndarray]:
        """Return the ``camera`` argument of `Renderer.render`, slightly moved every frame."""
        hair = np.array((frame % 7 - 3, frame % 5 - 2, frame % 3 - 1), np.float64)
        distance = float(linalg.length(self.target - self.eye))
        return self.camera, linalg.look_at(self.eye + HAIR / 3 * distance * hair, self.target)

    @property
    def output(self) -> str:
        """The output that is delivered."""
        return self.options.get("outputs", ("color",))[0]

    @property
    def triangles(self) -> int:
        """Number of triangles, including instances."""
        return sum(_triangles(node.object) for node in self.scene.nodes)


def _triangles(thing) -> int:
    if isinstance(thing, InstancedMesh):
        return len(thing) * len(thing.mesh.faces)
    return len(thing.faces) if isinstance(thing, Mesh) else 0


def make(name: str, plain: bool = False) -> Workload:
    """Return a workload by its name, one of `WORKLOAD_NAMES`; plain: one of `PLAIN_NAMES`."""
    if plain and not SCENES[name].plain:
        raise InvalidArgumentError(f"there is no plain picture of {name}")
    return _workload(name, globals()[SCENES[name].measured](plain), plain)


def _workload(name: str, parts, plain: bool = False) -> Workload:
    """Build a workload from a scene, (eye, target, (yfov, znear, zfar)), and options."""
    scene, (eye, target, (yfov, near, far)), options = parts
    return Workload(
        name,
        scene,
        PerspectiveCamera(yfov, znear=near, zfar=far),
        np.array(eye, np.float64),
        np.array(target, np.float64),
        options,
        "linear" if plain else "srgb",
    )


def layers(count: int) -> Workload:
    """Return a number of walls that fill the picture, back to front."""
    return _workload("layers", fill_front(False, count, back_to_front=True))


def spheres_on_a_plane(side: int) -> Workload:
    """Return ``side * side`` instances of a sphere of 1,000 triangles, all side by side in view."""
    scene = _scene()
    poses = _rows(side, 2.0 / side, 0.95 / side)[:, [0, 2, 1, 3]]
    scene.add(InstancedMesh(uv_sphere(1.0, (25, 21)), poses))
    view = (0.0, 0.0, 2.6), (0.0, 0.0, 0.0), (0.8, 0.5, 10.0)
    return _workload("spheres on a plane", (scene, view, {}))


def _scene() -> Scene:
    scene = Scene(background=(26, 31, 38), ambient=linear(0.2, 0.2, 0.2))
    scene.add(DirectionalLight((-0.4, -0.7, -0.6), linear(0.8, 0.8, 0.8)))
    return scene


def _matte(materials) -> list[Material]:
    """Return materials with only colour and texture, filtered without mip levels."""
    matte = functools.cache(lambda texture: Texture(texture.pixels, filter="bilinear"))
    return [
        Material(color=one.color, texture=one.texture and matte(one.texture)) for one in materials
    ]


def textured(plain):
    scene = _scene()
    mesh = load_mesh(MODELS / "teapot.obj")
    if plain:
        mesh.materials = _matte(mesh.materials)
    scene.add(mesh)
    return scene, ((0.2, 3.4, 7.0), (0.2, 1.4, 0.0), (0.6, 1.0, 30.0)), {}


@functools.cache
def bumpy_sphere() -> Mesh:
    """Return 70,200 similar triangles, as in a scanned figure; the radius is at most 1."""
    sphere = uv_sphere(1.0, (270, 131))
    x, y, z = sphere.positions.astype(np.float64).T
    bumps = 0.88 + 0.08 * linalg.sin(7.0 * x + 3.0 * y) + 0.04 * linalg.sin(17.0 * z - 9.0 * y)
    return Mesh(
        sphere.positions * bumps[:, np.newaxis], sphere.faces, position_ids=sphere.position_ids
    )


def mesh(plain):
    scene = _scene()
    scene.add(bumpy_sphere())
    return scene, ((0.3, 0.4, 2.9), (0.0, 0.0, 0.0), (0.66, 0.5, 10.0)), {}


def grid(plain, output="color"):
    scene = _scene()
    scene.add(InstancedMesh(bumpy_sphere(), _rows(GRID_SIDE, 1.35, 0.62)))
    eye, target = (0.0, 1.05 * GRID_SIDE, 1.25 * GRID_SIDE), (0.0, 0.0, 0.12 * GRID_SIDE)
    return scene, (eye, target, (0.7, 1.0, 100.0)), {"outputs": (output,)}


def _rows(side, pitch, scale):
    """Return a flat grid of (N, 4) poses, front rows first."""
    places = (np.arange(side) - (side - 1) / 2) * pitch
    z, x = np.meshgrid(places[::-1], places, indexing="ij")
    return np.stack([x, 0 * x, z, 0 * x + scale], axis=-1).reshape(-1, 4)


@functools.cache
def _city(plain):
    world = city(CITY_TRIANGLES)
    if plain:
        materials = _matte(world.materials)
        for mesh in world.districts:
            mesh.materials = materials
    return world


def city_street(plain, lights=0):
    scene, _ = city_views.city_scene(_city(plain), lights)
    return scene, (city_views.START, city_views.TARGET, (1.0, 0.1, 4000.0)), {}


def city_above(plain):
    scene, _ = city_views.city_scene(_city(plain), 0)
    return scene, (city_views.ABOVE, city_views.ABOVE_TARGET, (0.9, 5.0, 6000.0)), {}


def city_occlusion(plain):
    scene, view, options = city_street(plain)
    return scene, view, {**options, "ambient_occlusion": True}


def _turned(radii, height, around=96) -> Mesh:
    """Return a surface of revolution about the Y axis, from its radii at evenly spaced heights."""
    turns = 2 * np.pi / around * np.arange(around)
    rows = np.linspace(0.0, height, len(radii))[:, np.newaxis] + 0.0 * turns
    radii = np.asarray(radii)[:, np.newaxis]
    positions = np.stack([radii * linalg.cos(turns), rows, radii * linalg.sin(turns)], axis=-1)
    corner = np.arange(rows.size).reshape(rows.shape)
    here, over = corner[:-1], corner[1:]
    beside, across = np.roll(here, -1, 1), np.roll(over, -1, 1)
    faces = np.stack([here, over, across, here, across, beside], axis=-1)
    return Mesh(positions.reshape(-1, 3), faces.reshape(-1, 3))


def glass(plain):
    """Return glass that bends what is behind it, and panes that tint it, on a globe's map."""
    scene = _scene()
    ground = plane((12.0, 12.0))
    ground.materials = [Material(texture=load_texture(MODELS / "globe.webp"))]
    scene.add(ground)
    heights = np.linspace(0.0, 1.0, 48)
    vase = _turned(0.42 + 0.2 * linalg.sin(5.0 * heights) - 0.15 * heights, 1.8)
    vase.materials = [Material(transmission=1.0, thickness=0.3, roughness=0.0, metallic=0.0)]
    scene.add(vase, translation=(-0.9, 0.0, 0.0))
    blue = Material(
        transmission=1.0,
        thickness=0.5,
        roughness=0.2,
        metallic=0.0,
        attenuation_color=linear(0.3, 0.5, 0.9),
        attenuation_distance=0.5,
    )
    foot, stem = torus(0.35, 0.12), cylinder(0.2, 0.9)
    foot.materials = stem.materials = [blue]
    scene.add(foot, translation=(0.9, 0.12, 0.5), rotation=(0.5**0.5, 0.0, 0.0, 0.5**0.5))
    scene.add(stem, translation=(0.9, 0.45, 0.5))
    pane = quad()
    pane.materials = [Material(color=(120, 190, 160, 70), alpha_mode="blend", two_sided=True)]
    scene.add(InstancedMesh(pane, _rows(8, 0.6, 0.9) + (0.0, 0.5, -2.8, 0.0)))
    return scene, ((0.0, 1.7, 4.4), (0.0, 0.7, 0.0), (0.7, 0.1, 40.0)), {}


def fill_front(plain, count=LAYERS, back_to_front=False):
    """Return walls that fill the picture as one mesh."""
    distance = np.linspace(2.0, 40.0, count)
    distance = distance[::-1] if back_to_front else distance
    corners = np.array([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)])
    positions = np.empty((count, 4, 3))
    positions[:, :, :2] = corners * (1.6 * distance[:, np.newaxis, np.newaxis])
    positions[:, :, 2] = -distance[:, np.newaxis]
    quads = 4 * np.arange(count)[:, np.newaxis, np.newaxis] + [(0, 1, 2), (0, 2, 3)]
    materials = [Material(texture=load_texture(MODELS / "globe.webp"))]
    mesh = Mesh(
        positions.reshape(-1, 3),
        quads.reshape(-1, 3),
        uvs=np.tile(2.0 * (corners + 1.0), (count, 1)),
        materials=_matte(materials) if plain else materials,
    )
    scene = _scene()
    scene.add(mesh)
    return scene, ((0.0, 0.0, 0.0), (0.0, 0.0, -10.0), (1.0, 0.5, 100.0)), {"mode": "unlit"}


def _spheres(plain, view):
    places = np.arange(SPHERES_SIDE) - (SPHERES_SIDE - 1) / 2
    grid = np.stack(np.meshgrid(places, places, places, indexing="ij"), axis=-1).reshape(-1, 3)
    poses = np.column_stack([grid, np.full(len(grid), 0.33)])
    colors = 60 + 190 * (grid - grid[0]) / (SPHERES_SIDE - 1)
    scene = _scene()
    sphere = uv_sphere(1.0, (16, 12))
    scene.add(InstancedMesh(sphere, poses, colors=colors.astype(np.uint8)))
    return scene, view, {}


grid_depth = functools.partial(grid, output="ndc_depth")
grid_ids = functools.partial(grid, output="instance_id")
city_lights = functools.partial(city_street, lights=LIGHTS)
fill_back = functools.partial(fill_front, back_to_front=True)
spheres = functools.partial(_spheres, view=((34, 26, 44), (0, 0, 0), (0.94, 1.0, 150.0)))
spheres_inside = functools.partial(
    _spheres, view=((4.5, 2.5, 3.5), (-2, -1, -17), (0.7, 0.2, 80.0))
)
