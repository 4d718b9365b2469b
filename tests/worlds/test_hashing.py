"""The integer hash against its definition, written out with Python's integers."""

import numpy as np

from engine3d.extras.worlds.hashing import hash_words, unit_floats


def mix(x):
    x = (x ^ x >> 16) * 0x7FEB352D % 2**32
    x = (x ^ x >> 15) * 0x846CA68B % 2**32
    return x ^ x >> 16


def expected(seed, *words):
    state = mix(seed % 2**32)
    for word in words:
        state = mix(state ^ word * 0x9E3779B9 % 2**32)
    return state


def test_words():
    for seed in (0, 1, -5, 2**40 + 3):
        for words in ((), (0,), (1, -1), (-(2**31), 7, 123456789), (5, 4, 3, 2)):
            assert hash_words(seed, *words).tolist() == [expected(seed, *words)]


def test_words_broadcast():
    rows, columns = np.arange(-2, 2)[:, np.newaxis], np.arange(3)
    table = hash_words(9, rows, columns)
    assert table.dtype == np.uint32
    assert table.tolist() == [[expected(9, r, c) for c in range(3)] for r in range(-2, 2)]


def test_floats_are_the_upper_bits():
    assert unit_floats(1, 2, 3).tolist() == [(expected(1, 2, 3) >> 8) / 2**24]
    many = unit_floats(0, np.arange(10000))
    assert many.min() >= 0.0 and many.max() < 1.0
    assert abs(many.mean() - 0.5) < 0.01
