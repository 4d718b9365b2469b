"""The benchmarks run and report what they say; how fast anything is is not tested."""

import importlib.util
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from patience import HUNG

import engine3d as e3d

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"


# Runs scripts as where nothing but `pip install .` was run: without what only developers have.
PLAINLY = """
import os, runpy, sys
for name in ("pytest", "setuptools", "Cython", "engine3d._native.kernels_testing"):
    sys.modules[name] = None
script, *sys.argv[1:] = sys.argv[1:]
sys.path[0] = os.path.dirname(script)
sys.argv[0] = script
runpy.run_path(script, run_name="__main__")
"""


def skip_where_processes_tell_nothing():
    """Most benchmarks read what Linux tells of processes, by clocks that Windows lacks."""
    if os.name == "nt":
        pytest.skip("it measures processes as Linux tells of them")


def report(name, *arguments, plainly=False, **environment):
    """The JSON object that a benchmark prints, with variables of the environment set."""
    if name != "simd_vs_scalar.py":
        skip_where_processes_tell_nothing()
    start = ["-c", PLAINLY] if plainly else []
    command = [sys.executable, *start, str(BENCHMARKS / name), "--json", *arguments]
    environment = {**os.environ, **environment}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=HUNG)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_scripts_load_after_a_plain_installation():
    """Each with what it imports of the others, and of the tests."""
    skip_where_processes_tell_nothing()
    texts = {path: path.read_text("utf-8") for path in sorted(BENCHMARKS.glob("*.py"))}
    scripts = [str(path) for path, text in texts.items() if '__name__ == "__main__"' in text]
    for package, script in (("imgui_bundle", "user_interface.py"), ("OCP", "line_drawings.py")):
        if importlib.util.find_spec(package) is None:
            scripts.remove(str(BENCHMARKS / script))
    assert len(scripts) > 15
    each = PLAINLY.partition("script, *")[0] + "for script in sys.argv[1:]:\n"
    for line in (
        'sys.argv, sys.path[0] = [script, "--help"], os.path.dirname(script)',
        "try: runpy.run_path(script, run_name='__main__')",
        "except SystemExit as end: assert not end.code, script",
    ):
        each += f"    {line}\n"
    done = subprocess.run([sys.executable, "-c", each, *scripts], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert done.stdout.count("usage: ") == len(scripts)


def test_progress_is_told_where_it_takes_long(monkeypatch, capsys):
    monkeypatch.syspath_prepend(str(BENCHMARKS))
    progress = importlib.import_module("progress")
    clock = iter(range(0, 1000, 2))
    monkeypatch.setattr(progress.time, "monotonic", lambda: next(clock))
    assert list(progress.tracked("abcdefg", 7, "drawing")) == list("abcdefg")
    told = capsys.readouterr()
    assert told.out == ""
    assert told.err.splitlines() == ["drawing: 3 of 7, 6 s", "drawing: 6 of 7, 12 s"]
    assert list(progress.tracked("ab", 2, "drawing")) == ["a", "b"]
    assert capsys.readouterr().err == ""
    assert list(progress.tracked("abcd", None, "drawing")) == list("abcd")
    assert capsys.readouterr().err == "drawing: 3 done, 6 s\n"


def test_lines():
    rows = report("lines.py", "--repeats", "1")["rows"]
    assert len(rows) == 25
    for row in rows:
        assert row["dda_ns_per_line"] > 0 and row["bresenham_ns_per_line"] > 0


def test_line_drawings():
    pytest.importorskip("OCP", exc_type=ImportError)
    rows = report("line_drawings.py", "--repeats", "1", "--part", "bracket")["rows"]
    assert [row["part"] for row in rows] == ["bracket"] * 4
    times = ("exact_ms", "update_ms", "extract_ms", "first_ms", "view_ms")
    assert all(row[name] > 0 for row in rows for name in times)


def test_batches():
    rows = report("batches.py", "--pictures", "2", "--rounds", "1", "--without-dask")["rows"]
    assert [row["way"] for row in rows] == ["loop", "processes"]
    assert all(row["ms_per_picture"] > 0 for row in rows)


def test_shadows():
    rows = report("shadows.py", "--repeats", "1")["rows"]
    assert {(row["scene"], row["light"]) for row in rows} == {
        (scene, light) for scene in ("ball", "fence") for light in ("sun", "spot")
    }
    assert all(value > 0 for row in rows for value in row["milliseconds"].values())


def test_user_interface():
    pytest.importorskip(
        "imgui_bundle", reason="it is an extra: pip install -e .[editor]", exc_type=ImportError
    )
    rows = report("user_interface.py", "--repeats", "1")["rows"]
    assert [row["backend"] for row in rows] == e3d.backends()
    assert all(row["triangles"] > 5000 and row["milliseconds"] > 0 for row in rows)


def test_loaders():
    rows = report(
        "loaders.py", "--megabytes", "0.02", "--repeat", "1", "--only", "engine3d", "NumPy"
    )
    rows = rows["rows"]
    suffixes = [Path(row["file"]).suffix for row in rows]
    assert suffixes == [".obj"] * 2 + [".ply"] * 3 + [".stl"] * 3 + [".off", ".asc"]
    assert all(row["milliseconds"] > 0 for row in rows)


@pytest.mark.parametrize("plainly", [True, False])
def test_simd_vs_scalar(tmp_path, plainly):
    if not plainly:
        pytest.importorskip("engine3d._native.kernels_testing", reason="it is built in place only")
    chart = tmp_path / "chart.svg"
    quick = ["--repeats", "1", "--size", "32x18", "--plot", str(chart)]
    backends = ["--backend", "scalar", "--backend", "portable"]
    rows = report("simd_vs_scalar.py", *quick, *backends, plainly=plainly)["rows"]
    assert len(rows) == (7 if plainly else 20) and chart.stat().st_size > 1000
    for row in rows:
        assert all(taken > 0 for taken in row["time"].values())
        assert row["over"]["portable"]["portable"] == 1


@pytest.mark.slow
@pytest.mark.experiment
@pytest.mark.skipif(shutil.which("cc") is None, reason="needs a C compiler")
def test_compiler_flags():
    """Every instruction set has the bytes of plain C, which only fused operations change."""
    vectors = [name for name in ("sse41", "avx2", "neon") if name in e3d.backends()]
    chosen = [word for name in ("portable", *vectors) for word in ("--backend", name)]
    rows = report("compiler_flags.py", *chosen, "--level", "O0", "--compiler", "cc", plainly=True)[
        "rows"
    ]
    fused = "... and fused a*b + c"
    flags = ["-O0", "-O3 -march=native", *["-O0"] * len(vectors), fused]
    assert [row["flags"] for row in rows] == flags
    assert all(row["same_bytes"] for row in rows if row["flags"] != fused)
    assert all(row["frames_a_second"] > 0 for row in rows)
    assert all(nanoseconds > 0 for row in rows for nanoseconds in row["nanoseconds"].values())


def test_profile():
    small = ["--frames", "1", "--size", "64x36", "--functions", "none"]
    rows = report("profile.py", *small, "--workload", "lights", "--workload", "texture")["stages"]
    assert [row["workload"] for row in rows] == ["lights", "texture"]
    for row in rows:
        assert abs(sum(row["milliseconds"].values()) - row["wall"]) < 0.5 * row["wall"]
        assert row["pixels_shaded"] > 0


@pytest.mark.slow
@pytest.mark.experiment
@pytest.mark.skipif(shutil.which("gprof") is None, reason="needs gprof")
def test_profile_by_gprof():
    """Of a build for a debugger, which is compiled in a third of the time."""
    small = ["--frames", "1", "--size", "64x36", "--workload", "lights", "--scenes", "40"]
    gprof = ["--functions", "gprof"]
    functions = report("profile.py", *small, *gprof, plainly=True, ENGINE3D_BUILD="debug")
    functions = functions["functions"]
    (found,) = functions.values()
    assert len(found) > 3 and 0 < sum(percent for percent, _ in found) < 100.5


def test_busy():
    quick = ["--workload", "textured", "--busy", "1", "--rounds", "1", "--seconds", "0.1"]
    (row,) = report("busy.py", *quick, "--threads", "2")["rows"]
    assert row["times_as_fast"] == row["one_milliseconds"] / row["several_milliseconds"] > 0


def test_overhead():
    figures = report("overhead.py", "--calls", "2", "--starts", "1")
    assert len(figures["calls"]) == 9 and len(figures["starts"]) == 5
    assert all(row["microseconds"] > row["core_microseconds"] > 0 for row in figures["calls"])
    assert all(row["milliseconds"] > 0 for row in figures["starts"])


def test_small_frames():
    figures = report("small_frames.py", "--frames", "2", "--scenes", "2")
    assert [row["size"] for row in figures["rows"]] == [84, 128, 256]
    assert all(row["none"] > 0 and row["map"] > 0 for row in figures["rows"])
    assert all(value > 0 for value in figures["scenes"].values())


def test_lights(tmp_path):
    chart = tmp_path / "lights.svg"
    small = ["--triangles", "50000", "--most", "4", "--frames", "1", "--size", "64x36"]
    rows = report("lights.py", *small, "--plot", str(chart))["rows"]
    assert [row["lights"] for row in rows] == [1, 2, 4] and chart.stat().st_size > 1000
    assert all(row["same_bytes"] and row["forward"] > 0 and row["deferred"] > 0 for row in rows)


def test_worlds():
    small = ["--side", "4", "--triangles", "30000", "--largest", "100000", "--frames", "1"]
    rows = report("worlds.py", *small, "--size", "64x36")["rows"]
    assert len(rows) == 12 + 4 + 2 + 1
    assert all(row.get("cpu_milliseconds", 1) > 0 for row in rows)
    assert sum("aim" in row and "reached" in row for row in rows) == 9
    for word in ("64 spheres", "OBJ", "256 lights, street", "the same street"):
        assert any(word in row["what"] for row in rows)


def test_scene_graph():
    rows = report("scene_graph.py", "--side", "4", "--rounds", "2")["rows"]
    assert len(rows) == 11
    assert all(row["milliseconds"] >= 0 for row in rows)


@pytest.fixture
def compare(monkeypatch):
    """The module benchmarks/compare.py."""
    monkeypatch.syspath_prepend(str(BENCHMARKS))
    return importlib.import_module("compare")


def measured(ratio, spread=0.01):
    return {"ratio": ratio, "spread": spread}


@pytest.mark.parametrize(
    ("now", "expected"),
    [(2.0, ""), (1.81, ""), (1.79, "slower"), (2.19, ""), (2.21, "faster")],
)
def test_a_ratio_is_lost_beyond_its_margin_only(compare, now, expected):
    assert compare.verdict({"ratio": 2.0, "margin": 0.1}, measured(now)) == expected


def test_ratios_without_a_partner_are_no_regression(compare):
    rows = compare.compare({"a": {"ratio": 1.0, "margin": 0.1}}, {"b": measured(2.0)}, "ab")
    assert [row["verdict"] for row in rows] == ["not measured", "new"]
    assert [compare.line(row).split() for row in rows] == [
        ["a", "1.00", "10%", "not", "measured"],
        ["b", "2.00", "new"],
    ]


def test_margins_follow_the_noise_within_limits(compare):
    spreads = [0.0, 0.2, 3.0]
    margins = [compare.entry(measured(2.0, spread))["margin"] for spread in spreads]
    assert margins == [compare.LEAST_MARGIN, 0.2, compare.MOST_MARGIN]


@pytest.mark.parametrize(
    ("values", "expected"), [([1.0, 2.0], ""), ([1.0, 1.0], "slower"), ([2.0], "")]
)
def test_what_fell_is_measured_again(compare, values, expected):
    ratio = compare.RATIOS[0]
    stored = {ratio.name: {"ratio": 2.0, "margin": 0.1}}
    left = iter(values)
    rows = compare.run(
        [(ratio, True)], stored, 1.0, lambda row: None, lambda *_: measured(next(left))
    )
    assert rows[0]["verdict"] == expected and list(left) == []


def test_an_update_keeps_what_was_not_measured(compare):
    first, second = (ratio.name for ratio in compare.RATIOS[:2])
    old = {"ratios": {second: {"ratio": 3.0, "margin": 0.1}, "gone": {"ratio": 1, "margin": 1}}}
    new = compare.updated(old, {first: measured(2.0)})["ratios"]
    assert new == {
        first: {"ratio": 2.0, "margin": compare.LEAST_MARGIN},
        second: {"ratio": 3.0, "margin": 0.1},
    }


def test_a_round_is_other_over_better(compare):
    ratios = importlib.import_module("ratios")
    assert ratios.summary([2.0, 4.0, 3.0, 3.0, 3.0]) == {"ratio": 3.0, "spread": 1 / 3}
    clock = iter(range(0, 10**6, 7))

    class Sleeper:
        def __init__(self, ticks):
            self._ticks = ticks

        def draw(self, frame):
            for _ in range(self._ticks):
                next(clock)

    rounds = ratios._rounds(Sleeper(1), Sleeper(5), lambda: next(clock), 0.0)
    assert list(rounds) == [3.0] * ratios.LEAST_ROUNDS


@pytest.mark.parametrize(("stored", "status"), [(1e-6, 0), (1e6, 1)])
def test_the_exit_status_tells_of_a_regression(tmp_path, stored, status):
    skip_where_processes_tell_nothing()
    name = "textured: default picture over plain"
    baseline = tmp_path / "baseline.json"
    baseline.write_text(json.dumps({"ratios": {name: {"ratio": stored, "margin": 0.4}}}))
    arguments = ["--baseline", str(baseline), "--only", name, "--seconds", "0.01", "--json"]
    command = [sys.executable, str(BENCHMARKS / "compare.py"), *arguments]
    done = subprocess.run(command, capture_output=True, text=True, timeout=HUNG)
    assert done.returncode == status, done.stderr
    assert json.loads(done.stdout)["slower"] == [name] * status


def test_the_baseline_holds_ratios_that_exist(compare):
    stored = json.loads(compare.BASELINE.read_text())["ratios"]
    names = [ratio.name for ratio in compare.RATIOS]
    assert len(set(names)) == len(names) and stored and set(stored) <= set(names)
    assert all(entry["ratio"] > 0 and entry["margin"] < 0.5 for entry in stored.values())


def test_scaling(tmp_path, monkeypatch):
    chart = tmp_path / "scaling.svg"
    series = ["--series", "triangles", "--series", "layers"]
    small = ["--triangles", "5000", "--seconds", "0.001", "--plot", str(chart)]
    rows = report("scaling.py", *series, *small)["rows"]
    assert [row["size"] for row in rows] == [1000, 4000, 1, 2, 4, 8, 16, 32, 64]
    assert ["growth" in row for row in rows] == [False, True, False, *[True] * 6]
    assert chart.read_text().count("<line") == 1 + 6
    monkeypatch.syspath_prepend(str(BENCHMARKS))
    scaling = importlib.import_module("scaling")
    assert scaling.growth((100, 2.0), (1000, 20.0)) == 1.0
    assert scaling.growth((100, 2.0), (200, 16.0)) == 4.0


def test_steady():
    (row,) = report("steady.py", "--workload", "textured", "--frames", "3")["rows"]
    assert row["first_over_second"] == row["first_milliseconds"] / row["second_milliseconds"]
    assert row["faults_a_frame"] >= 0 and row["steady_milliseconds"] > 0


def test_a_line_chart_spans_whole_powers(monkeypatch):
    monkeypatch.syspath_prepend(str(BENCHMARKS))
    line_chart = importlib.import_module("line_chart")
    axis = line_chart._Axis([30, 4000])
    assert [value for value, _ in axis.ticks()] == [10, 100, 1000, 10000]
    assert axis.place(100) == pytest.approx(1 / 3)
    assert [value for value, _ in line_chart._Axis([3, 3]).ticks()] == [2, 4]


def test_beside_peers():
    """Only engine3d is surely there."""
    given = ("--only", "engine3d", "bpy", "--triangles", "2000", "--repeat", "1")
    rows = {row["library"]: row for row in report("beside_peers.py", *given)["rows"]}
    row = rows["engine3d"]
    assert row["version"] == e3d.__version__
    assert min(value for key, value in row.items() if key not in ("library", "version")) > 0
    assert row["first_picture_s"] > row["import_s"]


def test_occlusion_is_compared_with_rays():
    arguments = ["--scene", "cubes", "--size", "160", "90", "--pixels", "200", "--repeats", "1"]
    (row,) = report("occlusion.py", *arguments, plainly=True)["rows"]
    assert row["scene"] == "cubes" and 0.0 < row["mean"] < 0.05 and row["p95"] < 0.2
    assert min(row["without"], row["with"]) > 0.0
