"""Pictures that take too long: their processes are ended, all others are drawn."""

import os
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor

import pytest
from missing_here import is_running
from patience import HUNG

from engine3d.apps.batch.processes import ProcessPool, TimeLimitError, WorkerDiedError
from engine3d.apps.cli import main
from engine3d.batch import read_manifest, run

SCRIPT = {"script": "script.py"}
LIMIT = 20.0 if os.name == "nt" else 5.0  # a busy machine loads the engine in less


def test_a_call_that_takes_too_long_ends_its_process_alone():
    with ProcessPool(1, limit=2.0) as pool:
        assert pool.submit(abs, -3).result() == 3
        (first,) = pool.process_ids()
        with pytest.raises(TimeLimitError, match="it took more than 2 s, and was ended"):
            pool.submit(time.sleep, 1000).result()
        assert pool.submit(abs, -4).result() == 4
        assert pool.process_ids() != [first]
        with pytest.raises(WorkerDiedError):
            pool.submit(os._exit, 3).result()


def test_a_process_that_nobody_asks_ends():
    with ProcessPool(1, idle=0.1) as pool:
        assert pool.submit(abs, -3).result() == 3
        (first,) = pool.process_ids()
        deadline = time.monotonic() + HUNG
        while is_running(first):
            assert time.monotonic() < deadline
            time.sleep(0.02)
        assert pool.submit(abs, -4).result() == 4


def test_a_process_whose_pool_is_gone_before_it_begins_ends_without_a_word():
    program = "from engine3d.apps.batch.worker import main; main()"
    command = [sys.executable, "-c", program]
    ended = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, timeout=HUNG)
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, b"", b"")


@pytest.mark.parametrize("by_threads", [False, True])
def test_a_slow_picture_fails_and_is_tried_again_by_resume(place, manifest, by_threads):
    entries = [{**SCRIPT, "name": f"t{n}", "seed": n} for n in range(4)]
    path = manifest(entries[0], {**entries[1], "function": "sleep"}, *entries[2:])
    tasks, out = read_manifest(path).tasks, place / "out"
    with ThreadPoolExecutor(1) as executor:
        who = {"executor": executor} if by_threads else {"jobs": 1}
        summary = run(tasks, out, timeout=LIMIT, **who)
    assert [failure.name for failure in summary.failures] == ["t1"]
    assert summary.failures[0].error == f"it took more than {LIMIT:g} s, and was ended"
    assert summary.drawn == 3 and not list(out.rglob("*.part"))
    (other,) = place.glob("other*")
    assert not is_running(int(other.name.removeprefix("other")))
    whole = read_manifest(manifest(*entries)).tasks
    again = run(whole, out, jobs=1, resume=True)
    assert (again.drawn, again.done_before) == (1, 3)
    assert again.hash == run(whole, place / "serial", jobs=1).hash


def test_the_command_has_limits(place, manifest, capsys):
    assert main(["batch", str(manifest(SCRIPT)), "-o", str(place / "out"), "--timeout", "60"]) == 0
    assert main(["batch", "m.json", "-o", "out", "--timeout", "0"]) == 2
    assert "'0' is not above zero" in capsys.readouterr().err
