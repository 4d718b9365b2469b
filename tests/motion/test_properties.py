"""Properties of materials, cameras, lights and nodes that clips change, and files that say so."""

import base64
import json

import numpy as np
import pytest
from loaders.seeds import FILES
from loaders.test_gltf import data_uri, png, triangle_tree
from plain_picture import Renderer

import engine3d as e3d
from engine3d import lights
from engine3d.io.formats.gltf import gltf_pointers
from engine3d.model.motion import properties
from engine3d.model.motion.properties import Property, range_of

TEXTURE = e3d.Texture(np.arange(48, dtype=np.uint8).reshape(4, 4, 3))


def things():
    """One of each kind of thing whose properties change."""
    slots = dict.fromkeys(properties.TEXTURE_SLOTS, TEXTURE)
    return {
        e3d.Material: e3d.Material(metallic=0.5, color=(9, 8, 7), **slots),
        e3d.PerspectiveCamera: e3d.PerspectiveCamera(),
        e3d.OrthographicCamera: e3d.OrthographicCamera(2.0),
        e3d.DirectionalLight: e3d.DirectionalLight(),
        e3d.PointLight: e3d.PointLight(range=5.0, falloff="gltf"),
        e3d.SpotLight: e3d.SpotLight(range=5.0),
        **{kind: kind(range=5.0) for kind in (lights.RectangleLight, lights.DiscLight)},
        lights.TubeLight: lights.TubeLight(range=5.0),
    }


PATHS = [(kind, path) for kind, held in properties._PROPERTIES.items() for path in held]


def test_an_index_of_refraction_of_0_stays():
    """It is allowed, apart from the range that clips keep to."""
    material = e3d.Material(metallic=0.0, ior=1.5)
    for put, held in ((0.0, 0.0), (0.3, 0.0), (0.7, 1.0), (1.2, 1.2), (-3.0, 0.0)):
        Property(material, "ior").put(np.array([put]))
        assert material.ior == held


@pytest.mark.parametrize(("kind", "path"), PATHS)
def test_every_property_changes_and_is_put_back(kind, path):
    thing = things()[kind]
    limits, held = range_of(thing, path), Property(thing, path).held()
    low, high = max(limits.low, -3.0), min(limits.high, 3.0)
    keys = np.array([[low] * limits.width, [high] * limits.width])
    if path == "color" and limits.width == 4:
        keys[1, 3] = 1.0
    values = e3d.linear(keys) if limits.is_color else keys
    channel = e3d.motion.PropertyChannel(thing, path, [0, 2], values)
    player = e3d.AnimationPlayer(e3d.Scene(), [e3d.motion.AnimationClip([channel])])
    player.loop = "once"
    player.play()
    for time, share in ((0.0, 0.0), (1.0, 0.5), (5.0, 1.0), (0.5, 0.25)):
        player.seek(time)
        found = Property(thing, path).numbers()
        assert np.allclose(found, keys[0] * (1 - share) + keys[1] * share, atol=1e-6)
    player.stop()
    assert Property(thing, path).held() is held or Property(thing, path).held() == held


def test_what_splines_have_beyond_the_limits_is_the_limit():
    material = e3d.Material(metallic=0.5)
    keys = [[[0], [0], [9]], [[-9], [1], [0]]]
    channel = e3d.motion.PropertyChannel(material, "metallic", [0, 1], keys, "cubicspline")
    player = e3d.AnimationPlayer(e3d.Scene(), [e3d.motion.AnimationClip([channel])])
    player.play()
    found = []
    for time in np.linspace(0, 0.999, 30):
        player.seek(time)
        found.append(material.metallic)
    assert max(found) == 1.0 and min(found) == 0.0
    lens = e3d.PerspectiveCamera(znear=0.5, zfar=1.0)
    channel = e3d.motion.PropertyChannel(
        lens, "znear", [0, 1], np.array(keys) * 0.5 + 0.1, "cubicspline"
    )
    player = e3d.AnimationPlayer(e3d.Scene(), [e3d.motion.AnimationClip([channel])])
    player.play()
    for time in np.linspace(0, 0.999, 30):
        player.seek(time)
        assert 0.0999 < lens.znear < 0.6001


@pytest.mark.parametrize(
    ("target", "path", "message"),
    [
        (e3d.Material(), "shine", "path must be one of"),
        (e3d.Material(), "texture.offset", "the material has no texture"),
        (e3d.PointLight(), "yfov", "path must be one of"),
        (TEXTURE, "filter", "target must be a Node, Material, camera or light"),
        (e3d.Material(), ["color"], "path must be one of"),
    ],
)
def test_what_does_not_change_is_told(target, path, message):
    with pytest.raises(e3d.InvalidArgumentError, match=message):
        e3d.motion.PropertyChannel(target, path, [0], [[0]])


