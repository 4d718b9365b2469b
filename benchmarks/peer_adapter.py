"""The engine as a peer of other renderers: one class, on the public API alone.

In:  a renderer-neutral scene (NumPy arrays, matrices, a mode; 8-bit colours as they are, no gamma).
Out: finished frames as NumPy arrays. The environment variables ENGINE3D_BACKEND and
     ENGINE3D_THREADS choose backend and number of threads.
"""

import numpy as np

import engine3d as e3d
from engine3d import linalg

OUTPUTS = {"depth": "ndc_depth", "id": "instance_id"}
KEYED_FRAMES = 300  # of scenes that move: keys of a clip, as animated files have them
UNLIT = {"unlit", "blend"}
BLENDED = {"blend", "glass"}


class Peer:
    """Draws one scene; `scene.view` is read anew for each frame."""

    split = False  # a frame is delivered as an array
    MODES = {"lit", "unlit", "lights", "deferred", "depth", "id", "pbr", "blend", "glass", "skin"}
    MODES |= {"shadow"}

    def __init__(self, scene):
        self.source = scene
        self.output = OUTPUTS.get(scene.mode, "color")
        ambient = (float(scene.ambient),) * 3
        self.scene = e3d.Scene(background=tuple(map(float, scene.clear[:3])), ambient=ambient)
        made = {}
        nodes = [self.scene.add(drawable(draw, scene.mode, made)) for draw in scene.draws]
        self.crowd = Crowd(self.scene, nodes, scene.draws) if scene.mode == "skin" else None
        self.lights = [light for light, _ in lights(scene)]
        for light, (_, place) in zip(self.lights, lights(scene), strict=True):
            self.scene.add(light, translation=place)
        self.frames = 0
        self.camera = e3d.Camera(np.asarray(scene.proj, np.float64))
        self.renderer = e3d.Renderer(
            (scene.width, scene.height),
            look="plain",
            color_space="linear",
            samples=scene.samples,
            antialiasing="msaa" if scene.samples > 1 else "ssaa",
        )

    def info(self):
        return {"version": "engine3d " + e3d.__version__, "backend": self.renderer.backend}

    def render(self):
        source = self.source
        if self.crowd is not None:
            self.crowd.show(source.frame)
        if source.mode == "shadow":
            self.turn_light()
        pose = linalg.inverse(np.asarray(source.view, np.float64))
        self.frame = self.renderer.render(
            self.scene,
            (self.camera, pose),
            cull="back",
            mode="unlit" if source.mode in UNLIT else "lit",
            outputs=(self.output,),
        )
        if self.output == "instance_id":
            np.add(self.frame.instance_id, 1, out=self.frame.instance_id)  # 0 is the background

    def turn_light(self):
        """Turn the light by a hair, so that its map is drawn anew in every frame."""
        self.frames += 1
        hair = 1e-6 * np.array([self.frames % 5 - 2, 0.0, self.frames % 7 - 3])
        self.lights[0].direction = hair - np.asarray(self.source.light_dir, np.float64)

    def read(self):
        pixels = getattr(self.frame, self.output)
        return pixels.view(np.uint32) if self.output == "instance_id" else pixels

    def render_read(self):
        """Draw a frame and return it: what the harness times."""
        self.render()
        return self.read()


class Crowd:
    """Skinned nodes: the joints' matrices are keys of clips, which a player plays."""

    def __init__(self, scene, nodes, draws):
        self.draws, self.joints = draws, []
        for node, draw in zip(nodes, draws, strict=True):
            joints = [scene.add() for _ in draw.joint_matrices(0)]
            node.skin = e3d.motion.Skin(joints, np.tile(np.eye(4), (len(joints), 1, 1)))
            self.joints += joints
        self.selection = scene.select(self.joints)
        times, channels = np.arange(KEYED_FRAMES), []
        translations, rotations = zip(*map(self.keys_of, times.tolist()), strict=True)
        for number, joint in enumerate(self.joints):
            for path, keys in (("translation", translations), ("rotation", rotations)):
                values = [key[number] for key in keys]
                channels.append(e3d.motion.Channel(joint, path, times, values))
        self.player = e3d.AnimationPlayer(scene, [e3d.motion.AnimationClip(channels)])
        self.player.loop = "once"
        self.player.play()

    def keys_of(self, frame):
        """Where all joints are in a frame: translations and rotations."""
        poses = [draw.joint_matrices(frame) for draw in self.draws]
        self.selection.poses = np.array(poses, np.float64).reshape(-1, 4, 4)
        return self.selection.translations, self.selection.rotations

    def show(self, frame):
        """Move all to where they are in a frame."""
        if frame < KEYED_FRAMES:
            self.player.seek(frame)
        else:
            self.keys_of(frame)


def drawable(draw, mode, made):
    """A mesh or instances, from the neutral description; the same mesh once."""
    if draw.mesh.joints is None or draw.inst is not None:
        return new_drawable(draw, mode)
    if id(draw.mesh) not in made:
        made[id(draw.mesh)] = new_drawable(draw, mode)
    return made[id(draw.mesh)]


def new_drawable(draw, mode):
    """A mesh or instances."""
    mesh = draw.mesh
    made = e3d.Mesh(
        mesh.pos,
        mesh.idx.astype(np.int32),
        normals=mesh.nrm,
        uvs=mesh.uv,
        tangents=mesh.tan,
        colors=mesh.col,
        materials=[material(draw, mode)],
        joints=mesh.joints,
        weights=mesh.weights,
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
    return e3d.Material(**held, two_sided=mode == "glass")


def lights(scene):
    """(light, position) pairs of the neutral description."""
    if scene.mode == "pbr":
        yield from physical_lights(scene)
    elif scene.light_pos is not None:
        for (x, y, z, radius), color in zip(scene.light_pos, scene.light_col, strict=True):
            color = tuple(map(float, color[:3]))
            light = e3d.PointLight(color=color, range=float(radius), falloff="window")
            yield light, (float(x), float(y), float(z))
    elif scene.mode in ("lit", "skin", "glass", "shadow"):
        strength = 1.0 - float(scene.ambient)
        direction = tuple(-float(c) for c in scene.light_dir)
        light = e3d.DirectionalLight(direction=direction, color=(strength,) * 3)
        if scene.mode == "shadow":
            light.shadow, light.shadow_map_size = "map", int(scene.shadow.size)
            light.shadow_cascades = 1  # one map, as the description has it
        yield light, None


def physical_lights(scene):
    """A sun and lamps; a white surface that faces one shows its colour."""
    direction = tuple(-float(c) for c in scene.light_dir)
    yield e3d.DirectionalLight(direction=direction), None
    for (x, y, z, _), color in zip(scene.light_pos, scene.light_col, strict=True):
        color = tuple(map(float, color[:3]))
        yield e3d.PointLight(color=e3d.linear(color)), (float(x), float(y), float(z))
