"""Warnings of several threads: none takes another's, and the process has its filters back."""

import threading
import warnings
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from PIL import Image

import engine3d as e3d
from engine3d.base.side_by_side import side_by_side
from engine3d.base.warning_scopes import gathered, ignored_of
from engine3d.errors import Engine3DWarning, warn

THREADS = 6


@pytest.fixture(autouse=True)
def filters_stay():
    before, show = list(warnings.filters), warnings.showwarning
    yield
    assert warnings.filters == before and warnings.showwarning is show


def test_each_thread_gathers_its_own():
    meeting = threading.Barrier(THREADS, timeout=30)

    def warned(number):
        told = []
        for turn in range(20):
            with gathered() as texts:
                meeting.wait()
                warn(f"{number}: {turn}")
                side_by_side(lambda one, turn=turn: warn(f"{number}: {turn}, {one}"), "ab", 2)
            told.append(sorted(texts))
        return told

    with ThreadPoolExecutor(THREADS) as pool:
        all_told = list(pool.map(warned, range(THREADS)))
    for number, told in enumerate(all_told):
        assert told == [
            [f"{number}: {k}", f"{number}: {k}, a", f"{number}: {k}, b"] for k in range(20)
        ]


def test_within_a_gathering_others_are_dropped_and_outside_shown():
    with gathered() as outer:
        warn("first")
        warnings.warn("of another library", RuntimeWarning, stacklevel=1)
        with gathered() as inner:
            warn("second")
        warn("third")
        with pytest.warns(Engine3DWarning, match="^fourth$"):
            warn("fourth")
    assert (outer, inner) == (["first", "third"], ["second"])
    with pytest.warns(Engine3DWarning, match="^fifth$"):
        warn("fifth")


def test_a_thread_that_gathers_nothing_is_heard():
    begun, ended = threading.Event(), threading.Event()

    def gather():
        with gathered() as texts:
            begun.set()
            ended.wait(30)
        return texts

    with ThreadPoolExecutor(1) as pool, pytest.warns(Engine3DWarning, match="^heard$"):
        there = pool.submit(gather)
        begun.wait(30)
        warn("heard")
        ended.set()
        assert there.result() == []


def test_ignored_are_those_of_the_modules_alone():
    with pytest.warns(Engine3DWarning, match="^heard$"), ignored_of("PIL"):
        warnings.warn_explicit("dropped", UserWarning, "Image.py", 1, module="PIL.Image")
        warn("heard")


def test_threads_that_load_images_leave_warnings_as_they_were(tmp_path):
    for number in range(THREADS):
        Image.fromarray(np.full((8, 8, 3), number, np.uint8)).save(tmp_path / f"{number}.png")

    def load(number):
        return [e3d.load_texture(tmp_path / f"{number}.png").pixels[0, 0, 0] for _ in range(20)]

    with ThreadPoolExecutor(THREADS) as pool:
        assert list(pool.map(load, range(THREADS))) == [[k] * 20 for k in range(THREADS)]
    with pytest.warns(Engine3DWarning, match="^heard$"):
        warn("heard")
