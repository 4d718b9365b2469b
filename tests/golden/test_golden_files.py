"""Golden files hold exactly what was drawn, show it, and notice what was done to them."""

import io
import zlib

import numpy as np
import pytest
from golden.samples import changed, colors, write_png
from PIL import Image

import engine3d as e3d
from engine3d.apps.golden import png_files
from engine3d.apps.golden.given_pixels import as_pixels
from engine3d.apps.golden.golden_files import encode_golden, exact_pixels, read_golden, write_golden
from engine3d.apps.golden.pixel_hash import describe, pixel_hash
from engine3d.apps.golden.reading import read_picture
from engine3d.base.files.png import encode_pixels

DEPTHS = np.array([[0.0, 1.5, np.inf], [np.nan, -0.0, 3e38]], np.float32)
PICTURES = {
    "RGBA": colors(),
    "RGB": colors(channels=3),
    "grey": colors(channels=1)[..., 0],
    "grey, with an axis": colors(channels=1),
    "grey and alpha": colors(channels=2),
    "one pixel": colors(1, 1),
    "bool": colors(channels=1)[..., 0] > 128,
    "16 bits": colors(channels=1, dtype=np.uint16)[..., 0],
    "16 bits and alpha": colors(channels=2, dtype=np.uint16),
    "16 bits RGB": colors(channels=3, dtype=np.uint16),
    "16 bits RGBA": colors(channels=4, dtype=np.uint16),
    "depth": DEPTHS,
    "float16": np.array([[0, 1.5, np.inf], [np.nan, -0.0, 6e4]], np.float16),
    "float64": DEPTHS.astype(np.float64),
    "normals": np.dstack([DEPTHS] * 3),
    "texture coordinates": np.dstack([DEPTHS] * 2),
    "identities": np.array([[-1, 0, 7], [2**31 - 1, 5, -1]], np.int32),
    "int64": np.array([[-(2**63), 2**63 - 1]], np.int64),
    "uint32": np.array([[2**32 - 1, 0]], np.uint32),
    "a range that overflows": np.array([[-3e38, 3e38]], np.float32),
    "all the same": np.full((2, 2), 4.0, np.float32),
    "nothing finite": np.full((2, 2), np.nan, np.float32),
}


@pytest.mark.parametrize("pixels", PICTURES.values(), ids=PICTURES)
def test_what_was_drawn_is_read_back(pixels, tmp_path):
    path = str(tmp_path / "new folder" / "a.png")
    write_golden(path, pixels)
    golden = read_golden(path)
    assert golden.digest == pixel_hash(pixels)
    read = golden.pixels()
    assert read.dtype == pixels.dtype and read.shape == pixels.shape
    assert read.tobytes() == pixels.tobytes()
    assert read_picture(path).frames[0].tobytes() == pixels.tobytes()
    with Image.open(path) as image:  # a picture for everybody else
        image.load()
        assert image.size == (pixels.shape[1], pixels.shape[0])


def test_colors_are_shown_as_they_are():
    with Image.open(io.BytesIO(encode_golden(PICTURES["RGBA"]))) as image:
        assert np.array_equal(np.asarray(image), PICTURES["RGBA"])


def test_depths_and_identities_are_shown():
    def shown(pixels):
        with Image.open(io.BytesIO(encode_golden(pixels))) as image:
            return np.asarray(image.convert("RGB")).astype(int)

    assert shown(np.array([[0.0, 1.0, 2.0]], np.float32))[0, :, 0].tolist() == [0, 128, 255]
    assert shown(DEPTHS)[1, 0].tolist() == [255, 0, 255]
    numbers = shown(np.array([[-1, 0, 1, 2, 3]], np.int32))[0]
    assert numbers[0].tolist() == [0, 0, 0]
    assert min(np.abs(a - b).sum() for i, a in enumerate(numbers) for b in numbers[:i]) > 40


def test_the_hash_tells_types_and_shapes_apart():
    zeros = [
        np.zeros(shape, dtype) for shape in ((4, 2), (2, 4), (2, 2, 2)) for dtype in ("u1", "i1")
    ]
    assert len({pixel_hash(pixels) for pixels in zeros}) == len(zeros)


