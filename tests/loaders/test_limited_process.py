"""A risky reader has a process of its own, with so much memory and time and no more."""

import importlib
import os
import signal
import subprocess
import sys
from types import MappingProxyType

import pytest

from engine3d.errors import FileFormatError
from engine3d.io.reading import limited_process
from engine3d.io.reading.limited_process import in_limited_process
from engine3d.io.reading.open_files import OpenFile
from engine3d.io.reading.sources import Source, read_source

MEGABYTE = 1 << 20
READERS = """
def greedy(source, split):
    if split:
        while True:
            pass
    return [bytearray(1 << 20) for _ in range(1 << 20)]


def told(source, split):
    return source, split


def limits(source, split):
    import resource

    kinds = (resource.RLIMIT_AS, resource.RLIMIT_CPU, resource.RLIMIT_CORE)
    return [resource.getrlimit(kind)[0] for kind in kinds]
"""


@pytest.fixture
def reader(write, monkeypatch):
    """``reader(name)``: a function of a module, which the other process finds by `sys.path`."""
    monkeypatch.syspath_prepend(write("readers_of_test.py", READERS).parent)
    yield lambda name: getattr(importlib.import_module("readers_of_test"), name)
    sys.modules.pop("readers_of_test", None)


def read(reader, split=False, **options):
    return in_limited_process(reader, Source("a.xyz", b"0 0 0", **options), split, size=5)


def test_what_a_process_reads_comes_back(reader):
    source, split = read(reader("told"), split=True)
    assert (source.path, source.data, split) == ("a.xyz", b"0 0 0", True)


def test_options_of_the_caller_reach_the_process(reader):
    options = {"crease_angle": 0.25, "values": False, "root": "models", "shapes": "collision"}
    joints = MappingProxyType({"elbow": 0.5})
    told = []
    source, _ = read(
        reader("told"), **options, joints=joints, progress=told.append, companion=told.append
    )
    assert {name: getattr(source, name) for name in options} == options
    assert source.joints == joints


def test_a_large_file_reaches_the_process(write, reader):
    content = bytes(range(256)) * (5 * MEGABYTE // 256)
    with read_source(write("a.xyz", content)) as source:
        assert isinstance(source.content, OpenFile)
        found, _ = in_limited_process(reader("told"), source, False, size=source.size)
    assert found.data == content


@pytest.mark.parametrize("status", [0, 7, -9])
def test_a_process_is_late_where_a_signal_says_so(monkeypatch, status):
    """Windows has no such signal: a process that ended well ended with status 0."""
    monkeypatch.delattr(signal, "SIGXCPU", raising=False)
    assert not limited_process._is_late(status)
    monkeypatch.setattr(signal, "SIGXCPU", 24, raising=False)
    assert limited_process._is_late(-24) and limited_process._is_late(None)
    assert not limited_process._is_late(status)


@pytest.mark.skipif(os.name == "nt", reason="it limits no processes")
def test_limits_do_not_depend_on_each_other(reader, monkeypatch):
    """As where nothing tells the address space, or the system refuses to limit it."""
    size, seconds, cores = read(reader("limits"))
    assert (size > 0) == sys.platform.startswith("linux")
    assert (seconds, cores) == (limited_process.MAX_SECONDS_BASE, 0)
    refusing = """
import builtins, resource
from engine3d.io.reading import limited_process
set_limit = resource.setrlimit
def refused(what, limits):
    if what == resource.RLIMIT_AS:
        raise ValueError("current limit exceeds maximum limit")
    set_limit(what, limits)
resource.setrlimit = refused
limited_process.main()
"""
    unknown = """
from engine3d.io.reading import limited_process
limited_process._address_space = lambda page: None
limited_process.main()
"""
    for program in (refusing, unknown):
        monkeypatch.setattr(limited_process, "_RUN", f"exec({program!r})")
        assert read(reader("limits")) == [-1, seconds, cores]


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="Linux alone limits memory")
def test_memory_is_limited(reader):
    limit = limited_process.MAX_MEMORY_BASE + limited_process.MAX_MEMORY_RATIO * 5
    with pytest.raises(FileFormatError, match=rf"a\.xyz: needs more than {limit} bytes of memory"):
        read(reader("greedy"))
    assert limit < 520 * MEGABYTE


@pytest.mark.parametrize("by_clock", [False, True])
def test_time_is_limited(reader, monkeypatch, by_clock):
    monkeypatch.setattr(limited_process, "MAX_SECONDS_BASE", 1000 if by_clock else 1)
    if by_clock:  # as where the system knows no limits
        monkeypatch.setattr(limited_process, "_PATIENCE", 1e-3)
    with pytest.raises(FileFormatError, match=r"a\.xyz: takes longer than 1(000)? seconds"):
        read(reader("greedy"), split=True)


def test_a_process_that_ends_is_an_error(reader, monkeypatch):
    monkeypatch.setattr(limited_process, "_RUN", "sys.exit(7)")
    with pytest.raises(FileFormatError, match=r"a\.xyz: damaged: .* ended \(status 7\)"):
        read(reader("told"))


def test_pillow_forgets_what_may_start_programs(write):
    path = write("a.eps", "%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 10 10\n%%EndComments\n")
    code = (
        "import sys\n"
        "from PIL import Image\n"
        "from engine3d.io.formats.images import PILLOW_FORMATS\n"
        "from engine3d.io.reading.limited_process import _limit_pillow\n"
        "Image.open(sys.argv[1])\n"
        "_limit_pillow()\n"
        "try: Image.open(sys.argv[1])\n"
        "except Image.UnidentifiedImageError: print(sorted(Image.OPEN) == sorted(PILLOW_FORMATS))\n"
    )
    command = [sys.executable, "-c", code, str(path)]
    found = subprocess.run(command, check=True, capture_output=True, text=True)
    assert found.stdout.strip() == "True"
