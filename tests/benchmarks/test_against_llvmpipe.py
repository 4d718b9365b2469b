"""The engine beside a peer, and the chart of it: both draw the same; speed is not tested."""

import importlib
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from patience import HUNG
from PIL import Image

from engine3d.apps.bench import measuring
from engine3d.apps.scenes import workloads

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"


@pytest.fixture
def script(monkeypatch):
    """A module of benchmarks/ by its name."""
    monkeypatch.syspath_prepend(str(BENCHMARKS))
    return importlib.import_module


@pytest.fixture
def few(monkeypatch):
    """Fewer instances, so that tests are quick."""
    monkeypatch.setattr(workloads, "GRID_SIDE", 2)
    monkeypatch.setattr(workloads, "SPHERES_SIDE", 12)


def run(name, *arguments, **options):
    command = [sys.executable, str(BENCHMARKS / name), *arguments]
    return subprocess.run(command, capture_output=True, text=True, timeout=HUNG, **options)


def row(name="mesh", threads=1, milliseconds=2.0, **more):
    measured = {"workload": name, "backend": "avx2", "threads": threads}
    return {**measured, "milliseconds": milliseconds, **more}


def beside_peer(mean, covered=0.5):
    ours = {"covered": 0.5, "mean": [10.0, 20.0, 30.0]}
    peer = {"name": "peer 1", "milliseconds": 6.0, "picture": {"covered": covered, "mean": mean}}
    return row(picture=ours, peer=peer, times_as_fast=3.0)


class Peer:
    """Draws what engine3d draws, with one engine more."""

    name = "another engine3d"

    def __init__(self, workload, size):
        self._drawing = measuring.Drawing(workload, size, backend="portable", threads=1)
        self.draw = self._drawing.draw

    def as_output(self, picture):
        return picture


@pytest.mark.parametrize("slow", [False, True])
@pytest.mark.parametrize("name", ["textured", "grid-ids", "grid-depth"])
def test_a_peer_that_draws_the_same(name, slow, script, few, monkeypatch):
    if slow:
        monkeypatch.setattr(measuring, "SLOW", 0.0)
    against = script("against_llvmpipe")
    made = workloads.make(name, plain=True)
    measured = against.compare(made, (48, 27), Peer(made, (48, 27)), seconds=0.01)
    assert measured["picture"] == measured["peer"]["picture"] and measured["times_as_fast"] > 0
    assert measured["frames"] >= (1 if slow else against.ROUNDS)
    assert against.same_picture(measured)


@pytest.mark.parametrize("name", ["textured", "grid-depth", "grid-ids", "fill-back", "spheres"])
def test_llvmpipe_draws_the_same_picture(name, script, few):
    pytest.importorskip("moderngl", reason="needs moderngl")
    against, llvmpipe = script("against_llvmpipe"), script("llvmpipe")
    made = workloads.make(name, plain=True)
    try:
        peer = llvmpipe.Peer(made, (320, 180))
    except llvmpipe.Engine3DError as error:
        pytest.skip(str(error))
    measured = against.compare(made, (320, 180), peer, seconds=0.01)
    peer.close()
    assert measured["picture"]["covered"] > 0.02 and against.same_picture(measured)


def test_a_line_says_whether_the_pictures_differ(script):
    against = script("against_llvmpipe")
    same, other = beside_peer([10.9, 20.0, 30.0]), beside_peer([11.1, 20.0, 30.0])
    assert against.same_picture(same) and "differ" not in against.line(same)
    assert not against.same_picture(other) and against.line(other).endswith("the pictures differ")
    assert not against.same_picture(beside_peer([10.0, 20.0, 30.0], covered=0.503))
    assert against.line(same).split()[1:5] == ["1", "2.00", "6.00", "3.00"]
    assert against.columns().index("   covered") == against.line(same).index("   0.5")


def test_what_the_peer_needs_is_one_line(tmp_path):
    (tmp_path / "moderngl.py").write_text("raise ImportError")
    done = run("against_llvmpipe.py", env={**os.environ, "PYTHONPATH": str(tmp_path)})
    needs = "llvmpipe needs the package moderngl: pip install 'engine3d[bench]' (or moderngl)\n"
    assert (done.returncode, done.stdout, done.stderr) == (1, "", needs)


def test_a_chart_groups_bars_by_workload(script):
    bars = script("bench_chart").bars
    rows = [row(), row(threads=2, milliseconds=4.0), row("grid", milliseconds=500.0)]
    title, groups, series = bars(rows)
    assert title == "frames per second" and series == ["avx2 x1", "avx2 x2"]
    assert groups == [("mesh", [500.0, 250.0]), ("grid", [2.0, None])]
    title, groups, _ = bars([beside_peer([10.0, 20.0, 30.0])])
    assert title == "times as fast as peer 1" and groups == [("mesh", [3.0])]


@pytest.mark.parametrize("suffix", [".svg", ".png"])
def test_a_chart_of_a_file(tmp_path, suffix):
    figures, chart = tmp_path / "figures.json", tmp_path / f"chart{suffix}"
    figures.write_text(json.dumps({"rows": [row(), row("grid", milliseconds=500.0)]}))
    done = run("bench_chart.py", str(figures), str(chart))
    assert (done.returncode, done.stderr) == (0, "")
    if suffix == ".svg":
        assert chart.read_text().count("<rect") > 4 and "frames per second" in chart.read_text()
    else:
        with Image.open(chart) as image:
            assert len(set(image.convert("RGB").tobytes())) > 4
