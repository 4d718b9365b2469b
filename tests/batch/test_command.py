"""``engine3d batch``: what it prints, how it ends, and what it leaves when it is stopped."""

import subprocess
import sys
import time

import pytest
from missing_here import STOPPABLE, STOPPED, stop
from patience import HUNG

from engine3d.apps.batch.processes import ProcessPool
from engine3d.apps.cli import main
from engine3d.batch import read_manifest, run

MODEL = {"model": "model.obj"}
SCRIPT = {"script": "script.py"}


def batch(manifest, out, *options):
    return main(["batch", str(manifest), "-o", str(out), *options])


def test_counts_and_the_hash_are_printed(manifest, place, capsys):
    path = manifest({**SCRIPT, "matrix": {"seed": {"count": 3}}})
    assert batch(path, place / "out", "--jobs", "1") == 0
    said = capsys.readouterr()
    expected = run(read_manifest(path).tasks, place / "other", jobs=1).hash
    assert said.out == f"3 drawn, 0 done before, 0 failed; SHA256SUMS {expected}\n"
    assert said.err == ""
    assert batch(path, place / "out", "--jobs", "1", "--resume") == 0
    assert capsys.readouterr().out.startswith("0 drawn, 3 done before, 0 failed;")


def test_failures_are_listed_at_the_end(manifest, place, capsys):
    failing = {**SCRIPT, "function": "fail", "matrix": {"seed": {"count": 22}}}
    path = manifest(failing, {**MODEL, "name": "fine"})
    assert batch(path, place / "out", "--jobs", "1", "--threads", "1") == 1
    said = capsys.readouterr()
    lines = said.err.splitlines()
    assert len(lines) == 21
    assert lines[0].startswith("engine3d: error: script_0: ") and "no such thing" in lines[0]
    assert lines[-1] == "engine3d: error: and 2 more"
    assert said.out.startswith("1 drawn, 0 done before, 22 failed;")


def test_a_terminal_gets_a_bar(manifest, place, capsys, monkeypatch):
    monkeypatch.setattr("engine3d.apps.cli.quietness.shows_progress", lambda: True)
    monkeypatch.setenv("FORCE_COLOR", "1")
    path = manifest(
        MODEL, {**SCRIPT, "function": "say"}, {**SCRIPT, "function": "fail", "name": "f"}
    )
    assert batch(path, place / "out", "--jobs", "1") == 1
    said = capsys.readouterr()
    assert "drawing, 1 failed" in said.err and "3/3" in said.err
    assert said.out.startswith("2 drawn, 0 done before, 1 failed;") and said.out.count("\n") == 1


def test_what_scripts_print_is_not_in_the_way(manifest, place, capfd):
    path = manifest({**SCRIPT, "function": "say", "matrix": {"seed": {"count": 2}}})
    with ProcessPool(1) as pool:
        assert run(read_manifest(path).tasks, place / "out", executor=pool).drawn == 2
    said = capfd.readouterr()
    assert said.out == "" and said.err.count("a script prints this") == 2


def test_warnings_of_models_are_told_once(manifest, place, capsys):
    (place / "model.obj").write_text("mtllib none.mtl\nv -1 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n")
    cameras = {"camera": [{"azimuth_degrees": 0}, {"azimuth_degrees": 9}]}
    assert batch(manifest({**MODEL, "matrix": cameras}), place / "out", "--jobs", "1") == 0
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 1 and "none.mtl" in lines[0]


@pytest.mark.parametrize(
    ("options", "status", "message"),
    [
        (["--jobs", "0"], 2, "'0' is not a whole number of at least 1"),
        (["--jobs", "2", "--scheduler", "tcp://127.0.0.1:1"], 2, "not allowed with argument"),
        (["--backend", "cuda"], 2, "is not one of auto, scalar"),
    ],
)
def test_wrong_usage(manifest, place, capsys, options, status, message):
    assert batch(manifest(MODEL), place / "out", *options) == status
    assert message in capsys.readouterr().err


def test_a_broken_manifest_is_one_line(manifest, place, capsys):
    assert batch(manifest({**MODEL, "seed": "x"}), place / "out") == 1
    said = capsys.readouterr().err
    assert said.startswith(f"engine3d: error: {place / 'manifest.json'}: tasks[0].seed: seed must")
    assert said.count("\n") == 1 and not (place / "out").exists()


def ended(path, place, end, count):
    """Start a batch, end it when some pictures are there; return its status and what it said."""
    command = [sys.executable, "-m", "engine3d", "batch", str(path), "-o", str(place / "out")]
    started = subprocess.Popen([*command, "--jobs", "2"], stdout=-1, stderr=-1, **STOPPABLE)
    deadline = time.monotonic() + HUNG
    while len(list((place / "out").glob("*.png"))) < count:
        assert time.monotonic() < deadline and started.poll() is None
        time.sleep(0.002)
    end(started)
    _, said = started.communicate(timeout=HUNG)
    return started.returncode, said.decode()


@pytest.mark.parametrize(
    "end, status",
    [(stop, STOPPED), (subprocess.Popen.kill, 1 if sys.platform == "win32" else -9)],
    ids=["stopped", "killed"],
)
def test_a_batch_that_was_ended_goes_on_where_it_was(manifest, place, end, status):
    path = manifest({**SCRIPT, "size": [400, 300], "matrix": {"seed": {"count": 30}}})
    out, tasks = place / "out", read_manifest(path).tasks
    was, said = ended(path, place, end, 3)
    assert was == status
    assert end is not stop or (not list(out.rglob("*.part")) and "--resume" in said)
    there = len(list(out.glob("*.png")))
    assert 3 <= there < 20
    # Processes of a batch that was killed end by themselves, at once.
    summary = run(tasks, out, jobs=1, resume=True)
    assert summary.done_before >= there and summary.drawn + summary.done_before == 30
    assert not list(out.rglob("*.part"))
    assert summary.hash == run(tasks, place / "serial", jobs=1).hash
