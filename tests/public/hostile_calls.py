"""Calls of everything public with arguments that are right, in whose place tests put wrong ones.

A row is a name, a function and its arguments by name. Functions make what they work on, so that no
call meets what an earlier one left behind.
"""

import functools
import math

import numpy as np
from plain_picture import Renderer, render

import engine3d as e3d

SIZE = (16, 12)
linalg = e3d.linalg


def mesh():
    return e3d.Mesh(np.eye(3), [[0, 1, 2]])


def scene():
    scene = e3d.Scene()
    scene.add(mesh())
    scene.add(e3d.InstancedMesh(mesh(), [(0, 0, 0, 1)]))
    return scene


@functools.cache
def drawing():
    return e3d.drawings.line_drawing(mesh(), threads=1)


@functools.cache
def sheet():
    return e3d.sheets.contact_sheet(mesh(), size=(240, 240), views="iso", threads=1)


def bendable(**arrays):
    parts = {"joints": [[0, 1]] * 3, "weights": [[0.5, 0.5]] * 3, **arrays}
    return e3d.Mesh(np.eye(3), [[0, 1, 2]], **parts)


def bent(**arrays):
    """A skinned node that is drawn."""
    shown = e3d.Scene()
    joints = [shown.add(), shown.add()]
    node = shown.add(bendable())
    node.skin = e3d.motion.Skin(joints, **arrays)
    render(shown, camera(), size=SIZE, threads=1)
    return node


def influenced(joints, weights):
    shown = e3d.Scene()
    chain = [shown.add() for _ in range(2)]
    node = shown.add(bendable(joints=joints, weights=weights))
    node.skin = e3d.motion.Skin(chain)
    render(shown, camera(), size=SIZE, threads=1)


def morphed(positions, normals, weights):
    target = e3d.motion.MorphTarget(positions, normals)
    shown = e3d.Scene()
    node = shown.add(e3d.Mesh(np.eye(3), [[0, 1, 2]], morph_targets=[target]))
    node.morph_weights = weights
    render(shown, camera(), size=SIZE, threads=1)


def keyed(times, values, path="translation", interpolation="linear"):
    shown = scene()
    channel = e3d.motion.Channel(shown.nodes[0], path, times, values, interpolation)
    player = e3d.AnimationPlayer(shown, [e3d.motion.AnimationClip([channel])])
    player.play()
    for time in (-1.0, 0.3, 9.0):
        player.seek(time)
    render(shown, camera(), size=SIZE, threads=1)


def changing(times, values, path="color", interpolation="linear"):
    shown = scene()
    material = shown.nodes[0].object.materials[0]
    channel = e3d.motion.PropertyChannel(material, path, times, values, interpolation)
    player = e3d.AnimationPlayer(shown, [e3d.motion.AnimationClip([channel])])
    player.play()
    for time in (-1.0, 0.3, 9.0):
        player.seek(time)
    render(shown, camera(), size=SIZE, threads=1)


def playing(name):
    shown = scene()
    channel = e3d.motion.Channel(shown.nodes[0], "scale", [0, 1], [(1, 1, 1), (2, 2, 2)])
    player = e3d.AnimationPlayer(shown, [e3d.motion.AnimationClip([channel])])
    player.play()

    def call(**value):
        if name in ("speed", "loop"):
            setattr(player, name, value["value"])
            player.advance(0.5)
        else:
            getattr(player, name)(**value)
        render(shown, camera(), size=SIZE, threads=1)

    return call


def lit_scene():
    """A scene in an environment, which shows."""
    lit = scene()
    lit.environment = lit.background = white_environment()
    return lit


@functools.cache  # finding the light of one takes longer than all else
def white_environment():
    return e3d.Environment(np.ones((2, 4, 3)))


def camera():
    return e3d.PerspectiveCamera(), e3d.look_at((0, 0, 5), (0, 0, 0))


def draw(**options):
    return render(scene(), **{"size": SIZE, "threads": 1, **options})


