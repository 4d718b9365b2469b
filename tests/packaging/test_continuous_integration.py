"""The scripts of .ci: which Python they take, and in which order .ci/run installs and tests."""

import subprocess
import sys

import pytest

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="they are for bash")


@pytest.mark.parametrize(
    ("there", "wanted", "found"),
    [
        (["3.10", "3.11", "3.13"], [], "3.13"),
        (["3.9", "3.12", "3.10"], [], "3.12"),
        (["3.12", "3.13"], ["3.12"], "3.12"),
        (["3.9"], [], None),
    ],
)
def test_the_newest_python_is_taken(source_tree, tmp_path, there, wanted, found):
    for version in there:
        python = tmp_path / "versions" / f"{version}.1" / "bin" / "python"
        python.parent.mkdir(parents=True)
        # Of what it is asked for, it says its version and its path; the old one refuses.
        python.write_text(f"#!/bin/sh\n[ {version} != 3.9 ] && echo {version} {python}\n")
        python.chmod(0o755)
    command = ["bash", source_tree / ".ci" / "find_python", *wanted]
    # Of the system's own commands, none is a Python.
    tools = tmp_path / "tools"
    tools.mkdir()
    for name in ("bash", "ls", "echo"):
        (tools / name).symlink_to(f"/bin/{name}")
    environment = {"PATH": str(tools), "PYENV_ROOT": str(tmp_path)}
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    assert (done.returncode == 0) == (found is not None), done.stderr
    assert (f"/versions/{found}.1/" in done.stdout) == (found is not None)


@pytest.mark.parametrize("name", ["minimal_root", "pythons", "quick", "run", "sanitize", "types"])
@pytest.mark.parametrize("option", ["-h", "--help"])
def test_scripts_print_their_usage(source_tree, name, option):
    command = ["bash", source_tree / ".ci" / name, option]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stderr) == (0, "")
    assert f"{name} [" in done.stdout or f"{name} driver [" in done.stdout
    assert "#" not in done.stdout.split() and "set -e" not in done.stdout


def test_what_the_quick_one_tests_is_there(source_tree):
    script = (source_tree / ".ci" / "quick").read_text("utf-8")
    words = [word for word in script.split() if word.startswith("tests/")]
    command = ["bash", "-c", f"printf '%s\\n' {' '.join(words)}"]
    paths = subprocess.run(command, capture_output=True, text=True, check=True).stdout.split()
    assert len(paths) > 20
    assert [path for path in paths if not (source_tree / path).exists()] == []


def test_nothing_is_installed_between_the_halves_of_readmes_commands(source_tree):
    """What a newcomer lacks would be there, and hide tests that need it."""
    lines = (source_tree / ".ci" / "run").read_text("utf-8").splitlines()
    (install,) = (k for k, line in enumerate(lines) if line == 'eval "$install --quiet"')
    (test,) = (
        k for k, line in enumerate(lines) if line.startswith("time timeout") and "$test" in line
    )
    between = [line for line in lines[:test] if line.lstrip().startswith("pip install")]
    assert install < test and not between
    assert any("-r tests/requirements.txt" in line for line in lines[test:])


@pytest.mark.parametrize(
    ("name", "status", "said"),
    [
        ("z80", 2, "no processor z80: expected one of aarch64, riscv64, wasm32"),
        ("riscv64", 1, "processors: riscv64: no qemu-riscv64-static (pip install ziglang; Debian:"),
    ],
)
def test_a_processor_that_cannot_be_tried_is_told_at_once(
    source_tree, tmp_path, name, status, said
):
    # Neither a compiler nor an emulator is on this path: nothing can be built by mistake.
    command = [sys.executable, source_tree / ".ci" / "processors", name]
    environment = {"PATH": str(tmp_path)}
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    assert done.returncode == status and said in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize(
    ("there", "said"),
    [
        (["wine"], "windows quick"),
        (["apt-get"], "windows quick"),  # which .ci/windows calls
        ([], "skipped: wine is not installed, and cannot be from here"),
    ],
)
def test_windows_is_tried_where_wine_can_be_had(source_tree, tmp_path, there, said):
    script = (source_tree / ".ci" / "run").read_text("utf-8")
    part = script[script.index('step "Windows"') : script.index('step "passed')]
    programs = {"id": "echo 0", **dict.fromkeys(there, "exit 1")}
    programs |= {".ci/find_python": "exit 0", ".ci/windows": 'echo "windows $1"'}
    (tmp_path / ".ci").mkdir()
    for name, text in programs.items():
        (tmp_path / name).write_text(f"#!/bin/bash\n{text}\n")
        (tmp_path / name).chmod(0o755)
    start = "set -euo pipefail; started=0; step() { :; }; fail() { exit 1; }\n"
    command = ["/bin/bash", "-c", start + part]
    done = subprocess.run(
        command, cwd=tmp_path, env={"PATH": str(tmp_path)}, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith(said)


def test_the_site_is_made_with_what_read_the_docs_installs(source_tree):
    script = (source_tree / ".ci" / "run").read_text("utf-8")
    assert '"$work/first/bin/sphinx-build" -W' in script
    into = [
        line for line in script.splitlines() if line.startswith('"$work/first/bin/pip" install')
    ]
    assert [line.split()[-1] for line in into] == ["docs/requirements.txt"]
    assert "requirements: docs/requirements.txt" in (source_tree / ".readthedocs.yaml").read_text()