def test_a_picture_that_was_edited_is_read_as_it_is(tmp_path):
    pixels = PICTURES["RGBA"]
    path = tmp_path / "a.png"
    write_golden(str(path), pixels)
    other = dict(png_files.split_chunks(encode_pixels(changed(pixels))))
    chunks = png_files.split_chunks(path.read_bytes())
    edited = [(name, other[b"IDAT"] if name == b"IDAT" else data) for name, data in chunks]
    path.write_bytes(png_files.join_chunks(edited))  # by a program that keeps unknown chunks
    golden = read_golden(str(path))
    assert golden.digest is None
    assert np.array_equal(golden.pixels(), changed(pixels))


def test_numbers_that_are_cut_short_are_an_error(tmp_path):
    """Only who forges the seal gets there."""
    from engine3d.apps.golden import golden_files

    chunks = png_files.split_chunks(encode_golden(PICTURES["depth"]))
    short = [(n, zlib.compress(b"abc") if n == b"daTA" else d) for n, d in chunks]
    body = [c for c in short if c[0] not in (b"goLD", b"IEND")]
    old = golden_files._seal([c for c in chunks if c[0] not in (b"goLD", b"IEND")])
    text = dict(chunks)[b"goLD"].replace(old.encode(), golden_files._seal(body).encode())
    file = png_files.join_chunks([body[0], (b"goLD", text), *body[1:], (b"IEND", b"")])
    with pytest.raises(e3d.FileFormatError, match="does not hold the numbers"):
        exact_pixels(file, "a.png")


@pytest.mark.parametrize("damage", ["cut", "flipped", "empty", "other"])
def test_damaged_files_are_errors(damage, tmp_path):
    data = bytearray(encode_golden(PICTURES["RGBA"]))
    if damage == "flipped":
        data[-30] ^= 1
    damaged = {"cut": data[:-5], "flipped": data, "empty": b"", "other": b"GIF89a"}[damage]
    path = tmp_path / "a.png"
    path.write_bytes(damaged)
    with pytest.raises(e3d.FileFormatError, match=r"a\.png: (the|not a) PNG file"):
        read_golden(str(path))


def test_no_file_is_none(tmp_path):
    (tmp_path / "file").write_text("")
    assert read_golden(str(tmp_path / "a.png")) is None
    assert read_golden(str(tmp_path / "file" / "a.png")) is None


