"""The peer: Mesa's llvmpipe, which draws the same scenes on the CPU through OpenGL.

In:  a plain `Workload`. Out: a `Peer` with ``draw(frame)``. moderngl is imported only here; EGL and
     the driver are the system's. What a careful program would do is done: vertices interleaved
     and small, draws grouped by texture, what is outside of the frustum left out, many lights
     through a geometry buffer, the projection flipped so that the picture arrives top row first.
"""

from __future__ import annotations

import os

import llvmpipe_shaders as shaders
import numpy as np

from engine3d import (
    DirectionalLight,
    Engine3DError,
    InstancedMesh,
    Mesh,
    PointLight,
    Texture,
    linalg,
)
from engine3d.apps.scenes.workloads import Workload
from engine3d.model.materials.colors import linear_color

NAME = "llvmpipe"
NEEDS_MODERNGL = "llvmpipe needs the package moderngl: pip install 'engine3d[bench]' (or moderngl)"
NEEDS_MESA = (
    "llvmpipe needs EGL and its driver of Mesa (on Debian and Ubuntu: "
    "apt install libegl1 libgl1 libegl-mesa0 libgl1-mesa-dri)"
)
#: From so many instances on, those outside of the frustum are left out before drawing.
MANY = 1000
_VERTEX = np.dtype(
    [("position", "f4", 3), ("normal", "u1", 4), ("color", "u1", 4), ("uv", "f4", 2)]
)
_VERTEX_FORMAT = "3f4 4f1 4f1 2f4"
_BARE = np.dtype([("position", "f4", 3)])


def open_context(threads: int = 0):
    """Return an OpenGL context of llvmpipe's.

    Parameters
    ----------
    threads : int
        Of the driver; 0 leaves them to it. The first context of a process decides.

    Raises
    ------
    Engine3DError
        Something is not installed; the text says what.
    """
    os.environ["LIBGL_ALWAYS_SOFTWARE"] = "1"
    os.environ["GALLIUM_DRIVER"] = NAME
    os.environ.setdefault("EGL_LOG_LEVEL", "fatal")  # what goes wrong is said here
    if threads:
        os.environ["LP_NUM_THREADS"] = str(threads)
    try:
        import moderngl
    except ImportError:
        raise Engine3DError(NEEDS_MODERNGL) from None
    try:
        context = moderngl.create_standalone_context(backend="egl")
    except Exception as error:  # of whatever type glcontext and moderngl choose
        raise Engine3DError(f"{NEEDS_MESA}: {error}") from None
    renderer = context.info["GL_RENDERER"]
    if NAME not in renderer:
        context.release()
        raise Engine3DError(f"{NEEDS_MESA}: OpenGL is drawn by {renderer}")
    return context


