"""Pictures do not depend on what NumPy, BLAS and the C library choose for a CPU.

Nor on the caller's floating-point mode. Whole processes are started with other choices, and the
hashes of twenty pictures compared with those that are drawn here.
"""

import contextlib
import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from images.picture import digests
from images.scenes import SCENES
from kernels.calls import kernels_testing
from patience import HUNG

import engine3d as e3d

PROGRAM = Path(__file__).with_name("draw_hashes.py")
PICTURES = [
    "automatic_camera",
    "broken_vertices",
    "camera_in_the_scene",
    "emissive",
    "floor_to_the_horizon",
    "headlight",
    "hierarchy",
    "hills",
    "instances_matrices",
    "instances_offsets",
    "intrinsics",
    "layers_back_to_front",
    "lines_near_and_behind",
    "many_lights",
    "mirrored_poses",
    "near_plane_cuts",
    "samples_4",
    "specular",
    "stretched_normals",
    "tiny_world",
]


def numpy_features():
    """What this NumPy would choose at run time on this CPU, and may be told not to."""
    try:
        from numpy._core import _multiarray_umath as numpy_core
    except ImportError:
        from numpy.core import _multiarray_umath as numpy_core
    found = numpy_core.__cpu_features__
    return [name for name in numpy_core.__cpu_dispatch__ if found.get(name)]


ENVIRONMENTS = {
    "older_blas": {"OPENBLAS_CORETYPE": "Nehalem"},
    "numpy_baseline": {"NPY_DISABLE_CPU_FEATURES": " ".join(numpy_features())},
    "older_libm": {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-FMA,-AVX2,-AVX2_Usable,-FMA_Usable"},
    "unchanged": {},
}


@pytest.fixture(scope="module")
def expected():
    return {name: digests(SCENES[name]().draw("scalar")) for name in PICTURES}


def draw_elsewhere(arguments, changes):
    """The hashes of PICTURES by another process."""
    command = [sys.executable, str(PROGRAM), *arguments, *PICTURES]
    done = subprocess.run(
        command, env={**os.environ, **changes}, capture_output=True, text=True, timeout=HUNG
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_twenty_pictures():
    assert len(PICTURES) == 20 and set(PICTURES) <= set(SCENES)


@pytest.mark.parametrize("name", ENVIRONMENTS)
def test_libraries(name, expected):
    changes = ENVIRONMENTS[name]
    if name == "numpy_baseline" and not changes["NPY_DISABLE_CPU_FEATURES"]:
        pytest.skip("NumPy has nothing to choose on this CPU")
    assert draw_elsewhere(["portable", "2"], changes) == expected


@pytest.mark.parametrize("backend", e3d.backends())
def test_flush_to_zero_before_the_first_frame(backend, expected):
    """Threads inherit the mode of the thread that starts them."""
    if not kernels_testing.FLUSH_DENORMALS:
        pytest.skip("the floating-point mode of this processor is not known")
    assert draw_elsewhere(["--flush", backend, "3"], {}) == expected


@contextlib.contextmanager
def float_mode(bits):
    """Another floating-point mode in this thread, which must still be on at the end."""
    before = kernels_testing.float_control()
    kernels_testing.set_float_control(before | bits)
    try:
        yield
        kept = kernels_testing.float_control() & bits
    finally:
        kernels_testing.set_float_control(before)
    assert kept == bits


@pytest.mark.parametrize("backend", e3d.backends())
@pytest.mark.parametrize("mode", ["FLUSH_DENORMALS", "ROUND_UP"])
def test_modes_of_the_caller(backend, mode):
    """Denormal and odd depths and corners, by the door that has no Python arithmetic."""
    bits = getattr(kernels_testing, mode)
    if not bits:
        pytest.skip("the floating-point mode of this processor is not known")
    rng = np.random.default_rng(0)
    clip = rng.uniform(-1.2, 1.2, (300, 4)).astype(np.float32)
    clip[:, 3] = rng.uniform(0.3, 3, 300)
    clip[:150, 2] = rng.uniform(-1e-38, 1e-38, 150)
    faces = np.arange(300, dtype=np.int32).reshape(-1, 3)
    plain = e3d.rasterization.rasterize(clip, faces, (200, 150), backend=backend, threads=3)
    with float_mode(bits):
        changed = e3d.rasterization.rasterize(clip, faces, (200, 150), backend=backend, threads=3)
    for name in ("face_id", "depth", "barycentric"):
        assert getattr(changed, name).tobytes() == getattr(plain, name).tobytes(), name
    seen = plain.depth[plain.face_id >= 0]
    assert (np.abs(seen) < 1e-38).any() and (np.abs(seen) > 0.1).any()
