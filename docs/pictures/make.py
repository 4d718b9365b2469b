"""Draws the pictures of README.md and of the documentation with engine3d itself.

    python docs/pictures/make.py               draw them all again, a few seconds each
    python docs/pictures/make.py models        only some
    python docs/pictures/make.py --check       draw, and compare with the files, pixel for pixel

In: the models of data/models, the programs of docs/gallery.md. Out: one WebP a picture in this
folder: lossless, or small, with the digest of what was drawn in drawn.json; an SVG for each drawing
of vectors.py. The same pixels and texts come out on every machine and backend; a test compares
them.
"""

from __future__ import annotations

import argparse
import math
import sys
from dataclasses import replace
from functools import partial
from pathlib import Path

import gallery
import numpy as np
from digests import Digests
from places import MODELS
from vectors import SIZE, VECTORS
from windows import WINDOWS

import engine3d as e3d
from engine3d import linalg
from engine3d.apps.agents.pictures import Request
from engine3d.apps.agents.server_limits import Limits
from engine3d.apps.agents.session import Session
from engine3d.apps.golden.comparison import compare
from engine3d.apps.golden.difference_picture import difference_picture
from engine3d.apps.scenes import load_demo
from engine3d.stage.open_model import open_model
from engine3d.stage.stage_settings import Settings
from engine3d.stage.view_renderer import ViewRenderer
from engine3d.stage.viewed_scene import ViewedScene
from engine3d.stage.views.walking import controller

