"""Masks as run lengths: what COCO's own library reads and writes, where it is installed."""

import numpy as np
import pytest

import engine3d as e3d
from engine3d.datasets import decode_rle, encode_rle


def masks():
    random = np.random.default_rng(3)
    yield np.zeros((7, 5), bool)
    yield np.ones((7, 5), bool)
    yield np.zeros((0, 0), bool)
    yield np.eye(300, dtype=bool)
    for share in (0.01, 0.5, 0.97):
        yield random.random((random.integers(1, 90), random.integers(1, 90))) < share
    for step in (1, 31, 32, 33, 1000, 40000):  # runs around the limits of a character
        column = np.zeros(200_000, bool)
        column[step::step] = True
        yield column.reshape((1000, 200))


@pytest.mark.parametrize("mask", list(masks()))
def test_masks_come_back(mask):
    assert np.array_equal(decode_rle(encode_rle(mask)), mask)


def test_the_text_is_that_of_coco():
    coco = pytest.importorskip("pycocotools.mask", reason="pip install pycocotools")
    for mask in masks():
        if mask.size == 0:
            continue
        rle = encode_rle(mask)
        theirs = coco.encode(np.asfortranarray(mask, np.uint8))
        assert rle == {"size": list(theirs["size"]), "counts": theirs["counts"].decode()}
        assert np.array_equal(coco.decode(rle), mask)
        assert coco.area(rle) == mask.sum()


def test_a_known_text():
    assert encode_rle(np.array([[0, 1], [1, 1]], bool)) == {"size": [2, 2], "counts": "13"}


@pytest.mark.parametrize("counts", ["13", "1", "1\t", "\x7f"])
def test_broken_texts_are_refused(counts):
    with pytest.raises(e3d.InvalidArgumentError):
        decode_rle({"size": [3, 3], "counts": counts})


def test_what_is_no_mask_is_refused():
    for wrong in (np.zeros(4, bool), np.zeros((2, 2)), "mask"):
        with pytest.raises(e3d.InvalidArgumentError, match="bool"):
            encode_rle(wrong)
