"""TGA, feature by feature, with files put together byte by byte."""

import struct
import time

import numpy as np
import pytest

from engine3d.errors import FileFormatError
from engine3d.loaders import load_texture


def tga(kind, width, height, bits, body, *, flags=0x20, color_map=b"", map_of=(0, 0, 0), name=b""):
    first, length, map_bits = map_of
    header = struct.pack(
        "<BBBHHBHHHHBB",
        len(name),
        1 if color_map else 0,
        kind,
        first,
        length,
        map_bits,
        0,
        0,
        width,
        height,
        bits,
        flags,
    )
    return header + name + color_map + body


@pytest.fixture
def pixels(write):
    return lambda data: load_texture(write("image.tga", data)).pixels


def test_true_color_is_stored_blue_first(pixels):
    assert pixels(tga(2, 1, 1, 24, bytes([1, 2, 3])))[0, 0].tolist() == [3, 2, 1, 255]


@pytest.mark.parametrize(
    ("flags", "expected"),
    [
        (0x20, [[1, 2], [3, 4]]),
        (0x00, [[3, 4], [1, 2]]),
        (0x30, [[2, 1], [4, 3]]),
        (0x10, [[4, 3], [2, 1]]),
    ],
)
def test_origins(pixels, flags, expected):
    image = pixels(tga(3, 2, 2, 8, bytes([1, 2, 3, 4]), flags=flags))
    assert image[:, :, 0].tolist() == expected


def test_bottom_up_images_of_odd_height(pixels):
    assert pixels(tga(3, 1, 3, 8, bytes([1, 2, 3]), flags=0))[:, 0, 0].tolist() == [3, 2, 1]


def test_five_bit_channels_are_widened(pixels):
    body = struct.pack("<HH", 0b0_11111_00000_00001, 0b0_10000_11111_00000)
    image = pixels(tga(2, 2, 1, 16, body))
    assert image[0].tolist() == [[255, 0, 8, 255], [132, 255, 0, 255]]


def test_alpha_by_attribute_bits(pixels):
    body = bytes([1, 2, 3, 128, 4, 5, 6, 255])
    assert pixels(tga(2, 2, 1, 32, body, flags=0x28))[0, :, 3].tolist() == [128, 255]
    assert pixels(tga(2, 2, 1, 32, body, flags=0x20))[0, :, 3].tolist() == [255, 255]


def test_alpha_of_zero_everywhere_counts_as_none(pixels):
    assert pixels(tga(2, 1, 1, 32, bytes(4), flags=0x28))[0, 0, 3] == 255


def test_one_alpha_bit(pixels):
    body = struct.pack("<HH", 0x8000, 0x0000)
    assert pixels(tga(2, 2, 1, 16, body, flags=0x21))[0, :, 3].tolist() == [255, 0]


@pytest.mark.parametrize(("attributes", "alpha"), [(0, 255), (1, 255), (2, 7), (3, 7), (4, 7)])
def test_the_extension_area_says_whether_there_is_alpha(pixels, attributes, alpha):
    data = tga(2, 1, 1, 32, bytes([1, 2, 3, 7]), flags=0x28)
    extension = bytes(494) + bytes([attributes])
    footer = struct.pack("<II", len(data), 0) + b"TRUEVISION-XFILE.\0"
    assert pixels(data + extension + footer)[0, 0, 3] == alpha


def test_grey_with_alpha(pixels):
    image = pixels(tga(3, 2, 1, 16, bytes([10, 20, 30, 40]), flags=0x28))
    assert image[0].tolist() == [[10, 10, 10, 20], [30, 30, 30, 40]]


def test_color_map_with_offset_and_identification(pixels):
    color_map = bytes([1, 2, 3, 4, 5, 6])
    data = tga(1, 2, 1, 8, bytes([6, 5]), color_map=color_map, map_of=(5, 2, 24), name=b"id")
    assert pixels(data)[0].tolist() == [[6, 5, 4, 255], [3, 2, 1, 255]]


def test_color_map_indices_of_16_bits(pixels):
    color_map = bytes(3 * 300 - 3) + bytes([1, 2, 3])
    body = struct.pack("<H", 299)
    data = tga(1, 1, 1, 16, body, color_map=color_map, map_of=(0, 300, 24))
    assert pixels(data)[0, 0].tolist() == [3, 2, 1, 255]


