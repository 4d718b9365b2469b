"""Damaged and made-up files: each loads as sound arrays or raises an error of the project's own.

The long form, with other files each time, is `fuzzing.py`.
"""

import random

import pytest
from loaders.fuzzing import Finding, check, make_case, seeds, write_companions

from engine3d.io.formats import asc_meshes

CASES = 120
# Time is bounded so that nothing hangs, here also where sanitizers slow everything down.
SLACK = 20


@pytest.mark.parametrize("suffix", sorted(seeds(corpus=False)))
def test_no_file_does_harm(tmp_path, suffix):
    write_companions(tmp_path)
    start, loaded = seeds(corpus=False), 0
    for number in range(CASES):
        choice = random.Random(f"{suffix} {number}")
        name, data = make_case(choice, start, suffix)
        loaded += check(tmp_path, name, data, draw=number % 20 == 0, slack=SLACK)
    assert loaded > 0


@pytest.mark.parametrize(
    "harm", [OverflowError("too large"), RecursionError(), MemoryError(), ValueError("?")]
)
def test_the_check_finds_what_is_no_error_of_our_own(tmp_path, monkeypatch, harm):
    def fail(*args):
        raise harm

    monkeypatch.setattr(asc_meshes, "_mesh", fail)
    name, data = "case.asc", seeds(corpus=False)[".asc"][0]
    with pytest.raises((Finding, type(harm))):
        check(tmp_path, name, data)


def test_smoothing_groups_beyond_all_are_left_out(tmp_path):
    groups = ", ".join(["000000001999", "0", "33", "1" * 5000, "²"])
    data = seeds(corpus=False)[".asc"][0].replace(
        b"Smoothing:  1, 3", f"Smoothing: {groups}".encode()
    )
    assert check(tmp_path, "case.asc", data)


@pytest.mark.parametrize("number", ["1e200", "3e38", "1e-320"])
def test_coordinates_beyond_the_range_of_floats_are_quiet(tmp_path, number):
    text = f"v 0 0 0\nv {number} 0 0\nv 0 {number} 0\nvn 0 0 {number}\n"
    text += "s off\nf 1//1 2 3\ns 1\nf 3 2 1\n"
    assert check(tmp_path, "case.obj", text.encode(), draw=True)