FOLDER = Path(__file__).resolve().parent
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
    """A floor that recedes, through the texture filters."""
    board = (np.indices((64, 64)) // 32).sum(axis=0) % 2
    pixels = np.where(board[:, :, None], np.uint8([236, 232, 222]), np.uint8([64, 84, 120]))
    textures = {
        "nearest": e3d.Texture(pixels, filter="nearest"),
        "bilinear": e3d.Texture(pixels, filter="bilinear"),
        "trilinear": e3d.Texture(pixels),
        "anisotropy=16": e3d.Texture(pixels, anisotropy=16),
    }
    tiles = []
    for name, texture in textures.items():
        floor = e3d.plane((240.0, 120.0))
        floor.uvs = floor.uvs * np.float32((96, 48))
        floor.materials = [e3d.Material(texture=texture)]
        scene = e3d.Scene(background=(196, 211, 222))
        scene.add(floor)
        camera = look((0.0, 2.2, 30.0), (4.0, -0.6, 8.0), 0.4)
        frame = e3d.render(scene, camera, size=(630, 200), mode="unlit", **EXACT)
        tiles.append((name, frame.color))
    return sheet(tiles, 2)


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


def balls() -> dict[str, dict]:
    """The materials of `materials`: what stands below each, and its values."""
    gold, red = e3d.linear(1.0, 0.77, 0.34), e3d.linear(0.45, 0.02, 0.02)
    smooth = (0.0, 0.25, 0.5, 0.75, 1.0)
    rough = {f"metal, roughness {r:g}": {"metallic": 1.0, "roughness": r} for r in smooth}
    matt = {f"roughness {r:g}": {"metallic": 0.0, "roughness": r} for r in smooth}
    return {
        **{name: {"color": gold, **values} for name, values in rough.items()},
        **{name: {"color": red, **values} for name, values in matt.items()},
        "clearcoat": {
            "color": e3d.linear(0.03, 0.06, 0.3),
            "roughness": 0.6,
            "metallic": 0.3,
            "clearcoat": 1.0,
        },
        "sheen": {
            "color": e3d.linear(0.01, 0.08, 0.05),
            "roughness": 0.9,
            "metallic": 0.0,
            "sheen_color": e3d.linear(0.3, 0.8, 0.5),
            "sheen_roughness": 0.4,
        },
        "normal map": {
            "color": e3d.linear(0.9, 0.9, 0.92),
            "metallic": 1.0,
            "roughness": 0.15,
            "normal_texture": ripples(),
        },
        "anisotropy": {
            "color": e3d.linear(0.9, 0.5, 0.35),
            "metallic": 1.0,
            "roughness": 0.4,
            "anisotropy": 0.9,
        },
        "iridescence": {
            "color": e3d.linear(0.5, 0.5, 0.52),
            "metallic": 1.0,
            "roughness": 0.15,
            "iridescence": 1.0,
        },
    }


def materials() -> np.ndarray:
    """Physically based balls in a studio, each with what makes it."""
    scene = e3d.Scene(background=e3d.Gradient((70, 75, 84), (42, 46, 53)), ambient=(0, 0, 0))
    scene.environment = e3d.Environment.studio()
    for number, values in enumerate(balls().values()):
        row, column = divmod(number, 5)
        ball = e3d.uv_sphere(0.4, (96, 48)).with_tangents()
        ball.materials = [e3d.Material(**values)]
        scene.add(ball, translation=(column - 2.0, 1.04 - row, 0.0))
    scene.add(e3d.DirectionalLight((-0.5, -0.7, -0.6), e3d.linear(1.0, 0.95, 0.85), 1.5))
    camera = e3d.OrthographicCamera(1.5), e3d.look_at((0, 0, 5), (0, 0, 0))
    picture = draw(scene, camera, (1120, 660), tone_mapping="neutral")
    canvas = e3d.Canvas(picture)
    for number, name in enumerate(balls()):
        row, column = divmod(number, 5)
        canvas.text(120 + 220 * column - 4 * len(name), 197 + 220 * row, name, CAPTION)
    return picture


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


def surface(size, **values) -> e3d.Mesh:
    mesh = e3d.plane(size) if len(size) == 2 else e3d.box(size)
    mesh.materials = [e3d.Material(**values)]
    return mesh


def furnished(**floor) -> e3d.Scene:
    """A teapot and other things before a wall, in the sun."""
    scene = e3d.Scene(background=(150, 175, 205), ambient=e3d.linear(0.35, 0.37, 0.42))
    scene.add(surface((6, 5), **floor), translation=(0, 0, 0.6))
    scene.add(surface((6, 3, 0.1), color=(205, 190, 170)), translation=(0, 1.5, -1.56))
    stand(scene, "teapot.obj", at=(-0.8, -0.1), height=0.7, turn=0.6)
    gold = e3d.icosphere(0.3, 5)
    gold.materials = [e3d.Material(color=(255, 200, 90), metallic=1.0, roughness=0.35)]
    scene.add(gold, translation=(0.3, 0.3, 0.5))
    scene.add(surface((0.5, 0.5, 0.5), color=(60, 110, 190)), translation=(1.1, 0.25, -0.3))
    sun = e3d.DirectionalLight((-0.5, -1.0, -0.7), e3d.linear(1.0, 0.95, 0.85), 2.2)
    sun.shadow = "exact"
    scene.add(sun)
    return scene


def mirrors() -> np.ndarray:
    """A mirror on a wall, and a floor that is polished."""
    camera = e3d.PerspectiveCamera(0.62), e3d.look_at((-1.2, 1.5, 5.2), (0.1, 0.75, 0.0))
    hung = furnished(color=(150, 120, 95))
    frame = surface((2.5, 1.7, 0.05), color=(95, 60, 35), metallic=0.0, roughness=0.5)
    hung.add(frame, translation=(0.3, 1.0, -1.48))
    pane = surface((2.3, 1.5), color=(235, 240, 240), mirror=0.95)
    hung.add(pane, pose=linalg.translation((0.3, 1.0, -1.45)) @ linalg.rotation_x(math.pi / 2))
    floor = {"color": (60, 45, 40), "metallic": 0.0, "roughness": 0.2, "ior": 2.0}
    polished = furnished(**floor, mirror=1.0)
    tiles = [
        (name, draw(scene, camera, (470, 320), ambient_occlusion=True))
        for name, scene in (("mirror=0.95", hung), ("a physical floor, mirror=1", polished))
    ]
    return sheet(tiles, 2)


def lenses() -> np.ndarray:
    """The island from one place, through lenses of several kinds."""
    scene = e3d.Scene(background=(140, 178, 214), ambient=(0.35, 0.37, 0.4))
    scene.add(load("island.obj"))
    sun = e3d.DirectionalLight((0.35, -1.0, -0.6), e3d.linear(1.0, 0.96, 0.9), 2.4)
    sun.shadow = "exact"
    scene.add(sun)
    pose = e3d.look_at((0.5, 1.5, 2.2), (0.0, 1.2, 0.0))
    size = (420, 320)
    lens = {
        "fisheye, 220 degrees": e3d.FisheyeCamera(
            82, 82, 210, 160, (-0.01, 0.0, 0.0, 0.0), max_angle=math.radians(110)
        ),
        "equirectangular": e3d.EquirectangularCamera(),
        "cylindrical, 200 degrees": e3d.CylindricalCamera(xfov=math.radians(200), yfov=1.6),
        "pinhole": e3d.IntrinsicsCamera(230, 230, 210, 160),
        "Brown-Conrady": e3d.BrownConradyCamera(230, 230, 210, 160, (-0.28, 0.08, 0.0, 0.0, 0.0)),
        "double sphere": e3d.DoubleSphereCamera(130, 130, 210, 160, -0.2, 0.6),
    }
    return sheet([(name, draw(scene, (camera, pose), size)) for name, camera in lens.items()], 3)


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
        for caption, walks in (("--dusk --camera fps", True), ("from above", False)):
            view = view_renderer.view()
            if walks:
                controller(view_renderer, view).place(view)
            else:
                view.target, view.distance = np.array([14.0, 0.0, -24.0]), 350.0
                view.azimuth, view.elevation = math.radians(125.0), math.radians(38.0)
            tiles.append((caption, view_renderer.draw(view, 1.0).color))
    return sheet(tiles, 2)


def contact_sheet() -> np.ndarray:
    """The sheet of docs/sheet.md."""
    train = MODELS / "train.asc"
    return e3d.sheets.contact_sheet(train, sections="-y=50%", size=(1500, 900)).picture.pixels


def beside_lines() -> np.ndarray:
    """The view of vectors.py's line drawing, in pixels."""
    return e3d.render(MODELS / "train.asc", size=SIZE).color


def agents() -> np.ndarray:
    """What an agent gets by the tools of docs/agents.md."""
    session = Session(Limits(root=str(MODELS)))
    session.load("train.asc")
    session.edit("train/Smoke", {"visible": False})
    side = {"azimuth": 60, "elevation": 16}
    requests = {
        "render labels=true": Request(labels=True),
        'section={"axis": "y"}': Request(view=side, section={"axis": "y"}),
        'highlight=[{"object": "train/Boiler"}]': Request(
            view=side, highlight=[{"object": "train/Boiler"}]
        ),
        'view="train/Cab" look="ids"': Request(view="train/Cab", look="ids"),
    }
    tiles = []
    for caption, request in requests.items():
        drawn = session.studio.draw(session.things, replace(request, size=[560, 400]))
        tiles.append((caption, drawn.pixels))
    return sheet(tiles, 2)


def impostors() -> np.ndarray:
    """A field of teapots as meshes, and with impostors where nobody can tell."""
    mesh = load("teapot.obj")
    impostor = e3d.detail.Impostor(mesh, views=12, texels=64)
    random = np.random.default_rng(3)
    poses = np.zeros((360, 4, 4))
    for number in range(len(poses)):
        turn = linalg.rotation_y(random.uniform(0, 2 * math.pi))
        row, column = divmod(number, 18)
        place = ((column - 8.5) * 7.0, 0.0, -8.0 * row)
        poses[number] = linalg.multiply(linalg.translation(place), turn)
    camera, pose = look((6.0, 16.0, 26.0), (0.0, -6.0, -36.0), yfov=0.6)
    size, tiles = (630, 340), []
    for card in (None, impostor):
        teapots = e3d.detail.DetailedInstances(
            [(mesh, 0.0)], poses, impostor=card, impostor_pixels=8.0
        )
        scene = e3d.Scene(background=(196, 211, 222))
        add_daylight(scene)
        teapots.add_to(scene)
        teapots.update(camera, pose, size)
        meshes = int(np.count_nonzero(teapots.level == 0))
        caption = f"{meshes} meshes" + ("" if card is None else f", {360 - meshes} impostors")
        tiles.append((caption, draw(scene, (camera, pose), size)))
    return sheet(tiles, 2)


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


#: Of the picture of docs/urdf.md: where the arm's joints stand, radians and metres.
ARM_POSES = (
    {},
    {"lift": 0.7, "elbow": 1.5, "wrist": 0.7, "grip": 0.06},
    {"turn": 1.1, "lift": -0.6, "elbow": 1.9, "wrist": 0.9, "grip": 0.02},
)


def robot() -> np.ndarray:
    """The arm of docs/urdf.md in three poses."""
    pictures = []
    for joints in ARM_POSES:
        scene = e3d.load(FOLDER / "robot.urdf", joints=joints)
        camera, pose = look((2.7, 2.3, 5.6), (0.25, 1.15, 0.0), 0.46)
        pictures.append(e3d.render(scene, (camera, pose), size=(420, 460), samples=SAMPLES).color)
    return np.hstack(pictures)


def sensors() -> np.ndarray:
    """A stereo pair with its disparity, optical flow with its mask, and a LiDAR's points."""
    scene, size = e3d.Scene(background=(150, 185, 215)), (320, 240)
    stand(scene, "island.obj", at=(0.0, 0.0), height=6.0, turn=-0.35)
    stand(scene, "teapot.obj", at=(-3.4, 3.2), height=1.6, turn=0.5)
    scene.add(e3d.plane(30.0), name="floor")
    add_daylight(scene)
    lens, pose = look((-2.0, 4.5, 13.0), (0.0, 2.2, 0.0), 0.7)
    outputs = ("color", "depth", *e3d.sensors.Moment.OUTPUTS)
    with e3d.Renderer(size, look="plain", samples=4, antialiasing="msaa") as renderer:
        options = {"outputs": outputs, "cull": "back"}
        pair = e3d.sensors.StereoCamera(lens, 0.6).render(renderer, scene, pose, **options)
        now = e3d.sensors.Moment(pair.left, scene)
        teapot = scene.find("teapot.obj")
        teapot.pose = linalg.multiply(linalg.translation((0.9, 0.0, 0.3)), teapot.pose)
        later = look((-1.6, 4.5, 13.0), (0.2, 2.2, 0.0), 0.7)
        flow = now.flow_to(e3d.sensors.Moment(renderer.render(scene, later, **options), scene))
        scan = e3d.sensors.Lidar.of("hdl-64e").scan(
            scene, linalg.look_at((-1.0, 2.4, 7.0), (-1.0, 2.4, 0.0))
        )
        cloud = e3d.Mesh(scan.world_points, points=np.arange(len(scan)))
        points = e3d.render(
            cloud,
            look((-9.0, 9.0, 17.0), (-0.5, 1.0, 1.0), 0.62),
            size=size,
            color_by="y",
            colormap="turbo",
            clim=(0.0, 5.0),
            look="plain",
            samples=4,
            point_size=1.5,
        ).color
    near = np.clip(pair.left_disparity / pair.left_disparity.max(), 0.0, 1.0)
    tiles = (
        ("left", pair.left.color[..., :3]),
        ("right", pair.right.color[..., :3]),
        ("disparity", np.repeat((near[..., np.newaxis] * 255).astype(np.uint8), 3, axis=2)),
        ("flow", flow.colors()),
        ("hidden in the next", np.repeat((flow.occluded * np.uint8(255))[..., None], 3, axis=2)),
        ("LiDAR, 64 beams", points[..., :3]),
    )
    solid = np.full((*size[::-1], 1), 255, np.uint8)
    return sheet([(name, np.concatenate([one, solid], axis=2)) for name, one in tiles], 3)


PICTURES = {
    "models": models,
    "modes": modes,
    "filters": filters,
    "scenes": scenes,
    "materials": materials,
    "walls": walls,
    "mirrors": mirrors,
    "lenses": lenses,
    "viewer": viewer,
    **WINDOWS,
    "city": city,
    "impostors": impostors,
    "golden": golden,
    "sheet": contact_sheet,
    "agents": agents,
    "sensors": sensors,
    "robot": robot,
    "beside_lines": beside_lines,
    **VECTORS,
    **{name: partial(gallery.draw, name) for name in gallery.programs()},
}
#: Those that are compressed, of which drawn.json has digests.
SMALL = (
    *("beside_lines", "models", "mirrors", "lenses", "sheet", "agents", "sensors"),
    *("city", "impostors", "robot"),
    *WINDOWS,
    *gallery.programs(),
)
QUALITY = 82
DIGESTS = Digests(FOLDER / "drawn.json")


def save(picture: np.ndarray | str, name: str) -> None:
    from PIL import Image

    if isinstance(picture, str):
        (FOLDER / f"{name}.svg").write_text(picture, "utf-8")
        return
    how = {"quality": QUALITY} if name in SMALL else {"lossless": True, "quality": 100}
    path = FOLDER / f"{name}.webp"
    Image.fromarray(picture[:, :, :3]).save(path, method=6, **how)
    print(f"{path.name}: {picture.shape[1]}x{picture.shape[0]}, {path.stat().st_size:,} bytes")
    if name in SMALL:
        DIGESTS.record(name, picture)


def differs(picture: np.ndarray | str, name: str) -> bool:
    """Whether a file shows anything else than a picture."""
    from PIL import Image

    if isinstance(picture, str):
        return (FOLDER / f"{name}.svg").read_text("utf-8") != picture
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
            stale.append(name)
    if stale:
        print(f"not what the engine draws: {', '.join(stale)}", file=sys.stderr)
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
