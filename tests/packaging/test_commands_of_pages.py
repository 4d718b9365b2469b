"""What .ci/commands finds in pages, and what it makes of commands that fail."""

import os
import runpy
import shutil
import sys

import pytest

pytestmark = [
    pytest.mark.skipif(sys.platform == "win32", reason="it is for bash"),
    pytest.mark.skipif(shutil.which("bash") is None, reason="needs bash"),
]
PAGE = """
```sh
pip install . && engine3d run    # shows it
# nothing
engine3d edit a.json             # pip install 'engine3d[editor]'
```
```python
import engine3d
```
```
print(engine3d)
```
"""


@pytest.fixture
def script(source_tree):
    return runpy.run_path(str(source_tree / ".ci" / "commands"), run_name="commands")


def test_commands_and_examples_are_found(script):
    assert script["commands"](PAGE) == ["pip install .", "engine3d run", "engine3d edit a.json"]
    assert script["program"](PAGE) == "import engine3d\n\nprint(engine3d)\n"


def test_each_page_installs_shows_and_draws(script, source_tree):
    asked = {name: script["commands"]((source_tree / name).read_text()) for name in script["PAGES"]}
    assert "pip install engine3d-*.whl" in asked["docs/start.md"]
    assert len(asked["README.md"]) > 10
    left = {one for many in asked.values() for one in many if script["RUN_ELSEWHERE"].match(one)}
    assert left == {
        "pip install .",
        "engine3d run",
        'pip install -e ".[test]"',
        "pytest -n 3 --dist loadfile",
    }


def as_engine3d(folder, text):
    """The variables with which `engine3d` is a program of this text."""
    (folder / "engine3d").write_text(f"#!/bin/sh\n{text}\n")
    (folder / "engine3d").chmod(0o755)
    return {"PATH": f"{folder}{os.pathsep}{os.environ['PATH']}"}


@pytest.mark.parametrize(
    "command, text, said",
    [
        ("engine3d render", "exit 0", None),
        ("engine3d render", "echo no such file; exit 3", "engine3d render: 3\nno such file"),
        ("engine3d run", "trap 'exit 143' TERM; while :; do sleep 0.1; done", None),
        ("engine3d run", "sleep 2; trap 'exit 143' TERM; while :; do sleep 0.1; done", None),
        ("engine3d run", "echo no screen; exit 0", "engine3d run: no window\nno screen"),
        ("engine3d run", "trap 'echo lost; exit 1' TERM; while :; do sleep 0.1; done", "run: 1"),
    ],
)
def test_only_what_does_its_work_passes(script, tmp_path, command, text, said):
    variables = as_engine3d(tmp_path, text)
    if said is None:
        assert script["run"](command, tmp_path, variables, open_for=1) < 60
    else:
        with pytest.raises(SystemExit, match=said):
            script["run"](command, tmp_path, variables, open_for=1)
