"""Draws the pictures of README.md and of the documentation with engine3d itself.

    python docs/pictures/make.py               draw them all again, a few seconds each
    python docs/pictures/make.py models        only some
    python docs/pictures/make.py --check       draw, and compare with the files, pixel for pixel

In: the models of engine3d.data, the programs of docs/gallery.md. Out: one WebP a picture in this
folder: lossless, or small, with the digest of what was drawn in drawn.json. The same pixels come
out on every machine and backend; a test compares them.
"""

from __future__ import annotations

import argparse
import math
import sys
from functools import partial
from importlib.resources import files
from pathlib import Path

import gallery
import numpy as np
from digests import Digests

import engine3d as e3d
from engine3d import linalg
from engine3d.apps.golden.comparison import compare
from engine3d.apps.golden.difference_picture import difference_picture
from engine3d.apps.scenes import load_demo
from engine3d.stage.open_model import open_model
from engine3d.stage.stage_settings import Settings
from engine3d.stage.view_renderer import ViewRenderer
from engine3d.stage.viewed_scene import ViewedScene
from engine3d.stage.views.walking import controller

FOLDER = Path(__file__).resolve().parent
MODELS = files("engine3d.data") / "models"
SAMPLES = 16
PAPER = (30, 33, 40)
#: One sample of the scene as it is.
EXACT = {"look": "plain", "samples": 1, "antialiasing": "ssaa", "cull": "back"}
CAPTION = (255, 255, 255)


def load(name: str) -> e3d.Mesh:
    return e3d.load_mesh(MODELS / name)


def stand(scene, name, *, at, height, turn=0.0, up="y"):
    """Add a model, scaled to a height, turned (radians) about the vertical, on the ground."""
    mesh = load(name)
    axis = "xyz".index(up)
    low, high = mesh.bounds[:, axis]
    lift = np.zeros(3)
    lift[axis] = -low
    upright = linalg.rotation_x(-math.pi / 2 if up == "z" else 0.0)
    pose = linalg.multiply(upright, linalg.translation(lift))
    pose = linalg.multiply(linalg.scaling(height / (high - low)), pose)
    pose = linalg.multiply(linalg.rotation_y(turn), pose)
    pose = linalg.multiply(linalg.translation((at[0], 0.0, at[1])), pose)
    scene.add(mesh, name=name, pose=pose)


def add_daylight(scene):
    """A warm sun from the upper right and a faint cool light from the other side."""
    scene.ambient = e3d.linear(0.20, 0.23, 0.27)
    scene.add(
        e3d.DirectionalLight((-0.55, -0.75, -0.55), e3d.linear(1.0, 0.94, 0.82), 0.92 * math.pi)
    )
    scene.add(e3d.DirectionalLight((0.7, -0.25, 0.5), e3d.linear(0.65, 0.80, 1.0), 0.18 * math.pi))


def draw(scene, camera, size, **options) -> np.ndarray:
    """Return a picture as (H, W, 4) uint8."""
    return e3d.render(scene, camera, size=size, **{**EXACT, "samples": SAMPLES, **options}).color


def look(eye, target, yfov=0.34):
    camera = e3d.PerspectiveCamera(yfov, znear=1.0, zfar=200.0)
    return camera, linalg.look_at(eye, target)