def looked_at(obj):
    """What is accepted must be drawn as well."""
    shown = scene()
    shown.add(obj)
    render(shown, camera(), size=SIZE, threads=1, wireframe="overlay")
    if not isinstance(obj, e3d.Camera):
        render(shown, size=SIZE, threads=1)
        assert np.isfinite(shown.bounds).all()
    else:
        render(shown, shown.nodes[-1], size=SIZE, threads=1)
    shown.raycast((0, 0, 5), (0, 0, -1))
    return obj


def drawn_as(kind):
    return lambda **arguments: looked_at(kind(**arguments))


def assigned(make, name):
    """Assigns an attribute of something that is drawn then."""

    def assign(value):
        thing = make()
        setattr(thing, name, value)
        if isinstance(thing, (e3d.Material, e3d.Texture)):
            ball = mesh()
            texture = thing if isinstance(thing, e3d.Texture) else None
            ball.materials = [e3d.Material(texture=texture) if texture else thing]
            thing = ball
        if isinstance(thing, e3d.Scene):
            return render(thing, size=SIZE, threads=1)
        return looked_at(thing)

    return assign


def node_set(name):
    def assign(value):
        shown = scene()
        setattr(shown.nodes[0], name, value)
        shown.nodes[0].world_pose, shown.nodes[0].euler, shown.nodes[0].bounds
        shown.raycast((0, 0, 5), (0, 0, -1))
        return render(shown, size=SIZE, threads=1)

    return assign


def selection_set(name):
    def assign(value):
        shown = scene()
        setattr(shown.select(), name, value)
        return render(shown, size=SIZE, threads=1)

    return assign


def added(**arguments):
    shown = scene()
    shown.add(mesh(), **arguments)
    shown.raycast((0, 0, 5), (0, 0, -1))
    return render(shown, size=SIZE, threads=1), shown.bounds


def with_collider(collider, query):
    shown = scene()
    shown.nodes[0].collider = collider
    return query(shown)


def overlap(shown):
    return shown.overlap_box((0, 0, 0), (1, 1, 1))


def on_canvas(name, **given):
    return lambda **arguments: getattr(e3d.Canvas((20, 20)), name)(**{**given, **arguments})


def ground():
    return e3d.navigation.NavigationGrid(e3d.plane((4, 4)))


def tracked(**arguments):
    shown = scene()
    animator = e3d.Animator(shown)
    animator.track(shown.nodes[0], **arguments)
    animator.seek(0.5)
    animator.advance(0.1)
    return render(shown, size=SIZE, threads=1)


def spun(**arguments):
    shown = scene()
    animator = e3d.Animator(shown)
    animator.spin(shown.nodes[0], **arguments)
    animator.seek(0.5)
    return render(shown, size=SIZE, threads=1)


def followed(**arguments):
    shown = scene()
    animator = e3d.Animator(shown)
    animator.follow(shown.nodes[0], **arguments)
    animator.seek(0.5)
    return render(shown, size=SIZE, threads=1)


def circling(**arguments):
    shown = scene()
    animator = e3d.Animator(shown)
    animator.orbit(shown.nodes[0], **arguments)
    animator.seek(0.5)
    return render(shown, size=SIZE, threads=1)


def timed(name):
    def call(value):
        shown = scene()
        animator = e3d.Animator(shown)
        animator.spin(shown.nodes[0], period=2.0)
        getattr(animator, name)(value)
        return render(shown, size=SIZE, threads=1)

    return call


LEVELS = [(mesh(), 0.0)]
IDENTITY = np.eye(4)
TEXT = {"string": "ab", "x": 1, "y": 1, "color": (1, 2, 3), "scale": 1}
LOW_HIGH = {"low": (0, 0, 0), "high": (1, 1, 1)}
RADIANCE = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n" + bytes([9, 9, 9, 128] * 2)
RAY = {"origin": (0, 0, 5), "direction": (0, 0, -1), "max_distance": 9.0}

