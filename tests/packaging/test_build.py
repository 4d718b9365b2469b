"""The build's own promises, tried with the real setup.py on a tree of a few tiny C files."""

import os
import platform
import re
import runpy
import shutil
import stat
import subprocess
import sys

import pytest
from missing_here import needs_compiler

pytestmark = needs_compiler

# The core is two numbers, one of them behind an .inl file.
CORE = """
#if defined(__FAST_MATH__) || defined(__AVX2__) || defined(__FMA__)
#error "the baseline must be plain x86-64 with exact arithmetic"
#endif
#include "kernels/number.inl"
int e3d_number(void);
int e3d_number(void) { return NUMBER; }
"""
ISA_AVX2 = """
#if !defined(__AVX2__) || defined(__FMA__) || defined(__AVX512F__) || defined(__FAST_MATH__)
#error "AVX2 means -mavx2 alone"
#endif
"""
GATEWAY = """
cdef extern from *:
    "int e3d_number(void);"
    int e3d_number()

def number():
    return e3d_number()
"""
REAL_FILES = ("setup.py", "csrc/build_rules.py", "pyproject.toml", "engine/version.py")
REAL_FILES += ("csrc/headers.py", "csrc/mirrors.py", "csrc/stubs.py")
REAL_FILES += ("csrc/include/e3d_backends.h", "csrc/include/e3d_options.h")
# Prints the number that the one module of the core gives.
PROBE = """
from glob import glob
from importlib.machinery import ExtensionFileLoader
from importlib.util import module_from_spec, spec_from_file_location
(library,) = glob("_core*.so")
loader = ExtensionFileLoader("number", library)
number = module_from_spec(spec_from_file_location("number", library, loader=loader))
loader.exec_module(number)
print(number.number())
"""


@pytest.fixture(scope="module")
def built_once(source_tree, run_python, tmp_path_factory):
    """A tree with the real setup.py and a core that compiles in a moment, built in place."""
    folder = tmp_path_factory.mktemp("tiny")
    files = {
        "csrc/data/number.c": CORE,
        "csrc/kernels/number.inl": "#define NUMBER 42\n",
        "csrc/kernels/isa_avx2.c": ISA_AVX2,
        "engine/__init__.py": "",
        "engine/_native/__init__.py": "",
        "engine/_native/number.pyx": GATEWAY,
        "data/__init__.py": "",
        "lessons/__init__.py": "",
        "README.md": "",
        "LICENSE": "",
        "data/fonts/LICENSE.txt": "",
        "csrc/NOTICES.txt": "",
    }
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, "utf-8")
    for name in REAL_FILES:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(source_tree / name, folder / name)
    run_python("setup.py", "-q", "build_ext", "--inplace", cwd=folder)
    return folder


@pytest.fixture
def tiny_tree(built_once, tmp_path):
    """A copy of the tree that was built once, with the times of its files."""
    return shutil.copytree(built_once, tmp_path, dirs_exist_ok=True)


@pytest.fixture
def build(run_python, tiny_tree):
    """Call with variables to set: builds the tiny tree in place, returns the number it gives."""

    def build_in_place(**environment):
        run_python("setup.py", "-q", "build_ext", "--inplace", cwd=tiny_tree, **environment)
        return int(run_python("-c", PROBE, cwd=tiny_tree / "engine" / "_native"))

    return build_in_place


def made_at(tree):
    """When each object, library, module and translated file of a build was made."""
    paths = [path for kind in ("o", "a", "c", "so") for path in tree.glob(f"build/**/*.{kind}")]
    return {
        re.sub(r"\.(cpython|abi3).*", "", "/".join(path.parts[-2:])): path.stat().st_mtime_ns
        for path in paths
    }


def test_edited_include_rebuilds_what_includes_it(build, tiny_tree):
    before = made_at(tiny_tree)
    (tiny_tree / "csrc/kernels/number.inl").write_text("#define NUMBER 43\n", "utf-8")
    assert build() == 43
    after = made_at(tiny_tree)
    rebuilt = {name.partition("/")[2] for name in after if after[name] != before[name]}
    assert rebuilt == {"number.o", "libe3d_core.a", "_core"}
    assert after["_native/number.o"] == before["_native/number.o"]


