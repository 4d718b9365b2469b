"""A scene is written as glTF with its motion; pictures, turns and motion are drawn into files."""

import numpy as np
import pytest
from PIL import Image

import engine3d as e3d
from engine3d.apps.editor.document import SceneDocument
from engine3d.apps.editor.render_job import RenderJob, Shot
from engine3d.apps.editor.scene_state import SceneState


@pytest.fixture
def document():
    scene = e3d.Scene()
    sun = scene.add(e3d.icosphere(), name="Sun")
    earth = scene.add(e3d.icosphere(0.3), name="Earth", translation=(3, 0, 0))
    scene.animator = e3d.Animator(scene)
    scene.animator.spin(sun, period=2)
    scene.animator.orbit(earth, sun, radius=3, period=4)
    return SceneDocument(scene)


@pytest.mark.parametrize("name", ["a.glb", "a.gltf"])
def test_the_motion_is_an_animation_of_the_exported_file(document, tmp_path, name):
    before = SceneState(document.scene)
    assert document.export(tmp_path / name)
    assert [e.text for e in document.console.entries if e.level == "warning"] == []
    assert SceneState(document.scene) == before and document.scene.animations == {}
    assert document.path is None
    scene = e3d.load_scene(tmp_path / name)
    player = e3d.AnimationPlayer(scene)
    player.play("Motion")
    for time in (0.5, 1.0, 3.3):
        player.seek(time)
        document.animator.seek(time)
        for made, node in zip(scene.nodes, document.scene.nodes, strict=True):
            assert np.allclose(made.world_pose, node.world_pose, atol=5e-3)


def test_a_scene_at_rest_is_exported_without_animation(tmp_path):
    scene = e3d.Scene()
    scene.add(e3d.box())
    assert SceneDocument(scene).export(tmp_path / "a.glb")
    assert e3d.load_scene(tmp_path / "a.glb").animations == {}


def test_an_export_that_fails_is_told(document, tmp_path):
    assert not document.export(tmp_path / "none" / "a.glb")
    assert "cannot write" in document.console.entries[-1].text
    assert document.scene.animator is not None


VIEW = e3d.PerspectiveCamera(1.0), e3d.look_at((2, 6, 9), (0, 0, 0))


def drawn(job):
    job.wait()
    return job.error


def test_a_picture_is_what_render_draws(document, tmp_path):
    path = str(tmp_path / "a.png")
    job = RenderJob(document.scene, [Shot(*VIEW)], path, size=(80, 60), look="plain")
    assert drawn(job) == "" and job.done == job.count == 1
    wanted = e3d.render(document.scene, VIEW, size=(80, 60), look="plain")
    assert np.array_equal(np.asarray(Image.open(path).convert("RGBA")), wanted.color)


def test_motion_is_drawn_picture_by_picture(document, tmp_path):
    path, before = str(tmp_path / "a.apng"), SceneState(document.scene)
    shots = [Shot(*VIEW, time) for time in (0.0, 1.0, 2.0)]
    job = RenderJob(document.scene.copy(), shots, path, size=(40, 30), fps=10)
    assert drawn(job) == "" and job.done == 3
    assert SceneState(document.scene) == before
    with Image.open(path) as image:
        assert image.n_frames == 3
        first = np.asarray(image.convert("RGB")).copy()
        image.seek(1)
        assert (np.asarray(image.convert("RGB")) != first).any()


def test_a_stopped_job_leaves_no_file(document, tmp_path):
    path = tmp_path / "a.webp"
    shots = [Shot(*VIEW)] * 500
    job = RenderJob(document.scene, shots, str(path), size=(320, 240))
    job.stop()
    assert drawn(job) == "stopped" and not path.exists() and job.is_stopped


def test_a_job_that_fails_tells_why(document, tmp_path):
    job = RenderJob(document.scene, [Shot(*VIEW)], str(tmp_path / "no" / "a.png"), size=(8, 8))
    assert "cannot write" in drawn(job)
