"""Pictures for agents: what they show, what is told of them, what makes them blank."""

import numpy as np
import pytest

import engine3d as e3d


def test_a_picture_comes_with_what_shows(loaded):
    image, told = loaded.picture("render")
    assert image.size == (800, 600) == tuple(told["size"])
    assert [one["name"] for one in told["visible"]] == ["three/ball", "three/box", "three/ring"]
    assert not told["blank"] and told["not_visible"] == []
    x, y, width, height = told["visible"][0]["box"]
    pixels = np.asarray(image)[y : y + height, x : x + width]
    assert pixels.std() > 5  # the ball, and not the background


def test_the_same_call_gives_the_same_bytes(loaded):
    pictures = [loaded.call("render", labels=True).content[0].data for _ in range(2)]
    loaded.told("render", view="top", look="edges")
    pictures.append(loaded.call("render", labels=True).content[0].data)
    assert len(set(pictures)) == 1


@pytest.mark.parametrize("view", ["front", "right", "back", "left", "top", "bottom", "iso"])
def test_each_view_shows_its_side(loaded, view):
    _, told = loaded.picture("render", view=view, size=[200, 150])
    sight = np.subtract(told["camera"]["target"], told["camera"]["position"])
    expected = {"front": (0, 0, -1), "right": (-1, 0, 0), "top": (0, -1, 0)}
    for name, other in (("back", "front"), ("left", "right"), ("bottom", "top")):
        expected[name] = -np.array(expected[other])
    expected["iso"] = np.array((-1, -1, -1)) / 3**0.5
    np.testing.assert_allclose(sight / np.linalg.norm(sight), expected[view], atol=1e-6)
    assert not told["blank"]


def test_an_object_fills_the_picture_by_its_name(loaded):
    _, told = loaded.picture("render", view="three/ring", size=[200, 200], objects="three/ring")
    x, y, width, height = told["visible"][0]["box"]
    assert max(width, height) > 180
    _, beside = loaded.picture(
        "render", view={"azimuth": 0, "elevation": 0, "fit": ["three/ring"]}, size=[200, 200]
    )
    assert {one["name"] for one in beside["visible"]} >= {"three/ring"}


def test_distance_moves_the_camera(loaded):
    _, told = loaded.picture("render", view={"azimuth": 0, "elevation": 0, "distance": 40})
    middle = np.mean(loaded.told("scene")["bounds"], axis=0)
    assert np.linalg.norm(told["camera"]["position"] - middle) == pytest.approx(40, rel=1e-5)
    assert told["visible"][0]["pixels"] < 3000


def test_hidden_objects_do_not_show(loaded):
    _, told = loaded.picture("render", hide=["three/ball"])
    assert [one["name"] for one in told["visible"]] == ["three/box", "three/ring"]
    _, told = loaded.picture("render", objects=["three/ball", "three/box"], hide="three/box")
    assert [one["name"] for one in told["visible"]] == ["three/ball"]


@pytest.mark.parametrize("look", ["studio", "plain", "edges", "normals", "depth", "ids"])
def test_each_look_is_another_picture(loaded, look):
    image, _ = loaded.picture("render", look=look, size=[160, 120])
    others = {"studio", "plain", "edges", "normals", "depth", "ids"} - {look}
    for other in sorted(others):
        assert (
            np.asarray(loaded.picture("render", look=other, size=[160, 120])[0])
            != np.asarray(image)
        ).any()


def test_transparent_pictures_show_only_objects(loaded):
    image, told = loaded.picture("render", transparent=True)
    alpha = np.asarray(image.convert("RGBA"))[..., 3]
    covered = sum(one["pixels"] for one in told["visible"])
    assert (alpha == 0).sum() > 0.5 * alpha.size
    assert covered == pytest.approx((alpha > 127).sum(), rel=0.02)


def test_names_stand_on_their_objects(loaded):
    plain, told = loaded.picture("render")
    named, _ = loaded.picture("render", labels=True)
    changed = (np.asarray(plain) != np.asarray(named)).any(axis=2)
    for one in told["visible"]:
        x, y, width, height = one["box"]
        assert changed[y : y + height, x : x + width].any()


def test_highlights_tint_what_they_name(loaded):
    plain, told = loaded.picture("render")
    lit, _ = loaded.picture("render", highlight=[{"object": "three/ball"}])
    changed = (np.asarray(plain) != np.asarray(lit)).any(axis=2)
    ball = next(one for one in told["visible"] if one["name"] == "three/ball")
    assert ball["pixels"] <= changed.sum() < ball["pixels"] * 1.1
    face = loaded.told("pick", x=400, y=300)["triangle"]
    one, _ = loaded.picture("render", highlight=[{"object": "three/box", "faces": [face]}])
    assert 0 < (np.asarray(plain) != np.asarray(one)).any(axis=2).sum() < changed.sum()