CALLS = {
    "Mesh": (
        drawn_as(e3d.Mesh),
        {
            "positions": np.eye(3),
            "faces": [[0, 1, 2]],
            "normals": np.eye(3),
            "uvs": np.zeros((3, 2)),
            "colors": np.ones((3, 3)),
            "materials": None,
            "material_ids": [0],
            "lines": [[0, 1]],
            "points": [0],
            "edge_visible": [[True] * 3],
            "position_ids": [0, 1, 2],
        },
    ),
    "InstancedMesh": (
        lambda **a: looked_at(e3d.InstancedMesh(mesh(), **a)),
        {"poses": [(0, 0, 0, 1)], "colors": [(1.0, 1.0, 1.0)]},
    ),
    "Material": (
        lambda **a: looked_at(e3d.Mesh(np.eye(3), [[0, 1, 2]], materials=[e3d.Material(**a)])),
        {"color": (1, 1, 1), "specular": (0, 0, 0), "shininess": 3.0, "emissive": (0, 0, 0)},
    ),
    "Texture": (
        lambda **a: e3d.Texture(**a),
        {
            "pixels": np.zeros((2, 2, 3), np.uint8),
            "filter": "nearest",
            "wrap": "clamp",
            "anisotropy": 4,
            "lod_bias": 0.5,
        },
    ),
    "Environment": (
        lambda **a: e3d.Environment(**a),
        {"pixels": np.ones((2, 4, 3), np.float32)},
    ),
    "Environment.sky": (
        lambda **a: e3d.Environment.sky(**a),
        {"sun_direction": (0, 1, 0), "turbidity": 3.0},
    ),
    "DirectionalLight.sun": (
        lambda **a: e3d.DirectionalLight.sun(**a),
        {"sun_direction": (0, 1, 0), "turbidity": 3.0},
    ),
    "Fog": (lambda **a: e3d.Fog(**a), {"color": (1, 1, 1), "near": 1.0, "far": 9.0}),
    "ExponentialFog": (
        lambda **a: e3d.ExponentialFog(**a),
        {"color": (1, 1, 1), "density": 0.1},
    ),
    "Gradient": (lambda **a: e3d.Gradient(**a), {"top": (1, 1, 1), "bottom": (0, 0, 0)}),
    "Environment.load": (lambda **a: e3d.Environment.load(**a), {"path": RADIANCE}),
    "Scene": (
        lambda **a: render(e3d.Scene(**a), size=SIZE, threads=1),
        {"background": (0, 0, 0), "ambient": (0, 0, 0), "light_clamp": (0, 1)},
    ),
    "Scene.add": (added, {"translation": (0, 0, 0), "euler": (0, 0, 0), "scale": 1.0}),
    "Scene.add rotation": (added, {"rotation": (0, 0, 0, 1)}),
    "Scene.add pose": (added, {"pose": IDENTITY}),
    "Scene.raycast": (lambda **a: scene().raycast(**a), RAY),
    "Scene.raycast_many": (
        lambda **a: scene().raycast_many(**a),
        {"origins": [(0, 0, 5)], "directions": (0, 0, -1), "max_distance": 9.0},
    ),
    "Scene.pick": (lambda **a: scene().pick(draw(), **a), {"x": 3, "y": 4}),
    "Scene.overlap_box": (
        lambda **a: with_collider(e3d.colliders.BoxCollider(), lambda s: s.overlap_box(**a)),
        LOW_HIGH,
    ),
    "Scene.overlap_sphere": (
        lambda **a: with_collider(e3d.colliders.MeshCollider(), lambda s: s.overlap_sphere(**a)),
        {"center": (0, 0, 0), "radius": 1.0},
    ),
    "Scene.raycast_colliders": (
        lambda **a: with_collider(
            e3d.colliders.SphereCollider(1.0), lambda s: s.raycast_colliders(**a)
        ),
        RAY,
    ),
    "BoxCollider": (
        lambda **a: with_collider(
            e3d.colliders.BoxCollider(**a), lambda s: s.overlap_box((0,) * 3, (1,) * 3)
        ),
        LOW_HIGH,
    ),
    "SphereCollider": (
        lambda **a: with_collider(
            e3d.colliders.SphereCollider(**a), lambda s: s.raycast_colliders((0, 0, 5), (0, 0, -1))
        ),
        {"radius": 1.0, "center": (0, 0, 0)},
    ),
    "PerspectiveCamera": (
        drawn_as(e3d.PerspectiveCamera),
        {"yfov": 1.0, "znear": 0.1, "zfar": 9.0, "aspect": 1.0},
    ),
    "OrthographicCamera": (
        drawn_as(e3d.OrthographicCamera),
        {"ymag": 1.0, "xmag": 1.0, "znear": 0.1, "zfar": 9.0},
    ),
    "IntrinsicsCamera": (
        drawn_as(e3d.IntrinsicsCamera),
        {"fx": 9.0, "fy": 9.0, "cx": 8.0, "cy": 6.0, "znear": 0.1, "zfar": 9.0},
    ),
    "FisheyeCamera": (
        drawn_as(e3d.FisheyeCamera),
        {"fx": 9.0, "fy": 9.0, "cx": 8.0, "cy": 6.0, "k": (0, 0, 0, 0), "max_angle": 1.0},
    ),
    "BrownConradyCamera": (
        drawn_as(e3d.BrownConradyCamera),
        {"fx": 9.0, "fy": 9.0, "cx": 8.0, "cy": 6.0, "distortion": (0, 0, 0, 0), "znear": 0.1},
    ),
    "DoubleSphereCamera": (
        drawn_as(e3d.DoubleSphereCamera),
        {"fx": 9.0, "fy": 9.0, "cx": 8.0, "cy": 6.0, "xi": 0.1, "alpha": 0.6, "zfar": 9.0},
    ),
    "EquirectangularCamera": (
        drawn_as(e3d.EquirectangularCamera),
        {"xfov": 1.0, "yfov": 1.0, "znear": 0.1, "zfar": 9.0},
    ),
    "CylindricalCamera": (
        drawn_as(e3d.CylindricalCamera),
        {"xfov": 1.0, "yfov": 1.0, "znear": 0.1, "zfar": 9.0},
    ),
    "Camera": (drawn_as(e3d.Camera), {"projection": linalg.perspective(1.0, 1.0, 0.1, 9.0)}),
    "DirectionalLight": (
        drawn_as(e3d.DirectionalLight),
        {"direction": (0, 0, -1), "color": (1, 1, 1), "intensity": 1.0},
    ),
    "PointLight": (
        drawn_as(e3d.PointLight),
        {"color": (1, 1, 1), "intensity": 1.0, "range": 9.0, "falloff": "window"},
    ),
    "render": (
        draw,
        {
            "size": SIZE,
            "threads": 1,
            "samples": 1,
            "line_width": 1.0,
            "point_size": 1.0,
            "line_color": (1, 1, 1),
            "outputs": ("color",),
            "mode": "lit",
            "wireframe": "overlay",
            "line_shape": "round",
            "point_shape": "round",
            "size_unit": "picture",
        },
    ),
    "render camera": (
        lambda pose: draw(camera=(e3d.PerspectiveCamera(), pose)),
        {"pose": IDENTITY},
    ),
    "Renderer": (
        lambda **a: Renderer(**a).render(scene()),
        {"size": (8, 8), "threads": 1, "samples": 1},
    ),
    "Renderer.resize": (
        lambda **a: Renderer(SIZE, threads=1).resize(**a),
        {"size": (8, 8)},
    ),
    "Frame.encode": (lambda **a: draw().encode(**a), {"format": "png"}),
    "look_at": (e3d.look_at, {"eye": (0, 0, 5), "target": (0, 0, 0), "up": (0, 1, 0)}),
    "frame_bounds": (
        e3d.frame_bounds,
        {"bounds": np.array([[0, 0, 0], [1, 1, 1]]), "aspect": 1.0, "margin": 1.1, "yfov": 0.9},
    ),
    "frame_scene": (
        lambda **a: e3d.frame_scene(scene(), **a),
        {"aspect": 1.0, "margin": 1.1, "direction": (0, 0, 1), "yfov": 0.9, "up": (0, 1, 0)},
    ),
    "contact_sheet": (
        lambda **a: e3d.sheets.contact_sheet(mesh(), **a),
        {
            "views": "front,iso",
            "sections": ("x",),
            "size": (300, 400),
            "up": "+Z",
            "unit": "mm",
            "threads": 1,
        },
    ),
    "line_drawing": (
        lambda **a: e3d.drawings.line_drawing(mesh(), **a),
        {"size": (300, 400), "unit": "mm", "crease_angle": 0.5, "threads": 1},
    ),
    "LineDrawing.svg": (
        lambda **a: drawing().svg(**a),
        {"hidden": True, "line_width": 0.5},
    ),
    "drawing_sheet": (
        lambda **a: e3d.drawings.drawing_sheet(mesh(), **a),
        {
            "views": "front,iso",
            "sections": ("x",),
            "page": "A4",
            "scale": 0.001,
            "title": "part",
            "up": "+Z",
            "unit": "mm",
            "crease_angle": 0.5,
            "line_width": 0.5,
            "threads": 1,
        },
    ),
    "Sheet.project": (
        lambda **a: sheet().project("iso", **a),
        {"points": (1.0, 2.0, 3.0), "model": 0},
    ),
    "Sheet.at": (
        lambda **a: sheet().at(**a),
        {"x": 120, "y": 120},
    ),
    "rasterize": (
        e3d.rasterization.rasterize,
        {"clip": np.zeros((3, 4)), "faces": [[0, 1, 2]], "size": (8, 8), "threads": 1},
    ),
    "box": (e3d.box, {"size": (1, 1, 1)}),
    "quad": (e3d.primitives.quad, {"p0": (-1, -1, 0), "p2": (1, 1, 0)}),
    "plane": (e3d.plane, {"size": (1, 1), "segments": (2, 2)}),
    "uv_sphere": (e3d.uv_sphere, {"radius": 1.0, "segments": (8, 4)}),
    "icosphere": (e3d.icosphere, {"radius": 1.0, "subdivisions": 1}),
    "cylinder": (e3d.cylinder, {"radius": 1.0, "height": 1.0, "segments": 8}),
    "torus": (e3d.torus, {"major_radius": 1.0, "minor_radius": 0.3, "segments": (8, 4)}),
    "city": (e3d.worlds.city, {"triangles": 20_000, "seed": 1}),
    "NavigationGrid": (
        lambda **a: e3d.navigation.NavigationGrid(e3d.plane((4, 4)), **a),
        {
            "cell": 0.5,
            "bounds": ((-1, -1), (1, 1)),
            "max_slope": 0.5,
            "step": 0.4,
            "headroom": 1.8,
            "radius": 0.2,
        },
    ),
    "NavigationGrid.sample_ground": (
        lambda **a: ground().sample_ground(**a),
        {"x": 0.1, "z": 0.1, "y": 1.0},
    ),
    "Walker": (
        lambda **a: e3d.navigation.Walker(ground(), **a),
        {"x": 0.0, "z": 0.0, "eye_height": 1.7},
    ),
    "Walker.move": (
        lambda **a: e3d.navigation.Walker(ground(), 0.0, 0.0).move(**a),
        {"dx": 0.1, "dz": 0.1},
    ),
    "DetailedInstances": (
        lambda **a: e3d.detail.DetailedInstances(LEVELS, **a),
        {"poses": [(0, 0, 0, 1)], "colors": [(1.0, 1.0, 1.0)], "pixels": 1.0, "hysteresis": 0.3},
    ),
    "DetailedInstances.update": (
        lambda **a: e3d.detail.DetailedInstances(LEVELS, [(0, 0, 0, 1)]).update(camera()[0], **a),
        {"pose": IDENTITY, "size": SIZE},
    ),
    "DetailedMeshes.update": (
        lambda **a: e3d.detail.DetailedMeshes([((mesh(),), 0.0)]).update(camera()[0], **a),
        {"pose": IDENTITY, "size": SIZE},
    ),
    "DetailedMeshes": (
        lambda error, **a: e3d.detail.DetailedMeshes([((mesh(),), 0.0), ((mesh(),), error)], **a),
        {"error": 0.1, "pixels": 1.0, "hysteresis": 0.3},
    ),
    "Impostor": (lambda **a: e3d.detail.Impostor(mesh(), **a), {"views": 2, "texels": 8}),
    "Canvas": (lambda **a: e3d.Canvas(**a), {"size": (4, 4)}),
    "Font": (lambda **a: e3d.Font(**a), {"face": "sans", "size": 12}),
    "Canvas.point": (on_canvas("point"), {"x": 1, "y": 1, "color": (1, 2, 3)}),
    "Canvas.points": (on_canvas("points"), {"xy": [(1, 1)], "color": (1, 2, 3)}),
    "Canvas.line": (
        on_canvas("line"),
        {"x0": 1, "y0": 1, "x1": 5, "y1": 6, "color": (1, 2, 3), "width": 2},
    ),
    "Canvas.text": (on_canvas("text"), {"x": 1, "y": 1, "string": "ab", "color": (1, 2, 3)}),
    "Animator.track": (
        tracked,
        {
            "times": [0, 1],
            "translations": [(0, 0, 0), (1, 1, 1)],
            "rotations": [(0, 0, 0, 1)] * 2,
            "scales": [(1, 1, 1)] * 2,
        },
    ),
    "Mesh.joints": (influenced, {"joints": [[0, 1]] * 3, "weights": [[0.5, 0.5]] * 3}),
    "MorphTarget": (
        morphed,
        {"positions": np.ones((3, 3)), "normals": np.ones((3, 3)), "weights": [0.5]},
    ),
    "Skin": (bent, {"inverse_binds": np.tile(np.eye(4), (2, 1, 1))}),
    "Channel": (
        keyed,
        {"times": [0.0, 1.0], "values": [(0, 0, 0), (1, 1, 1)], "path": "scale"},
    ),
    "PropertyChannel": (
        changing,
        {"times": [0.0, 1.0], "values": [(0, 0, 0, 1), (1, 1, 1, 0)], "path": "color"},
    ),
    "PropertyChannel.interpolation": (
        changing,
        {
            "times": [0.0],
            "values": e3d.linear(np.zeros((1, 3, 4))),
            "interpolation": "cubicspline",
        },
    ),
    "Channel.interpolation": (
        keyed,
        {"times": [0.0], "values": [((0, 0, 0),) * 3], "interpolation": "cubicspline"},
    ),
    "AnimationPlayer.play": (playing("play"), {"clip": 0, "fade": 0.5, "offsets": 0.25}),
    "AnimationPlayer.seek": (playing("seek"), {"time": 0.5}),
    "AnimationPlayer.advance": (playing("advance"), {"seconds": 0.5}),
    "AnimationPlayer.speed": (playing("speed"), {"value": 0.5}),
    "AnimationPlayer.loop": (playing("loop"), {"value": "once"}),
    "Animator.follow": (
        followed,
        {"points": [(0, 0, 0), (1, 1, 1)], "period": 2.0, "phase": 0.1},
    ),
    "Animator.orbit": (circling, {"radius": 1.0, "period": 2.0, "axis": (0, 1, 0), "phase": 0.1}),
    "Animator.spin": (spun, {"period": 2.0, "axis": (0, 1, 0), "phase": 0.1}),
    "Animator.seek": (timed("seek"), {"value": 0.5}),
    "Animator.advance": (timed("advance"), {"value": 0.5}),
    "Animator": (
        lambda **a: e3d.Animator(scene(), **a),
        {"full_rate_distance": 5.0},
    ),
    "linalg.compose": (
        linalg.compose,
        {"offset": (0, 0, 0), "rotation": (0, 0, 0, 1), "scale": (1, 1, 1)},
    ),
    "linalg.perspective": (
        linalg.perspective,
        {"yfov": 1.0, "aspect": 1.0, "znear": 0.1, "zfar": 9.0},
    ),
    "linalg.inverse": (linalg.inverse, {"m": IDENTITY}),
    "linalg.decompose": (linalg.decompose, {"m": IDENTITY}),
    "linalg.multiply": (linalg.multiply, {"a": IDENTITY, "b": IDENTITY}),
    "linalg.normalize": (linalg.normalize, {"v": (1, 2, 3)}),
    "linalg.length": (linalg.length, {"v": (1, 2, 3)}),
    "linalg.cross": (linalg.cross, {"a": (1, 2, 3), "b": (3, 2, 1)}),
    "linalg.dot": (linalg.dot, {"a": (1, 2, 3), "b": (3, 2, 1)}),
    "linalg.euler_to_quaternion": (linalg.euler_to_quaternion, {"angles": (1, 2, 3)}),
    "linalg.quaternion_to_euler": (linalg.quaternion_to_euler, {"q": (0, 0, 0, 1)}),
    "linalg.quaternion_to_matrix": (linalg.quaternion_to_matrix, {"q": (0, 0, 0, 1)}),
    "linalg.matrix_to_quaternion": (linalg.matrix_to_quaternion, {"m": IDENTITY}),
    "linalg.rotation_axis": (linalg.rotation_axis, {"axis": (0, 1, 0), "angle": 0.3}),
    "linalg.sin": (linalg.sin, {"angle": 0.3}),
    "linalg.transform_points": (
        linalg.transform_points,
        {"m": IDENTITY, "points": [(1, 2, 3)]},
    ),
}
for _name in ("positions", "normals"):
    CALLS[f"Mesh.{_name} ="] = (assigned(mesh, _name), {"value": np.eye(3)})
