"""`import engine3d` is light: NumPy and the core, and nothing that only some of its users need."""

import importlib
import json
import sys

import pytest

import engine3d
from engine3d.extras.lod import simplify

# Prints the modules that engine3d adds to NumPy's own, and the seconds that they take.
PROBE = """
import json, sys, time
import numpy
before = set(sys.modules)
start = time.perf_counter()
import engine3d
seconds = time.perf_counter() - start
print(json.dumps([sorted(set(sys.modules) - before), seconds]))
"""
HEAVY = {
    "argparse",
    "asyncio",
    "concurrent.futures",
    "email",
    "http",
    "importlib.metadata",
    "multiprocessing",
    "socket",
    "ssl",
    "subprocess",
    "unittest",
    "urllib.request",
}


def test_import_loads_only_numpy_and_the_core(run_python, tmp_path):
    added, seconds = json.loads(run_python("-c", PROBE, cwd=tmp_path))
    print(f"import engine3d after NumPy: {1000 * seconds:.0f} ms, {len(added)} modules")
    foreign = {
        name
        for name in added
        if name.split(".")[0] not in {"engine3d", *sys.stdlib_module_names}
        # Shared by everything that Cython compiled.
        and not name.startswith(("_cython", "cython_runtime"))
    }
    # What an editable install's .pth file brings, before anything is imported by name.
    foreign = {name for name in foreign if not name.startswith("__editable__")}
    assert not foreign
    assert not HEAVY.intersection(added)


PICTURE = """
import sys
from pathlib import Path
import engine3d.data
from engine3d.apps.cli import main
model = Path(engine3d.data.__file__).parent / "models" / "teapot.obj"
before = set(sys.modules)
assert main(["render", str(model), "-o", "teapot.png", "--size", "32x18"]) == 0
print(*sorted(set(sys.modules) - before))
"""
# What a picture of an OBJ with a TGA can do without; each takes a noticeable part of its time.
DISPENSABLE = {"PIL", "numpy.ma", "sdl2", "rich", "engine3d.io.formats.asc"}
DISPENSABLE |= {"hashlib", "subprocess", "tempfile"}


def test_a_picture_imports_what_it_needs(run_python, tmp_path):
    added = set(run_python("-c", PICTURE, cwd=tmp_path).split())
    assert "engine3d.io.formats.obj.obj" in added
    assert not DISPENSABLE & added
    assert (tmp_path / "teapot.png").read_bytes().startswith(b"\x89PNG")


def test_package_refuses_another_name(run_python, source_tree, tmp_path):
    code = f"""
import sys

import pytest

import engine3d
from engine3d.extras.lod import simplify
sys.path.insert(0, {str(source_tree)!r})
try:
    import engine
except ImportError as error:
    print(error)
"""
    assert "engine3d" in run_python("-c", code, cwd=tmp_path)


@pytest.mark.parametrize(
    ("package", "extra", "use"),
    [
        ("jupyter_rfb", "notebook", lambda: importlib.import_module("engine3d.notebook")),
        ("trimesh", "formats", lambda: engine3d.box().to_trimesh()),
        ("fast_simplification", "detail", lambda: simplify(engine3d.box(), 0.5)),
    ],
)
def test_a_missing_extra_is_named(monkeypatch, package, extra, use):
    """By the package in `name`, too, which tells it from a fault of engine3d's own imports."""
    for name in ("engine3d.notebook", "engine3d.apps.notebook"):
        monkeypatch.delitem(sys.modules, name, raising=False)
    monkeypatch.delattr("engine3d.apps.notebook", raising=False)
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(ImportError, match=rf"engine3d\[{extra}\]") as told:
        use()
    assert told.value.name == package
