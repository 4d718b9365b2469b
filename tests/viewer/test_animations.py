"""Models that move, in the viewer: what plays, the bar, the keys, hidden parts."""

import numpy as np
import pytest
from motion.moving_model import flag
from viewer.test_viewer import key, make_viewer, play

from engine3d import events
from engine3d.apps.viewer.model_files import ModelFiles
from engine3d.stage.open_models import open_models
from engine3d.stage.played_clips import play_clips


@pytest.fixture
def moving(tmp_path):
    return flag(tmp_path / "flag.gltf")


def opened(path):
    return open_models([path], animation=play_clips)


def test_animations_play_from_the_start_and_space_pauses(moving):
    viewed = opened(moving)
    assert viewed.plays and viewed.period == 2.0
    viewer, window = make_viewer([[events.Exposed()]], viewed)
    viewer.time = 0.0
    viewer.draw()
    first = window.shown[-1].copy()
    viewer.advance(0.1)
    viewer.draw()
    assert 0.05 < viewer.time < 0.2 and (window.shown[-1] != first).any()
    viewer.handle(key("Space"))
    before = viewer.time
    viewer.advance(0.1)
    assert viewer.time == before


def test_a_bar_shows_how_far_the_animation_is(moving):
    viewer, window = make_viewer([], opened(moving))
    lengths = []
    for time in (0.0, 0.5, 1.5):
        viewer.time = time
        viewer.draw()
        row = window.shown[-1][-1, :, :3]
        played = (row == viewer.view_renderer.theme.title[:3]).all(axis=1)
        lengths.append(int(played.sum()))
    assert lengths == [0, 40, 120]


def test_what_does_not_move_has_no_bar():
    viewer, window = play(events.Exposed())
    assert (window.shown[0][-1, :, :3] == (10, 20, 30)).all()


def test_a_key_goes_through_the_animations(moving):
    viewed = opened(moving)
    viewer, _ = make_viewer([], viewed)
    names = []
    for shift in (False, False, False, True):
        viewer.handle(key("J", shift=shift))
        names.append([clip.name for clip in viewed.player.playing])
        viewer.view_renderer.draw(viewer.view, 1.0)
    assert names == [["rise"], ["turn", "rise"], ["turn"], ["turn", "rise"]]
    pole = viewed.scene.find("pole")
    assert np.isclose(pole.translation[1], 1.5)
    viewer.handle(key("J", shift=True))
    viewer.handle(key("J", shift=True))
    viewer.view_renderer.draw(viewer.view, 1.0)
    assert names[2] == ["turn"] and pole.translation[1] == 0.0  # put back


def test_files_that_are_dropped_play(moving, tmp_path):
    files = ModelFiles(())
    assert files.replace([moving]).player is not None


def test_hidden_parts_come_back_bent(moving):
    viewed = opened(moving)
    viewer, _ = make_viewer([], viewed)
    node = viewed.scene.find("flag")
    viewed.update(1.9)
    before = node.bounds
    whole = viewer.view_renderer.staging.scene.bounds
    viewer.view_renderer.visibility.toggle_object(0)
    assert (viewer.view_renderer.staging.scene.bounds != whole).any()
    viewer.view_renderer.draw(viewer.view, 1.9)
    viewer.view_renderer.visibility.toggle_object(0)
    assert np.array_equal(node.bounds, before)


def test_several_models_stand_still(moving):
    viewed = open_models([moving, moving], side_by_side=True, animation=play_clips)
    assert viewed.player is None and viewed.scene.bounds[1][1] > 1.9


def test_a_click_selects_what_is_bent(moving):
    viewed = opened(moving)
    viewer, _ = make_viewer([], viewed)
    viewer.time = 1.9
    viewer.draw()
    bounds = viewed.scene.find("flag").bounds
    assert bounds[0][0] < -0.5
    hits = 0
    for x in range(0, 160, 4):
        for y in range(0, 120, 4):
            viewer.select(x, y)
            if viewer.selected is not None:
                hits += 1
                low, high = bounds[0] - 1e-2, bounds[1] + 1e-2
                assert (
                    (low <= viewer.selected.position) & (viewer.selected.position <= high)
                ).all()
    assert hits > 3
