"""``engine3d info --system``: what it says, and what it keeps to itself."""

import getpass
import json
import os
import platform
import sys
from importlib import metadata
from unittest.mock import Mock

import pytest

import engine3d as e3d
from engine3d.apps.bench import figures
from engine3d.apps.cli import main, system_report

pytestmark = pytest.mark.usefixtures("no_screen")


def report(capsys):
    assert main(["info", "--system", "--json"]) == 0
    return json.loads(capsys.readouterr().out)


def test_it_says_what_a_report_of_a_bug_needs(capsys, monkeypatch):
    monkeypatch.setenv("ENGINE3D_THREADS", "3")
    found = report(capsys)
    assert found["engine3d"] == e3d.__version__
    assert found["build"]["kind"] in ("release", "debug", "profile", "asan", "tsan")
    assert found["build"]["compiler"]
    assert found["python"].endswith(platform.python_version())
    assert found["backends"] == {
        "available": e3d.backends(),
        "auto": e3d.Renderer((8, 8)).backend,
        "threads": 3,
    }
    assert found["packages"]["numpy"] == metadata.version("numpy")
    assert set(found["extras"]) | set(found["missing_extras"]) > {"notebook", "video", "step"}
    assert not {"test", "fuzz"} & (set(found["extras"]) | set(found["missing_extras"]))
    assert found["window"]["sdl"].count(".") == 2
    assert not sys.platform.startswith("linux") or "DISPLAY" in found["window"]["missing"]
    assert found["environment"]["ENGINE3D_THREADS"] == "3"


def test_the_text_says_what_json_says(capsys, monkeypatch):
    monkeypatch.setattr(system_report, "SAFE_PILLOW", (999, 0, 0))
    found = report(capsys)
    assert main(["info", "--system"]) == 0
    text = capsys.readouterr().out
    lines = text.splitlines()
    assert all(len(line) > 12 and (line[11] == " " or ": " in line) for line in lines)
    for part in (
        *(f"{name} {version}" for name, version in found["packages"].items()),
        *(f"warning: {warning}" for warning in found["warnings"]),
        " ".join(found["backends"]["available"]),
        found["build"]["kind"],
        found["processor"]["name"],
    ):
        assert part in text


@pytest.mark.parametrize(
    ("system", "brand", "processor", "distribution"),
    [
        ("darwin", "Apple M1", "Apple M1", "macOS 14.1"),
        ("darwin", "", "by Python", "macOS 14.1"),
        ("win32", "Apple M1", "by Python", "Windows 10.0.22631"),
        ("freebsd14", "Apple M1", "by Python", None),
    ],
)
def test_each_system_tells_its_name_and_processor(
    system, brand, processor, distribution, capsys, monkeypatch
):
    monkeypatch.setattr(sys, "platform", system)
    monkeypatch.setattr(figures, "CPUINFO", "/nowhere")
    monkeypatch.setattr(figures, "answer_of", lambda *command: brand)
    monkeypatch.setattr(platform, "processor", lambda: "by Python")
    monkeypatch.setattr(platform, "mac_ver", lambda: ("14.1", ("", "", ""), "arm64"))
    monkeypatch.setattr(platform, "version", lambda: "10.0.22631")
    monkeypatch.setattr(platform, "freedesktop_os_release", Mock(side_effect=OSError))
    assert system_report._system()["distribution"] == distribution
    assert system_report._processor()["name"] == processor
    assert system_report._processor()["features"] == []


def test_a_processor_without_a_name_is_called_by_its_kind(monkeypatch):
    monkeypatch.setattr(figures, "CPUINFO", "/nowhere")
    monkeypatch.setattr(platform, "processor", lambda: "")
    monkeypatch.setattr(platform, "machine", lambda: "riscv64")
    assert figures.machine()["processor"] == "riscv64"


@pytest.mark.parametrize(("version", "is_told"), [("9.5.0", 1), ("12.2.9", 1), ("12.3.0", 0)])
def test_known_holes_of_pillow_are_told(capsys, monkeypatch, version, is_told):
    monkeypatch.setattr(system_report, "_version", lambda name: version)
    told = [line for line in report(capsys)["warnings"] if "known holes" in line]
    assert len(told) == is_told
    assert not told or f"pillow {version} " in told[0] and "'pillow>=12.3.0'" in told[0]


def test_nothing_private_is_in_it(capsys, monkeypatch, tmp_path):
    home = tmp_path / "jane-doe"
    for name in ("HOME", "USERPROFILE"):  # Windows has the latter
        monkeypatch.setenv(name, os.fspath(home))
    monkeypatch.setenv("ENGINE3D_SHARED", os.fspath(home / "secret"))
    monkeypatch.setenv("ENGINE3D_NAME", "Jane Doe")

    def fail():
        raise e3d.errors.DisplayError(f"SDL cannot be loaded: {home}/lib/sdl.so is damaged")

    monkeypatch.setattr(system_report, "load_sdl", fail)
    assert main(["info", "--system"]) == 0
    text = capsys.readouterr().out
    assert "ENGINE3D_SHARED=(set)" in text and "ENGINE3D_NAME=(set)" in text
    assert "~/lib/sdl.so" in text
    private = ["jane", "Jane", "secret", os.getcwd(), platform.node()]
    private += [] if getpass.getuser() == "root" else [getpass.getuser()]
    assert not [word for word in private if word and word in text]


def test_what_the_environment_asks_for_in_vain_is_told(capsys, monkeypatch):
    monkeypatch.setenv("ENGINE3D_BACKEND", "abacus")
    monkeypatch.setenv("ENGINE3D_THREADS", "many")
    drawn = report(capsys)["backends"]
    assert "'abacus' is unknown" in drawn["auto"] and "'many'" in drawn["threads"]


def test_a_copy_that_is_not_installed_says_so_far_as_it_can(capsys, monkeypatch):
    def requires(name):
        raise metadata.PackageNotFoundError(name)

    monkeypatch.setattr(system_report.metadata, "requires", requires)
    found = report(capsys)
    assert found["packages"] == {} and found["engine3d"] == e3d.__version__


@pytest.mark.parametrize("arguments", [["info"], ["info", "--system", "a.obj"]])
def test_it_is_a_model_or_the_system(capsys, arguments):
    assert main(arguments) == 2
    assert "say which MODEL, or --system alone" in capsys.readouterr().err
