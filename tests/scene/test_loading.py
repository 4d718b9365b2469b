"""Scenes from documents: what becomes of objects, lights and cameras."""

import math

import numpy as np
import pytest

import engine3d as e3d
from engine3d.io.reading.documents import DocumentObject
from engine3d.io.scenes.scene_loading import scene_from_document
from engine3d.loaders import CameraRecord, Document, LightRecord


def document_of(*, lights=(), cameras=(), warnings=()):
    """A document with two boxes, at the origin and at x = 4: bounds -0.5..4.5, -0.5..0.5."""
    pose = np.eye(4)
    pose[0, 3] = 4
    return Document(
        "test",
        [DocumentObject("near", e3d.box()), DocumentObject("far", e3d.box(), pose)],
        list(lights),
        list(cameras),
        warnings=list(warnings),
    )


def objects_of(scene, kind):
    return [node for node in scene.nodes if isinstance(node.object, kind)]


def test_objects_keep_names_and_poses():
    scene = scene_from_document(document_of(warnings=["something is missing"]))
    near, far = objects_of(scene, e3d.Mesh)
    assert (near.name, far.name) == ("near", "far")
    assert far.translation.tolist() == [4, 0, 0]
    assert scene.warnings == ["something is missing"]


def test_ambient_light_is_the_scenes():
    scene = scene_from_document(document_of(lights=[LightRecord("ambient", color=(0.2, 0.4, 0.6))]))
    assert scene.ambient == e3d.linear(0.2, 0.4, 0.6)
    assert objects_of(scene, (e3d.PointLight, e3d.DirectionalLight)) == []


def test_a_point_light_is_as_bright_as_the_file_says_at_the_centre():
    record = LightRecord("point", (2, 10, 0), (1.0, 0.5, 0.25), 0.8, name="lamp")
    (node,) = objects_of(scene_from_document(document_of(lights=[record])), e3d.PointLight)
    assert node.name == "lamp"
    assert node.translation.tolist() == [2, 10, 0]
    assert node.object.color == e3d.linear(1.0, 0.5, 0.25)
    assert node.object.intensity == pytest.approx(0.8 * math.pi * 10**2)


def test_directional_light_shines_at_its_target():
    record = LightRecord("directional", (0, 5, 0), target=(0, 0, 0))
    (node,) = objects_of(scene_from_document(document_of(lights=[record])), e3d.DirectionalLight)
    assert node.object.direction.tolist() == [0, -5, 0]


def test_spot_light_becomes_a_point_light_and_says_so():
    record = LightRecord("spot", (0, 5, 0), name="stage", target=(0, 0, 0))
    scene = scene_from_document(document_of(lights=[record]))
    assert len(objects_of(scene, e3d.PointLight)) == 1
    assert "'stage'" in scene.warnings[0]


def test_camera_looks_at_its_target_and_sees_everything():
    record = CameraRecord((2, 0, 10), (2, 0, 0), 0.7, name="main")
    (node,) = objects_of(scene_from_document(document_of(cameras=[record])), e3d.Camera)
    assert node.object.yfov == 0.7
    assert node.object.znear < 7
    assert node.object.zfar > 13
    np.testing.assert_allclose(node.pose[:3, 2], (0, 0, 1))


def test_camera_roll():
    record = CameraRecord((0, 0, 10), (0, 0, 0), 0.7, roll=math.pi / 2)
    (node,) = objects_of(scene_from_document(document_of(cameras=[record])), e3d.Camera)
    np.testing.assert_allclose(node.pose[:3, 0], (0, 1, 0), atol=1e-12)


def test_impossible_camera_is_left_out():
    record = CameraRecord((1, 1, 1), (1, 1, 1), 0.7, name="blind")
    scene = scene_from_document(document_of(cameras=[record]))
    assert objects_of(scene, e3d.Camera) == []
    assert "camera 'blind' is left out" in scene.warnings[0]


def test_a_light_too_far_to_be_as_bright_is_left_out():
    record = LightRecord("point", (1e200, 0, 0), name="star")
    scene = scene_from_document(document_of(lights=[record]))
    assert objects_of(scene, e3d.PointLight) == []
    assert "light 'star' is left out" in scene.warnings[0]


def test_load_scene_reads_a_file(tmp_path):
    path = tmp_path / "triangle.obj"
    path.write_text("o tri\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    scene = e3d.load_scene(path)
    assert [node.name for node in scene.nodes] == ["tri"]
    assert scene.bounds.tolist() == [[0, 0, 0], [1, 1, 0]]
    with pytest.raises(e3d.FileAccessError):
        e3d.load_scene(tmp_path / "missing.obj")
