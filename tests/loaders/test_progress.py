"""What a callback is told while a file loads."""

import pytest

from engine3d import load_mesh, load_scene

TRIANGLE = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
# Five times as long as what is read between two calls.
LONG = TRIANGLE + b"# nothing but a long file\n" * 800_000


@pytest.mark.parametrize("load", [load_mesh, load_scene])
def test_fractions_rise_from_0_to_1(load):
    told = []
    load(LONG, format="obj", progress=told.append)
    assert told[0] == 0
    assert told[-1] == 1
    assert told == sorted(told)
    assert len(told) >= 5


@pytest.mark.parametrize(
    ("name", "content"), [("obj", TRIANGLE), ("off", b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")]
)
def test_small_files_tell_beginning_and_end(name, content):
    told = []
    load_mesh(content, format=name, progress=told.append)
    assert told == [0, 1]


def test_what_the_callback_raises_ends_loading():
    def stop(fraction):
        if fraction > 0:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        load_mesh(LONG, format="obj", progress=stop)
