"""``engine3d bench``: what it prints, writes and refuses; how fast anything is is not tested."""

import json
import sys

import numpy as np
import pytest
from PIL import Image

from engine3d.benchmarking import llvmpipe, measuring, names, report, workloads
from engine3d.cli import main

SMALL = ("--resolution", "64x36", "--seconds", "0.01")


@pytest.fixture
def few(monkeypatch):
    """Fewer instances, so that tests are quick."""
    monkeypatch.setattr(workloads, "GRID_SIDE", 2)
    monkeypatch.setattr(workloads, "SPHERES_SIDE", 12)


def bench(*arguments):
    return main(["bench", *SMALL, *arguments])


def row(name="mesh", backend="avx2", threads=1, milliseconds=2.0, **more):
    stages = dict.fromkeys(measuring.STAGES, 0.25)
    figures = {"triangles_per_second": 5e6, "pixels_per_second": 7e6, **stages, **more}
    measured = {"workload": name, "backend": backend, "threads": threads}
    return {**measured, "milliseconds": milliseconds, **figures}


def beside_peer(mean, covered=0.5, **more):
    ours = {"covered": 0.5, "mean": [10.0, 20.0, 30.0]}
    peer = {"name": "peer 1", "milliseconds": 6.0, "picture": {"covered": covered, "mean": mean}}
    return row(picture=ours, peer=peer, times_as_fast=3.0, **more)


def test_a_row_for_each_case(capsys, tmp_path):
    path, chart = tmp_path / "figures.json", tmp_path / "chart.png"
    files = ("--json", str(path), "--plot", str(chart))
    cases = ("--workloads", "textured,fill-back", "--backends", "portable,scalar")
    assert bench(*cases, "--threads", "1,2", *files) == 0
    rows = json.loads(path.read_text())["rows"]
    assert len(rows) == 2 * 2 * 2
    assert {one["workload"] for one in rows} == {"textured", "fill-back"}
    assert {(one["backend"], one["threads"]) for one in rows} >= {("portable", 1), ("portable", 2)}
    for one in rows:
        assert one["frames"] >= measuring.LEAST and one["milliseconds"] >= one["ms_total"] > 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[:2] for line in lines[-8:]] == [
        [one["workload"], one["backend"]] for one in rows
    ]
    with Image.open(chart) as image:
        assert len(set(image.convert("RGB").tobytes())) > 4


def test_json_alone_on_standard_output(capsys):
    assert bench("--workloads", "textured", "--json", "-") == 0
    printed = json.loads(capsys.readouterr().out)
    assert printed["resolution"] == [64, 36] and printed["picture"] == "default"


@pytest.mark.parametrize(
    "arguments",
    [
        ("--workloads", "teapots"),
        ("--backends", "avx1024"),
        ("--threads", "1,two"),
        ("--seconds", "0"),
        ("--against", "softpipe"),
        ("--plot", "chart.txt"),
    ],
)
def test_wrong_usage(arguments, capsys):
    assert bench(*arguments) == 2
    assert "Traceback" not in capsys.readouterr().err


def test_help_lists_the_workloads(capsys):
    assert main(["bench", "--help"]) == 0
    printed = capsys.readouterr().out
    assert [line.split()[0] for line in printed.splitlines()[-12:]] == list(names.WORKLOADS)


def test_what_the_peer_needs_is_one_line(monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "moderngl", None)
    assert bench("--against", "llvmpipe") == 1
    printed = capsys.readouterr()
    assert printed.err == f"engine3d: error: {llvmpipe.NEEDS_MODERNGL}\n" and not printed.out


@pytest.mark.parametrize("name", [n for n in names.WORKLOADS if not n.startswith("city")])
def test_workloads_show_something_and_move(name):
    made = workloads.make(name)
    assert made.triangles >= 64
    drawing = measuring.Drawing(made, (64, 36))
    first = drawing.draw(0)
    described = measuring.describe(first, made)
    assert 0.2 < described["covered"] <= 1.0
    _, pose = made.view(0)
    assert any((pose != made.view(frame)[1]).any() for frame in range(1, 4))


def test_numbers_of_triangles_are_those_that_are_told():
    assert workloads.make("mesh").triangles == 70_200
    assert workloads.make("grid").triangles == 144 * 70_200
    assert len(workloads.make("spheres").scene.nodes[-1].object) == 39_304


def test_layers_hide_each_other_in_both_orders():
    front, back = (
        measuring.Drawing(workloads.make(name), (32, 18)).draw(0)
        for name in ("fill-front", "fill-back")
    )
    assert np.array_equal(front, back)


def test_table():
    assert len(report.line(row())) == len(report.columns(False))
    assert report.line(row()).split() == [
        "mesh",
        "avx2",
        "1",
        "2.00",
        "0.25",
        "0.25",
        "0.25",
        "0.25",
        "5.00",
        "7.0",
    ]
    same, other = beside_peer([10.9, 20.0, 30.0]), beside_peer([11.1, 20.0, 30.0])
    assert report.same_picture(same) and "differ" not in report.line(same)
    assert not report.same_picture(other) and report.line(other).endswith("the pictures differ")
    assert not report.same_picture(beside_peer([10.0, 20.0, 30.0], covered=0.503))
    assert report.line(same).split()[3:6] == ["2.00", "6.00", "3.00"]


def test_chart_groups_bars_by_workload():
    rows = [row(), row(threads=2, milliseconds=4.0), row("grid", milliseconds=500.0)]
    title, bars, series = report.chart(rows)
    assert title == "frames per second" and series == ["avx2 x1", "avx2 x2"]
    assert bars == [("mesh", [500.0, 250.0]), ("grid", [2.0, None])]
    title, bars, _ = report.chart([beside_peer([10.0, 20.0, 30.0])])
    assert title == "times as fast as peer 1" and bars == [("mesh", [3.0])]


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
def test_a_peer_that_draws_the_same(name, slow, few, monkeypatch):
    if slow:
        monkeypatch.setattr(measuring, "SLOW", 0.0)
    made = workloads.make(name, plain=True)
    measured = measuring.compare(made, (48, 27), Peer(made, (48, 27)), seconds=0.01)
    assert measured["picture"] == measured["peer"]["picture"] and measured["times_as_fast"] > 0
    assert measured["frames"] >= (1 if slow else measuring.ROUNDS)
    assert report.same_picture(measured)


@pytest.mark.parametrize("name", ["textured", "grid-depth", "grid-ids", "fill-back", "spheres"])
def test_llvmpipe_draws_the_same_picture(name, few):
    pytest.importorskip("moderngl", reason="needs moderngl")
    made = workloads.make(name, plain=True)
    try:
        peer = llvmpipe.Peer(made, (320, 180))
    except llvmpipe.Engine3DError as error:
        pytest.skip(str(error))
    measured = measuring.compare(made, (320, 180), peer, seconds=0.01)
    peer.close()
    assert measured["picture"]["covered"] == pytest.approx(
        measured["peer"]["picture"]["covered"], abs=2e-3
    )
    assert measured["picture"]["mean"] == pytest.approx(measured["peer"]["picture"]["mean"], abs=1)
