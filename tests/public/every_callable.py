"""Every public callable, found by looking, with a call of each that is right.

A new public name enters by itself. What its required parameters get stands in `RIGHT`, what its
methods are called on in `OWNERS`; a test names what is missing there.
"""

import functools
import inspect
import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from importlib import import_module
from typing import Any

import numpy as np
import pytest
from public.hostile_calls import SIZE, camera, draw, ground, lit_scene, mesh, scene, sheet
from public.public_names import OWN_NAMES
from public.test_copies import COPIED, REFUSED

import engine3d as e3d
from engine3d import batch, datasets, events, loaders
from engine3d.apps.datasets.writer import Note
from engine3d.base.plugins.plugin import Plugin
from engine3d.io.reading.sources import Source

MODULES = ("", *e3d._MODULES)
#: Classes that only the package makes, or that are data of its own without a check.
MADE_ELSEWHERE = {
    *("Flow", "Frame", "Joint", "LidarScan", "Node", "NodeSelection", "Robot", "Sheet"),
    *("DrawingSheet", "LineDrawing", "StereoPair", "World"),
    *("batch.Summary", "datasets.Sample"),
    *("loaders.CameraRecord", "loaders.Document", "loaders.LightRecord"),
    *("plugins.Plugin", "plugins.PluginFile"),
    *(f"events.{name}" for name in events.__all__),
}
OBJ = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
PPM = b"P6 1 1 255\n   "


def generator():
    return datasets.Generator(1, "picture")


def clip():
    shown = scene()
    return e3d.motion.AnimationClip([channel(shown)])


def channel(shown=None):
    shown = shown or scene()
    return e3d.motion.Channel(shown.nodes[0], "scale", [0.0, 1.0], [(1, 1, 1), (2, 2, 2)])


def player():
    shown = scene()
    found = e3d.AnimationPlayer(shown, [e3d.motion.AnimationClip([channel(shown)])])
    found.play()
    return found


def sample():
    shown = scene()
    renderer = e3d.Renderer(SIZE, threads=1)
    outputs = ("color", "depth", "object_id")
    lens, pose = camera()
    frame = renderer.render(shown, (lens, pose), outputs=outputs)
    return datasets.Sample("a", 0, frame, shown, lens, pose, renderer)


def removed_node(shown):
    node = shown.nodes[0]
    shown.remove(node)
    return node


def cube_of_trimesh():
    return pytest.importorskip("trimesh").creation.box()


def with_uvs():
    return e3d.Mesh(np.eye(3), [[0, 1, 2]], uvs=np.eye(3)[:, :2])


def written():
    return Note("a", 0, ["color/a.png"], {"shapes": [], "objects": []})


def plugin():
    return Plugin("looks", "evening", lambda: e3d.Look.studio())


def plugin_file():
    return e3d.plugins.PluginFile(Source("there.obj", OBJ))


def registered():
    e3d.plugins.register("looks", "evening", e3d.Look.studio())
    return "evening"


def window():
    return e3d.Window((64, 48))


@functools.cache
def frame():
    every = ("color", "depth", "ndc_depth", *e3d.sensors.Moment.OUTPUTS)
    return draw(outputs=every)


