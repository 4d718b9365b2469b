"""Files of numbers per pixel: their bytes by definition, and as OpenCV and OpenEXR read them."""

import os
import struct

import numpy as np
import pytest
from PIL import Image

import engine3d as e3d
from engine3d.sensors import save_values

RANDOM = np.random.default_rng(8)
DEPTH = RANDOM.uniform(0.2, 200.0, (7, 5)).astype(np.float32)
FLOW = RANDOM.uniform(-300.0, 300.0, (7, 5, 2)).astype(np.float32)
VALID = RANDOM.random((7, 5)) > 0.3


def test_flo_is_middleburys(tmp_path):
    save_values(tmp_path / "a.flo", FLOW, valid=VALID)
    data = (tmp_path / "a.flo").read_bytes()
    assert data[:4] == b"PIEH" and struct.unpack("<fii", data[:12]) == (202021.25, 5, 7)
    read = np.frombuffer(data[12:], "<f4").reshape(7, 5, 2)
    assert np.array_equal(read[VALID], FLOW[VALID])
    assert (np.abs(read[~VALID]) > 1e9).all()


def test_kittis_flow_has_steps_and_a_mark(tmp_path):
    save_values(tmp_path / "a.png", FLOW, valid=VALID)
    cv2 = pytest.importorskip("cv2", exc_type=ImportError)
    read = cv2.imread(str(tmp_path / "a.png"), cv2.IMREAD_UNCHANGED)[..., ::-1].astype(float)
    assert read.shape == (7, 5, 3)
    u, v = (read[..., 0] - 2**15) / 64, (read[..., 1] - 2**15) / 64
    assert np.array_equal(read[..., 2] == 1, VALID) and not read[~VALID].any()
    assert np.abs(u - FLOW[..., 0])[VALID].max() <= 1 / 128
    assert np.abs(v - FLOW[..., 1])[VALID].max() <= 1 / 128


def test_kittis_disparity_has_steps_and_zero(tmp_path):
    values = np.array([[1.25, 100.0, 0.0001, 255.99]], np.float32)
    save_values(tmp_path / "a.png", values, valid=np.array([[True, False, True, True]]))
    with Image.open(tmp_path / "a.png") as image:
        codes = np.asarray(image)
    assert codes.tolist() == [[320, 0, 1, 65533]]


def test_what_16_bits_do_not_hold_is_marked_and_told(tmp_path):
    flow = np.array([[(0.0, 0.0), (600.0, 0.0), (0.0, -512.1)]], np.float32)
    with pytest.warns(e3d.Engine3DWarning, match="2 pixels"):
        save_values(tmp_path / "a.png", flow)
    with pytest.warns(e3d.Engine3DWarning, match="1 pixels"):
        save_values(tmp_path / "b.png", np.array([[256.0, 1.0]], np.float32))
    with Image.open(tmp_path / "b.png") as image:
        assert np.asarray(image).tolist() == [[0, 256]]


def test_negative_numbers_are_no_small_ones(tmp_path):
    values = np.array([[-1.0, -1e-9, -1e9, np.nan, 0.0, 1e-9, 2.0]])
    with pytest.warns(e3d.Engine3DWarning, match="4 pixels have values that 16 bits do not hold"):
        save_values(tmp_path / "a.png", values)
    with Image.open(tmp_path / "a.png") as image:
        assert np.asarray(image).tolist() == [[0, 0, 0, 0, 1, 1, 512]]


@pytest.mark.parametrize("values", [DEPTH, FLOW, RANDOM.random((7, 5, 3)).astype(np.float32)])
def test_pfm_is_read_by_opencv(tmp_path, values):
    cv2 = pytest.importorskip("cv2", exc_type=ImportError)
    save_values(tmp_path / "a.pfm", values, valid=VALID)
    head = (tmp_path / "a.pfm").read_bytes()[:3]
    assert head == (b"Pf\n" if values.ndim == 2 else b"PF\n")
    read = cv2.imread(str(tmp_path / "a.pfm"), cv2.IMREAD_UNCHANGED)
    read = read[..., ::-1] if read.ndim == 3 else read
    channels = values.shape[2] if values.ndim == 3 else 1
    shown = read[VALID].reshape(-1, read.shape[2] if read.ndim == 3 else 1)[:, :channels]
    assert np.array_equal(shown, values[VALID].reshape(-1, channels))
    assert np.isinf(read.reshape(7, 5, -1)[~VALID][:, 0]).all()


@pytest.mark.parametrize(
    ("values", "names"), [(DEPTH, "Y"), (FLOW, "RG"), (RANDOM.random((7, 5, 3)), "RGB")]
)
def test_exr_is_read_by_its_own_library(tmp_path, values, names):
    openexr = pytest.importorskip("OpenEXR", exc_type=ImportError)
    values = values.astype(np.float32)
    save_values(tmp_path / "a.exr", values, valid=VALID)
    channels = openexr.File(str(tmp_path / "a.exr"), separate_channels=True).channels()
    assert sorted(channels) == sorted(names)
    for number, name in enumerate(names):
        read, given = channels[name].pixels, values.reshape(7, 5, -1)[..., number]
        assert read.dtype == np.float32 and np.isnan(read[~VALID]).all()
        assert np.array_equal(read[VALID], given[VALID])


def test_numpys_files(tmp_path):
    save_values(tmp_path / "a.npy", FLOW, valid=VALID)
    read = np.load(tmp_path / "a.npy")
    assert np.isnan(read[~VALID]).all() and np.array_equal(read[VALID], FLOW[VALID])
    ids = np.arange(35, dtype=np.int32).reshape(7, 5)
    save_values(tmp_path / "a.npz", ids, valid=VALID)
    with np.load(tmp_path / "a.npz") as arrays:
        assert np.array_equal(arrays["values"], ids) and np.array_equal(arrays["valid"], VALID)
    save_values(tmp_path / "b.npz", ids, valid=VALID)
    assert (tmp_path / "a.npz").read_bytes() == (tmp_path / "b.npz").read_bytes()


def test_masks_are_black_and_white(tmp_path):
    save_values(tmp_path / "a.png", VALID)
    with Image.open(tmp_path / "a.png") as image:
        assert np.array_equal(np.asarray(image), VALID * np.uint8(255))


@pytest.mark.parametrize(
    ("name", "values", "valid", "words"),
    [
        ("a.flo", DEPTH, None, "flo holds floats of 2 channels"),
        ("a.png", np.zeros((4, 4), np.int32), None, "npy and .npz hold any"),
        ("a.png", np.zeros((4, 4, 3)), None, "1 or 2 channels"),
        ("a.tiff", DEPTH, None, "suffix"),
        ("a", DEPTH, None, "suffix"),
        ("a.npy", np.zeros((4, 4), np.int32), np.zeros((4, 4), bool), "NaN"),
        ("a.npy", np.zeros(4), None, "values must be"),
        ("a.npy", np.zeros((0, 4)), None, "values must be"),
        ("a.npy", [["a", "b"]], None, "values must be"),
        ("a.pfm", DEPTH, np.ones((3, 3), bool), "valid must be"),
        ("a.pfm", DEPTH, np.ones((7, 5)), "valid must be"),
    ],
)
def test_what_a_format_does_not_hold(tmp_path, name, values, valid, words):
    with pytest.raises(e3d.InvalidArgumentError, match=words):
        save_values(tmp_path / name, values, valid=valid)
    assert os.listdir(tmp_path) == []
