"""Textures of images of every mode that Pillow has: they look alike."""

import numpy as np
import pytest

pyrender = pytest.importorskip("engine3d.compat.pyrender")
Image = pytest.importorskip("PIL.Image")
ImageCms = pytest.importorskip("PIL.ImageCms")

DARK, BRIGHT = 64, 200
MODES = ["1", "L", "LA", "La", "P", "PA", "RGB", "RGBA", "RGBa", "RGBX", "CMYK", "YCbCr", "HSV"]
MODES += ["LAB", "I", "F", "F of 0 to 1", "I of 16 bits", "I;16", "I;16B", "I;16L"]


def picture(mode):
    """Left dark, right bright, as an image of a mode."""
    grey = Image.new("L", (4, 2), DARK)
    grey.paste(BRIGHT, (2, 0, 4, 2))
    if mode == "1":
        return Image.fromarray(np.asarray(grey) > 128)
    if mode == "LAB":
        profiles = ImageCms.createProfile("sRGB"), ImageCms.createProfile("LAB")
        return ImageCms.profileToProfile(grey.convert("RGB"), *profiles, outputMode="LAB")
    if mode == "P":
        return grey.convert("RGB").convert("P", palette=Image.Palette.ADAPTIVE)
    if mode.startswith("I;16"):
        order = ">u2" if mode.endswith("B") else "<u2"
        wide = np.asarray(grey).astype(np.uint16) * 256 + 99
        return Image.frombytes(mode, grey.size, wide.astype(order).tobytes())
    if mode == "I of 16 bits":
        return Image.fromarray(np.asarray(grey).astype(np.int32) * 257)
    if mode == "F of 0 to 1":
        return Image.fromarray(np.float32(np.asarray(grey)) / 255)
    between = {"La": "LA", "PA": "LA", "RGBa": "RGBA"}.get(mode, "RGB")
    return grey.convert(between).convert(mode)


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("channels", ["R", "RG", "GB", "RGB", "RGBA"])
def test_all_modes_are_read_alike(mode, channels):
    texels = pyrender.Texture(source=picture(mode), source_channels=channels).source
    dark, bright = (0, 255) if mode == "1" else (DARK, BRIGHT)
    count = len(channels)
    shape = (2, 4) if count == 1 else (2, 4, count)
    assert texels.shape == shape and texels.dtype == np.uint8
    for column, code in ((0, dark), (3, bright)):
        texel = np.atleast_1d(texels[0, column]).astype(int)
        assert (abs(texel[:3] - code) <= (mode == "LAB")).all(), texel
        assert count < 4 or texel[3] == 255


def test_alpha_is_kept():
    image = Image.new("PA", (1, 1))
    image.putpalette([10, 20, 30] * 256)
    image.putpixel((0, 0), (5, 77))
    for mode in (image, image.convert("RGBA")):
        texels = pyrender.Texture(source=mode, source_channels="RGBA").source
        assert texels[0, 0].tolist() == [10, 20, 30, 77]