#: By class: something that its methods and attributes are tried on.
OWNERS: dict[str, Callable[[], Any]] = {
    **COPIED,
    **REFUSED,
    "AnimationClip": clip,
    "AnimationPlayer": player,
    "Animator": lambda: e3d.Animator(scene()),
    "BopWriter": datasets.BopWriter,
    "CameraRecord": lambda: loaders.CameraRecord((0, 0, 0), (0, 0, 1), 1.0),
    "Channel": channel,
    "CocoWriter": datasets.CocoWriter,
    "DatasetWriter": datasets.FolderWriter,
    "DetailedInstances": lambda: e3d.detail.DetailedInstances([(mesh(), 0.0)], [(0, 0, 0, 1)]),
    "DetailedMeshes": lambda: e3d.detail.DetailedMeshes([((mesh(),), 0.0)]),
    "DrawingSheet": functools.cache(lambda: e3d.drawings.drawing_sheet(mesh(), threads=1)),
    "FolderWriter": datasets.FolderWriter,
    "Frame": frame,
    "Generator": generator,
    "Impostor": functools.cache(lambda: e3d.detail.Impostor(mesh(), views=2, texels=8)),
    "InstancedMesh": lambda: e3d.InstancedMesh(mesh(), [(0, 0, 0, 1)]),
    "LightProbe": lambda: e3d.LightProbe(np.ones((9, 3))),
    "LineDrawing": functools.cache(lambda: e3d.drawings.line_drawing(mesh(), threads=1)),
    "Mesh": with_uvs,
    "NavigationGrid": functools.cache(ground),
    "Node": lambda: scene().nodes[0],
    "NodeSelection": lambda: scene().select(),
    "Plugin": plugin,
    "PluginFile": plugin_file,
    "Renderer": lambda: e3d.Renderer(SIZE, threads=1),
    "Sample": sample,
    "Scene": lit_scene,
    "Sheet": sheet,
    "Skin": lambda: e3d.motion.Skin(scene().nodes),
    "Task": lambda: batch.Task("a", script="a.py"),
    "Walker": lambda: e3d.navigation.Walker(ground(), 0.0, 0.0),
    "WebDatasetWriter": datasets.WebDatasetWriter,
    "Window": window,
    "World": functools.cache(lambda: e3d.worlds.city(20_000)),
}

