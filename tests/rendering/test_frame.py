"""Frames: missing outputs, arrays, and files that appear whole or not at all."""

import copy
import io
import os
import pickle

import numpy as np
import pytest
from PIL import Image

import engine3d as e3d
from engine3d.rendering.frame import OUTPUTS


@pytest.fixture
def frame():
    color = np.zeros((3, 5, 4), np.uint8)
    color[..., 3] = 255
    color[0, 0] = (255, 0, 0, 255)
    color[2, 4] = (0, 255, 0, 255)
    return e3d.Frame((5, 3), {"color": color})


@pytest.mark.parametrize("name", OUTPUTS)
def test_missing_output_names_the_argument(name):
    empty = e3d.Frame((5, 3), {})
    with pytest.raises(e3d.errors.MissingOutputError) as caught:
        getattr(empty, name)
    assert f'outputs=("{name}",)' in str(caught.value)
    assert not hasattr(empty, name)


@pytest.mark.parametrize("name", OUTPUTS)
def test_outputs_are_documented(name):
    assert getattr(e3d.Frame, name).__doc__


def test_array(frame):
    assert np.shares_memory(np.asarray(frame), frame.color)
    assert not np.shares_memory(np.array(frame), frame.color)
    assert np.asarray(frame, np.float32).dtype == np.float32
    assert frame.outputs == ("color",)


def test_image_is_a_copy_the_right_way_up(frame):
    image = frame.image()
    assert (image.mode, image.size) == ("RGBA", (5, 3))
    assert image.getpixel((0, 0)) == (255, 0, 0, 255)
    frame.color[0, 0] = 9
    assert image.getpixel((0, 0)) == (255, 0, 0, 255)


def test_what_is_left_of_a_frame_elsewhere():
    frame = e3d.render(e3d.Scene(), size=(5, 3))
    for other in (pickle.loads(pickle.dumps(frame)), copy.deepcopy(frame)):
        np.testing.assert_array_equal(other.color, frame.color)
        assert other.stats == frame.stats
        assert other.stats["tiles"] == 1


@pytest.mark.parametrize("suffix", ["png", "tga", "webp", "PNG"])
def test_save_is_lossless(frame, tmp_path, suffix):
    path = tmp_path / f"frame.{suffix}"
    frame.save(path)
    with Image.open(path) as image:
        np.testing.assert_array_equal(np.asarray(image.convert("RGBA")), frame.color)


def test_png_passes_options_on(frame):
    with Image.open(io.BytesIO(frame.encode("png", compress_level=9))) as image:
        np.testing.assert_array_equal(np.asarray(image), frame.color)


@pytest.mark.parametrize("suffix", ["jpg", "jpeg"])
def test_jpeg_has_no_alpha(frame, tmp_path, suffix):
    path = tmp_path / f"frame.{suffix}"
    frame.save(str(path), quality=90)
    with Image.open(path) as image:
        assert (image.format, image.mode, image.size) == ("JPEG", "RGB", (5, 3))


@pytest.mark.parametrize("name", ["frame.gif", "frame", "frame.txt"])
def test_unknown_suffix(frame, tmp_path, name):
    with pytest.raises(e3d.InvalidArgumentError, match=".png., .jpg., .jpeg., .tga., .webp."):
        frame.save(tmp_path / name)
    assert list(tmp_path.iterdir()) == []


def test_a_failed_save_leaves_what_was_there(frame, tmp_path, monkeypatch):
    path = tmp_path / "frame.webp"
    path.write_bytes(b"before")
    monkeypatch.setattr(
        Image.Image, "save", lambda *_, **__: (_ for _ in ()).throw(OSError("full"))
    )
    with pytest.raises(OSError, match="full"):
        frame.save(path)
    assert path.read_bytes() == b"before"
    assert list(tmp_path.iterdir()) == [path]


def test_missing_folder(frame, tmp_path):
    with pytest.raises(e3d.FileAccessError, match="nowhere"):
        frame.save(tmp_path / "nowhere" / "frame.png")


def test_paths_may_be_bytes(frame, tmp_path):
    frame.save(os.fsencode(tmp_path / "ü.png"))
    assert (tmp_path / "ü.png").read_bytes() == frame.encode()


@pytest.mark.parametrize("path", [None, 3, io.BytesIO()])
def test_what_is_no_path(frame, path):
    with pytest.raises(e3d.InvalidArgumentError, match="path must be"):
        frame.save(path)
    if not isinstance(path, io.BytesIO):  # models go to streams as well
        with pytest.raises(e3d.InvalidArgumentError, match="path must be"):
            e3d.box().save(path, format="ply")


def test_saving_without_colour(tmp_path):
    with pytest.raises(e3d.errors.MissingOutputError):
        e3d.Frame((5, 3), {}).save(tmp_path / "frame.png")
    assert list(tmp_path.iterdir()) == []


def test_notebook_picture(frame):
    data = frame._repr_png_()
    np.testing.assert_array_equal(np.asarray(Image.open(io.BytesIO(data))), frame.color)
    assert e3d.Frame((5, 3), {})._repr_png_() is None
