"""How an editor ends that fails, is told to end, or cannot begin."""

import os
import subprocess
import sys

import pytest

pytest.importorskip(
    "imgui_bundle", reason="it is an extra: pip install -e .[editor]", exc_type=ImportError
)

STUBBORN = "exec('while True:\\n try:\\n  while True: pass\\n except BaseException: pass')"


def run(program, folder):
    """Run a program in a process of its own, in a folder that is its home too."""
    homes = {name: str(folder) for name in ("XDG_STATE_HOME", "XDG_CACHE_HOME")}
    environment = {**os.environ, **homes, "SDL_VIDEODRIVER": "dummy"}
    command = [sys.executable, "-c", program]
    return subprocess.run(command, env=environment, capture_output=True, cwd=folder)


def test_what_is_not_saved_is_kept_when_the_editor_fails(tmp_path):
    """In a process of its own, which must end as Python does after an error."""
    program = (
        "import sys\n"
        "from engine3d.apps.editor.ui.editor_window import EditorWindow\n"
        "with EditorWindow(size=(600, 400)) as editor:\n"
        "    editor.workspace.lines_to_run.append('scene.add()')\n"
        "    editor.turn(0.0)\n"
        "    editor._guarded = lambda act: sys.exit('planted')\n"
        "    editor.run()\n"
    )
    done = run(program, tmp_path)
    assert (done.returncode, done.stderr) == (1, b"planted\n")
    assert len(list((tmp_path / "engine3d" / "unsaved").glob("*.e3d.json"))) == 1


@pytest.mark.parametrize(
    ("path", "line"),
    [
        ("new.e3d.json", ""),
        ("", ""),
        ("", "while True: pass"),
        ("", "import time; time.sleep(99)"),
        ("", STUBBORN),
    ],
)
def test_sigterm_ends_the_editor_whatever_it_does(tmp_path, path, line):
    program = (
        "import os, signal, sys, threading\n"
        "from engine3d.apps.editor.ui.editor_window import EditorWindow\n"
        f"with EditorWindow({path!r}, size=(600, 400)) as editor:\n"
        f"    editor.workspace.lines_to_run += ['scene.add()', {line!r}, '']\n"
        "    end = lambda: os.kill(os.getpid(), signal.SIGTERM)\n"
        "    threading.Timer(0.5, end).start()\n"
        "    sys.exit(editor.run())\n"
    )
    done = run(program, tmp_path)
    assert (done.returncode, done.stderr) == (143, b"")
    assert len(list((tmp_path / "engine3d" / "unsaved").glob("*.e3d.json"))) == 1


@pytest.mark.parametrize(
    "name, why",
    [
        ("broken.obj", "broken.obj:1: "),
        ("none.obj", "none.obj: cannot read: "),
        ("none/scene.e3d.json", "its folder is not there"),
    ],
)
def test_a_file_that_cannot_be_opened_ends_the_command(name, why, monkeypatch, tmp_path, capsys):
    from engine3d.apps.cli import main

    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    monkeypatch.chdir(tmp_path)
    (tmp_path / "broken.obj").write_text("v 1 x\n")
    assert main(["edit", name]) == 1
    said = capsys.readouterr().err
    assert said.count("\n") == 1 and said.startswith("engine3d: error: ") and why in said


@pytest.mark.parametrize("is_there", [False, True])
def test_without_imgui_one_line_says_what_lacks(is_there, monkeypatch, capsys, tmp_path):
    from engine3d.apps.cli import main

    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    for name in list(sys.modules):
        if name.startswith(("engine3d.apps.editor.ui", "imgui_bundle")):
            monkeypatch.delitem(sys.modules, name)
    if is_there:
        (tmp_path / "imgui_bundle").mkdir()
        (tmp_path / "imgui_bundle" / "__init__.py").write_text(
            "raise ImportError('libX11.so.6: no such file', name='imgui_bundle._imgui_bundle')\n"
        )
        monkeypatch.syspath_prepend(tmp_path)
    else:
        monkeypatch.setitem(sys.modules, "imgui_bundle", None)
    assert main(["edit"]) == 1
    said = capsys.readouterr().err
    lacks = "it does not load: libX11.so.6" if is_there else "pip install 'engine3d[editor]'"
    assert said.count("\n") == 1 and lacks in said