def test_a_section_shows_what_is_within(agent):
    agent.told("load", path="block.stl", name="block", up="+Y")
    whole, _ = agent.picture("render")
    cut, told = agent.picture("render", section={"axis": "z", "at": 0.5})
    assert [(one["name"], one["area"]) for one in told["cut"]] == [("block", pytest.approx(2))]
    assert told["camera"]["projection"] == "parallel"
    assert (np.asarray(cut) != np.asarray(whole)).any()
    found = agent.told("pick", x=400, y=300)
    assert found["object"] == "block"
    assert "from the edge" in agent.error("render", view="top", section={"axis": "x"})
    assert "section must be like" in agent.error("render", section={"axes": "x"})


def test_a_blank_picture_says_why(agent):
    _, told = agent.picture("render")
    assert told["blank"] and told["reason"].startswith("no_geometry")
    agent.told("load", path="block.stl", name="block")
    agent.told("edit", name="block", visible=False)
    assert agent.picture("render")[1]["blank"]
    _, told = agent.picture("render", view={"distance": 1e7}, objects="block")
    assert told["blank"] and told["reason"].startswith("far_away")


def test_views_are_a_grid_whose_pixels_are_known(loaded):
    image, told = loaded.picture("views", names="front,top,iso", sections="z=0.1", size=[900, 700])
    assert image.size == (900, 700)
    names = [cell["name"] for cell in told["cells"]]
    assert names == ["front", "top", "iso", "section z=0.1", "cutaway z=0.1"]
    x, y, width, height = told["cells"][2]["box"]
    found = loaded.told("pick", x=x + width // 2, y=y + height // 2)
    assert found["view"] == "iso"
    assert loaded.told("pick", x=0, y=0) == {"object": None, "view": None}


@pytest.mark.parametrize("frames", [2, 5, 8])
def test_a_turntable_is_a_grid_of_all_sides(loaded, frames):
    image, told = loaded.picture("turntable", frames=frames, size=[600, 400])
    assert image.size == (600, 400) and len(told["cells"]) == frames
    for cell in told["cells"]:
        x, y, width, height = cell["box"]
        assert x + width <= 600 and y + height <= 400 and not cell["blank"]
    assert "a turntable" in loaded.error("pick", x=1, y=1)


def test_a_turntable_may_move(loaded):
    image, told = loaded.picture("turntable", frames=4, size=[80, 60], format="webp")
    assert image.format == "WEBP" and image.n_frames == 4 and image.size == (80, 60)


def test_pixels_are_those_of_rays(loaded):
    loaded.told("render")
    for x, y in ((400, 300), (300, 400), (520, 430), (240, 120)):
        found = loaded.told("pick", x=x, y=y)
        assert found["object"] is not None
        camera = loaded.told("scene")["camera"]
        away = np.subtract(found["position"], camera["position"])
        assert np.linalg.norm(away) == pytest.approx(found["distance"], rel=1e-5)
        assert np.dot(away, found["normal"]) < 0
    assert loaded.told("pick", x=5, y=5)["object"] is None
    assert loaded.told("pick", x=50, y=40, view="front", size=[100, 80])["view"] == "front"


def test_far_models_keep_their_coordinates(agent):
    mesh = e3d.box()
    scene = e3d.Scene()
    scene.add(mesh, name="far", translation=(1e6, 2e6, 3e6))
    e3d.save_scene(scene, agent.root / "far.e3d.json")
    agent.told("load", path="far.e3d.json", name="far")
    _, told = agent.picture("render", view="front")
    assert not told["blank"]
    np.testing.assert_allclose(told["camera"]["target"], (1e6, 2e6, 3e6), rtol=1e-6)
    found = agent.told("pick", x=400, y=300)
    assert found["position"][2] == pytest.approx(3e6 + 0.5)
    assert agent.told("measure")["center"] == pytest.approx([1e6, 2e6, 3e6])


def test_the_last_picture_is_a_resource(loaded):
    async def read(client):
        drawn = await client.call_tool("render", {"size": [64, 48]})
        last = await client.read_resource("engine3d://render/last.png")
        scene = await client.read_resource("engine3d://scene")
        return drawn.content[0].data, last.contents[0].blob, scene.contents[0].text

    drawn, last, scene = loaded.ask(read)
    assert drawn == last and '"three/box"' in scene