def test_unchanged_files_are_not_rebuilt(build, tiny_tree):
    before = made_at(tiny_tree)
    assert {"kernels/isa_avx2.o", "_native/number.c"} <= before.keys()
    assert build() == 42
    assert made_at(tiny_tree) == before


def test_edited_gateway_is_translated_again(build, tiny_tree):
    (tiny_tree / "engine/_native/number.pyx").write_text(f"{GATEWAY.rstrip()} + 1\n", "utf-8")
    assert build() == 43


def test_other_flags_rebuild(run_python, tiny_tree):
    """The kind of build stays, so the objects lie where those of before lay."""
    before = made_at(tiny_tree)
    rules = tiny_tree / "csrc/build_rules.py"
    rules.write_text(rules.read_text("utf-8").replace('"-O3", "-g0"', '"-O2", "-g0"'), "utf-8")
    run_python("setup.py", "-q", "build_clib", cwd=tiny_tree)
    assert made_at(tiny_tree)["kernels/isa_avx2.o"] != before["kernels/isa_avx2.o"]


def test_editable_install_keeps_its_objects(run_python, tiny_tree):
    def install():
        # What pip calls for `pip install -e .`.
        code = "from setuptools.build_meta import build_editable; build_editable('dist')"
        run_python("-c", code, cwd=tiny_tree)
        return made_at(tiny_tree)

    before = install()
    assert "kernels/isa_avx2.o" in before
    assert install() == before


def test_only_builds_in_place_hold_what_calls_single_kernels(run_python, tiny_tree):
    native = tiny_tree / "engine/_native"
    (native / "kernels_testing.pyx").write_text(GATEWAY, "utf-8")
    run_python("setup.py", "-q", "build", cwd=tiny_tree)
    assert not [*tiny_tree.glob("build/**/kernels_testing*")]
    run_python("setup.py", "-q", "build", cwd=tiny_tree, ENGINE3D_TESTING="1")
    assert [*tiny_tree.glob("build/**/kernels_testing*.so")]
    run_python("setup.py", "-q", "build_ext", "--inplace", cwd=tiny_tree)
    assert [*native.glob("kernels_testing*.so")]


def test_deleted_modules_leave_the_build_folder(run_python, tiny_tree):
    def modules_built():
        run_python("setup.py", "-q", "build", cwd=tiny_tree)
        return {path.name.partition(".")[0] for path in tiny_tree.glob("build/*/lib*/**/*.*")}

    (tiny_tree / "engine/gone.py").write_text("", "utf-8")
    before = modules_built()
    assert {"version", "_core", "gone"} <= before
    (tiny_tree / "engine/gone.py").unlink()
    assert modules_built() == before - {"gone"}


def test_flags_of_the_user_cannot_change_results(build):
    assert build(CFLAGS="-O0 -ffast-math -march=native -flto -Ofast") == 42


@pytest.mark.skipif(sys.platform != "linux", reason="sanitizers are set up for Linux only")
def test_kinds_of_build_share_no_object(run_python, tiny_tree):
    for kind in ("release", "asan"):
        run_python("setup.py", "-q", "build_clib", cwd=tiny_tree, ENGINE3D_BUILD=kind)
    objects = tiny_tree.glob("build/**/data/number.o")
    folders = [path.relative_to(tiny_tree).parts[1] for path in objects]
    # After the kind comes, if CC or CFLAGS is set, a mark of those.
    assert sorted(folder.split("-")[0] for folder in folders) == ["asan", "release"]


def test_unknown_kind_of_build_is_refused(run_python, tiny_tree):
    with pytest.raises(AssertionError, match="expected one of release, debug"):
        run_python("setup.py", "-q", "build_clib", cwd=tiny_tree, ENGINE3D_BUILD="fast")