class Peer:
    """Draws a plain workload's frames with OpenGL.

    Parameters
    ----------
    workload : Workload
        Made with ``plain=True``.
    size : (int, int)
    threads : int
        As for `open_context`.

    Attributes
    ----------
    name : str
        The driver and its version.
    """

    def __init__(self, workload: Workload, size, threads: int = 0) -> None:
        self._workload, self._size = workload, size
        self._context = context = open_context(threads)
        info = context.info
        self.name = f"{NAME}, {info['GL_VERSION'].split(') ')[-1]}"
        self._light = _light(workload.scene)
        self._lights = _point_lights(workload.scene)
        self._textures: dict[Texture, object] = {}
        self._programs: dict[tuple, object] = {}
        self._make_targets()
        context.enable(context.DEPTH_TEST | context.CULL_FACE)
        context.front_face = "cw"  # as seen in the flipped projection
        self._items = [
            _Item(self, node.object)
            for node in workload.scene.nodes
            if isinstance(node.object, (Mesh, InstancedMesh))
        ]

    def close(self) -> None:
        self._context.release()

    def _make_targets(self) -> None:
        """The framebuffers, the array that a picture is delivered in, and how it is read."""
        context, size = self._context, self._size
        shape = size[::-1]
        self._geometry = None
        self.macros = {"color": (), "ndc_depth": ("DEPTH",), "instance_id": ("DEPTH", "IDS")}[
            self._workload.output
        ]
        if self._workload.output == "ndc_depth":
            self._target = context.framebuffer([], context.depth_texture(size))
            self._read = {"attachment": -1, "components": 1, "dtype": "f4"}
            self._array = np.empty(shape, np.float32)
        elif self._workload.output == "instance_id":
            numbers = context.texture(size, 1, dtype="u4")
            self._target = context.framebuffer([numbers], context.depth_renderbuffer(size))
            self._read = {"components": 1, "dtype": "u4"}
            self._array = np.empty(shape, np.uint32)
        else:
            color = context.texture(size, 4)
            self._read = {"components": 4}
            self._array = np.empty((*shape, 4), np.uint8)
            if self._lights is None:
                self._target = context.framebuffer([color], context.depth_renderbuffer(size))
                self.macros = ("UNLIT",) if self._workload.options.get("mode") == "unlit" else ()
            else:
                self._target = context.framebuffer([color])
                self._make_geometry_buffer()
                self.macros = ("GEOMETRY",)

    def _make_geometry_buffer(self) -> None:
        context, size = self._context, self._size
        planes = [context.texture(size, 4), context.texture(size, 4), context.depth_texture(size)]
        planes[2].compare_func = ""
        for plane in planes:
            plane.filter = context.NEAREST, context.NEAREST
        self._planes = planes
        self._geometry = context.framebuffer(planes[:2], planes[2])
        fragment = shaders.LIGHTS_FRAGMENT
        program = self.program(shaders.SCREEN_VERTEX, fragment, (f"COUNT {len(self._lights)}",))
        for number, name in enumerate(("albedos", "normals", "depths")):
            program[name] = number
        self.set_light(program)
        program["background"] = self._light["background"]
        self._light_buffer = context.buffer(self._lights.tobytes())
        self._light_buffer.bind_to_uniform_block(0)
        program["Lights"].binding = 0
        self._lighting = context.vertex_array(program, [])

    def program(self, vertex: str, fragment: str, macros):
        """Return a program compiled with macros."""
        head = "#version 330\n" + "".join(f"#define {macro}\n" for macro in macros)
        return self._context.program(head + vertex, head + fragment)

    def mesh_program(self, macros: tuple):
        """Return the program that draws meshes, with the light of the scene."""
        if macros not in self._programs:
            program = self.program(shaders.VERTEX, shaders.FRAGMENT, macros)
            self.set_light(program)
            self._programs[macros] = program
        return self._programs[macros]

    def set_light(self, program) -> None:
        """Set the uniforms of ambient light and sun that a program has."""
        for name in ("ambient", "sun", "to_sun"):
            if name in program:
                program[name] = self._light[name]

    def texture(self, texture: Texture):
        """Return the texture's copy in OpenGL."""
        if texture not in self._textures:
            pixels = np.ascontiguousarray(texture.pixels[::-1])
            made = self._context.texture(pixels.shape[1::-1], 4, pixels.tobytes())
            made.filter = self._context.LINEAR, self._context.LINEAR
            self._textures[texture] = made
        return self._textures[texture]

    @property
    def context(self):
        return self._context

    def draw(self, frame: int) -> np.ndarray:
        """Draw a frame and return the picture, as OpenGL has it, top row first."""
        camera, pose = self._workload.view(frame)
        flip = np.diag((1.0, -1.0, 1.0, 1.0))
        clip_from_world = flip @ camera.projection(self._size) @ linalg.inverse(pose)
        first = self._geometry or self._target
        first.use()
        if self._workload.output == "color":
            first.clear(*self._light["background"], 1.0, depth=1.0)
        else:
            first.clear(0.0, 0.0, 0.0, 0.0, depth=1.0)
        for item in self._items:
            item.draw(clip_from_world)
        if self._geometry:
            self._add_lights(clip_from_world)
        self._target.read_into(self._array, **self._read)
        return self._array

    def _add_lights(self, clip_from_world) -> None:
        context = self._context
        self._target.use()
        for number, plane in enumerate(self._planes):
            plane.use(number)
        inverse = np.linalg.inv(clip_from_world).astype(np.float32)
        self._lighting.program["world_from_clip"].write(inverse.T.tobytes())
        context.disable(context.DEPTH_TEST | context.CULL_FACE)
        self._lighting.render(context.TRIANGLES, vertices=3)
        context.enable(context.DEPTH_TEST | context.CULL_FACE)

    def as_output(self, picture: np.ndarray) -> np.ndarray:
        """Return the picture as engine3d would have delivered it."""
        if self._workload.output == "ndc_depth":
            return np.where(picture == 1.0, np.float32(np.inf), 2.0 * picture - 1.0)
        if self._workload.output == "instance_id":
            return picture.view(np.int32) - 1
        return picture


