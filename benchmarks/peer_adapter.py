"""The engine as a peer of other renderers: one class, on the public API alone.

In:  a renderer-neutral scene (NumPy arrays, matrices, a mode; 8-bit colours as they are, no gamma).
Out: finished frames as NumPy arrays. The environment variables ENGINE3D_BACKEND and
     ENGINE3D_THREADS choose backend and number of threads.
"""

import numpy as np

import engine3d as e3d
from engine3d import linalg

OUTPUTS = {"depth": "ndc_depth", "id": "instance_id"}
UNLIT = {"unlit", "blend"}
BLENDED = {"blend", "glass"}


class Peer:
    """Draws one scene; `scene.view` is read anew for each frame."""

    split = False  # a frame is delivered as an array
    MODES = {"lit", "unlit", "lights", "deferred", "depth", "id", "pbr", "blend", "glass"}

    def __init__(self, scene):
        self.source = scene
        self.output = OUTPUTS.get(scene.mode, "color")
        ambient = (float(scene.ambient),) * 3
        self.scene = e3d.Scene(background=tuple(map(float, scene.clear[:3])), ambient=ambient)
        for draw in scene.draws:
            self.scene.add(drawable(draw, scene.mode))
        for light, pose in lights(scene):
            self.scene.add(light, translation=pose)
        self.camera = e3d.Camera(np.asarray(scene.proj, np.float64))
        self.renderer = e3d.Renderer(scene.width, scene.height, color_space="linear")

    def info(self):
        return {"version": "engine3d " + e3d.__version__, "backend": self.renderer.backend}

    def render(self):
        source = self.source
        pose = linalg.inverse(np.asarray(source.view, np.float64))
        self.frame = self.renderer.render(
            self.scene,
            (self.camera, pose),
            mode="unlit" if source.mode in UNLIT else "lit",
            outputs=(self.output,),
        )
        if self.output == "instance_id":
            np.add(self.frame.instance_id, 1, out=self.frame.instance_id)  # 0 is the background

    def read(self):
        pixels = getattr(self.frame, self.output)
        return pixels.view(np.uint32) if self.output == "instance_id" else pixels

    def render_read(self):
        self.render()
        return self.read()


def drawable(draw, mode):
    """A mesh or instances, from the neutral description."""
    mesh = draw.mesh
    made = e3d.Mesh(
        mesh.pos,
        mesh.idx.astype(np.int32),
        normals=mesh.nrm,
        uvs=mesh.uv,
        tangents=mesh.tan,
        colors=mesh.col,
        materials=[material(draw, mode)],
    )
    if draw.inst is None:
        return made
    return e3d.InstancedMesh(made, draw.inst, colors=draw.inst_col)


def material(draw, mode):
    """Physically based where the neutral description has maps for it, and blended by its mode."""
    slots = {
        "texture": draw.texture,
        "normal_texture": draw.normal_map,
        "metallic_roughness_texture": draw.rough_metal,
    }
    held = {
        slot: e3d.Texture(pixels, filter="bilinear")
        for slot, pixels in slots.items()
        if pixels is not None
    }
    if draw.rough_metal is not None:
        held.update(roughness=float(draw.roughness), metallic=float(draw.metallic))
    if mode in BLENDED:
        held.update(color=(1.0, 1.0, 1.0, float(draw.alpha)), alpha_mode="blend")
        held.update(two_sided=mode == "glass")
    return e3d.Material(**held)


def lights(scene):
    """(light, position) pairs of the neutral description."""
    if scene.mode == "pbr":
        yield from physical_lights(scene)
    elif scene.light_pos is not None:
        for (x, y, z, radius), color in zip(scene.light_pos, scene.light_col, strict=True):
            color = tuple(map(float, color[:3]))
            light = e3d.PointLight(
                color=color, intensity=1.0, range=float(radius), falloff="window"
            )
            yield light, (float(x), float(y), float(z))
    elif scene.mode in ("lit", "glass"):
        strength = 1.0 - float(scene.ambient)
        direction = tuple(-float(c) for c in scene.light_dir)
        yield e3d.DirectionalLight(direction=direction, color=(strength,) * 3, intensity=1.0), None


def physical_lights(scene):
    """A sun and lamps, in units in which a white surface that faces 1 shows 1: pi lux."""
    direction = tuple(-float(c) for c in scene.light_dir)
    yield e3d.DirectionalLight(direction=direction, intensity=np.pi), None
    for (x, y, z, _), color in zip(scene.light_pos, scene.light_col, strict=True):
        color = tuple(map(float, color[:3]))
        yield e3d.PointLight(color=color, intensity=np.pi), (float(x), float(y), float(z))
