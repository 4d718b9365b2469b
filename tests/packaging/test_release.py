"""What wheels for other machines are built with."""

import os
import runpy
import subprocess
import sys
import sysconfig
from types import SimpleNamespace

import pytest

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="wheels are built on Linux")


def rules(source_tree, name):
    return runpy.run_path(str(source_tree / name), run_name="rules")


@pytest.mark.parametrize("machine", ["aarch64-linux-gnu", "x86_64-linux-musl"])
def test_a_module_is_named_after_its_machine(source_tree, tmp_path, machine):
    release = rules(source_tree, ".ci/release")
    release["write_settings"](machine, tmp_path)
    made = runpy.run_path(str(tmp_path / f"{release['SETTINGS']}.py"))["build_time_vars"]
    tag = f"{sys.implementation.cache_tag}-{machine}"
    assert made["EXT_SUFFIX"] == f".{tag}.so"
    assert made["SOABI"] == tag


def test_no_folder_of_this_machine_is_in_the_settings(source_tree, tmp_path, monkeypatch):
    release = rules(source_tree, ".ci/release")
    here = {"MULTIARCH": "m", "EXT_SUFFIX": ".m.so", "SOABI": "m", "N": 1}
    here["LDSHARED"] = "gcc -shared -L/here/lib -Wl,-rpath,/here/lib -Wl,-z,now"
    monkeypatch.setattr(
        release["importlib"], "import_module", lambda name: SimpleNamespace(build_time_vars=here)
    )
    release["write_settings"]("x86_64-linux-musl", tmp_path)
    made = runpy.run_path(str(tmp_path / f"{release['SETTINGS']}.py"))["build_time_vars"]
    assert made["LDSHARED"] == "gcc -shared -Wl,-z,now"
    assert made["HOST_GNU_TYPE"] == "x86_64-linux-musl" and made["N"] == 1


def test_the_cross_compiler_names_its_target(source_tree):
    command = [sys.executable, source_tree / ".ci" / "zigcc", "-dumpmachine"]
    environment = {**os.environ, "ENGINE3D_TARGET": "aarch64-linux-gnu.2.17"}
    named = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    assert named.stdout == "aarch64-linux-gnu.2.17\n"


def test_a_module_for_windows_is_named_so_and_sees_its_headers(source_tree, tmp_path, monkeypatch):
    release = rules(source_tree, ".ci/release")
    ran = []
    monkeypatch.setattr(release["subprocess"], "run", lambda command, **_: ran.append(command))
    release["write_settings"]("win-amd64", tmp_path)
    made = runpy.run_path(str(tmp_path / f"{release['SETTINGS']}.py"))["build_time_vars"]
    assert made["EXT_SUFFIX"] == ".pyd"
    config = (tmp_path / "include" / "pyconfig.h").read_text()
    assert made["INCLUDEPY"] == str(tmp_path / "include") and "SIZEOF_LONG 4" in config
    names = (tmp_path / "python3.def").read_text().split("EXPORTS")[1].splitlines()
    assert {"PyLong_FromLong", "PyType_Type DATA", "_Py_FatalErrorFunc", "PyErr_Format"} < {*names}
    assert all(name.lstrip("_").startswith("Py") for name in names if name)
    assert "ziglang" in ran[0]


@pytest.mark.parametrize(
    "platform, machine, is_windows",
    [
        ("linux-x86_64", "X86", False),
        ("x86_64-linux-gnu.2.17", "X86", False),
        ("win-amd64", "X86", True),
        ("x86_64-windows-gnu", "X86", True),
        ("linux-aarch64", "AARCH64", False),
        ("macosx-11.0-arm64", "AARCH64", False),
        ("aarch64_be-linux-gnu", "", False),
        ("linux-riscv64", "", False),
    ],
)
def test_the_build_knows_its_machine(source_tree, platform, machine, is_windows):
    build = rules(source_tree, "csrc/build_rules.py")
    assert build["machine_of"](platform) == machine
    assert build["is_windows"](platform) == is_windows


def test_each_machine_has_its_kernels(source_tree):
    isa_flags = rules(source_tree, "csrc/build_rules.py")["isa_flags"]
    assert list(isa_flags("X86")) == ["sse41", "avx2", "avx512"]
    assert isa_flags("AARCH64") == {"neon": []}
    assert isa_flags("") == {}


@pytest.mark.parametrize("machine", ["x86_64-linux-gnu", "aarch64-linux-musl"])
def test_only_where_there_is_sdl_it_is_required(source_tree, monkeypatch, machine):
    settings = {"SOABI": f"cpython-311-{machine}", "HOST_GNU_TYPE": machine}
    monkeypatch.setattr(sysconfig, "get_config_var", settings.get)
    required = rules(source_tree, "setup.py")["requirements"]()
    names = [requirement.partition(">")[0] for requirement in required]
    sdl = ["pysdl2-dll"] if machine.endswith("gnu") else []
    assert names == ["numpy", "pillow", "pysdl2", "rich", *sdl]
