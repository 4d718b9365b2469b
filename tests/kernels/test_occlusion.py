"""Ambient occlusion of pictures: every backend and number of threads as the reference."""

import numpy as np
import pytest

from engine3d._native import rasterizer

COVERS = (
    "occlusion_sites",
    "occlusion",
    "occlusion_across",
    "occlusion_down",
    "occlusion_wide_across",
    "occlusion_wide_down",
    "occlusion_spread",
)
BACKENDS = [name for name, k in rasterizer.BACKENDS.items() if rasterizer.backend_available(k)]
ACROSS, DOWN = (0.011, -0.6), (-0.009, 0.4)


def visibility(
    depth, normal, backend, threads=1, radius=0.5, perspective=True, across=ACROSS, down=DOWN
):
    height, width = depth.shape
    scratch = np.full(rasterizer.occlusion_scratch(width, height), 7.0, np.float32)
    out = np.full(depth.shape, 7.0, np.float32)
    number = rasterizer.BACKENDS[backend]
    rasterizer.find_occlusion(
        *(depth, normal, across, down, perspective, radius, number, threads, scratch, out)
    )
    return out


def facing(shape):
    """Normals towards the viewer, (height, width, 3)."""
    return np.ascontiguousarray(np.broadcast_to(np.float32((0, 0, 1)), (*shape, 3)))


def pictures():
    """Depths and normals: smooth, noisy, with holes, huge and tiny; sizes that fill no vector."""
    random = np.random.default_rng(8)
    for k, (height, width) in enumerate([(1, 1), (3, 2), (37, 53), (70, 131), (64, 64), (9, 300)]):
        y, x = np.mgrid[0:height, 0:width].astype(np.float32)
        depth = 3.0 + np.sin(x * 0.2) * np.cos(y * 0.1)
        if k % 2:
            depth += random.random((height, width)) * 0.3
        depth[random.random((height, width)) < 0.1] = 0.0
        normal = facing(depth.shape) + random.normal(0.0, 0.3, (height, width, 3))
        normal[random.random((height, width)) < 0.05] = 0.0
        yield np.ascontiguousarray(depth, np.float32), normal.astype(np.float32)
    hostile = [1e-38, 1e-20, 3e38, 1e20, -1.0, 5.0, 0.0]
    normal = random.choice(hostile, (40, 77, 3)).astype(np.float32)
    yield random.choice(hostile, (40, 77)).astype(np.float32), normal


@pytest.mark.parametrize("perspective", [True, False])
@pytest.mark.parametrize("backend", BACKENDS)
def test_every_backend_finds_what_the_reference_finds(backend, perspective):
    for depth, normal in pictures():
        for radius in (1e-6, 0.3, 40.0):
            for across, down in ((ACROSS, DOWN), ((-0.02, 1.0), (0.01, -0.2))):
                given = {"radius": radius, "perspective": perspective}
                given |= {"across": across, "down": down}
                expected = visibility(depth, normal, "scalar", **given)
                assert not np.isnan(expected).any()
                assert (expected >= 0).all() and (expected <= 1).all()
                for threads in (1, 2, 5):
                    found = visibility(depth, normal, backend, threads, **given)
                    assert found.tobytes() == expected.tobytes()


@pytest.mark.parametrize("perspective", [True, False])
def test_nothing_is_in_the_way_where_nothing_shows(perspective):
    depth = np.zeros((20, 30), np.float32)
    assert (visibility(depth, facing((20, 30)), "portable", perspective=perspective) == 1.0).all()
    depth[10, 15] = 2.0
    assert (visibility(depth, facing((20, 30)), "portable", perspective=perspective) == 1.0).all()


def test_what_has_no_normal_gets_all_light():
    depth = np.random.default_rng(3).uniform(2.0, 2.5, (20, 30)).astype(np.float32)
    assert visibility(depth, facing((20, 30)), "portable").min() < 1.0
    assert (visibility(depth, np.zeros((20, 30, 3), np.float32), "portable") == 1.0).all()


def test_what_cannot_be_is_refused():
    depth, normal = np.ones((4, 5), np.float32), facing((4, 5))
    for wrong in ({"radius": 0.0}, {"radius": np.nan}, {"across": (0.0, 1.0)}):
        with pytest.raises(ValueError, match="invalid"):
            visibility(depth, normal, "portable", **wrong)
    with pytest.raises(ValueError, match="normal must be"):
        visibility(depth, facing((5, 4)), "portable")
    few, out = np.ones(3, np.float32), depth.copy()
    with pytest.raises(ValueError, match="scratch"):
        rasterizer.find_occlusion(depth, normal, ACROSS, DOWN, True, 1.0, 1, 1, few, out)