def test_runs_and_raw_packets_across_lines(pixels):
    body = bytes([0x82, 9, 0x02, 1, 2, 3, 0x81, 7])
    image = pixels(tga(11, 4, 2, 8, body))
    assert image[:, :, 0].tolist() == [[9, 9, 9, 1], [2, 3, 7, 7]]


def test_run_length_true_color(pixels):
    body = bytes([0x81, 1, 2, 3, 0x00, 4, 5, 6])
    image = pixels(tga(10, 3, 1, 24, body))
    assert image[0, :, :3].tolist() == [[3, 2, 1], [3, 2, 1], [6, 5, 4]]


def test_run_length_color_map(pixels):
    data = tga(
        9, 3, 1, 8, bytes([0x82, 1]), color_map=bytes([0] * 3 + [1, 2, 3]), map_of=(0, 2, 24)
    )
    assert pixels(data)[0].tolist() == [[3, 2, 1, 255]] * 3


def test_a_last_packet_that_is_too_long_ends_with_the_image(pixels):
    assert pixels(tga(11, 2, 1, 8, bytes([0x84, 5])))[0, :, 0].tolist() == [5, 5]
    assert pixels(tga(11, 2, 1, 8, bytes([0x04, 5, 6])))[0, :, 0].tolist() == [5, 6]


def test_a_large_run_length_image_equals_its_plain_form(pixels):
    random = np.random.default_rng(2)
    grey = np.repeat(random.integers(0, 256, 2000, dtype=np.uint8), random.integers(1, 200, 2000))
    width, height = 512, len(grey) // 512
    grey = grey[: width * height]
    edges = np.flatnonzero(np.diff(grey)) + 1
    body = bytearray()
    for run in np.split(grey, edges):
        for start in range(0, len(run), 128):
            body += bytes([127 + min(128, len(run) - start), run[0]])
    packed = pixels(tga(11, width, height, 8, bytes(body), flags=0))
    plain = pixels(tga(3, width, height, 8, grey.tobytes(), flags=0))
    assert np.array_equal(packed, plain)


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"", "cut short in the TGA header"),
        (bytes(17), "cut short in the TGA header"),
        (tga(0, 1, 1, 24, bytes(3)), "unknown TGA image type 0"),
        (tga(32, 1, 1, 24, bytes(3)), "unknown TGA image type 32"),
        (tga(2, 0, 1, 24, bytes(3)), "0x1 pixels"),
        (tga(2, 40000, 1, 24, bytes(120000)), "limited to 16384"),
        (tga(2, 30000, 30000, 24, b""), "limited to"),
        (tga(2, 1000, 1000, 24, bytes(10)), "cut short: 1000x1000 pixels need 3000000 bytes"),
        (tga(10, 1000, 1000, 24, bytes(10)), "cut short"),
        (tga(2, 1, 1, 17, bytes(3)), "17 bits per pixel"),
        (tga(2, 1, 1, 8, bytes(3)), "8 bits per pixel"),
        (tga(1, 1, 1, 8, bytes(1)), "colour map 0"),
        (tga(1, 1, 1, 8, bytes(1), color_map=b"abc", map_of=(0, 1, 17)), "17 bits an entry"),
        (tga(1, 1, 1, 8, b"", color_map=b"abc", map_of=(0, 9, 24)), "cut short in the TGA col"),
        (tga(1, 1, 1, 8, b"\x01", color_map=b"abc", map_of=(0, 1, 24)), "value 1 is outside"),
        (tga(1, 1, 1, 8, b"\x01", color_map=b"abc", map_of=(9, 1, 24)), "value 1 is outside"),
        (tga(2, 1, 1, 24, bytes(3), flags=0x40), "interleaved"),
        (tga(11, 4, 1, 8, bytes([0x81, 1])), "cut short: 2 of 4"),
        (tga(11, 4, 1, 8, bytes([0x03, 1, 2, 3])), "cut short: 3 of 4 pixels"),
    ],
)
def test_damaged_files_are_clear_errors(pixels, data, message):
    with pytest.raises(FileFormatError, match=message) as caught:
        pixels(data)
    assert "image.tga: " in str(caught.value)


def test_an_image_of_a_megapixel_loads_at_once(pixels):
    body = bytes([0x7F]) + bytes(range(128)) * 3
    started = time.process_time()
    pixels(tga(10, 1024, 1024, 24, body * 8192))
    assert time.process_time() - started < 2
