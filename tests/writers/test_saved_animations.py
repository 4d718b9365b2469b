"""Animations of frames that a program drew: whole files, and one clear error for what is none."""

import numpy as np
import pytest
from PIL import Image

import engine3d as e3d


def turned(count, size=(32, 24)):
    scene = e3d.Scene()
    scene.add(e3d.box())
    camera = e3d.PerspectiveCamera()
    with e3d.Renderer(*size) as renderer:
        for pose in e3d.orbit((0, 0, 0), 4.0, np.linspace(0.0, 1.0, count), 0.3):
            yield renderer.render(scene, (camera, pose))


@pytest.mark.parametrize("suffix", [".gif", ".webp", ".apng", ".GIF"])
def test_frames_become_an_animation(tmp_path, suffix):
    e3d.save_animation(turned(4), tmp_path / f"turn{suffix}", fps=10)
    with Image.open(tmp_path / f"turn{suffix}") as image:
        assert (image.n_frames, image.size, image.info.get("loop")) == (4, (32, 24), 0)
        image.seek(1)
        image.load()
        assert image.info["duration"] == 100
        shown = np.asarray(image.convert("RGB")).astype(int)
    second = list(turned(4))[1].color[..., :3]
    assert np.abs(shown - second).mean() < 6


def test_arrays_do_as_well_as_frames(tmp_path):
    frames = list(turned(2))
    e3d.save_animation(frames, tmp_path / "a.apng")
    e3d.save_animation([frame.color for frame in frames], tmp_path / "b.apng")
    assert (tmp_path / "a.apng").read_bytes() == (tmp_path / "b.apng").read_bytes()


@pytest.mark.parametrize(
    ("frames", "name", "fps", "message"),
    [
        (turned(1), "a.avi", 25, "suffix is one of .gif, .webp, .apng"),
        (turned(1), "a", 25, "suffix"),
        (turned(1), "a.gif", 0, "fps"),
        (turned(1), "a.gif", 60, "fps"),
        (turned(1), "a.gif", "fast", "fps"),
        (turned(1), "a.gif", 1e-320, "fps"),
        ([], "a.gif", 25, "at least one frame"),
        (3, "a.gif", 25, "iterable"),
        ([np.zeros((4, 4, 3), np.uint8)], "a.gif", 25, r"\(H, W, 4\) uint8"),
        ([np.zeros((4, 4, 4))], "a.gif", 25, "float64"),
        ([np.zeros((n, 4, 4), np.uint8) for n in (4, 5)], "a.gif", 25, "one size"),
    ],
)
def test_what_is_no_animation_leaves_no_file(tmp_path, frames, name, fps, message):
    with pytest.raises(e3d.InvalidArgumentError, match=message):
        e3d.save_animation(frames, tmp_path / name, fps=fps)
    assert list(tmp_path.iterdir()) == []


def test_a_frame_is_not_an_animation(tmp_path):
    with pytest.raises(e3d.InvalidArgumentError, match="iterable"):
        e3d.save_animation(next(turned(1)), tmp_path / "a.gif")


def test_a_folder_that_is_not_there(tmp_path):
    with pytest.raises(e3d.FileAccessError):
        e3d.save_animation(turned(1), tmp_path / "no" / "a.gif")