class _Item:
    """A mesh or instances in OpenGL: a vertex array for each texture, and what culling needs."""

    def __init__(self, peer: Peer, thing) -> None:
        self._instances = thing if isinstance(thing, InstancedMesh) else None
        mesh = thing.mesh if self._instances else thing
        bare = "DEPTH" in peer.macros
        context = peer.context
        vertices, parts = _interleave(mesh, bare)
        content = [(context.buffer(vertices.tobytes()), _VERTEX_FORMAT, *_VERTEX.names)]
        if bare:
            content = [(content[0][0], "3f4", "position")]
        macros = list(peer.macros)
        if self._instances:
            macros.append("INSTANCED")
            self._make_instances(context, content, bare)
        self._bounds = mesh.bounds.astype(np.float64)
        self._radius = float(np.abs(self._bounds).max()) * 3**0.5
        self._parts = []
        for texture, faces in parts:
            extra = ["TEXTURED"] if texture is not None and not bare else []
            program = peer.mesh_program(tuple(macros + extra))
            used = [_only_used(entry, program) for entry in content]
            array = context.vertex_array(program, used, context.buffer(faces.tobytes()))
            image = peer.texture(texture) if extra else None
            self._parts.append((program, array, image))

    def _make_instances(self, context, content, bare) -> None:
        poses = np.ascontiguousarray(self._instances.poses, np.float32)
        self._poses, self._poses_buffer = poses, context.buffer(poses.tobytes())
        content.append((self._poses_buffer, "4f4/i", "instance"))
        self._colors = self._colors_buffer = None
        if not bare:
            colors = self._instances.colors
            self._colors = np.full((len(poses), 4), 255, np.uint8) if colors is None else colors
            self._colors_buffer = context.buffer(self._colors.tobytes())
            content.append((self._colors_buffer, "4f1/i", "instance_color"))

    def draw(self, clip_from_world: np.ndarray) -> None:
        planes = _frustum(clip_from_world)
        if self._instances is None:
            middle, half = self._bounds.sum(axis=0) / 2, np.diff(self._bounds, axis=0)[0] / 2
            reach = np.abs(planes[:, :3]) @ half
            if (planes[:, :3] @ middle + planes[:, 3] + reach < 0.0).any():
                return
            count = 1
        else:
            count = self._choose(planes)
        matrix = clip_from_world.astype(np.float32).T.tobytes()
        for program, array, image in self._parts:
            program["clip_from_world"].write(matrix)
            if image is not None:
                image.use(0)
            array.render(instances=count)

    def _choose(self, planes) -> int:
        """Hand over the instances that may be in the frustum; return how many they are."""
        if len(self._poses) < MANY:
            return len(self._poses)
        distance = self._poses[:, :3] @ planes[:, :3].T.astype(np.float32) + planes[:, 3]
        reach = self._poses[:, 3:] * self._radius
        chosen = np.flatnonzero((distance > -reach).all(axis=1))
        self._poses_buffer.write(self._poses[chosen].tobytes())
        if self._colors_buffer is not None:
            self._colors_buffer.write(self._colors[chosen].tobytes())
        return len(chosen)


