"""How clips are framed: all of their motion shows, and it fills the picture."""

import numpy as np
import pytest

import engine3d as e3d
from engine3d.model.motion.clips import AnimationClip, Channel
from engine3d.stage.open_model import open_model
from engine3d.stage.played_clips import _outermost, play_clips
from engine3d.stage.stage_settings import Settings
from engine3d.stage.view_renderer import ViewRenderer
from engine3d.stage.viewed_scene import ViewedScene
from engine3d.stage.views.first_view import FirstView

SIZE = (160, 120)


def played(path, values, shape=None):
    scene = e3d.Scene()
    node = scene.add(e3d.uv_sphere(0.5) if shape is None else shape)
    times = np.linspace(0.0, 2.0, len(values))
    scene.animations["clip"] = AnimationClip([Channel(node, path, times, np.array(values, float))])
    viewed = ViewedScene(scene, "clip", themed=True)
    play_clips(viewed)
    return viewed


def bent():
    """A strip that a morph target bends."""
    strip = e3d.box((0.3, 4.0, 0.3))
    offsets = np.zeros_like(strip.positions)
    offsets[strip.positions[:, 1] > 0] = (2.5, -1.0, 0.0)
    strip.morph_targets = [e3d.motion.MorphTarget(offsets)]
    return strip


def moved_by_an_animator(tmp_path):
    """A ball on the end of a turning arm, which an animator of a scene file moves."""
    scene = e3d.Scene()
    arm = scene.add()
    scene.add(e3d.uv_sphere(0.5), parent=arm, translation=(4, 0, 0))
    scene.animator = e3d.Animator(scene)
    scene.animator.spin(arm, period=3.0)
    scene.save(tmp_path / "arm.e3d.json")
    return open_model(tmp_path / "arm.e3d.json", animation=play_clips)


def test_the_motion_of_an_animator_stays_in_the_picture(tmp_path):
    viewed, sides = moved_by_an_animator(tmp_path), []
    with ViewRenderer(viewed, Settings({}, look="studio"), SIZE) as renderer:
        view = FirstView().place(renderer, turns=False)
        for time in np.linspace(0.0, viewed.period, 41):
            frame = renderer.draw(view, time, outputs=("color", "face_id"))
            rows, columns = np.nonzero(frame.face_id >= 0)
            sides.append((columns.min(), rows.min(), columns.max() + 1, rows.max() + 1))
    sides = np.array(sides)
    assert (sides[:, :2] > 0).all() and (sides[:, 2:] < SIZE).all()
    assert (np.ptp(sides[:, [0, 2]]) / SIZE[0]) > 0.8


MOTIONS = {
    "slides": lambda: played("translation", [(0, 0, 0), (3, 0, 0), (0, 0, 0)]),
    "jumps": lambda: played("translation", [(0, 0, 0), (0, 2, 0), (0, 0, 0)]),
    "circles": lambda: played(
        "translation", [(np.cos(a), 0, np.sin(a)) for a in np.linspace(0, 2 * np.pi, 33)]
    ),
    "grows": lambda: played("scale", [(1, 1, 1), (2, 2, 2)]),
    "bends": lambda: played("weights", [(0.0,), (1.0,), (0.0,)], bent()),
}


@pytest.mark.parametrize("orthographic", [False, True])
@pytest.mark.parametrize("name", MOTIONS)
def test_all_times_fill_the_picture(name, orthographic):
    viewed, sides = MOTIONS[name](), []
    with ViewRenderer(viewed, Settings({}, look="studio"), SIZE) as renderer:
        view = FirstView(orthographic=orthographic).place(renderer, turns=False)
        for time in np.linspace(0.0, viewed.period, 41):
            frame = renderer.draw(view, time, outputs=("color", "object_id"))
            rows, columns = np.nonzero(frame.object_id == 0)
            sides.append((columns.min(), rows.min(), columns.max() + 1, rows.max() + 1))
    sides = np.array(sides)
    low, high = sides[:, :2].min(0), sides[:, 2:].max(0)
    assert (low > 0).all() and (high < SIZE).all()
    assert ((high - low) / SIZE).max() >= 0.85


def test_a_turntable_of_a_motion_stays_in_the_picture():
    viewed = MOTIONS["slides"]()
    with ViewRenderer(viewed, Settings({}, look="studio"), SIZE) as renderer:
        view = FirstView().place(renderer, turns=True)
        for k in range(12):
            view.azimuth = k * np.pi / 6
            frame = renderer.draw(view, viewed.period * k / 12, outputs=("color", "object_id"))
            shown = frame.object_id == 0
            assert shown.any() and not (shown[0].any() or shown[-1].any())
            assert not (shown[:, 0].any() or shown[:, -1].any())


def test_outermost_places_enclose_points_closely():
    points = np.random.default_rng(2).normal(size=(20_000, 3)) * (5.0, 1.0, 0.0)
    places = _outermost(points)
    directions = np.random.default_rng(3).normal(size=(50, 3))
    reach, found = (points @ directions.T).max(0), (places @ directions.T).max(0)
    size = np.abs(directions) @ np.ptp(points, axis=0)
    assert (found >= reach - 1e-9).all() and (found <= reach + size / 128 + 1e-9).all()
    assert len(places) < len(points)
    assert np.array_equal(_outermost(points[:9]), points[:9])
