"""Times of the last frames, the oldest first."""

import numpy as np
import pytest

import engine3d as e3d
from engine3d.editor.frame_history import FRAMES, FrameHistory


def test_the_last_frames_are_kept_in_order():
    scene = e3d.Scene()
    scene.add(e3d.box())
    frame = e3d.render(scene, size=(16, 12))
    history = FrameHistory()
    assert history.times() == {} == history.mean() and history.frames_per_second == 0
    for k in range(3):
        history.add(frame, (k + 1) / 1000)
    assert history.times()["frame"].tolist() == [1, 2, 3]
    assert history.mean()["frame"] == 2 and history.frames_per_second == 500
    assert set(history.times()) == {"frame", "geometry", "raster", "shade", "resolve", "total"}
    for k in range(3, FRAMES + 50):
        history.add(frame, (k + 1) / 1000)
    times = history.times()
    assert np.array_equal(times["frame"], np.arange(51, FRAMES + 51, dtype=np.float32))
    assert times["raster"][0] == pytest.approx(frame.stats["ms_raster"])
    assert history.mean(2)["frame"] == FRAMES + 49.5
    assert history.stats == frame.stats