def _only_used(entry, program):
    """A vertex buffer's (buffer, format, names), where bytes that a program ignores are padding."""
    buffer, layout, *names = entry
    rate = "/i" if layout.endswith("/i") else ""
    words = layout.removesuffix("/i").split()
    layout = " ".join(
        word if name in program else f"{int(word[0]) * int(word[-1])}x1"
        for word, name in zip(words, names, strict=True)
    )
    return buffer, layout + rate, *(name for name in names if name in program)


def _frustum(clip_from_world: np.ndarray) -> np.ndarray:
    """The six planes of the frustum, (6, 4), normals of unit length inward."""
    x, y, z, w = clip_from_world
    planes = np.stack([w + x, w - x, w + y, w - y, w + z, w - z])
    return planes / np.sqrt((planes[:, :3] ** 2).sum(axis=1))[:, np.newaxis]


def _interleave(mesh: Mesh, bare: bool):
    """Vertices as one array, and (texture, (F, 3) uint32) for each texture of the materials."""
    if bare:
        vertices = np.empty(len(mesh.positions), _BARE)
        vertices["position"] = mesh.positions
        return vertices, [(None, mesh.faces.astype(np.uint32))]
    # A vertex between materials stands once for each: its colour is the material's.
    corners = np.column_stack([mesh.faces.reshape(-1), np.repeat(mesh.material_ids, 3)])
    keys = corners[:, 0].astype(np.int64) * len(mesh.materials) + corners[:, 1]
    keys, faces = np.unique(keys, return_inverse=True)
    sources, materials = np.divmod(keys, len(mesh.materials))
    vertices = np.zeros(len(keys), _VERTEX)
    vertices["position"] = mesh.positions[sources]
    vertices["normal"][:, :3] = np.rint(127.5 * mesh.normals[sources] + 127.5)
    colors = np.array([_color(one.color) for one in mesh.materials])[materials]
    if mesh.colors is not None:
        scale = 1.0 if mesh.colors.dtype == np.uint8 else 255.0
        colors = colors * (mesh.colors[sources, :3] * scale / 255.0)
    vertices["color"][:, :3] = np.rint(255.0 * colors)
    vertices["color"][:, 3] = 255
    if mesh.uvs is not None:
        vertices["uv"] = mesh.uvs[sources]
    faces = faces.reshape(-1, 3).astype(np.uint32)
    textures = {material.texture: None for material in mesh.materials}
    numbers = [list(textures).index(material.texture) for material in mesh.materials]
    numbers = np.array(numbers)[mesh.material_ids]
    parts = [(texture, faces[numbers == k]) for k, texture in enumerate(textures)]
    return vertices, [part for part in parts if len(part[1])]


def _color(color) -> np.ndarray:
    """A colour as the plain picture has it: 8-bit values as they are."""
    return linear_color(color, "linear").astype(np.float64)


def _light(scene) -> dict:
    """The background, the ambient light and the one directional light."""
    values = {"ambient": scene.ambient, "background": scene.background}
    light = {name: tuple(_color(value).tolist()) for name, value in values.items()}
    for node in scene.nodes:
        if isinstance(node.object, DirectionalLight):
            color = _color(node.object.color) * node.object.intensity / np.pi
            light["sun"] = tuple(color.tolist())
            light["to_sun"] = tuple(linalg.normalize(-node.object.direction).tolist())
    return light


def _point_lights(scene) -> np.ndarray | None:
    """(2 N, 4) float32: position and range, then colour, of each point light; or None."""
    rows = []
    for node in scene.nodes:
        light = node.object
        if isinstance(light, PointLight):
            rows.append([*node.world_pose[:3, 3], light.range])
            rows.append([*_color(light.color) * light.intensity / np.pi, 0.0])
    return np.array(rows, np.float32) if rows else None
