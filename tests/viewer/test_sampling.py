"""Samples per pixel: as many as there is time for in motion, and four at rest."""

import math

import pytest
from viewer.scripted_window import ScriptedWindow

import engine3d as e3d
from engine3d import events
from engine3d.apps.viewer.sampling import AT_REST, REST_SECONDS, Sampling
from engine3d.apps.viewer.viewer import Viewer
from engine3d.stage.stage_settings import Settings
from engine3d.stage.view_renderer import ViewRenderer
from engine3d.stage.viewed_scene import ViewedScene


@pytest.fixture
def now(monkeypatch):
    """The time, which tests set."""
    clock = [100.0]
    monkeypatch.setattr("time.monotonic", lambda: clock[0])
    return clock


def move(sampling, cost, frames, now):
    """Draw frames in motion that take ``cost[samples]`` seconds each; return their samples."""
    drawn = []
    for _ in range(frames):
        samples = sampling.in_motion()
        now[0] += cost[samples]
        sampling.add(samples, cost[samples])
        drawn.append(samples)
    return drawn


def test_a_fast_scene_moves_with_four_samples_and_needs_nothing_at_rest(now):
    sampling = Sampling()
    assert move(sampling, {1: 0.004, 4: 0.010}, 20, now) == [4] * 20
    assert sampling.until_rest() == math.inf


def test_a_slow_scene_moves_with_one_sample_and_rests_with_four(now):
    sampling = Sampling()
    cost = {1: 0.020, 4: 0.060}
    drawn = move(sampling, cost, 60, now)
    assert drawn[:2] == [4, 4] and set(drawn[2:]) == {1}
    assert sampling.until_rest() == pytest.approx(REST_SECONDS)
    now[0] += REST_SECONDS
    assert sampling.until_rest() == 0.0
    sampling.add(sampling.at_rest(), 0.060)
    assert sampling.until_rest() == math.inf
    assert set(move(sampling, cost, 60, now)) == {1}


def test_samples_come_back_where_there_is_less_to_draw(now):
    sampling = Sampling()
    move(sampling, {1: 0.020, 4: 0.060}, 10, now)
    assert move(sampling, {1: 0.005, 4: 0.014}, 10, now)[-5:] == [4] * 5


def test_one_disturbed_frame_changes_nothing(now):
    sampling = Sampling()
    move(sampling, {4: 0.010}, 5, now)
    sampling.add(4, 0.5)
    assert move(sampling, {1: 0.004, 4: 0.010}, 5, now) == [4] * 5


def test_a_fixed_number_stays(now):
    sampling = Sampling(16)
    assert move(sampling, {16: 1.0}, 5, now) == [16] * 5
    assert (sampling.at_rest(), sampling.until_rest()) == (16, math.inf)


def test_the_viewer_draws_again_when_nothing_moves_any_more(now):
    scene = e3d.Scene()
    scene.add(e3d.box())
    view_renderer = ViewRenderer(ViewedScene(scene, "box"), Settings({}), (64, 48), samples=AT_REST)
    window = ScriptedWindow([[]] * 100, (64, 48))
    viewer = Viewer(view_renderer, window, sampling=Sampling())
    drawn = []
    draw = view_renderer.draw

    def slowly(*arguments):
        drawn.append(view_renderer.samples)
        now[0] += {1: 0.01, 4: 0.05}[view_renderer.samples]
        return draw(*arguments)

    view_renderer.draw = slowly
    for _ in range(6):
        viewer.redraw()
        viewer.run_once()
    assert drawn == [4, 4, 1, 1, 1, 1]
    viewer.run_once()
    assert len(drawn) == 6 and viewer._patience() < 0.2
    now[0] += REST_SECONDS
    viewer.run_once()
    viewer.run_once()
    assert drawn[6:] == [4]
    assert view_renderer.renderer.samples == 4
    viewer.handle(events.KeyDown("A", "A"))
    assert viewer.sampling.fixed == 1
    viewer.run_once()
    now[0] += 10.0
    viewer.run_once()
    assert set(drawn[7:]) == {1}