#: What required parameters get, by name, or by the callable's name and theirs. Functions are
#: called for it.
RIGHT: dict[str, Any] = {
    "Animator.follow.node": lambda owner: owner._scene.nodes[0],
    "Animator.follow.points": [(0, 0, 0), (1, 0, 0)],
    "Animator.orbit.node": lambda owner: owner._scene.nodes[0],
    "Animator.spin.nodes": lambda owner: owner._scene.nodes[0],
    "Animator.track.node": lambda owner: owner._scene.nodes[0],
    "Scene.remove.node": lambda owner: owner.nodes[0],
    "Scene.restore.node": removed_node,
    "Node.look_at.target": (1, 2, 3),
    "Mesh.from_trimesh.geometry": cube_of_trimesh,
    "Channel.path": "scale",
    "Joint.value.value": 0.5,
    "Robot.link_pose.name": "b",
    "Robot.set_joint.name": "j",
    "Robot.set_joint.position": 0.5,
    "Robot.set_joints.values": {"j": 0.5},
    "Channel.values": [(1, 1, 1), (2, 2, 2)],
    "DetailedMeshes.levels": lambda: [((mesh(),), 0.0)],
    "Environment.pixels": np.ones((2, 4, 3), np.float32),
    "Environment.load.path": (
        b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n" + bytes([9, 9, 9, 128] * 2)
    ),
    "Generator.uniform.low": 0.0,
    "measure.thing": mesh,
    "check.thing": mesh,
    "distance.a": mesh,
    "distance.b": mesh,
    "hausdorff.a": mesh,
    "hausdorff.b": mesh,
    "Mesh.save.path": "mesh.obj",
    "save_mesh.path": "mesh.obj",
    "save_animation.path": "turn.gif",
    "load.path": OBJ,
    "load_mesh.path": OBJ,
    "load_scene.path": OBJ,
    "load_texture.path": PPM,
    "load_camera.path": b'{"model": "PINHOLE", "params": [9, 9, 8, 6]}',
    "K": [[9, 0, 8], [0, 9, 6], [0, 0, 1]],
    **{
        f"{camera}.rays.pixels": [(3.0, 4.0)]
        for camera in (
            *("Camera", "PerspectiveCamera", "OrthographicCamera", "IntrinsicsCamera"),
            *("FisheyeCamera", "BrownConradyCamera", "DoubleSphereCamera"),
            *("EquirectangularCamera", "CylindricalCamera", "Frame"),
        )
    },
    "loaders.load_document.path": OBJ,
    "batch.load_mesh.path": "there.obj",
    "batch.load_texture.path": "there.ppm",
    "batch.read_manifest.path": "there.json",
    "Resources.load_mesh.path": "there.obj",
    "Resources.load_texture.path": "there.ppm",
    "RenderOptions.pixels_of.size": 1.0,
    "plugins.PluginFile.open.name": "there.ppm",
    "plugins.PluginFile.progress.fraction": 0.5,
    "plugins.register.group": "looks",
    "plugins.register.name": "evening",
    "plugins.register.value": e3d.Look.studio(),
    "plugins.unregister.group": "looks",
    "plugins.unregister.name": registered,
    "Resources.share.thing": mesh,
    "NavigationGrid.thing": mesh,
    "Canvas.triangle.a": (1.0, 2.0),
    "Canvas.triangle.b": (9.0, 2.0),
    "Font.face": "mono",
    "Window.key_at.position": "W",
    "Font.size": 12.0,
    "linalg.multiply.a": np.eye(4),
    "linalg.multiply.b": np.eye(4),
    "linalg.quaternion_multiply.a": (0, 0, 0, 1),
    "linalg.quaternion_multiply.b": (0, 0, 0, 1),
    "Scene.overlap_box.low": (0, 0, 0),
    "Scene.overlap_box.high": (1, 1, 1),
    "LineDrawing.strokes.kind": "border",
    "LineDrawing.save.path": "lines.svg",
    "DrawingSheet.save.path": "page.pdf",
    "drawing_sheet.model": mesh,
    "Scene.save.path": "scene.glb",
    "Scene.select.nodes": None,
    "Sheet.project.view": "iso",
    "SphereCollider.radius": 1.0,
    "a": (1.0, 2.0, 3.0),
    "angle": 0.3,
    "angles": (0.1, 0.2, 0.3),
    "aspect": 1.0,
    "azimuths": [0.0, 0.1],
    "baseline": 0.1,
    "elevations": [0.0],
    "fov": (1.0, 0.5),
    "axis": (0, 1, 0),
    "azimuth": 0.3,
    "b": (3.0, 2.0, 1.0),
    "bottom": (0, 0, 0),
    "bounds": np.array([[0, 0, 0], [1, 1, 1.0]]),
    "c": (3.0, 5.0),
    "camera": lambda: camera()[0],
    "captured": False,
    "center": (0, 0, 0),
    "channels": lambda: [channel()],
    "clip": np.zeros((3, 4)),
    "coefficients": np.ones((9, 3)),
    "color": (1, 1, 1),
    "column": 1,
    "corners": [(x, y, z) for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))],
    "count": 2,
    "cx": 8.0,
    "cy": 6.0,
    "density": 0.1,
    "direction": (0, 0, -1),
    "directions": (0, 0, -1),
    "distance": 3.0,
    "dx": 0.1,
    "dz": 0.1,
    "end": "png",
    "eye": (0, 0, 5),
    "faces": [[0, 1, 2]],
    "factors": (1, 2, 3),
    "far": 9.0,
    "folder": "folder",
    "frame": frame,
    "frames": lambda: [draw(), draw()],
    "fx": 9.0,
    "fy": 9.0,
    "generator": generator,
    "grid": functools.cache(ground),
    "half_size": 9.0,
    "high": 2,
    "items": ("a", "b"),
    "joints": lambda: scene().nodes,
    "Mesh.set_influences.joints": [[0, 1]] * 3,
    "layer": 0,
    "levels": lambda: [(mesh(), 0.0)],
    "low": 0,
    "m": np.eye(4),
    "mask": np.ones((2, 2), bool),
    "mesh": mesh,
    "meshes": lambda: [mesh()],
    "message": "what is wrong",
    "models": mesh,
    "name": "a",
    "near": 1.0,
    "node": lambda: scene().nodes[0],
    "nodes": lambda: scene().nodes[0],
    "note": written,
    "notes": (),
    "numbers": np.array([0]),
    "offset": (0, 0, 0),
    "origin": (0, 0, 5),
    "origins": [(0, 0, 5)],
    "out": "out",
    "parent": None,
    "path": "file.png",
    "period": 2.0,
    "picture": frame,
    "pixels": np.zeros((2, 2, 3), np.uint8),
    "points": [(1.0, 2.0, 3.0)],
    "matrix": np.eye(4),
    "polygons": [[0, 1, 2]],
    "pose": np.eye(4),
    "poses": [(0, 0, 0, 1)],
    "positions": np.eye(3),
    "MorphTarget.positions": np.ones((3, 3)),
    "StereoCamera.disparity.depth": [[1.0]],
    "StereoCamera.render.renderer": lambda: e3d.Renderer(SIZE, threads=1),
    "Flow.warp.picture": np.ones((4, 4)),
    "Flow.save.path": "flow.flo",
    "LidarScan.save.path": "scan.pcd",
    "Lidar.of.name": "vlp-16",
    "sensors.save_values.values": np.ones((2, 2)),
    "save_values.values": np.ones((2, 2)),
    "Moment.flow_to.other": COPIED["Moment"],
    "PropertyChannel.target": e3d.Material,
    "PropertyChannel.path": "shininess",
    "PropertyChannel.values": [[1.0], [2.0]],
    "probability": 0.5,
    "projection": np.eye(4),
    "q": (0, 0, 0, 1),
    "radii": [1.0, 2.0],
    "radius": 1.0,
    "ratio": 0.5,
    "rle": lambda: datasets.encode_rle(np.ones((2, 2), bool)),
    "row": 1,
    "sample": sample,
    "samples": (),
    "scene": scene,
    "seconds": 0.5,
    "seed": 1,
    "shape": "hand",
    "size": SIZE,
    "string": "ab",
    "sun_direction": (0, 1, 0),
    "target": (0, 0, 0),
    "tasks": (),
    "text": "abc",
    "texture": lambda: e3d.Texture(np.zeros((2, 2, 3), np.uint8)),
    "thing": frame,
    "time": 0.5,
    "times": [0.0, 1.0],
    "top": (1, 1, 1),
    "towards": np.array([[0.0, 0.0, 1.0]]),
    "Impostor.nearest.last": np.array([0]),
    "v": (1, 2, 3),
    "values": [(1, 1, 1), (2, 2, 2)],
    "view": "iso",
    "weights": [[0.5, 0.5]] * 3,
    "width": 16,
    "height": 12,
    "writer": lambda: datasets.FolderWriter(),
    "x": 3,
    "y": 4,
    "z": 0.0,
    "x0": 1,
    "x1": 5,
    "y0": 1,
    "y1": 6,
    "xmag": 1.0,
    "xy": [(1, 1)],
    "xyxy": [(1, 1, 5, 6)],
    "xyxyxy": [(1, 1, 5, 6, 2, 8)],
    "yfov": 1.0,
    "ymag": 1.0,
    "zfar": 9.0,
    "znear": 0.1,
}
#: Optional parameters that calls get as well: without them they take too long, or something else.
BESIDE: dict[str, dict[str, Any]] = {
    "city": {"triangles": 20_000},
    "contact_sheet": {"size": (240, 240), "views": "iso", "threads": 1},
    "render": {"size": SIZE, "threads": 1},
    "Renderer": {"threads": 1},
    "Impostor": {"views": 2, "texels": 8},
    "rasterize": {"threads": 1},
    "MorphTarget": {"positions": np.ones((3, 3))},
    "batch.Task": {"script": "there.py"},
    "show": {"size": (64, 48)},
}
#: The shape of a note is asked of whatever a record holds.
TAKE_ALL = {"note_shape"}
VARIABLE = (inspect.Parameter.VAR_POSITIONAL, inspect.Parameter.VAR_KEYWORD)