for _name in ("color", "specular", "emissive", "shininess"):
    _value = 3.0 if _name == "shininess" else (1, 1, 1)
    CALLS[f"Material.{_name} ="] = (assigned(e3d.Material, _name), {"value": _value})
for _name, _value in {
    "background": (1, 1, 1),
    "ambient": (1, 1, 1),
    "light_clamp": (0, 1),
    "environment": e3d.Environment(np.ones((2, 4, 3))),
    "environment_intensity": 0.5,
    "environment_rotation": 1.0,
    "background_blur": 0.5,
    "fog": e3d.Fog((1, 1, 1), 1.0, 9.0),
}.items():
    CALLS[f"Scene.{_name} ="] = (assigned(lit_scene, _name), {"value": _value})
for _name, _value in {
    "pose": IDENTITY,
    "translation": (0, 0, 0),
    "rotation": (0, 0, 0, 1),
    "euler": (0, 0, 0),
    "scale": (1, 1, 1),
}.items():
    CALLS[f"Node.{_name} ="] = (node_set(_name), {"value": _value})
for _name, _row, _shape in (
    ("poses", IDENTITY, (2, 4, 4)),
    ("translations", (0, 1, 2), (2, 3)),
    ("rotations", (0, 0, 0, 1), (2, 4)),
    ("scales", (1, 2, 3), (2, 3)),
):
    CALLS[f"NodeSelection.{_name} ="] = (selection_set(_name), {"value": np.resize(_row, _shape)})

