"""The benchmarks run and report what they say; how fast anything is is not tested."""

import json
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"


def report(name, *arguments):
    """The JSON object that a benchmark prints."""
    command = [sys.executable, str(BENCHMARKS / name), "--json", *arguments]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_lines():
    rows = report("lines.py", "--repeats", "1")["rows"]
    assert len(rows) == 25
    for row in rows:
        assert row["dda_ns_per_line"] > 0 and row["bresenham_ns_per_line"] > 0


def test_loaders():
    rows = report(
        "loaders.py", "--megabytes", "0.02", "--repeat", "1", "--only", "engine3d", "NumPy"
    )
    rows = rows["rows"]
    assert [Path(row["file"]).suffix for row in rows] == [".obj"] * 2 + [".ply"] * 2 + [".stl"] * 2
    assert all(row["milliseconds"] > 0 for row in rows)


@pytest.mark.parametrize("suffix", ["svg", "png"])
def test_simd_vs_scalar(tmp_path, suffix):
    chart = tmp_path / f"chart.{suffix}"
    quick = ["--repeats", "1", "--resolution", "32x18", "--plot", str(chart)]
    backends = ["--backend", "scalar", "--backend", "portable"]
    rows = report("simd_vs_scalar.py", *quick, *backends)["rows"]
    assert len(rows) > 15 and chart.stat().st_size > 1000
    for row in rows:
        assert all(taken > 0 for taken in row["time"].values())
        assert row["over"]["portable"]["portable"] == 1


@pytest.mark.skipif(shutil.which("cc") is None, reason="needs a C compiler")
def test_compiler_flags():
    pytest.importorskip("setuptools")
    arguments = ["--backend", "portable", "--level", "O0", "--compiler", "cc"]
    rows = report("compiler_flags.py", *arguments)["rows"]
    assert [row["flags"] for row in rows][:2] == ["-O0", "-O3 -march=native"]
    assert rows[1]["same_bytes"]
    assert all(nanoseconds > 0 for row in rows for nanoseconds in row["nanoseconds"].values())


def test_profile():
    small = ["--frames", "1", "--resolution", "64x36", "--functions", "none"]
    rows = report("profile.py", *small, "--workload", "lights", "--workload", "texture")["stages"]
    assert [row["workload"] for row in rows] == ["lights", "texture"]
    for row in rows:
        assert abs(sum(row["milliseconds"].values()) - row["wall"]) < 0.5 * row["wall"]
        assert row["pixels_shaded"] > 0


def test_overhead():
    figures = report("overhead.py", "--calls", "2", "--starts", "1")
    assert len(figures["calls"]) == 9 and len(figures["starts"]) == 5
    assert all(row["microseconds"] > row["core_microseconds"] > 0 for row in figures["calls"])
    assert all(row["milliseconds"] > 0 for row in figures["starts"])


def test_lights(tmp_path):
    chart = tmp_path / "lights.svg"
    small = ["--triangles", "50000", "--most", "4", "--frames", "1", "--resolution", "64x36"]
    rows = report("lights.py", *small, "--plot", str(chart))["rows"]
    assert [row["lights"] for row in rows] == [1, 2, 4] and chart.stat().st_size > 1000
    assert all(row["same_bytes"] and row["forward"] > 0 and row["deferred"] > 0 for row in rows)


def test_worlds():
    small = ["--side", "4", "--triangles", "30000", "--largest", "100000", "--frames", "1"]
    rows = report("worlds.py", *small, "--resolution", "64x36")["rows"]
    assert len(rows) == 7 + 3 + 2 + 1
    assert all(row["cpu_milliseconds"] > 0 for row in rows)
    for word in ("64 spheres", "OBJ", "256 lights, street", "the same street"):
        assert any(word in row["what"] for row in rows)


def test_scene_graph():
    rows = report("scene_graph.py", "--side", "4", "--rounds", "2")["rows"]
    assert len(rows) == 7
    assert all(row["milliseconds"] >= 0 for row in rows)