BUILDERS = {
    "wheel": ["-c", "from setuptools.build_meta import build_wheel; build_wheel('dist')"],
    "editable": ["-c", "from setuptools.build_meta import build_editable; build_editable('dist')"],
    "in place": ["setup.py", "build_ext", "--inplace"],
    "MinGW": ["setup.py", "build_clib", "--compiler", "mingw32"],
}


def failed(tree, command, **environment):
    """The lines that a build which must fail prints."""
    done = subprocess.run(
        [sys.executable, *command],
        cwd=tree,
        env={**os.environ, **environment},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    assert done.returncode != 0
    return done.stdout.splitlines()


def compiler_that(tree, says):
    """A program that fails at every file, as a compiler does, and says why."""
    program = tree / "broken-cc"
    program.write_text(f"#!/bin/sh\necho '{says}' >&2\nexit 1\n")
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    return str(program)


@pytest.mark.parametrize(
    ("builder", "compiler"),
    [
        ("wheel", "no-such-compiler"),
        ("editable", "/etc/passwd"),
        ("in place", "no-such-compiler -m64"),
        ("MinGW", "no-such-compiler"),
    ],
)
def test_a_missing_compiler_is_one_line_that_says_what_to_install(tiny_tree, builder, compiler):
    lines = failed(tiny_tree, BUILDERS[builder], CC=compiler)
    assert len(lines) < 20 and not [line for line in lines if "Traceback" in line]
    assert lines[-1].startswith(f"error: engine3d cannot be compiled: {compiler.split()[0]!r}: ")
    assert "Install gcc or clang (Debian, Ubuntu: apt-get install gcc libc6-dev" in lines[-1]
    assert lines[-1].endswith("apk add gcc musl-dev)")


def test_a_compiler_that_fails_has_the_first_word(tiny_tree):
    lines = failed(tiny_tree, BUILDERS["wheel"], CC=compiler_that(tiny_tree, "out of cheese"))
    assert len(lines) < 20 and lines[-2] == "out of cheese"
    assert "broken-cc' failed at " in lines[-1] and "stands above" in lines[-1]


def test_missing_headers_of_python_are_named(tiny_tree):
    says = "fatal error: Python.h: No such file or directory"
    lines = failed(tiny_tree, BUILDERS["in place"], CC=compiler_that(tiny_tree, says))
    assert lines[-2] == says and "apt-get install python3-dev" in lines[-1]


@pytest.mark.skipif(platform.machine() != "x86_64", reason="of processors with AVX")
def test_gcc_is_refused_for_windows(source_tree, tiny_tree):
    gcc = shutil.which("gcc") or pytest.skip("needs gcc")
    command = [gcc, "-E", "-x", "c", source_tree / "csrc" / "base" / "windows" / "memory.h"]
    refused = subprocess.run(command, capture_output=True, text=True)
    says = next(line for line in refused.stderr.splitlines() if "#error" in line)
    compiler = compiler_that(tiny_tree, says.replace("'", ""))
    lines = failed(tiny_tree, BUILDERS["wheel"], CC=compiler)
    assert lines[-1].startswith("error: engine3d cannot be compiled: gcc does not align the stack")
    assert lines[-1].endswith("Install clang of MSYS2 or llvm-mingw, and set CC=clang")


def test_processors_are_counted_where_the_system_knows_no_affinity(source_tree, monkeypatch):
    rules = runpy.run_path(str(source_tree / "csrc" / "build_rules.py"))
    monkeypatch.delattr(os, "sched_getaffinity", raising=False)
    assert rules["usable_processors"]() == os.cpu_count()


def test_an_error_in_a_file_is_the_compilers_and_ends_the_build(tiny_tree):
    (tiny_tree / "csrc/data/number.c").write_text("int e3d_number(void) { return gone; }\n")
    lines = failed(tiny_tree, BUILDERS["in place"])
    assert any("gone" in line and "number.c:1:" in line for line in lines)
    assert "failed at csrc/data/number.c" in lines[-1] and "Traceback" not in "".join(lines)