def rich_tree():
    """A file whose material has every part, with a camera of each kind, lights, morph targets."""
    tree = json.loads(FILES["moving.gltf"])
    image = np.full((2, 2, 3), 200, np.uint8)
    tree["images"] = [{"uri": data_uri(png(image), "image/png")}]
    material = tree["materials"][0]
    for key in gltf_pointers._MATERIALS:
        *way, last = key.split("/")
        place = material
        for name in way:
            place = place.setdefault(name, {})
            if name.endswith("Texture"):
                place.setdefault("index", 0)
    lights = tree["extensions"]["KHR_lights_punctual"]["lights"]
    lights[0]["range"] = 9.0
    tree["cameras"][0]["perspective"]["zfar"] = 9.0
    tree["animations"] = []
    return tree


def pointers():
    """Every pointer that plays, and a value for it."""
    found = {f"/materials/0/{key}": width for key, (_, width) in gltf_pointers._MATERIALS.items()}
    found |= {f"/cameras/{int(k[0] == 'o')}/{k}": 1 for k in gltf_pointers._LENSES}
    place = "/extensions/KHR_lights_punctual/lights/0"
    found |= {f"{place}/{key}": 3 if key == "color" else 1 for key in gltf_pointers._LAMPS}
    found |= {"/nodes/3/extensions/KHR_node_visibility/visible": 1, "/nodes/0/weights/0": 1}
    found |= {"/nodes/1/translation": 3, "/nodes/2/rotation": 4, "/nodes/2/scale": 3}
    return found


def with_clip(tree, moved, interpolation="LINEAR"):
    """The tree with a clip of 2 seconds that moves what pointers name."""
    data = np.array([0.0, 2.0], np.float32).tobytes()
    views, accessors = tree["bufferViews"], tree["accessors"]

    def add(array, component=5126):
        nonlocal data
        buffer = len(tree["buffers"])
        views.append({"buffer": buffer, "byteOffset": len(data), "byteLength": array.nbytes})
        data += array.tobytes() + bytes(-array.nbytes % 4)
        kind = "SCALAR" if array.shape[1] == 1 else f"VEC{array.shape[1]}"
        accessor = {"bufferView": len(views) - 1, "componentType": component, "type": kind}
        accessors.append({**accessor, "count": len(array)})
        return len(accessors) - 1

    views.append({"buffer": len(tree["buffers"]), "byteLength": 8})
    times = {"bufferView": len(views) - 1, "componentType": 5126, "count": 2, "type": "SCALAR"}
    accessors.append(times)
    at = len(accessors) - 1
    samplers, channels = [], []
    for pointer, width in moved.items():
        values = np.linspace(0.25, 1.0, 2 * width).reshape(2, width).astype(np.float32)
        if pointer.endswith(("/ior", "Ior", "zfar", "outerConeAngle")):
            values = np.minimum(values + np.float32(1), np.float32(1.5))
        if pointer.endswith(("znear", "innerConeAngle")):
            values *= np.float32(0.5)
        is_flag = pointer.endswith("visible")
        values = np.array([[1], [0]], np.uint8) if is_flag else values
        output = add(values, 5121 if is_flag else 5126)
        sampler = {"input": at, "output": output}
        samplers.append({**sampler, "interpolation": "STEP" if is_flag else interpolation})
        target = {"path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": pointer}}}
        channels.append({"sampler": len(samplers) - 1, "target": target})
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    tree["buffers"].append({"byteLength": len(data), "uri": uri})
    tree["animations"].append({"name": "all", "samplers": samplers, "channels": channels})
    return tree


def loaded(tree, path):
    path.write_text(json.dumps(tree))
    return e3d.load_scene(path)


def end_of(scene):
    """What every channel of the clip is at its end, by target kind and path."""
    player = e3d.AnimationPlayer(scene)
    player.loop = "once"
    player.play("all")
    player.seek(2.0)
    found = {}
    for channel in player.clips[0].channels:
        if isinstance(channel, e3d.motion.PropertyChannel):
            key = type(channel.target).__name__, channel.path
            found[key] = Property(channel.target, channel.path).numbers().tolist()
        else:
            found["Node", channel.path] = getattr(channel.node, channel.path).tolist()
    player.stop()
    return found


@pytest.mark.filterwarnings("ignore::engine3d.errors.Engine3DWarning")
def test_every_pointer_plays_and_is_written_again(tmp_path):
    plain = loaded(rich_tree(), tmp_path / "a.gltf")
    scene = loaded(with_clip(rich_tree(), pointers()), tmp_path / "a.gltf")
    assert scene.warnings == plain.warnings
    found = end_of(scene)
    assert len(found) == len(pointers())
    assert found["Node", "visible"] == [0.0]
    assert found["Node", "weights.0"] == [1.0]
    assert found["Material", "color"] == pytest.approx([0.25 + 0.75 * k / 7 for k in (4, 5, 6, 7)])
    assert found["Material", "normal_texture.scale"] == pytest.approx([0.75, 1.0])
    assert found["PerspectiveCamera", "zfar"] == [1.5]
    scene.save(tmp_path / "b.glb")
    again = end_of(e3d.load_scene(tmp_path / "b.glb"))
    assert again.keys() == found.keys()
    for key, numbers in found.items():
        assert again[key] == pytest.approx(numbers, abs=1e-6), key


