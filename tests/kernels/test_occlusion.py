"""Ambient occlusion of pictures of depths: every backend and number of threads as the reference."""

import numpy as np
import pytest

from engine3d._native import rasterizer

COVERS = ("nearness", "occlusion", "occlusion_across", "occlusion_down")
BACKENDS = [name for name, k in rasterizer.BACKENDS.items() if rasterizer.backend_available(k)]
ACROSS, DOWN = (0.011, -0.6), (-0.009, 0.4)


def visibility(depth, backend, threads=1, radius=0.5, perspective=True, across=ACROSS, down=DOWN):
    arrays = [np.full(depth.shape, 7.0, np.float32) for _ in range(2)]
    number = rasterizer.BACKENDS[backend]
    rasterizer.find_occlusion(depth, across, down, perspective, radius, number, threads, *arrays)
    return arrays[1]


def pictures():
    """Depths of all kinds: smooth, noisy, with holes, huge and tiny; sizes that fill no vector."""
    random = np.random.default_rng(8)
    for k, (height, width) in enumerate([(1, 1), (3, 2), (37, 53), (70, 131), (64, 64), (9, 300)]):
        y, x = np.mgrid[0:height, 0:width].astype(np.float32)
        depth = 3.0 + np.sin(x * 0.2) * np.cos(y * 0.1)
        if k % 2:
            depth += random.random((height, width)) * 0.3
        depth[random.random((height, width)) < 0.1] = 0.0
        yield np.ascontiguousarray(depth, np.float32)
    hostile = [1e-38, 1e-20, 3e38, 1e20, -1.0, 5.0, 0.0]
    yield random.choice(hostile, (40, 77)).astype(np.float32)


@pytest.mark.parametrize("perspective", [True, False])
@pytest.mark.parametrize("backend", BACKENDS)
def test_every_backend_finds_what_the_reference_finds(backend, perspective):
    for depth in pictures():
        for radius in (1e-6, 0.3, 40.0):
            for across, down in ((ACROSS, DOWN), ((-0.02, 1.0), (0.01, -0.2))):
                given = {"radius": radius, "perspective": perspective}
                given |= {"across": across, "down": down}
                expected = visibility(depth, "scalar", **given)
                assert not np.isnan(expected).any()
                assert (expected >= 0).all() and (expected <= 1).all()
                for threads in (1, 2, 5):
                    found = visibility(depth, backend, threads, **given)
                    assert found.tobytes() == expected.tobytes()


@pytest.mark.parametrize("perspective", [True, False])
def test_nothing_is_in_the_way_where_nothing_shows(perspective):
    depth = np.zeros((20, 30), np.float32)
    assert (visibility(depth, "portable", perspective=perspective) == 1.0).all()
    depth[10, 15] = 2.0
    assert (visibility(depth, "portable", perspective=perspective) == 1.0).all()


def test_what_cannot_be_is_refused():
    depth = np.ones((4, 5), np.float32)
    for wrong in ({"radius": 0.0}, {"radius": np.nan}, {"across": (0.0, 1.0)}):
        with pytest.raises(ValueError, match="invalid"):
            visibility(depth, "portable", **wrong)
    with pytest.raises(ValueError, match="depth must be"):
        rasterizer.find_occlusion(
            depth, ACROSS, DOWN, True, 1.0, 1, 1, np.ones((5, 4), np.float32), depth.copy()
        )
