"""Animations that commands write: numbered pictures, MP4."""

import os
import sys

import numpy as np
import pytest
from PIL import Image

from engine3d.apps.cli import main

pytestmark = pytest.mark.usefixtures("no_screen")
SMALL = ("--size", "48x32")


def pixels(path):
    with Image.open(path) as image:
        return np.asarray(image.convert("RGBA"))


def test_numbered_pictures_of_a_turntable(model, tmp_path):
    for name, names in (
        ("frame_{:04}.png", ["frame_0000.png", "frame_0001.png", "frame_0002.png"]),
        ("f%03d.webp", ["f000.webp", "f001.webp", "f002.webp"]),
        ("{}.jpg", ["0.jpg", "1.jpg", "2.jpg"]),
    ):
        folder = tmp_path / name[:2]
        folder.mkdir()
        arguments = ["--turntable", "3", "--cull", "none", "-o", str(folder / name)]
        assert main(["render", str(model), *SMALL, *arguments]) == 0
        assert sorted(path.name for path in folder.iterdir()) == names
        pictures = [pixels(folder / one) for one in names]
        assert (pictures[0] != pictures[1]).any()
    assert main(["render", str(model), *SMALL, "-o", "one.png", "--cull", "none"]) == 0
    arguments = ["--headless", "--frames", "3", *SMALL, "-o", "run{:02}.png"]
    assert main(["run", str(model), *arguments]) == 0
    assert (pixels("run00.png") != pixels("run01.png")).any()


def test_transparency_is_refused_before_ffmpeg_is_asked_for(model, capsys, monkeypatch):
    """Or somebody would install ffmpeg, and be refused afterwards."""
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    monkeypatch.setenv("PATH", "")
    turn = ["render", str(model), *SMALL, "--turntable", "3", "--no-background", "-o", "a.mp4"]
    assert main(turn) == 2
    assert "--no-background needs transparency, which .mp4 lacks" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("name", "most", "told"), [("a.gif", 100, 1), ("a.gif", 10**9, 0), ("a.webp", 100, 0)]
)
def test_a_large_gif_says_so(model, capsys, monkeypatch, name, most, told):
    monkeypatch.setattr("engine3d.apps.cli.outputs.LARGE_GIF", most)
    for command in (["render", str(model), "--turntable"], ["run", "--headless", "--frames"]):
        assert main([*command, "3", *SMALL, "-o", name]) == 0
        said = capsys.readouterr().err
        assert said.count(f"{name} has 0.0 MB: as .webp it would be many times smaller") == told


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["-o", "frame_%04d.png"], "'frame_%04d.png' has a place for numbers: several pictures"),
        (["--turntable", "3", "-o", "a%d.gif"], "a numbered picture needs one of the extensions"),
        (["--turntable", "3", "-o", "a%d_%d.png"], "an animation needs one of the extensions"),
        (["--turntable", "3", "-o", "a%d.jpg", "--no-background"], ".jpg lacks"),
    ],
)
def test_names_with_numbers_that_fit_nothing(model, capsys, arguments, message):
    assert main(["render", str(model), *SMALL, *arguments]) == 2
    assert message in capsys.readouterr().err
    assert [path for path in os.listdir() if path != model.name] == []


def test_mp4_without_the_package_names_the_extra(model, capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    monkeypatch.setenv("PATH", "")
    monkeypatch.setattr(
        "engine3d.apps.cli.options.scene_options.viewed_scene", None
    )  # no work is begun
    assert main(["render", str(model), *SMALL, "--turntable", "3", "-o", "a.mp4"]) == 1
    expected = (
        "engine3d: error: a.mp4: cannot write: MP4 needs the package imageio-ffmpeg: "
        "pip install 'engine3d[video]'\n"
    )
    assert capsys.readouterr().err == expected


def decoded(path, size):
    """The pictures of a video, (N, H, W, 3) int."""
    imageio_ffmpeg = pytest.importorskip("imageio_ffmpeg", reason="needs engine3d[video]")
    frames = imageio_ffmpeg.read_frames(path)
    assert next(frames)["size"] == size
    shape = (size[1], size[0], 3)
    return np.array([np.frombuffer(one, np.uint8).reshape(shape) for one in frames]).astype(int)


@pytest.mark.parametrize("size", [(48, 32), (47, 31)])
def test_mp4(model, capsys, tmp_path, size):
    pytest.importorskip("imageio_ffmpeg", reason="needs engine3d[video]")
    small = ["--size", f"{size[0]}x{size[1]}", "--color", "red", "--unlit"]
    arguments = [*small, "--turntable", "5", "--cull", "none", "--background-color", "blue"]
    for name in ("a.mp4", "b.mp4", "still{}.png"):
        assert main(["render", str(model), *arguments, "-o", name]) == 0
    even = "engine3d: warning: MP4 has even sides: 47x31 became 48x32\n" if size[0] % 2 else ""
    assert capsys.readouterr().err == 2 * even
    video = decoded("a.mp4", (48, 32))
    stills = np.array([pixels(f"still{k}.png")[..., :3] for k in range(5)]).astype(int)
    assert len(video) == 5
    assert abs(video[:, : size[1], : size[0]] - stills).mean() < 12  # half of the colours' pixels
    assert (tmp_path / "a.mp4").read_bytes() == (tmp_path / "b.mp4").read_bytes()
    assert sorted(os.listdir()) == sorted(
        ["a.mp4", "b.mp4", model.name, *(f"still{k}.png" for k in range(5))]
    )


@pytest.mark.skipif(sys.platform == "win32", reason="starts a script of POSIX's shell")
def test_an_mp4_that_fails_leaves_no_file(model, capsys, monkeypatch, tmp_path):
    program = tmp_path / "ffmpeg"
    program.write_text("#!/bin/sh\necho 'no such codec' >&2\nexit 3\n")
    program.chmod(0o755)
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    monkeypatch.setenv("PATH", str(tmp_path), prepend=os.pathsep)
    assert main(["render", str(model), "--turntable", "9", "-o", "a.mp4"]) == 1
    expected = "engine3d: error: a.mp4: cannot write: ffmpeg says: no such codec\n"
    assert capsys.readouterr().err == expected
    assert sorted(os.listdir()) == sorted(["ffmpeg", model.name])
