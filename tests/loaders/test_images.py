"""Images through Pillow, and the limits on them."""

import io
import struct
import zlib

import numpy as np
import pytest
from PIL import Image

from engine3d.errors import Engine3DWarning, FileAccessError, FileFormatError
from engine3d.io.formats import images
from engine3d.io.loaders import load_mesh, load_texture


@pytest.fixture
def saved(tmp_path):
    def save(image, name, **options):
        path = tmp_path / name
        image.save(path, **options)
        return path

    return save


@pytest.mark.parametrize("extension", ["png", "webp", "bmp", "gif", "tiff", "ppm", "tga"])
def test_lossless_formats(saved, extension):
    colors = np.array([[[255, 0, 0], [0, 255, 0]], [[0, 0, 255], [255, 255, 255]]], np.uint8)
    options = {"lossless": True} if extension == "webp" else {}
    texture = load_texture(saved(Image.fromarray(colors), f"a.{extension}", **options))
    assert np.array_equal(texture.pixels[:, :, :3], colors)
    assert (texture.pixels[:, :, 3] == 255).all()
    assert not texture.pixels.flags.writeable


def test_jpeg(saved):
    texture = load_texture(saved(Image.new("RGB", (8, 8), (200, 100, 50)), "a.jpg", quality=95))
    assert np.abs(texture.pixels[0, 0, :3].astype(int) - [200, 100, 50]).max() < 4


@pytest.mark.parametrize(
    ("mode", "color", "expected"),
    [
        ("L", 9, [9, 9, 9, 255]),
        ("LA", (9, 8), [9, 9, 9, 8]),
        ("RGBA", (1, 2, 3, 4), [1, 2, 3, 4]),
        ("1", 1, [255, 255, 255, 255]),
        ("I;16", 0x8012, [128, 128, 128, 255]),
    ],
)
def test_modes(saved, mode, color, expected):
    texture = load_texture(saved(Image.new(mode, (1, 1), color), "a.png"))
    assert texture.pixels[0, 0].tolist() == expected


@pytest.mark.parametrize("extension", ["png", "tiff", "pgm"])
def test_16_bit_grey(saved, extension):
    """The high byte, not what is clipped at 255."""
    grey = np.array([[0, 0x00FF, 0x0100], [0x8000, 0x80FF, 0xFFFF]], np.uint16)
    texture = load_texture(saved(Image.fromarray(grey), f"a.{extension}"))
    assert texture.pixels[:, :, 0].tolist() == [[0, 0, 1], [128, 128, 255]]
    assert (texture.pixels[:, :, 3] == 255).all()


def test_16_bit_grey_with_a_transparent_value(write):
    header = struct.pack(">IIBBBBB", 3, 1, 16, 0, 0, 0, 0)
    rows = struct.pack(">x3H", 0x1234, 0x1235, 0xFFFF)
    path = write("a.png", _png(header, rows, (b"tRNS", struct.pack(">H", 0x1235))))
    assert load_texture(path).pixels[0, :, ::3].tolist() == [[18, 255], [18, 0], [255, 255]]


@pytest.mark.parametrize(("kind", "channels"), [(4, 2), (2, 3), (6, 4)])
def test_16_bit_channels(write, kind, channels):
    header = struct.pack(">IIBBBBB", 1, 1, 16, kind, 0, 0, 0)
    rows = struct.pack(">x4H", 0x12FF, 0x34FF, 0x56FF, 0x78FF)[: 1 + 2 * channels]
    expected = {2: [18, 18, 18, 52], 3: [18, 52, 86, 255], 4: [18, 52, 86, 120]}[channels]
    assert load_texture(write("a.png", _png(header, rows))).pixels[0, 0].tolist() == expected


def test_integers_of_no_known_range_are_refused(saved):
    path = saved(Image.fromarray(np.array([[0, 70000]], np.int32)), "a.tiff")
    with pytest.raises(FileFormatError, match=r"a\.tiff: pixels of more than 16 bits"):
        load_texture(path)


@pytest.mark.parametrize("kind", ["tiff", "ppm"])
def test_floats_are_refused(saved, kind):
    """Pillow would clip them, so that a picture from 0 to 1 became black."""
    path = saved(Image.new("F", (2, 2), 0.5), "a.float", format=kind)
    with pytest.raises(FileFormatError, match="floats are not read"):
        load_texture(path, format=kind)


@pytest.mark.parametrize("mode", ["1", "L", "RGB"])
def test_portable_pixmaps_are_recognised_without_a_name(saved, mode):
    path = saved(Image.new(mode, (3, 2), "white"), "a.ppm")
    assert (load_texture(path.read_bytes()).pixels == 255).all()


