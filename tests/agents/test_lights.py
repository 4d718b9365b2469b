"""Lights of an agent's objects move with them, and shine where an object is nothing else."""

import numpy as np
import pytest
from agents.conftest import Agent

import engine3d as e3d

RED = 0.25, 0.0, 0.0
POINT = e3d.PointLight(intensity=20.0)


@pytest.fixture
def lit(agent):
    """A floor with a lamp above its corner, and a file that is a lamp alone."""
    floor = e3d.box((4, 0.25, 4))
    scene = e3d.Scene()
    scene.add(floor, name="floor")
    scene.add(POINT, translation=(1.5, 1, 1.5))
    e3d.save_scene(scene, agent.root / "lit.e3d.json")
    lamp, dark = e3d.Scene(), e3d.Scene()
    lamp.add(POINT, translation=(1.5, 1, 1.5))
    e3d.save_scene(lamp, agent.root / "lamp.e3d.json")
    dark.add(floor, name="floor")
    e3d.save_scene(dark, agent.root / "dark.e3d.json")
    return agent


def drawn(agent, **options):
    picture, _ = agent.picture("render", view="top", size=[64, 48], look="plain", **options)
    return np.asarray(picture.convert("RGB")).astype(int)


def differ(a, b):
    return float(np.abs(a - b).mean())


@pytest.mark.parametrize(
    "change",
    [{"translate": [64, 0, 0]}, {"rotate": {"axis": "y", "degrees": 360}}, {"scale": 1.0}],
)
def test_lights_move_with_their_object(lit, change):
    lit.told("load", path="lit.e3d.json", name="lit")
    before = drawn(lit)
    lit.told("edit", name="lit", **change)
    assert differ(before, drawn(lit)) < 1
    lit.told("undo")
    assert differ(before, drawn(lit)) == 0


def test_lights_turn_and_scale_about_the_middle_of_their_object(lit):
    lit.told("load", path="lit.e3d.json", name="lit")
    (low, high) = lit.told("scene")["bounds"]
    middle = (np.array(low) + high) / 2
    lit.told("edit", name="lit", rotate={"axis": "y", "degrees": 180}, scale=2.0)
    ((_, pose),) = lit.session.things["lit"].lights
    wanted = middle + 2 * np.array([-1.5, 1 - middle[1], -1.5])
    assert pose[:3, 3] == pytest.approx(wanted)


def test_lights_stay_where_one_of_several_parts_moves(lit):
    scene = e3d.Scene()
    scene.add(e3d.box(), name="a")
    scene.add(e3d.box(), name="b")
    scene.add(POINT, translation=(1.5, 1, 1.5))
    e3d.save_scene(scene, lit.root / "two.e3d.json")
    lit.told("load", path="two.e3d.json", name="two")
    lit.told("edit", name="two/a", translate=[9, 0, 0])
    ((_, pose),) = lit.session.things["two"].lights
    assert pose[:3, 3].tolist() == [1.5, 1, 1.5]


def test_an_object_that_is_lights_alone_shines(lit):
    lit.told("load", path="lit.e3d.json", name="lit")
    wanted = drawn(lit)
    lit.told("edit", name="lit", delete=True)
    lit.told("load", path="dark.e3d.json", name="dark")
    dark = drawn(lit)
    assert lit.told("load", path="lamp.e3d.json", name="lamp")["warnings"] == [
        "it has no mesh, only lights"
    ]
    assert differ(drawn(lit), wanted) == 0 < differ(dark, wanted)
    assert differ(drawn(lit, objects=["dark"]), dark) == 0
    assert differ(drawn(lit, hide=["lamp"]), dark) == 0
    assert differ(drawn(lit, objects=["dark", "lamp"]), wanted) == 0
    row = next(one for one in lit.told("scene")["objects"] if one["name"] == "lamp")
    assert row["triangles"] == 0 and row["visible"] and lit.told("scene")["lights"]


def test_an_object_that_is_lights_alone_is_edited(lit):
    lit.told("load", path="lamp.e3d.json", name="lamp")
    lit.told("load", path="dark.e3d.json", name="dark")
    near = drawn(lit)
    told = lit.told("edit", name="lamp", translate=[-3, 0, 0])
    assert told["bounds"] is None
    assert differ(near[:, ::-1], drawn(lit)) < 1
    lit.told("edit", name="lamp", visible=False)
    assert differ(near, drawn(lit)) > 1
    lit.told("edit", name="lamp", visible=True, translate=[3, 0, 0])
    assert differ(near, drawn(lit)) == 0
    assert "no mesh to color" in lit.error("edit", name="lamp", color="red")
    assert "'lamp' has no mesh" in lit.error("measure", objects=["lamp"])
    assert lit.told("edit", name="lamp", delete=True)["objects"] == ["dark"]
    assert "there is no 'lamp'" in lit.error("edit", name="lamp", delete=True)
    assert lit.told("undo")["objects"] == ["lamp", "dark"]