def test_a_folder_that_cannot_be_made_is_an_error(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(e3d.FileAccessError, match="cannot write"):
        write_golden(str(tmp_path / "file" / "a.png"), PICTURES["RGBA"])


# Files of others


@pytest.mark.parametrize("filter_type", range(5))
@pytest.mark.parametrize("channels", [1, 2, 3, 4])
def test_16_bits_are_read_whole(channels, filter_type, tmp_path):
    pixels = colors(5, 7, channels, np.uint16)
    name_and_header, _, end = png_files.split_chunks(encode_pixels(pixels))
    packed = zlib.compress(filtered(pixels.astype(">u2"), filter_type))
    path = tmp_path / "a.png"
    path.write_bytes(png_files.join_chunks([name_and_header, (b"IDAT", packed), end]))
    assert np.array_equal(read_picture(path).frames[0].reshape(pixels.shape), pixels)


def filtered(pixels, kind):
    """The rows of a PNG file by one of its filters (PNG specification, section 9)."""
    height, step = pixels.shape[0], 2 * pixels.shape[2]
    rows = np.ascontiguousarray(pixels).view(np.uint8).reshape(height, -1).astype(int)
    left, above = np.pad(rows, ((0, 0), (step, 0)))[:, :-step], np.pad(rows, ((1, 0), (0, 0)))[:-1]
    corner = np.pad(above, ((0, 0), (step, 0)))[:, :-step]
    estimate = left + above - corner
    a, b, c = (np.abs(estimate - one) for one in (left, above, corner))
    nearest = np.where((a <= b) & (a <= c), left, np.where(b <= c, above, corner))
    guess = (0 * rows, left, above, (left + above) // 2, nearest)[kind]
    lines = np.concatenate([np.full((height, 1), kind), (rows - guess) % 256], axis=1)
    return lines.astype(np.uint8).tobytes()


def test_formats_and_frames(tmp_path):
    pixels = colors(16, 16, 3)
    for name in ("a.png", "a.bmp", "a.tga", "a.webp", "a.tiff"):
        Image.fromarray(pixels).save(tmp_path / name, lossless=True)
        (read,) = read_picture(tmp_path / name).frames
        assert np.array_equal(read[..., :3], pixels), name
    frames = [Image.new("RGB", (4, 4), color) for color in ("red", "lime", "blue")]
    frames[0].save(tmp_path / "a.gif", save_all=True, append_images=frames[1:])
    read = read_picture(tmp_path / "a.gif").frames
    assert [frame[0, 0, :3].tolist() for frame in read] == [[255, 0, 0], [0, 255, 0], [0, 0, 255]]
    Image.fromarray(DEPTHS).save(tmp_path / "b.tiff")
    assert read_picture(tmp_path / "b.tiff").frames[0].tobytes() == DEPTHS.tobytes()


def test_palettes_and_transparent_colors_are_resolved(tmp_path):
    image = Image.new("P", (2, 1), 0)
    image.putpalette([10, 20, 30, 40, 50, 60])
    image.putpixel((1, 0), 1)
    image.save(tmp_path / "a.png", transparency=1)
    read = read_picture(tmp_path / "a.png").frames[0]
    assert read.tolist() == [[[10, 20, 30, 255], [40, 50, 60, 0]]]


@pytest.mark.parametrize("content", [b"", b"no picture", encode_golden(PICTURES["RGBA"])[:60]])
def test_what_is_no_picture_is_an_error(content, tmp_path):
    path = tmp_path / "a.png"
    path.write_bytes(content)
    with pytest.raises(e3d.FileFormatError, match=r"a\.png: "):
        read_picture(path)
    with pytest.raises(e3d.FileAccessError, match=r"b\.png: cannot read"):
        read_picture(tmp_path / "b.png")


# What tests hand over


def test_frames_canvases_images_and_files_are_pictures(tmp_path):
    canvas = e3d.Canvas((5, 4))
    canvas.line(0, 0, 4, 3, (255, 0, 0))
    assert np.array_equal(as_pixels(canvas), canvas.pixels)
    assert np.array_equal(as_pixels(canvas.image()), canvas.pixels)
    frame = e3d.render(e3d.Scene(background=(1, 2, 3)), size=(3, 2))
    assert np.array_equal(as_pixels(frame), frame.color)
    path = write_png(tmp_path / "a.png", canvas.pixels)
    assert np.array_equal(as_pixels(path), canvas.pixels)
    assert np.array_equal(as_pixels(str(path)), canvas.pixels)
    assert as_pixels(Image.new("1", (2, 2), 1)).tolist() == [[255, 255]] * 2
    assert as_pixels(Image.new("CMYK", (2, 2))).shape == (2, 2, 3)
    assert as_pixels([[1, 2]]).dtype == np.int64


def test_pictures_are_taken_in_any_layout():
    pixels = colors()
    for other in (pixels[::-1][::-1], np.asfortranarray(pixels), pixels.copy()):
        assert pixel_hash(as_pixels(other)) == pixel_hash(pixels)
    wide = colors(dtype=np.uint16)
    assert pixel_hash(as_pixels(wide.astype(">u2"))) == pixel_hash(wide)


@pytest.mark.parametrize(
    ("value", "message"),
    [
        (np.zeros((0, 4, 4), np.uint8), "not (0, 4, 4)"),
        (np.zeros((4, 4, 5), np.uint8), "not (4, 4, 5)"),
        (np.zeros(4, np.uint8), "not (4,)"),
        (np.zeros((1, 2, 3, 4), np.uint8), "not (1, 2, 3, 4)"),
        (np.zeros((2, 2), complex), "complex128"),
        (np.full((2, 2), "a"), "<U1"),
        (None, "NoneType"),
        (object(), "object"),
    ],
)
def test_what_is_no_picture_is_refused(value, message):
    with pytest.raises(e3d.InvalidArgumentError) as raised:
        as_pixels(value)
    assert message in str(raised.value)


def test_descriptions():
    assert describe(colors()) == "8x6 RGBA"
    assert describe(DEPTHS) == "3x2 float32"
    assert describe(np.dstack([DEPTHS] * 3)) == "3x2 float32 x 3"
