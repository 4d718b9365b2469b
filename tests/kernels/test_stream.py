"""stream: bytes arrive, and nothing around them changes, wherever they go."""

import numpy as np
from kernels.harness import all_backends

LINE = 64


@all_backends
def test_stream(kernels):
    """Every place within a cache line, and sizes of whole vectors and others."""
    rng = np.random.default_rng(17)
    room = np.zeros(8 * LINE, np.uint8)
    aligned = room[-room.ctypes.data % LINE :][: 6 * LINE]
    source = rng.integers(1, 256, 5 * LINE, np.uint8)
    for start in range(LINE):
        for size in (1, 4, 16, 32, 48, 64, 100, 128, 256):
            aligned[:] = 0
            kernels.stream(aligned[start : start + size], source[3 : 3 + size])
            assert np.array_equal(aligned[start : start + size], source[3 : 3 + size])
            assert not aligned[:start].any() and not aligned[start + size :].any(), (start, size)