def test_lights_are_exported_or_named(lit):
    lit.told("load", path="dark.e3d.json", name="dark")
    lit.told("load", path="lamp.e3d.json", name="lamp")
    lit.told("export", path="both.glb")
    scene = e3d.load_scene(lit.root / "both.glb")
    assert [type(one.object) for one in scene.nodes if isinstance(one.object, e3d.PointLight)]
    texts = [part.text for part in lit.call("export", path="both.stl").content]
    assert "both.stl: .stl files hold no lights: 1 left out" in "\n".join(texts)


def saved(agent, name, **surroundings):
    """Write a floor with a lamp in a scene of some surroundings."""
    scene = e3d.Scene(ambient=surroundings.pop("ambient", (0, 0, 0)))
    scene.add(e3d.box((4, 0.25, 4)), name="floor")
    scene.add(POINT, translation=(1.5, 1, 1.5))
    for key, value in surroundings.items():
        setattr(scene, key, value)
    e3d.save_scene(scene, agent.root / f"{name}.e3d.json")
    return scene


def from_below(agent, **options):
    view = {"azimuth": 20, "elevation": -30}
    picture, told = agent.picture("render", view=view, size=[64, 48], look="plain", **options)
    return np.asarray(picture.convert("RGB")).astype(int), told["camera"]


@pytest.mark.parametrize("way", ["file", "script", "list"])
def test_pictures_have_the_ambient_light_and_the_environment_of_files(tmp_path, way):
    agent = Agent(tmp_path, allow_scripts=True)
    sky = e3d.Environment(np.full((4, 8, 3), (0.1, 0.2, 0.4), np.float32))
    metal = e3d.Material(color="silver", metallic=1.0)
    scene = saved(agent, "lit", ambient=(0.3, 0.2, 0.1), environment=sky, environment_intensity=2)
    next(node for node in scene.nodes if node.name == "floor").object.materials = [metal]
    e3d.save_scene(scene, tmp_path / "lit.e3d.json")
    path = str(tmp_path / "lit.e3d.json")
    made = f"engine3d.load_scene({path!r})"
    made = f"[{made}]" if way == "list" else made
    if way == "file":
        agent.told("load", path="lit.e3d.json")
    else:
        agent.told("script", code=f"import engine3d\ndef build(): return {made}")
    pixels, seen = from_below(agent)
    eye = e3d.look_at(seen["position"], seen["target"], up=seen["up"])
    camera = e3d.PerspectiveCamera(np.radians(seen["yfov"])), eye
    frame = e3d.render(scene, camera, size=(64, 48), outputs=("color", "object_id"))
    on = frame.object_id >= 0
    within = on & np.all([np.roll(on, step, axis) for step in (-1, 1) for axis in (0, 1)], axis=0)
    assert within.sum() > 300
    assert np.abs(pixels - frame.color[..., :3])[within].max() <= 1


def test_ambient_light_of_several_objects_is_the_larger_one(agent):
    saved(agent, "red", ambient=e3d.linear(*RED))
    saved(agent, "blue", ambient=e3d.linear(0.125, 0, 0.25))
    saved(agent, "both", ambient=e3d.linear(0.25, 0, 0.25))
    agent.told("load", path="both.e3d.json", name="both")
    wanted, _ = from_below(agent)
    agent.told("undo")
    agent.told("load", path="red.e3d.json", name="red")
    red, _ = from_below(agent)
    agent.told("load", path="blue.e3d.json", name="blue")
    both, _ = from_below(agent)
    assert differ(both, wanted) < 1 < differ(red, wanted)
    agent.told("edit", name="blue", visible=False)
    assert differ(from_below(agent)[0], red) == 0
    agent.told("export", path="out.e3d.json")
    assert e3d.load_scene(agent.root / "out.e3d.json").ambient == e3d.linear(*RED)


def test_a_file_without_lights_wears_the_look_alone(agent):
    for name, ambient in (("dim", 0.0), ("bright", 0.8)):
        scene = e3d.Scene(ambient=(ambient,) * 3)
        scene.add(e3d.box((4, 0.25, 4)), name="floor")
        e3d.save_scene(scene, agent.root / f"{name}.e3d.json")
    pictures = []
    for name in ("dim", "bright"):
        agent.told("load", path=f"{name}.e3d.json", name=name)
        pictures.append(from_below(agent)[0])
        agent.told("undo")
    assert differ(*pictures) == 0
