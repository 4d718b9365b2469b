"""The source distribution is complete; the wheel built from it holds what it must, no more."""

import os
import runpy
import shutil
import tarfile
import zipfile
from pathlib import PurePosixPath

import pytest
from missing_here import needs_compiler

pytestmark = [pytest.mark.slow, needs_compiler]

SOURCE_FOLDERS = ["benchmarks", "csrc", "data", "docs", "engine", "lessons", "tests"]
SOURCE_FILES = [
    "CHANGELOG.md",
    "CITATION.cff",
    "LICENSE",
    "MANIFEST.in",
    "README.md",
    "pyproject.toml",
    "setup.py",
]
SOURCE_FILES += ["csrc/build_rules.py"]
SOURCE_ONLY = ("globe.obj", "globe.mtl", "globe_stand.", "nautilus")  # models
BUILD_PRODUCTS = {".so", ".o", ".a", ".pyc"}


@pytest.fixture(scope="module")
def sdist(run_python, source_tree, tmp_path_factory):
    """The path of the source distribution, built from the source tree."""
    folder = tmp_path_factory.mktemp("sdist")
    run_python("-m", "build", "-n", "--sdist", "-o", folder, source_tree, cwd=folder)
    (archive,) = folder.glob("*.tar.gz")
    return archive


@pytest.fixture(scope="module")
def unpacked(sdist):
    """The folder that the source distribution unpacks to."""
    with tarfile.open(sdist) as archive:
        archive.extractall(sdist.parent, filter="data")
    return sdist.parent / sdist.name.removesuffix(".tar.gz")


@pytest.fixture(scope="module")
def wheel(run_python, source_tree, unpacked, tmp_path_factory):
    """The path of the wheel, built from the unpacked source distribution.

    What the checkout's own build compiled lies beside it. setup.py takes an object only where
    every file that it was compiled from is there, unchanged: test_build.py proves that. So a
    file that the archive lacks still stops the build, and the rest need not be compiled twice.
    """
    kind = os.environ.get("ENGINE3D_BUILD") or "release"
    for objects in source_tree.glob(f"build/{kind}*/objects-*"):
        shutil.copytree(objects, unpacked / objects.relative_to(source_tree))
    folder = tmp_path_factory.mktemp("wheel")
    run_python("-m", "build", "-n", "--wheel", "-o", folder, unpacked, cwd=folder)
    (path,) = folder.glob("*.whl")
    return path


def files_below(folder, names):
    """The files of some folders of `folder`, as relative POSIX paths, build products aside."""
    return {
        path.relative_to(folder).as_posix()
        for name in names
        for path in (folder / name).rglob("*")
        if path.is_file() and path.suffix not in BUILD_PRODUCTS and "generated" not in path.parts
    }


def test_sdist_holds_every_source(unpacked, source_tree):
    held = files_below(unpacked, SOURCE_FOLDERS)
    assert files_below(source_tree, SOURCE_FOLDERS) <= held
    assert all((unpacked / name).is_file() for name in SOURCE_FILES)


def test_sdist_holds_no_build_product(sdist):
    with tarfile.open(sdist) as archive:
        names = [PurePosixPath(name) for name in archive.getnames()]
    assert not [str(name) for name in names if name.suffix in BUILD_PRODUCTS]
    assert not [str(name) for name in names if "build" in name.parts[1:2]]


def test_wheel_is_small(wheel, source_tree):
    rules = runpy.run_path(str(source_tree / ".ci" / "release"), run_name="rules")
    size = wheel.stat().st_size
    print(f"{wheel.name}: {size / 1e6:.2f} MB")
    assert size < rules["MAX_WHEEL_BYTES"]


def test_wheel_holds_every_module_stub_and_data_file(wheel, source_tree):
    with zipfile.ZipFile(wheel) as archive:
        held = set(archive.namelist())
    engine = source_tree / "engine"
    expected = {
        f"engine3d/{path.relative_to(engine).as_posix()}"
        for pattern in ("*.py", "*.pyi", "*.html", "py.typed")
        for path in engine.rglob(pattern)
        if path.stem != "kernels_testing"
    }
    models = {path.name for path in (source_tree / "data" / "models").iterdir()}
    left_out = {name for name in models if name.startswith(SOURCE_ONLY)}
    expected |= {f"engine3d/data/models/{name}" for name in models - left_out}
    expected |= {f"engine3d/data/{name}" for name in ("__init__.py", "README.md")}
    lessons = source_tree / "lessons"
    expected |= {
        f"engine3d/lessons/{path.name}"
        for path in lessons.iterdir()
        if path.is_file() and path.name != "README.md"
    }
    assert expected <= held
    assert len(left_out) == 7 and not {f"engine3d/data/models/{name}" for name in left_out} & held
    compiled = {PurePosixPath(name).name.split(".")[0] for name in held if name.endswith(".so")}
    assert compiled == {"_core"}


def test_wheel_holds_what_desktops_and_man_look_for(wheel, source_tree):
    with zipfile.ZipFile(wheel) as archive:
        names = [PurePosixPath(name) for name in archive.namelist()]
    shared = {path.name for path in names if path.parts[0].endswith(".data")}
    assert all(path.parts[1:3] == ("data", "share") for path in names if path.name in shared)
    desktop = (source_tree / "data" / "desktop").iterdir()
    assert shared == {path.name for path in desktop if path.suffix not in (".py", "")}


def test_wheel_holds_the_licences_of_all_that_is_in_it(wheel):
    with zipfile.ZipFile(wheel) as archive:
        names = [name.partition(".dist-info/licenses/")[2] for name in archive.namelist()]
        (metadata,) = (name for name in archive.namelist() if name.endswith("/METADATA"))
        text = archive.read(metadata).decode()
    assert {*filter(None, names)} == {"LICENSE", "data/fonts/LICENSE.txt", "csrc/NOTICES.txt"}
    assert "License-Expression: MIT AND OFL-1.1\n" in text


def test_wheel_holds_nothing_else(wheel):
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
    roots = {name.split("/")[0].split("-")[0] for name in names}
    assert roots == {"engine3d"}
    sources = [name for name in names if name.endswith((".pyx", ".c", ".h", ".inl", ".a"))]
    assert [name for name in sources if not name.startswith("engine3d/lessons/")] == []


def test_nothing_in_the_package_needs_what_the_wheel_leaves_out(source_tree):
    texts = {
        path.name: path.read_text("utf-8")
        for folder in ("engine", "lessons")
        for path in (source_tree / folder).rglob("*.py")
    }
    assert "23_solar.py" in texts and "solar.py" in texts
    assert not [n for n, text in texts.items() for left in SOURCE_ONLY if f'"{left}' in text]
