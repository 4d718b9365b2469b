"""Every TGA file of the corpus has its expected outcome."""

import hashlib

import pytest
from shared_corpus import CONFORMANCE, cases_of, needs_conformance

from engine3d.errors import FileFormatError
from engine3d.loaders import load_texture

pytestmark = needs_conformance


@pytest.mark.parametrize("case", cases_of("tga"))
def test_tga(case):
    path = CONFORMANCE / case["file"]
    if case["expect"] == "error":
        with pytest.raises(FileFormatError, match=path.name):
            load_texture(path)
        return
    try:
        pixels = load_texture(path).pixels
    except FileFormatError:
        assert case["expect"] == "ok_or_error"
        return
    _check_pixels(pixels, case)


def _check_pixels(pixels, case):
    if "width" in case:
        assert pixels.shape[:2] == (case["height"], case["width"])
    if case["expect"] == "ok" and "rgb_sha256" in case:
        assert _sha256(pixels[:, :, :3]) in _listed(case["rgb_sha256"])
    alpha = case.get("alpha")
    if alpha == "opaque":
        assert (pixels[:, :, 3] == 255).all()
    elif alpha not in (None, "ambiguous"):
        assert _sha256(pixels[:, :, 3]) == alpha
    if "rgba_const" in case:
        assert pixels.reshape(-1, 4)[0].tolist() == case["rgba_const"]


def _listed(value):
    return value if isinstance(value, list) else [value]


def _sha256(array):
    return hashlib.sha256(array.tobytes()).hexdigest()
