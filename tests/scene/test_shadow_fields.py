"""What lights and nodes say of shadows: saved, copied, put back, and told where it is lost."""

import math

import pytest

import engine3d as e3d
from engine3d.apps.editor.node_commands import copy_nodes
from engine3d.apps.editor.scene_state import SceneState

FIELDS = {
    "shadow": "map",
    "shadow_map_size": 512,
    "shadow_bias": -0.001,
    "shadow_normal_bias": 0.02,
    "shadow_radius": 1.5,
    "shadow_taps": 5,
    "shadow_softness": 0.25,
}


def scene_of_shadows():
    scene = e3d.Scene()
    scene.add(e3d.DirectionalLight((1, -1, 0), shadow_cascades=2, **FIELDS))
    scene.add(e3d.PointLight(**FIELDS))
    scene.add(e3d.SpotLight(**FIELDS))
    scene.add(e3d.box(1.0), name="caster", receive_shadows=False)
    scene.add(e3d.box(1.0), name="receiver", cast_shadows=False)
    return scene


def switches(scene):
    return [(node.cast_shadows, node.receive_shadows) for node in scene.nodes]


def test_lights_have_no_shadow_by_default():
    for light in (e3d.DirectionalLight(), e3d.PointLight(), e3d.SpotLight()):
        assert light.shadow == "none"
        assert (light.shadow_map_size, light.shadow_radius, light.shadow_taps) == (1024, 1.0, 3)
        assert (light.shadow_bias, light.shadow_normal_bias) == (0.0, 0.0)
        assert light.shadow_softness == 0.0


def test_scene_files_keep_it(tmp_path):
    scene = scene_of_shadows()
    e3d.save_scene(scene, tmp_path / "shadows.e3d")
    again = e3d.load_scene(tmp_path / "shadows.e3d")
    assert switches(again) == switches(scene)
    for node, other in zip(scene.nodes[:3], again.nodes[:3], strict=True):
        for name in FIELDS:
            assert getattr(other.object, name) == getattr(node.object, name), name
    assert again.nodes[0].object.shadow_cascades == 2


def test_gltf_files_tell_that_they_do_not(tmp_path):
    with pytest.warns(e3d.Engine3DWarning, match="gltf files do not hold .*shadows"):
        e3d.save_scene(scene_of_shadows(), tmp_path / "shadows.glb")


def test_copies_of_nodes_have_the_same_switches():
    scene = scene_of_shadows()
    for node in scene.nodes[3:]:
        (twin,) = copy_nodes(scene, {node: None})
        assert (twin.cast_shadows, twin.receive_shadows) == (
            node.cast_shadows,
            node.receive_shadows,
        )


def test_a_state_puts_switches_back():
    scene = scene_of_shadows()
    state = SceneState(scene)
    for node in scene.nodes:
        node.cast_shadows = not node.cast_shadows
        node.receive_shadows = not node.receive_shadows
    assert SceneState(scene) != state
    state.put()
    assert SceneState(scene) == state
    assert switches(scene)[3:] == [(True, False), (False, True)]


@pytest.mark.parametrize("shadow", [True, False, 1, None, "soft"])
def test_other_words_are_answered_by_those_that_are_meant(shadow):
    with pytest.raises(e3d.InvalidArgumentError, match="shadow must be one of 'none', 'map'"):
        e3d.PointLight(shadow=shadow)


def test_a_spot_of_half_a_turn_may_have_a_shadow():
    light = e3d.SpotLight(shadow="map", outer_cone_angle=math.pi / 2)
    light.check()