@dataclass
class Call:
    """A public callable, or an attribute that can be assigned."""

    name: str
    owner: Callable[[], Any] | None
    function: Callable[..., Any]
    parameters: tuple[str, ...]
    required: tuple[str, ...]

    def right(self) -> tuple[tuple, dict[str, Any]]:
        """Return what it is called on, if anything, and arguments that it takes."""
        owner = () if self.owner is None else (self.owner(),)
        given = {name: right_value(self.name, name, *owner) for name in self.required}
        return owner, {**given, **BESIDE.get(self.name, {})}


def right_value(call: str, parameter: str, *owner: Any) -> Any:
    """Return a right argument: what `RIGHT` has, or what a function there makes of the owner."""
    name = f"{call}.{parameter}"
    value = RIGHT[name] if name in RIGHT else RIGHT[parameter]
    if not callable(value):
        return value
    return value(*owner[: len(inspect.signature(value).parameters)])


def every_call() -> Iterator[Call]:
    """Everything public that can be called or assigned."""
    seen = set()
    for module in MODULES:
        package = import_module(f"engine3d.{module}".rstrip("."))
        for name in package.__all__:
            thing = getattr(package, name)
            if inspect.ismodule(thing) or not callable(thing) or id(thing) in seen:
                continue
            seen.add(id(thing))
            if not getattr(thing, "__module__", "").startswith("engine3d."):
                continue  # types of typing's
            label = f"{module}.{name}" if module in OWN_NAMES else name
            if inspect.isclass(thing):
                yield from _calls_of_class(label, thing)
            else:
                yield _call(label, None, thing, skip=0)


