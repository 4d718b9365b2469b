"""Whatever a file says very often costs work and memory in proportion to its size."""

import sys
import tracemalloc
import warnings

import pytest
from loaders.repeated_records import records, sized

import engine3d as e3d
from engine3d.errors import Engine3DError

SIZE = 3000
# Calls of functions, and bytes of memory, for each byte of a file.
MOST_CALLS, MOST_MEMORY = 70, 600
# How much more each further byte may cost in a file of twice the size, and what any file costs.
MOST_GROWTH = 1.6
CALLS_OF_ANY, MEMORY_OF_ANY = 3000, 200_000


def loaded(path):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            e3d.load_scene(path)
        except Engine3DError as error:
            return str(error)
        return None


def cost(path, data):
    """Calls of functions while a file is loaded, and the most memory at a time."""
    path.write_bytes(data)
    calls = 0

    def count(frame, event, argument):
        nonlocal calls
        calls += event in ("call", "c_call")

    sys.setprofile(count)
    try:
        loaded(path)
    finally:
        sys.setprofile(None)
    tracemalloc.start()
    try:
        said = loaded(path)
        return calls, tracemalloc.get_traced_memory()[1], said
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize(
    ("end", "make"),
    [pytest.param(end, make, id=f"{end}-{name}") for end, name, make in records()],
)
def test_records_cost_in_proportion(tmp_path, end, make):
    path = tmp_path / f"a.{end}"
    few, once, twice = make(4), sized(make, SIZE), sized(make, 2 * SIZE)
    path.write_bytes(few)
    loaded(path)  # what is imported then counts for no file
    calls, memory, said = zip(*(cost(path, data) for data in (few, once, twice)), strict=True)
    assert said == (None, None, None)
    assert calls[2] <= CALLS_OF_ANY + MOST_CALLS * len(twice)
    assert memory[2] <= MEMORY_OF_ANY + MOST_MEMORY * len(twice)
    share = MOST_GROWTH * (len(twice) - len(few)) / (len(once) - len(few))
    assert calls[2] - calls[0] <= share * (calls[1] - calls[0]) + CALLS_OF_ANY
    assert memory[2] - memory[0] <= share * (memory[1] - memory[0]) + MEMORY_OF_ANY
