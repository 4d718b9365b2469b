"""linalg and the primitives give the same bits whatever the processor offers to NumPy and libm."""

import os
import subprocess
import sys

import pytest
from patience import HUNG

PROGRAM = """
import hashlib
import numpy as np
import engine3d as e3d
from engine3d import linalg

x = np.arange(-20000, 20000) * 0.0317
m = np.cos(np.arange(1600) * 0.5).round(3).reshape(100, 4, 4) + np.eye(4)
arrays = [linalg.sin(x), linalg.cos(x), linalg.tan(x), linalg.atan2(x, x[::-1] + 0.3)]
arrays += [*linalg.unit_circle(360), linalg.inverse(m), linalg.multiply(m, m[::-1])]
arrays += [linalg.normal_matrix(m), linalg.normalize(m[..., :3]), linalg.perspective(1, 1.5, 0.1)]
arrays += [linalg.look_at((1, 2, 3), (0.1, 0.2, 0.3)), linalg.euler_to_quaternion((1, 2, 3))]
for mesh in (e3d.uv_sphere(), e3d.icosphere(), e3d.torus(), e3d.cylinder()):
    arrays += [mesh.positions, mesh.normals, mesh.uvs]
print(hashlib.sha256(b"".join(np.ascontiguousarray(a).tobytes() for a in arrays)).hexdigest())
"""
OLD_PROCESSOR = {
    "NPY_DISABLE_CPU_FEATURES": "AVX2 FMA3 AVX512F AVX512CD AVX512_SKX X86_V3 X86_V4",
    "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-FMA,-AVX2,-AVX512F",
    "OPENBLAS_CORETYPE": "Nehalem",
}


def run(environment):
    return subprocess.run(
        [sys.executable, "-W", "ignore", "-c", PROGRAM],
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        timeout=HUNG,
    )


def test_bits_do_not_depend_on_instruction_sets():
    here, old = run({}), run(OLD_PROCESSOR)
    assert here.returncode == 0, here.stderr
    if old.returncode != 0 and "NPY_DISABLE_CPU_FEATURES" in old.stderr:
        pytest.skip("this NumPy can't do without those instructions")
    assert (old.returncode, old.stdout) == (0, here.stdout), old.stderr