def _calls_of_class(label: str, kind: type) -> Iterator[Call]:
    if label not in MADE_ELSEWHERE and not inspect.isabstract(kind):
        if "__init__" in vars(kind) or not issubclass(kind, (BaseException, tuple)):
            yield _call(label, None, kind, skip=0)
    for name in dir(kind):
        if name.startswith("_") or name in TAKE_ALL:
            continue
        member = inspect.getattr_static(kind, name)
        where = f"{label}.{name}"
        if isinstance(member, (staticmethod, classmethod)):
            yield _call(where, None, getattr(kind, name), skip=0)
        elif inspect.isfunction(member):
            if member.__module__.startswith("engine3d."):
                yield _call(where, _owner(label), member, skip=1)
        elif _is_assignable(member):
            yield Call(f"{where} =", _owner(label), _assign(name), ("value",), ())


def _is_assignable(member: Any) -> bool:
    if isinstance(member, property):
        return member.fset is not None
    kind = type(member)
    is_ours = kind.__module__.startswith("engine3d.") and hasattr(kind, "__set__")
    return is_ours and kind.__name__ != "_Foreign"


def _assign(name: str) -> Callable[..., None]:
    def assign(owner, value):
        setattr(owner, name, value)

    return assign


def _owner(label: str) -> Callable[[], Any]:
    return OWNERS.get(label.rpartition(".")[2]) or functools.partial(_no_owner, label)


def _no_owner(label: str):
    raise KeyError(f"OWNERS has no {label}")


def _call(label: str, owner, function, skip: int) -> Call:
    parameters = list(inspect.signature(function).parameters.values())[skip:]
    named = [p for p in parameters if p.kind not in VARIABLE]
    required = tuple(p.name for p in named if p.default is p.empty)
    return Call(label, owner, function, tuple(p.name for p in named), required)


HUGE = 10**400


class Anything:
    """What can be made of whatever a callback is called with."""

    def __init__(self, *given: Any) -> None:
        pass


def hostile_values() -> dict[str, Any]:
    """What is handed in place of every argument, made anew each time."""
    loop: list = []
    loop.append(loop)
    return {
        "None": None,
        "True": True,
        "object": object(),
        "text": "text",
        "NUL": "a\0b",
        "bytes": b"bytes",
        "nan": math.nan,
        "inf": math.inf,
        "-1": -1,
        "2**31": 2**31,
        "10**400": HUGE,
        "complex": 1j,
        "empty list": [],
        "empty array": np.zeros((0, 3)),
        "ragged": [[1, 2], [3]],
        "a list of None": [None],
        "a list of huge": [HUGE, 1, 1],
        "a list of itself": loop,
        "nan in threes": [math.nan, 1.0, 2.0],
        "object array": np.array([None, 1, "a"], object),
        "a generator": (letter for letter in "ab"),
        "a class": Anything,
        "a function": lambda *given: None,
        "a Scene": e3d.Scene(),
        "a Mesh": mesh(),
        "a Material": e3d.Material(),
        "a dict": {"a": 1},
        "a module": math,
    }