HUGE = 10**400
#: What a number, or each number of an array, may be instead.
NUMBERS = {
    "nan": math.nan,
    "inf": math.inf,
    "-inf": -math.inf,
    "zero": 0.0,
    "-1": -1,
    "subnormal": 5e-324,
    "tiny": 1e-30,
    "1e20": 1e20,
    "1e39": 1e39,
    "largest": 1.7976931348623157e308,
    "2**31": 2**31,
    "2**63": 2**63,
    "10**400": HUGE,
    "-10**400": -HUGE,
}
#: What any argument may be instead.
THINGS = {
    "None": None,
    "text": "abc",
    "bytes": b"abc",
    "object": object(),
    "complex": 1j,
    "empty list": [],
    "empty array": np.zeros((0, 3)),
    "ragged": [[1, 2], [3]],
    "huge in a list": [HUGE, 1, 1],
    "objects": np.array([None, 1, "a"], object),
    "dates": np.array(["2020-01-01"], "datetime64[D]"),
    "many axes": np.zeros((1,) * 9),
    "zero rows of eight axes": np.zeros((0, 2, 2, 2, 2, 2, 2, 2)),
    "a dict": {"a": 1},
}


def wrong_values(right):
    """Wrong values in place of a right one, by name."""
    values = dict(THINGS)
    for name, number in NUMBERS.items():
        values[name] = number
        if np.ndim(right) and np.array(right).dtype.kind != "U":
            kind = object if isinstance(number, int) and abs(number) > 2**62 else float
            array = np.array(right, kind)
            if array.size:
                one = array.copy()
                one.flat[-1] = number
                values[f"one {name}"], values[f"all {name}"] = one, np.full_like(array, number)
                values[f"a list with {name}"] = one.tolist()
    return values