@pytest.mark.parametrize(
    "pointer",
    [
        "/materials/0/pbrMetallicRoughness/shine",
        "/materials/0/extensions/EXT_materials_subsurface/subsurfaceFactor",
        "/cameras/0/perspective/aspectRatio",
        "/nodes/0/matrix",
        "/extensions/EXT_lights_ies/lights/0/color",
        "/materials/00/a~1b",
        "/scenes",
        "/",
    ],
)
def test_what_is_not_played_is_named(tmp_path, pointer):
    with pytest.warns(e3d.Engine3DWarning, match="is not played: left out"):
        scene = loaded(with_clip(rich_tree(), {pointer: 1}), tmp_path / "a.gltf")
    assert any(repr(pointer) in told for told in scene.warnings)
    assert len(scene.nodes) == 6


@pytest.mark.filterwarnings("ignore::engine3d.errors.Engine3DWarning")
@pytest.mark.parametrize("pointer", ["/materials/9/alphaCutoff", "materials", "/nodes/99/scale", 7])
def test_pointers_to_nothing_are_left_out(tmp_path, pointer):
    moved = {"/materials/0/alphaCutoff": 1, pointer if isinstance(pointer, str) else "/x": 1}
    tree = with_clip(rich_tree(), moved)
    said = tree["animations"][0]["channels"][1]["target"]["extensions"]["KHR_animation_pointer"]
    said["pointer"] = pointer
    scene = loaded(tree, tmp_path / "a.gltf")
    assert any("animations[0].channels[1] is left out" in told for told in scene.warnings)
    assert {c.path for c in scene.animations["all"].channels} == {"alpha_cutoff"}


def test_planes_that_would_cross_stay(tmp_path):
    tree = with_clip(rich_tree(), {"/cameras/0/perspective/znear": 1})
    tree["cameras"][0]["perspective"]["zfar"] = 0.5
    scene = loaded(tree, tmp_path / "a.gltf")
    assert "animation 'all': znear would be beyond zfar: both stay" in scene.warnings
    assert scene.animations["all"].channels == ()


def test_weights_of_a_mesh_move_all_nodes_that_show_it(tmp_path):
    tree = rich_tree()
    del tree["nodes"][0]["weights"]
    tree["nodes"].append({"mesh": 0, "skin": 0})
    tree["scenes"][0]["nodes"].append(5)
    with_clip(tree, {"/meshes/0/weights": 1})
    scene = loaded(tree, tmp_path / "a.gltf")
    assert len(scene.animations["all"].channels) == 2


@pytest.mark.filterwarnings("ignore::engine3d.errors.Engine3DWarning")
def test_a_kept_renderer_draws_what_a_fresh_one_does(tmp_path):
    tree = triangle_tree()
    image = np.random.default_rng(1).integers(0, 255, (8, 8, 3), np.uint8)
    tree["images"] = [{"uri": data_uri(png(image), "image/png")}]
    tree["textures"] = [{"source": 0}]
    part = {"baseColorTexture": {"index": 0}}
    tree["materials"] = [{"pbrMetallicRoughness": part, "alphaMode": "BLEND"}]
    tree["meshes"][0]["primitives"][0]["material"] = 0
    lamp = {"extensions": {"KHR_lights_punctual": {"light": 0}}, "translation": [0, 0, 2]}
    tree["nodes"] += [{"mesh": 0, "translation": [0.3, 0.2, 0.1]}, lamp]
    tree["scenes"][0]["nodes"] = [0, 1, 2]
    tree["extensions"] = {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 9}]}}
    tree["animations"] = []
    base = "/materials/0/pbrMetallicRoughness"
    moved = {f"{base}/baseColorFactor": 4, f"{base}/roughnessFactor": 1}
    moved |= {"/materials/0/emissiveFactor": 3}
    moved |= {f"{base}/baseColorTexture/extensions/KHR_texture_transform/offset": 2}
    moved |= {"/extensions/KHR_lights_punctual/lights/0/intensity": 1}
    moved |= {"/nodes/1/extensions/KHR_node_visibility/visible": 1, "/nodes/0/translation": 3}
    path = tmp_path / "a.gltf"
    with_clip(tree, moved)

    def viewed():
        scene = loaded(tree, path)
        scene.add(e3d.OrthographicCamera(1.0), translation=(0.5, 0.5, 3))
        return scene

    def drawn(renderer, scene, time):
        player = e3d.AnimationPlayer(scene)
        player.loop = "once"
        player.play("all")
        player.seek(time)
        color = renderer.render(scene).color.tobytes()
        player.stop()
        return color

    kept, scene = Renderer((48, 48), threads=1), viewed()
    pictures = {}
    for time in (0.0, 1.0, 2.0, 0.5, 0.0, 2.0):
        picture = drawn(kept, scene, time)
        assert pictures.setdefault(time, picture) == picture
        assert drawn(Renderer((48, 48), threads=1), viewed(), time) == picture
    assert len(set(pictures.values())) == 4
