"""Work shared out among threads: it ends, however many threads there can be."""

import _thread
import contextvars
import threading
from pathlib import Path

import pytest

import engine3d as e3d
from engine3d.base import side_by_side as module
from engine3d.base.side_by_side import Thread, side_by_side
from engine3d.errors import OutOfMemoryError

ENGINE = Path(e3d.__file__).parent


@pytest.mark.parametrize("threads", [1, 2, 3, 8])
@pytest.mark.parametrize("count", [0, 1, 2, 50])
def test_results_are_in_the_order_of_the_items(threads, count):
    assert side_by_side(lambda one: one * one, range(count), threads) == [
        n * n for n in range(count)
    ]


def test_several_threads_work():
    meeting = threading.Barrier(3, timeout=30)
    assert sorted(side_by_side(lambda _: meeting.wait(), range(3), 3)) == [0, 1, 2]


def test_the_first_error_is_raised_and_nothing_more_is_begun():
    begun = []

    def work(one):
        begun.append(one)
        if one >= 5:
            raise ValueError(one)

    with pytest.raises(ValueError, match="5"):
        side_by_side(work, range(1000), 2)
    assert len(begun) < 1000


def test_helpers_find_the_variables_of_the_caller():
    variable = contextvars.ContextVar("variable")
    variable.set(3)
    meeting = threading.Barrier(2, timeout=30)

    def work(_):
        meeting.wait()
        return variable.get()

    assert side_by_side(work, range(2), 2) == [3, 3]


@pytest.mark.parametrize("how", ["refused", "never begins", "dies"])
def test_without_threads_the_caller_does_all(how, monkeypatch):
    def start(function, arguments):
        if how == "refused":
            raise RuntimeError("can't start new thread")
        return 0  # and nothing is run: a thread that has no memory to begin ends in silence

    monkeypatch.setattr(_thread, "start_new_thread", start)
    if how == "dies":
        monkeypatch.setattr(module._Helper, "_run", lambda self: 1 / 0)
        monkeypatch.undo()
        monkeypatch.setattr(module._Helper, "start", lambda self: None)
    assert side_by_side(lambda one: one, range(9), 4) == list(range(9))


def test_a_thread_that_does_not_begin_is_an_error(monkeypatch):
    monkeypatch.setattr(module, "PATIENCE", 0.05)
    monkeypatch.setattr(Thread, "_bootstrap", lambda self: None)
    with pytest.raises(OutOfMemoryError, match="did not begin"):
        Thread(target=print, daemon=True).start()


def test_threads_run():
    done = []
    thread = Thread(target=lambda: done.append(1), daemon=True)
    thread.start()
    thread.join(30)
    assert done == [1]


def test_nothing_waits_for_threads_that_may_not_begin():
    """Pools and threads of Python's own wait for ever when memory is gone."""
    for path in ENGINE.rglob("*.py"):
        text = path.read_text("utf-8")
        code = "\n".join(line for line in text.splitlines() if not line.lstrip().startswith("#"))
        for name in ("ThreadPoolExecutor(", "threading.Thread(", "threading.Timer("):
            assert name not in code, path
