"""What desktops and `man` know of engine3d: up to date, valid, and what it says runs."""

import configparser
import os
import runpy
import shlex
import shutil
import subprocess
import sys

import pytest
from PIL import Image

import engine3d as e3d
from engine3d.io.loaders import formats

CHECKS = {
    "engine3d.desktop": ["desktop-file-validate"],
    "engine3d.xml": ["xmllint", "--noout"],
    "engine3d.svg": ["xmllint", "--noout"],
    # Its identifier would begin with a domain, which the project has not.
    "engine3d.metainfo.xml": [
        *("appstreamcli", "validate", "--no-net"),
        "--override=cid-desktopapp-is-not-rdns=info",
    ],
    "engine3d.1": ["man", "--warnings", "--local-file"],
}


@pytest.fixture
def desktop(source_tree):
    return source_tree / "data" / "desktop"


@pytest.fixture
def make(desktop, monkeypatch):
    """What the script defines."""
    monkeypatch.syspath_prepend(str(desktop))
    return runpy.run_path(str(desktop / "make.py"))


def test_the_files_are_those_that_the_script_writes(desktop):
    command = [sys.executable, desktop / "make.py", "--check"]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("name", CHECKS)
def test_the_systems_own_tools_accept_the_files(desktop, name):
    tool = shutil.which(CHECKS[name][0]) or pytest.skip(f"needs {CHECKS[name][0]}")
    command = [tool, *CHECKS[name][1:], desktop / name]
    environment = {**os.environ, "MANWIDTH": "80", "LC_ALL": "C.UTF-8"}
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stderr == ""


def test_every_format_of_models_is_claimed_or_left_alone(make):
    optional = {item.name for item in formats() if "through" in item.description}
    models = {item.name for item in formats() if item.kind == "mesh"} - optional
    assert models == {*make["TYPES"], *make["NOT_CLAIMED"]}


def test_the_manual_page_names_every_option_of_every_command(desktop):
    from engine3d.apps.cli.parser import make_parser

    page = (desktop / "engine3d.1").read_text("utf-8").replace(r"\-", "-")
    for section, command in zip(
        page.split("\n.SS ")[1:], make_parser().commands.values(), strict=True
    ):
        for action in command._actions:
            if action.option_strings and not {"--help", "--help-all"} & {*action.option_strings}:
                assert rf"\fB{action.option_strings[-1]}\fR" in section


@pytest.mark.skipif(os.name == "nt", reason="desktops of Windows have no thumbnailers of this kind")
def test_the_thumbnailers_command_draws_a_thumbnail(desktop, tmp_path):
    entry = configparser.RawConfigParser()
    entry.read(desktop / "engine3d.thumbnailer", "utf-8")
    model, picture = tmp_path / "a box.obj", tmp_path / "box.png"
    e3d.box().save(model)
    values = {"%s": "96", "%i": str(model), "%o": str(picture)}
    command = [values.get(word, word) for word in shlex.split(entry["Thumbnailer Entry"]["Exec"])]
    program = tmp_path / "bin" / entry["Thumbnailer Entry"]["TryExec"]
    program.parent.mkdir()
    program.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m engine3d "$@"\n')
    program.chmod(0o755)
    environment = {**os.environ, "PATH": f"{program.parent}:{os.environ['PATH']}"}
    with open(picture, "w+b") as opened:  # as tumbler does
        done = subprocess.run(command, env=environment, capture_output=True, text=True)
        assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
        drawn = Image.open(opened)
        drawn.load()
    assert drawn.size == (96, 96) and drawn.getpixel((0, 0))[3] == 0
    assert drawn.getpixel((48, 48))[3] == 255


def test_the_page_tells_how_files_of_a_virtual_environment_are_found(source_tree, tmp_path):
    """The page's own command copies what a wheel puts below an environment's prefix."""
    bash = shutil.which("bash") or pytest.skip("needs bash")
    page = (source_tree / "docs" / "viewer" / "files.md").read_text(encoding="utf-8")
    command = next(line.strip() for line in page.splitlines() if line.startswith("    cp -r"))
    wanted = runpy.run_path(str(source_tree / "setup.py"))["DESKTOP_FILES"]
    environment, home = tmp_path / "an environment", tmp_path / "home"
    for path in ("bin/engine3d", *(f"{folder}/{name}" for folder, name in wanted.items())):
        (environment / path).parent.mkdir(parents=True, exist_ok=True)
        (environment / path).touch()
    for folder in ("bin", "share"):
        (home / ".local" / folder).mkdir(parents=True)
    (home / ".local/bin/engine3d").symlink_to(environment / "bin/engine3d")
    subprocess.run([bash, "-c", command], env={**os.environ, "HOME": str(home)}, check=True)
    for folder, name in wanted.items():
        assert (home / ".local" / folder / name).exists()


def test_the_system_tells_the_types_of_models(desktop, make, tmp_path):
    update = shutil.which("update-mime-database") or pytest.skip("needs update-mime-database")
    gio = shutil.which("gio") or pytest.skip("needs gio")
    packages = tmp_path / "share" / "mime" / "packages"
    packages.mkdir(parents=True)
    shutil.copy(desktop / "engine3d.xml", packages)
    environment = {**os.environ, "XDG_DATA_HOME": str(tmp_path / "share")}
    subprocess.run([update, packages.parent], env=environment, check=True, capture_output=True)
    for name, kind in make["TYPES"].items():
        path = tmp_path / f"model.{name}"
        path.write_bytes(b"v 0 0 0\n")
        command = [gio, "info", "-a", "standard::content-type", path]
        told = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
        assert f"content-type: {kind}\n" in told.stdout, name
