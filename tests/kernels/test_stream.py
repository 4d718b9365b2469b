"""stream: rows of bytes arrive, and nothing around them changes, wherever they go."""

import numpy as np
import pytest
from kernels.harness import all_backends

LINE, ROWS = 64, 3


@all_backends
@pytest.mark.parametrize("pitch", [256, 272, 259])
@pytest.mark.parametrize("step", [0, 256, 301])
def test_stream(kernels, pitch, step):
    """Every place within a cache line, and sizes of whole vectors and others."""
    rng = np.random.default_rng(17)
    source = rng.integers(1, 256, ROWS * 301, np.uint8)
    room = np.zeros((ROWS + 1) * 512, np.uint8)
    room = room[-room.ctypes.data % LINE :]
    for start in range(LINE):
        for size in (1, 4, 16, 32, 48, 64, 100, 128, 256):
            room[:] = 0
            kernels.stream(room[start:], pitch, source, step, size, ROWS)
            expected = np.zeros_like(room)
            for y in range(ROWS):
                expected[start + y * pitch :][:size] = source[y * step :][:size]
            assert np.array_equal(room, expected), (start, size)
