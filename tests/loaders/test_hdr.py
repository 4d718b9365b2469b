"""Radiance and OpenEXR pictures: whole ones, all orders of pixels, damaged ones."""

import contextlib
import os
import re
import sys
from types import SimpleNamespace

import numpy as np
import pytest
from loaders.seeds import HDR, OLD_HDR
from missing_here import open_files
from shared_corpus import SHARED

import engine3d as e3d

EXR = b"\x76\x2f\x31\x01" + bytes(60)
FOLDER = SHARED / "gltf" / "env"
needs_environments = pytest.mark.skipif(not FOLDER.is_dir(), reason="there is no shared/gltf/env")


def picture(pixels, size="-Y 2 +X 3", header=b"FORMAT=32-bit_rle_rgbe\n"):
    return b"#?RADIANCE\n" + header + b"\n" + size.encode() + b"\n" + bytes(pixels)


def load(data):
    return e3d.Environment.load(data).pixels


def new_line(channels):
    """A line of the new kind: each channel as stretches of up to 128 bytes."""
    width = len(channels[0])
    out = bytearray([2, 2, width >> 8, width & 255])
    for channel in channels:
        for first in range(0, width, 128):
            part = channel[first : first + 128]
            out += bytes([len(part), *part])
    return bytes(out)


def test_values_are_mantissas_times_powers_of_two():
    flat = [1, 2, 3, 128, 128, 64, 0, 129, 9, 9, 9, 0, 255, 255, 255, 255, 1, 0, 0, 1, 7, 0, 0, 136]
    expected = [
        [[1 / 256, 2 / 256, 3 / 256], [1, 0.5, 0], [0, 0, 0]],
        [[255 * 2.0**119] * 3, [2.0**-135, 0, 0], [7, 0, 0]],
    ]
    assert np.array_equal(load(picture(flat)), np.float32(expected))


def test_runs_of_both_kinds():
    new = load(HDR)
    assert new.shape == (3, 8, 3)
    assert (new == np.float32([40] * 5 + [1, 2, 3])[None, :, None] / 64).all()
    old = load(OLD_HDR)
    assert old.shape == (2, 4, 3)
    assert (old[1] == np.float32([9, 8, 7]) / 256).all()  # the bottom line comes first


def test_runs_of_the_old_kind_count_on():
    pixels = [7, 7, 7, 128, 1, 1, 1, 4, 1, 1, 1, 1] + [3, 2, 1, 128]
    got = load(picture(pixels, "-Y 1 +X 262"))
    assert (got[0, :261] == np.float32(7 / 256)).all()
    assert (got[0, 261] == np.float32([3, 2, 1]) / 256).all()


def test_lines_of_every_width():
    rng = np.random.default_rng(0)
    for width in (8, 127, 128, 129, 300, 5000):
        rgbe = rng.integers(0, 256, (2, 4, width)).astype(np.uint8)
        got = load(picture(b"".join(map(new_line, rgbe.tolist())), f"-Y 2 +X {width}"))
        scale = np.ldexp(np.float32(1), rgbe[:, 3].astype(int) - 136) * (rgbe[:, 3] > 0)
        assert np.array_equal(got, (rgbe[:, :3] * scale[:, None]).transpose(0, 2, 1))


@pytest.mark.parametrize(
    ("size", "turn"),
    [
        ("-Y 2 +X 3", lambda p: p),
        ("+Y 2 +X 3", lambda p: p[::-1]),
        ("-Y 2 -X 3", lambda p: p[:, ::-1]),
        ("+Y 2 -X 3", lambda p: p[::-1, ::-1]),
        ("+X 2 -Y 3", lambda p: p.transpose(1, 0, 2)),
        ("-X 2 -Y 3", lambda p: p[::-1].transpose(1, 0, 2)),
        ("+X 2 +Y 3", lambda p: p[:, ::-1].transpose(1, 0, 2)),
        ("-X 2 +Y 3", lambda p: p[::-1, ::-1].transpose(1, 0, 2)),
    ],
)
def test_all_orders_of_pixels(size, turn):
    stored = np.arange(18).reshape(2, 3, 3).astype(np.uint8)
    rgbe = np.concatenate([stored, np.full((2, 3, 1), 136, np.uint8)], axis=2)
    assert np.array_equal(load(picture(rgbe.tobytes(), size)), turn(stored.astype(np.float32)))