@pytest.mark.parametrize("mode", ["1", "L", "LA", "P", "RGB", "RGBA", "CMYK"])
@pytest.mark.parametrize("strip", [1, 20, 7 * 5])
def test_strips(saved, monkeypatch, mode, strip):
    """What is converted piece by piece is what Pillow converts at once."""
    monkeypatch.setattr(images, "_STRIP", strip)
    noise = np.random.default_rng(1).integers(0, 256, (5, 7, 4), np.uint8)
    image = Image.fromarray(noise).convert(mode)
    options = {"transparency": 3} if mode in ("P", "L") else {}
    path = saved(image, "a.tif" if mode == "CMYK" else "a.png", **options)
    with Image.open(path) as again:
        assert np.array_equal(load_texture(path).pixels, np.array(again.convert("RGBA")))


def test_palette_with_transparency(saved):
    image = Image.new("P", (2, 1))
    image.putpalette([10, 20, 30, 40, 50, 60])
    image.putpixel((1, 0), 1)
    texture = load_texture(saved(image, "a.png", transparency=0))
    assert texture.pixels[0].tolist() == [[10, 20, 30, 0], [40, 50, 60, 255]]


def test_options_go_to_the_texture(saved):
    path = saved(Image.new("L", (1, 1)), "a.png")
    texture = load_texture(path, wrap="clamp", color_space="linear", filter="nearest")
    assert (texture.wrap, texture.color_space, texture.filter) == ("clamp", "linear", "nearest")
    assert texture.name == "a.png"


def test_the_content_counts_more_than_the_extension(saved):
    path = saved(Image.new("L", (1, 1), 7), "a.png")
    renamed = path.with_suffix(".jpg")
    path.rename(renamed)
    assert load_texture(renamed).pixels[0, 0, 0] == 7


@pytest.mark.parametrize(
    "content", [b"", b"hello", b"\x89PNG\r\n\x1a\n", b"\xff\xd8\xff\xe0", b"GIF89a"]
)
def test_damaged_images_are_clear_errors(write, content):
    with pytest.raises(FileFormatError, match=r"a\.png: "):
        load_texture(write("a.png", content))


def test_a_cut_png_gives_no_partial_pixels(saved):
    path = saved(Image.effect_noise((64, 64), 50), "a.png")
    path.write_bytes(path.read_bytes()[:-200])
    with pytest.raises(FileFormatError):
        load_texture(path)


def test_a_decompression_bomb_is_refused_before_it_is_decoded(write):
    header = struct.pack(">IIBBBBB", 30000, 30000, 8, 0, 0, 0, 0)
    with pytest.raises(FileFormatError, match="limited to"):
        load_texture(write("a.png", _png(header)))


def test_the_limit_can_be_changed(saved, monkeypatch):
    path = saved(Image.new("L", (20, 20)), "a.png")
    monkeypatch.setattr(images, "MAX_PIXELS", 399)
    with pytest.raises(FileFormatError, match="limited to 399 pixels"):
        load_texture(path)


def test_programs_behind_formats_are_not_started(write):
    with pytest.raises(FileFormatError):
        load_texture(write("a.png", b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 10 10\n"))


def test_unknown_formats_and_missing_files(write, tmp_path):
    with pytest.raises(FileFormatError, match=r"unknown image format '\.xyz' \(known: .*\.tga"):
        load_texture(write("a.xyz", b"hello"))
    with pytest.raises(FileAccessError):
        load_texture(tmp_path / "none.png")


def test_images_of_one_model_are_limited_together(write, monkeypatch):
    """Each is small enough; a name of its own makes each a texture of its own."""
    monkeypatch.setattr(images, "MAX_PIXELS", 100_000)
    gif = io.BytesIO()
    Image.new("P", (200, 200)).save(gif, "GIF")
    names = [f"m{k}" for k in range(5)]
    for name in names:
        write(f"{name}.gif", gif.getvalue())
    write("a.mtl", "".join(f"newmtl {name}\nmap_Kd {name}.gif\n" for name in names))
    faces = "".join(f"usemtl {name}\nf 1/1 2/2 3/3\n" for name in names)
    text = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n" + faces
    with pytest.warns(Engine3DWarning, match="images of a model are limited to 100000 pixels"):
        mesh = load_mesh(write("a.obj", text))
    assert [material.texture is not None for material in mesh.materials] == [True] * 2 + [False] * 3
    assert len(mesh.warnings) == 3
    assert all(load_texture(write("b.gif", gif.getvalue())).width == 200 for _ in range(5))


def _png(header, rows=b"\0" * 1000, *chunks):
    def chunk(kind, data):
        crc = struct.pack(">I", zlib.crc32(kind + data))
        return struct.pack(">I", len(data)) + kind + data + crc

    body = [(b"IHDR", header), *chunks, (b"IDAT", zlib.compress(rows)), (b"IEND", b"")]
    return b"\x89PNG\r\n\x1a\n" + b"".join(chunk(*part) for part in body)