def sheet(tiles, columns: int) -> np.ndarray:
    """Lay (caption, picture) pairs of one size out in rows."""
    height, width = tiles[0][1].shape[:2]
    rows = -(-len(tiles) // columns)
    page = np.zeros((rows * height, columns * width, 4), np.uint8)
    page[:] = (*PAPER, 255)
    for number, (_, picture) in enumerate(tiles):
        row, column = divmod(number, columns)
        page[row * height : (row + 1) * height, column * width : (column + 1) * width] = picture
    canvas = e3d.Canvas(page)
    for number, (caption, _) in enumerate(tiles):
        row, column = divmod(number, columns)
        place = (column * width + 10, row * height + 10)
        canvas.text(*place, caption, CAPTION, background=(0, 0, 0, 130))
    return page


def models() -> np.ndarray:
    """Every model of engine3d.data, as the viewer shows models."""
    scene = e3d.Scene()
    stand(scene, "island.obj", at=(0.2, 0.0), height=7.33, turn=-0.35)
    stand(scene, "nautilus.obj", at=(-8.2, -3.0), height=6.2, turn=0.1)
    stand(scene, "teapot.obj", at=(-6.8, 4.0), height=2.2, turn=0.55)
    stand(scene, "globe.obj", at=(8.3, -2.6), height=6.0, turn=0.5)
    stand(scene, "train.asc", at=(7.0, 3.6), height=2.4, turn=-0.4, up="z")
    viewed = ViewedScene(scene, "models", themed=True, azimuth=0.0, elevation=math.radians(14.0))
    settings, size = Settings(appearance={}, look="studio"), (1280, 600)
    with ViewRenderer(
        viewed, settings, size, samples=SAMPLES, antialiasing="msaa"
    ) as view_renderer:
        view = view_renderer.view(0.362)
        view_renderer.fill(view)
        return view_renderer.draw(view).color


def modes() -> np.ndarray:
    """One scene in the modes that show how it is drawn."""
    mesh = load("island.obj")
    looks = (
        ("lit", {}),
        ("wireframe", {"wireframe": "overlay", "line_color": (20, 30, 50)}),
        ("depth", {"mode": "depth"}),
        ("normal", {"mode": "normal"}),
        ("random", {"mode": "random"}),
        ("overdraw", {"mode": "overdraw"}),
    )
    tiles = []
    for name, options in looks:
        scene = e3d.Scene(background=PAPER)
        add_daylight(scene)
        scene.add(mesh)
        camera = look((6.5, 7.0, 19.0), (0.0, 1.62, 0.0), 0.5)
        tiles.append((name, draw(scene, camera, (420, 380), **options)))
    return sheet(tiles, 3)


def filters() -> np.ndarray:
    """A floor that recedes, through the three texture filters."""
    board = (np.indices((64, 64)) // 32).sum(axis=0) % 2
    pixels = np.where(board[:, :, None], np.uint8([236, 232, 222]), np.uint8([64, 84, 120]))
    tiles = []
    for name in ("nearest", "bilinear", "trilinear"):
        floor = e3d.plane((240.0, 120.0))
        floor.uvs = floor.uvs * np.float32((96, 48))
        floor.materials = [e3d.Material(texture=e3d.Texture(pixels, filter=name))]
        scene = e3d.Scene(background=PAPER)
        scene.add(floor)
        camera = look((0.0, 2.2, 30.0), (4.0, 0.0, 8.0), 0.6)
        frame = e3d.render(scene, camera, size=(420, 240), mode="unlit", **EXACT)
        tiles.append((name, frame.color))
    return sheet(tiles, 3)


def scenes() -> np.ndarray:
    """Three of the scenes of ``--scene``: point lights, the edges of a cube, its faces."""
    tiles = []
    for name, time in (("shapes", 1.1), ("edges", 0.9), ("faces", 2.1)):
        with ViewRenderer(
            load_demo(name), Settings({}, look="studio"), (420, 280), samples=SAMPLES
        ) as view_renderer:
            tiles.append((f"--scene {name}", view_renderer.draw(view_renderer.view(), time).color))
    return sheet(tiles, 3)


def ripples(size=256) -> e3d.Texture:
    """A map of normals: waves that cross."""
    v, u = np.mgrid[0:size, 0:size] * (2 * math.pi / size)
    slopes = 0.45 * np.stack(
        [linalg.cos(8 * u) * linalg.sin(8 * v), linalg.sin(8 * u) * linalg.cos(8 * v)]
    )
    normals = np.stack([-slopes[0], slopes[1], np.ones(u.shape)], axis=-1)
    normals /= linalg.length(normals)[:, :, None]
    return e3d.Texture(np.rint(127.5 + 127.5 * normals).astype(np.uint8), color_space="linear")


def materials() -> np.ndarray:
    """Physically based balls in a hall, behind panes of coloured glass that cross."""
    rows = (
        [
            {"color": e3d.linear(1.0, 0.77, 0.34), "metallic": 1.0, "roughness": r}
            for r in (0.05, 0.2, 0.4, 0.6, 0.9)
        ],
        [
            {"color": e3d.linear(0.72, 0.05, 0.04), "metallic": 0.0, "roughness": r}
            for r in (0.05, 0.2, 0.4, 0.6, 0.9)
        ],
        [
            {
                "color": e3d.linear(0.05, 0.08, 0.3),
                "roughness": 0.6,
                "clearcoat": 1.0,
                "metallic": 0.3,
            },
            {
                "color": e3d.linear(0.02, 0.1, 0.06),
                "roughness": 0.9,
                "metallic": 0.0,
                "sheen_color": e3d.linear(0.3, 0.8, 0.5),
                "sheen_roughness": 0.4,
            },
            {
                "color": e3d.linear(0.9, 0.9, 0.92),
                "metallic": 1.0,
                "roughness": 0.15,
                "normal_texture": ripples(),
            },
            {"color": e3d.linear(0.9, 0.45, 0.3), "metallic": 1.0, "roughness": 0.3},
            {
                "color": e3d.linear(0.02, 0.02, 0.02),
                "metallic": 0.0,
                "roughness": 0.1,
                "emissive": e3d.linear(0.1, 0.5, 0.9),
            },
        ],
    )
    scene = e3d.Scene(background=e3d.Environment.hall(), ambient=(0, 0, 0))
    scene.environment, scene.background_blur = scene.background, 0.35
    scene.environment_intensity = 0.6
    for row, values in enumerate(rows):
        for column, value in enumerate(values):
            ball = e3d.uv_sphere(0.46, (96, 48))
            ball.materials = [e3d.Material(**value)]
            scene.add(ball, translation=(column - 2.0, 1.0 - row, 0.0))
    reddish, bluish = e3d.linear(0.8, 0.12, 0.03, 0.5), e3d.linear(0.03, 0.2, 0.8, 0.5)
    for angle, color in ((0.5, reddish), (-0.5, bluish)):
        pane = e3d.primitives.quad(
            (-0.65, -1.55, 0), (0.65, -1.55, 0), (0.65, 1.55, 0), (-0.65, 1.55, 0)
        )
        pane.materials = [
            e3d.Material(
                color=color, roughness=0.1, metallic=0.0, alpha_mode="blend", two_sided=True
            )
        ]
        scene.add(
            pane,
            translation=(2.0, 0.0, 0.75),
            rotation=linalg.quaternion_from_axis_angle((0, 1, 0), angle),
        )
    scene.add(e3d.DirectionalLight((-0.5, -0.7, -0.6), e3d.linear(1.0, 0.95, 0.85), 1.5))
    return draw(scene, look((0.9, 0.5, 9.5), (0.05, 0.0, 0.0)), (1120, 660))


def walls() -> np.ndarray:
    """White matt walls under each light: left of the middle not physical, right of it physical."""
    matt = e3d.Material(), e3d.Material(metallic=0.0, roughness=1.0, specular_intensity=0.0)
    bright = np.linspace(0.2, 1.0, 16)[:, np.newaxis, np.newaxis] * np.ones((16, 32, 3))
    lights = {
        "directional, pi": e3d.DirectionalLight(),
        "directional, pi/2": e3d.DirectionalLight(intensity=math.pi / 2),
        "point, pi": e3d.PointLight(),
        "spot, pi": e3d.SpotLight(outer_cone_angle=0.7),
        "environment": e3d.Environment(bright[::-1]),
    }
    camera = e3d.OrthographicCamera(1.0), e3d.look_at((0, 0, 5), (0, 0, 0))
    tiles = []
    for name, light in lights.items():
        scene = e3d.Scene(background=PAPER, ambient=(0, 0, 0))
        for side, material in zip((-1, 1), matt, strict=True):
            wall = e3d.box((0.85, 1.5, 0.1))
            wall.materials = [material]
            scene.add(wall, translation=(0.425 * side, 0, -0.05))
        if isinstance(light, e3d.Environment):
            scene.environment = light
        else:
            scene.add(light, translation=(0, 0, 1))
        tiles.append((name, draw(scene, camera, (220, 220))))
    return sheet(tiles, 5)


def viewer() -> np.ndarray:
    """What the viewer's window shows: a model with its edges, grid, axes, what the file holds."""
    settings = Settings(
        {"wireframe": "overlay"}, look="studio", grid=True, axes=True, metadata=True
    )
    viewed = open_model(MODELS / "train.asc")
    with ViewRenderer(viewed, settings, (1260, 600), samples=SAMPLES) as view_renderer:
        return view_renderer.draw(view_renderer.view()).color


def city() -> np.ndarray:
    """The city as one who walks sees it, and from above."""
    tiles = []
    size, viewed = (630, 354), load_demo("city", dusk=True)
    with ViewRenderer(viewed, Settings({}, look="studio"), size, samples=4) as view_renderer:
        for caption, walks in (("--dusk --camera fps", True), ("--scene city --dusk", False)):
            view = view_renderer.view()
            if walks:
                controller(view_renderer, view).place(view)
            tiles.append((caption, view_renderer.draw(view, 1.0).color))
    return sheet(tiles, 2)


def contact_sheet() -> np.ndarray:
    """The sheet of docs/sheet.md."""
    train = MODELS / "train.asc"
    return e3d.sheets.contact_sheet(train, sections="-y=50%", size=(1500, 900)).picture.pixels


def impostors() -> np.ndarray:
    """Teapots as meshes, as their impostors, and what the impostors look like from near."""
    mesh = load("teapot.obj")
    impostor = e3d.detail.Impostor(mesh, views=10, texels=32)
    random = np.random.default_rng(3)
    poses = np.zeros((120, 4, 4))
    for number in range(len(poses)):
        turn = linalg.rotation_y(random.uniform(0, 2 * math.pi))
        row, column = divmod(number, 12)
        place = ((column - 5.5) * 5.0, 0.0, -9.0 * row)
        poses[number] = linalg.multiply(linalg.translation(place), turn)
    camera, pose = look((0.0, 60.0, 90.0), (0.0, 0.0, -36.0), yfov=0.42)
    size = (420, 280)
    tiles = []
    for caption, zoom, card in (
        ("716,640 triangles", 1, None),
        ("as impostors", 1, impostor),
        ("the same from near", 4, impostor),
    ):
        teapots = e3d.detail.DetailedInstances(
            [(mesh, 0.0)], poses, impostor=card, impostor_pixels=1000.0
        )
        scene = e3d.Scene(background=(196, 211, 222))
        add_daylight(scene)
        teapots.add_to(scene)
        teapots.update(camera, pose, size)
        near = e3d.PerspectiveCamera(0.42 / zoom, znear=1.0, zfar=300.0)
        tiles.append((caption, draw(scene, (near, pose), size)))
    return sheet(tiles, 3)


def golden() -> np.ndarray:
    """A golden picture, one in which a ball has moved a little, and where they differ."""
    tiles = []
    for caption, x in (("golden", 2.3), ("drawn now", 2.32)):
        scene = e3d.Scene(background=(196, 211, 222))
        add_daylight(scene)
        stand(scene, "teapot.obj", at=(-0.5, 0.0), height=2.2, turn=0.4)
        ball = e3d.uv_sphere(0.6)
        ball.materials = [e3d.Material(color=(196, 40, 40))]
        scene.add(ball, translation=(x, 0.6, 1.2))
        tiles.append((caption, draw(scene, look((2.0, 5.0, 14.0), (0.2, 1.0, 0.0)), (420, 300))))
    drawn, now = tiles[0][1], tiles[1][1]
    return sheet([*tiles, ("difference", difference_picture(drawn, compare(now, drawn)))], 3)


PICTURES = {
    "models": models,
    "modes": modes,
    "filters": filters,
    "scenes": scenes,
    "materials": materials,
    "walls": walls,
    "viewer": viewer,
    "city": city,
    "impostors": impostors,
    "golden": golden,
    "sheet": contact_sheet,
    **{name: partial(gallery.draw, name) for name in gallery.programs()},
}
#: Those that are compressed, of which drawn.json has digests.
SMALL = ("models", "sheet", *gallery.programs())
QUALITY = 82
DIGESTS = Digests(FOLDER / "drawn.json")


def save(picture: np.ndarray, name: str) -> None:
    from PIL import Image

    how = {"quality": QUALITY} if name in SMALL else {"lossless": True, "quality": 100}
    path = FOLDER / f"{name}.webp"
    Image.fromarray(picture[:, :, :3]).save(path, method=6, **how)
    print(f"{path.name}: {picture.shape[1]}x{picture.shape[0]}, {path.stat().st_size:,} bytes")
    if name in SMALL:
        DIGESTS.record(name, picture)


def differs(picture: np.ndarray, name: str) -> bool:
    """Whether a file shows anything else than a picture."""
    from PIL import Image

    if name in SMALL:
        return not DIGESTS.knows(name, picture)
    with Image.open(FOLDER / f"{name}.webp") as image:
        return not np.array_equal(np.asarray(image.convert("RGB")), picture[:, :, :3])


def main() -> int:
    parser = argparse.ArgumentParser(description="Draw the pictures of the documentation.")
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(PICTURES))
    parser.add_argument("--check", action="store_true", help="compare with the files instead")
    arguments = parser.parse_args()
    unknown = set(arguments.names) - set(PICTURES)
    if unknown:
        parser.error(f"no such picture: {', '.join(sorted(unknown))}")
    stale = []
    for name in arguments.names or PICTURES:
        picture = PICTURES[name]()
        if not arguments.check:
            save(picture, name)
        elif differs(picture, name):
            stale.append(f"{name}.webp")
    if stale:
        print(f"not what the engine draws: {', '.join(stale)}", file=sys.stderr)
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
