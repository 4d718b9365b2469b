"""A scene that is drawn with what stands beside it: the same bytes as of one that holds it all."""

import numpy as np
import pytest

import engine3d as e3d
from engine3d.model.scene.staged_scene import StagedScene

SIZE = (96, 72)
OUTPUTS = ("color", "depth", "object_id", "face_id")
CAMERA = e3d.PerspectiveCamera(0.6), e3d.look_at((2.0, 1.5, 4.0), (0.0, 0.0, 0.0))


def build(staged):
    """A scene with a light of its own, and a light, a ground and another background."""
    scene = e3d.Scene(background=(10, 20, 30))
    ring = scene.add(e3d.torus(), name="ring")
    ball = scene.add(e3d.icosphere(subdivisions=2), parent=ring, translation=(2, 0, 0))
    lamp = scene.add(e3d.PointLight(), translation=(2, 3, 1))
    drawn = StagedScene(scene) if staged else scene
    beside = drawn.beside if staged else scene
    sun = beside.add(e3d.DirectionalLight((0.3, -1, -0.2), shadow="map"))
    ground = beside.add(e3d.box(), translation=(0, -1.5, 0), scale=(6, 0.1, 6))
    drawn.background, drawn.ambient = (1, 2, 3), (0.2, 0.1, 0.3)
    return scene, drawn, {"ring": ring, "ball": ball, "lamp": lamp, "sun": sun, "ground": ground}


CHANGES = [
    lambda scene, node: None,
    lambda scene, node: setattr(node["sun"], "euler", (0.4, 0.1, 0.0)),
    lambda scene, node: setattr(node["ball"], "translation", (0, 1, 0)),
    lambda scene, node: scene.remove(node["lamp"]),
    lambda scene, node: setattr(node["ground"], "visible", False),
    lambda scene, node: setattr(node["ring"].object.materials[0], "color", (1, 0, 0)),
    lambda scene, node: setattr(node["ball"], "object", e3d.cylinder()),
]


@pytest.mark.parametrize("mode", ["lit", "depth", "object_id"])
@pytest.mark.parametrize("cull", ["back", "auto"])
def test_it_is_drawn_as_one_scene_that_holds_it_all(mode, cull):
    one, other = build(False), build(True)
    with e3d.Renderer(SIZE) as first, e3d.Renderer(SIZE) as second:
        for change in CHANGES:
            frames = []
            for renderer, (scene, drawn, nodes) in ((first, one), (second, other)):
                change(scene, nodes)
                look = {"mode": mode, "cull": cull, "outputs": OUTPUTS}
                frames.append(renderer.render(drawn, CAMERA, **look))
            for name in OUTPUTS:
                assert np.array_equal(getattr(frames[0], name), getattr(frames[1], name)), name
    scene, drawn, nodes = other
    assert scene.background == (10, 20, 30) and scene.ambient == e3d.linear(0.1, 0.1, 0.1)
    assert len(scene.nodes) == 2 and nodes["ground"] not in scene.nodes


def test_nodes_that_come_later_have_ids_below_those_beside():
    scene, drawn, nodes = build(True)
    with e3d.Renderer(SIZE) as renderer:
        for _ in range(70):  # more objects than there was room for
            ball = scene.add(e3d.icosphere(0.2, 1), translation=(-1, 0.6, 0))
            frame = renderer.render(drawn, CAMERA, outputs=("object_id",))
        shown = set(np.unique(frame.object_id).tolist()) - {-1}
    assert max(shown) == drawn.data.first_added_id + nodes["ground"].id
    own = drawn.own_pixels(frame.object_id)
    assert set(np.unique(frame.object_id[own]).tolist()) <= {node.id for node in scene.nodes}
    assert drawn.data.first_added_id == ball.id + 1


def test_nodes_are_hidden_but_not_those_below_them():
    scene, drawn, nodes = build(True)
    drawn.hide([nodes["ring"]])
    with e3d.Renderer(SIZE) as renderer:
        frame = renderer.render(drawn, CAMERA, outputs=("object_id",))
        shown = np.unique(frame.object_id).tolist()
        assert nodes["ring"].id not in shown and nodes["ball"].id in shown
        assert nodes["ring"].visible and nodes["ring"].object is not None
        drawn.hide([])
        frame = renderer.render(drawn, CAMERA, outputs=("object_id",))
        assert nodes["ring"].id in np.unique(frame.object_id)


def test_the_lights_of_the_scene_are_left_out():
    scene, drawn, nodes = build(True)
    with e3d.Renderer(SIZE) as renderer:
        both = renderer.render(drawn, CAMERA).color.copy()
        drawn.keep_lights(False)
        one = renderer.render(drawn, CAMERA).color.copy()
        nodes["lamp"].visible = False
        drawn.keep_lights(True)
        assert (both != one).any()
        assert np.array_equal(renderer.render(drawn, CAMERA).color, one)


def test_a_part_of_a_bent_mesh_is_drawn_as_it_is_bent():
    flag = e3d.Mesh(
        [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)],
        [(0, 1, 2), (0, 2, 3)],
        material_ids=[0, 1],
        materials=[e3d.Material(name="one", unlit=True), e3d.Material(name="two", unlit=True)],
        morph_targets=[e3d.motion.MorphTarget(np.tile([0.5, 0.5, 0], (4, 1)))],
    )
    scene = e3d.Scene()
    node = scene.add(flag)
    drawn = StagedScene(scene)
    drawn.hide([], lambda thing: e3d.Mesh(thing.positions, thing.faces[:1]))
    with e3d.Renderer(SIZE) as renderer:
        for weight in (0.0, 1.0):
            node.morph_weights = [weight]
            frames = [
                renderer.render(what, CAMERA, cull="none", outputs=("face_id",))
                for what in (scene, drawn)
            ]
            whole, part = (frame.face_id for frame in frames)
            assert (part == 0).any() and np.array_equal(part == 0, whole == 0)
            assert (whole == 1).any() and not (part == 1).any()
