"""``engine3d bench``: what it prints, writes and refuses; how fast anything is is not tested."""

import json

import numpy as np
import pytest

from engine3d.apps.bench import figures, measuring
from engine3d.apps.cli import main
from engine3d.apps.scenes import PLAIN_NAMES, WORKLOAD_NAMES, workloads
from engine3d.errors import InvalidArgumentError

SMALL = ("--size", "64x36", "--seconds", "0.01")


def bench(*arguments):
    return main(["bench", *SMALL, *arguments])


def row(name="mesh", backend="avx2", threads=1, milliseconds=2.0, **more):
    stages = dict.fromkeys(measuring.STAGES, 0.25)
    figures = {"triangles_per_second": 5e6, "pixels_per_second": 7e6, **stages, **more}
    measured = {"workload": name, "backend": backend, "threads": threads}
    return {**measured, "milliseconds": milliseconds, **figures}


def test_a_row_for_each_case(capsys, tmp_path):
    path = tmp_path / "figures.json"
    cases = ("--workloads", "textured,fill-back", "--backends", "portable,scalar")
    assert bench(*cases, "--threads", "1,2", "--json", str(path)) == 0
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


def test_json_alone_on_standard_output(capsys):
    assert bench("--workloads", "textured", "--json", "-") == 0
    printed = json.loads(capsys.readouterr().out)
    assert printed["size"] == [64, 36] and printed["picture"] == "default"


@pytest.mark.parametrize(
    "arguments",
    [
        ("--workloads", "teapots"),
        ("--backends", "avx1024"),
        ("--threads", "1,two"),
        ("--seconds", "0"),
        ("--against", "llvmpipe"),
        ("--plot", "chart.svg"),
    ],
)
def test_wrong_usage(arguments, capsys):
    assert bench(*arguments) == 2
    assert "Traceback" not in capsys.readouterr().err


def test_help_lists_the_workloads(capsys):
    assert main(["bench", "--help"]) == 0
    printed = capsys.readouterr().out
    assert [line.split()[0] for line in printed.splitlines()[-14:]] == list(WORKLOAD_NAMES)


@pytest.mark.parametrize("name", [n for n in WORKLOAD_NAMES if not n.startswith("city")])
def test_workloads_show_something_and_move(name):
    made = workloads.make(name)
    assert made.triangles >= 64
    drawing = measuring.Drawing(made, (64, 36))
    first = drawing.draw(0)
    _, counts = np.unique(first.reshape(64 * 36, -1), axis=0, return_counts=True)
    assert len(counts) > 4 and counts.max() < 0.8 * 64 * 36  # the background does not fill it
    _, pose = made.view(0)
    assert any((pose != made.view(frame)[1]).any() for frame in range(1, 4))


@pytest.mark.parametrize("name", sorted({*WORKLOAD_NAMES} - {*PLAIN_NAMES}))
def test_no_plain_picture_is_made_of_what_others_do_not_draw(name):
    with pytest.raises(InvalidArgumentError, match=name):
        workloads.make(name, plain=True)


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
    assert len(figures.line(row())) == len(figures.columns())
    assert figures.line(row()).split() == [
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
