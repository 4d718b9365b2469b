"""Animations of frames that a program drew: whole files, and one clear error for what is none."""

import numpy as np
import pytest
from PIL import Image
from plain_picture import Renderer

import engine3d as e3d


def turned(count, size=(32, 24)):
    scene = e3d.Scene()
    scene.add(e3d.box())
    camera = e3d.PerspectiveCamera()
    with Renderer(size) as renderer:
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
        (turned(1), "a%d.gif", 25, "a numbered picture's suffix is one of .png"),
        (turned(1), "a.mp4", 241, "fps must be greater than 0 and at most 240"),
        (turned(1), "a.gif", 0, "fps"),
        (turned(1), "a.gif", 60, "fps"),
        (turned(1), "a.gif", "fast", "fps"),
        (turned(1), "a.gif", 1e-320, "fps"),
        ([], "a.gif", 25, "at least one frame"),
        (3, "a.gif", 25, "several"),
        ([np.zeros((4, 4, 3), np.uint8)], "a.gif", 25, r"\(H, W, 4\) uint8"),
        ([np.zeros((4, 4, 4))], "a.gif", 25, "float64"),
        ([np.zeros((n, 4, 4), np.uint8) for n in (4, 5)], "a.gif", 25, "one size"),
    ],
)
def test_what_is_no_animation_leaves_no_file(tmp_path, frames, name, fps, message):
    with pytest.raises(e3d.InvalidArgumentError, match=message):
        e3d.save_animation(frames, tmp_path / name, fps=fps)
    assert list(tmp_path.iterdir()) == []


def test_a_picture_for_each_frame(tmp_path):
    e3d.save_animation(turned(3), tmp_path / "turn_{:03}.png")
    assert sorted(path.name for path in tmp_path.iterdir()) == [f"turn_00{k}.png" for k in range(3)]
    for number, frame in enumerate(turned(3)):
        assert (tmp_path / f"turn_00{number}.png").read_bytes() == frame.encode("png")


def test_a_video(tmp_path):
    pytest.importorskip("imageio_ffmpeg", reason="needs engine3d[video]")
    import imageio_ffmpeg

    e3d.save_animation(turned(6), tmp_path / "turn.mp4", fps=60)
    count, seconds = imageio_ffmpeg.count_frames_and_secs(tmp_path / "turn.mp4")
    assert count == 6 and seconds == pytest.approx(0.1, abs=0.02)


def test_a_frame_is_not_an_animation(tmp_path):
    with pytest.raises(e3d.InvalidArgumentError, match="several"):
        e3d.save_animation(next(turned(1)), tmp_path / "a.gif")


def test_a_folder_that_is_not_there(tmp_path):
    with pytest.raises(e3d.FileAccessError):
        e3d.save_animation(turned(1), tmp_path / "no" / "a.gif")