@pytest.mark.parametrize(
    ("data", "told"),
    [
        (b"#?RADIANCE\n", "cut short in the header"),
        (b"#?RADIANCE\n\n", "no size"),
        (b"#?RADIANCEe\n\n-Y 2 +Y 3\n", "no size of a Radiance picture, .* at byte 13"),
        (picture([], "-Y 2 +X"), "no size"),
        (picture([], "-Y 0 +X 3"), "3x0 pixels"),
        (picture([], "-Y 3 +X 99999"), "a side is limited to 16384"),
        (picture([], "-Y 16000 +X 16000"), "limited to"),
        (picture([], "-Y 9000 +X 9000"), "cut short"),
        (picture([9] * 23), "the file ends in line 2 of 2, byte"),
        (picture([1, 1, 1, 3] * 6), "begins with a repetition in line 1 of 2, byte"),
        (picture([2, 2, 2, 128, 1, 1, 1, 9] * 4), "a run does not fit its line in line 1"),
        (picture([2, 2, 0, 9] * 8, "-Y 1 +X 8"), "a line has another width in line 1 of 1"),
        (picture([2, 2, 0, 8, 137, 5] + [0] * 30, "-Y 1 +X 8"), "a run does not fit"),
        (picture([2, 2, 0, 8, 0, 5] + [0] * 30, "-Y 1 +X 8"), "a run does not fit"),
        (picture([2, 2, 0, 8, 8, 5, 1, 1], "-Y 1 +X 8"), "the file ends in line 1 of 1"),
        (picture([9] * 24, header=b"FORMAT=32-bit_rle_xyze\n"), "32-bit_rle_xyze' are not read"),
        (b"#?RGBEX", "cut short in the header"),
        (b"#?SOMETHING\n\n-Y 1 +X 1\n1234", "does not begin with"),
        (b"BM and so on", "neither a Radiance picture"),
        (b"", "neither a Radiance picture"),
    ],
)
def test_what_is_wrong_is_told_in_a_line(data, told):
    with pytest.raises(e3d.FileFormatError, match=told) as raised:
        e3d.Environment.load(data)
    assert "\n" not in str(raised.value) and str(raised.value).startswith("<bytes>: ")


def test_where_a_fault_is():
    good = HDR[: len(HDR) - 1]
    with pytest.raises(e3d.FileFormatError, match=rf"line 3 of 3, byte {len(HDR) - 2}"):
        e3d.Environment.load(good)


@needs_environments
@pytest.mark.parametrize("name", ["hdr", "old_depot", "spiaggia_di_mondello_1k"])
def test_real_files_against_a_plain_reader(name):
    data = (FOLDER / f"{name}.hdr").read_bytes()
    assert np.array_equal(load(data), plainly_read(data))


def plainly_read(data):
    """A reader of -Y +X pictures, byte after byte."""
    size = re.search(rb"\n\n-Y (\d+) \+X (\d+)\n", data)
    height, width, at = int(size[1]), int(size[2]), size.end()
    out = np.zeros((height, width, 4), np.uint8)
    for row in out:
        if not (width >= 8 and data[at : at + 2] == b"\2\2"):
            row[:] = np.frombuffer(data, np.uint8, 4 * width, at).reshape(width, 4)
            at += 4 * width
            continue
        at += 4
        for channel in range(4):
            x = 0
            while x < width:
                head, at = data[at], at + 1
                count = head - 128 if head > 128 else head
                step = 1 if head > 128 else count
                row[x : x + count, channel] = np.frombuffer(data, np.uint8, step, at)
                at, x = at + step, x + count
    scale = np.ldexp(np.float32(1), out[..., 3].astype(int) - 136) * (out[..., 3] > 0)
    return out[..., :3] * scale[..., None]


@needs_environments
def test_openexr():
    pytest.importorskip("OpenEXR", reason="engine3d[exr] is not installed")
    environment = e3d.Environment.load(FOLDER / "hdr.exr")
    assert environment.pixels.shape == (8, 8, 3) and environment.name == "hdr"
    radiance = load((FOLDER / "hdr.hdr").read_bytes())
    assert np.abs(environment.pixels - radiance).max() < 0.02 * radiance.max()
    data = (FOLDER / "hdr.exr").read_bytes()
    for end in (10, 100, 500, 900):
        with pytest.raises(e3d.FileFormatError, match="damaged OpenEXR picture") as raised:
            e3d.Environment.load(data[:end])
        assert "\n" not in str(raised.value)


@needs_environments
def test_openexr_without_the_package(monkeypatch):
    monkeypatch.setitem(sys.modules, "OpenEXR", None)
    with pytest.raises(e3d.FileAccessError, match=r"pip install 'engine3d\[exr\]'"):
        e3d.Environment.load(FOLDER / "hdr.exr")


def handles_of(file):
    """The handles that this process has of a file, where the system tells them."""
    here = os.fstat(file.fileno())
    for handle in map(int, open_files()):
        with contextlib.suppress(OSError):
            if os.path.samestat(os.fstat(handle), here):
                yield handle


def test_openexr_reads_a_file_that_is_closed(monkeypatch):
    """Windows lets no library open a file that is open for writing."""
    paths = []

    def read(path, **_):
        with open(path, "rb") as file:
            assert file.read() == EXR
            paths.append(path)
            assert set(handles_of(file)) <= {file.fileno()}
        raise ValueError(f"{path} is no picture")

    monkeypatch.setitem(sys.modules, "OpenEXR", SimpleNamespace(File=read))
    with pytest.raises(e3d.FileFormatError, match="damaged OpenEXR picture: it is no picture"):
        e3d.Environment.load(EXR)
    assert len(paths) == 1 and not os.path.exists(os.path.dirname(paths[0]))
