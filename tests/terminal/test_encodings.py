"""Pictures as escape codes: decoded again, they are the same pixels."""

import re
import zlib
from base64 import b64decode

import numpy as np
import pytest

from engine3d.apps.terminal import half_blocks, kitty, sixel


@pytest.fixture
def picture():
    """A gradient with a hard edge, (26, 40, 4) uint8: no multiple of a band of sixels."""
    rows, columns = np.indices((26, 40))
    colors = [columns * 6, rows * 9, np.where(columns > rows, 200, 30), np.full_like(rows, 255)]
    return np.stack(colors, axis=-1).astype(np.uint8)


def test_kitty_sends_the_pixels_in_chunks():
    noise = np.random.default_rng(3).integers(0, 256, (60, 80, 4), np.uint8)
    codes = re.findall(rb"\x1b_G([^;]*);([^\x1b]*)\x1b\\", kitty.encode(noise, 10, 4, 7))
    assert len(codes) > 1
    assert all(len(payload) <= kitty.CHUNK for _, payload in codes)
    keys = dict(pair.split(b"=") for pair in codes[0][0].split(b","))
    assert (keys[b"s"], keys[b"v"], keys[b"c"], keys[b"r"], keys[b"i"]) == (
        b"80",
        b"60",
        b"10",
        b"4",
        b"7",
    )
    assert [keys[b"m"], codes[-1][0]] == [b"1", b"m=0"]
    data = zlib.decompress(b64decode(b"".join(payload for _, payload in codes)))
    assert np.array_equal(np.frombuffer(data, np.uint8).reshape(60, 80, 3), noise[..., :3])


def decoded_sixels(data):
    """Return the picture that sixels draw, (H, W, 3) in per cent."""
    body = data[data.index(b"q") + 1 : data.index(b"\x1b\\")]
    _, _, width, height = map(int, re.match(rb'"(\d+);(\d+);(\d+);(\d+)', body).groups())
    palette, picture = {}, np.full((height, width, 3), -1)
    color, x, y = 0, 0, 0
    tokens = re.finditer(
        rb'"[\d;]+|#(\d+);2;(\d+);(\d+);(\d+)|#(\d+)|!(\d+)([?-~])|([?-~])|(\$)|(-)', body
    )
    for token in tokens:
        if token[1]:
            palette[int(token[1])] = [int(token[n]) for n in (2, 3, 4)]
        elif token[5]:
            color = int(token[5])
        elif token[7] or token[8]:
            count, bits = int(token[6] or 1), (token[7] or token[8])[0] - 63
            for bit in range(6):
                if bits >> bit & 1:
                    picture[y + bit, x : x + count] = palette[color]
            x += count
        elif token[9]:
            x = 0
        elif token[10]:
            x, y = 0, y + 6
    return picture


def test_sixels_cover_every_pixel_with_nearly_its_color(picture):
    drawn = decoded_sixels(sixel.encode(picture))
    assert drawn.shape == (26, 40, 3)
    assert (drawn >= 0).all()
    # 256 colours of a quantizer, and per cent: as near as these allow.
    difference = np.abs(drawn * 2.55 - picture[..., :3])
    assert difference.mean() < 6
    assert difference.max() < 40


def decoded_blocks(data):
    """Return the picture that half blocks draw, (H, W, 3) uint8."""
    rows = []
    for line in data.decode().split("\r\n"):
        upper, lower, front, back = [], [], None, None
        for color, cell in re.findall(r"\x1b\[([\d;]*)m|(.)", line):
            numbers = color.split(";")
            if cell:
                assert cell == "\N{UPPER HALF BLOCK}"
                upper.append(front)
                lower.append(back)
            elif numbers[0] == "38":
                front = [int(number) for number in numbers[2:]]
            elif numbers[0] == "48":
                back = [int(number) for number in numbers[2:]]
        rows += [upper, lower]
    return np.array(rows, np.uint8)


def test_half_blocks_show_two_rows_of_pixels_each(picture):
    data = half_blocks.encode(picture)
    assert np.array_equal(decoded_blocks(data), picture[..., :3])
    assert data.endswith(b"\x1b[0m")


def test_half_blocks_name_a_color_only_where_it_changes():
    one = half_blocks.encode(np.full((2, 50, 4), 80, np.uint8))
    assert one.count(b"38;2") == one.count(b"48;2") == 1
