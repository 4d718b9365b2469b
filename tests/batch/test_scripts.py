"""Scripts of batches: what they import from their folder counts, whoever imported it before."""

import json
import sys
from concurrent.futures import ThreadPoolExecutor

import pytest

from engine3d.apps.batch.imports_beside import imports_beside
from engine3d.batch import Task, read_manifest, run

USES = """
import engine3d as e3d
import {0}

def build(scene, generator):
    scene.add(e3d.box())
    scene.background = {0}.COLOR
"""


@pytest.fixture(autouse=True)
def forget_modules(tmp_path):
    yield
    for name, module in list(sys.modules.items()):
        if (getattr(module, "__file__", None) or "").startswith(str(tmp_path)):
            del sys.modules[name]


def write(folder, **files):
    for name, text in files.items():
        (folder / f"{name}.py").write_text(text)


def inputs_of(folder, name):
    return set(json.loads((folder / ".batch" / f"{name}.json").read_text())["inputs"])


def task(folder, name):
    return Task(name=name, script=f"{name}.py", folder=str(folder), size=(4, 4))


def test_two_scripts_share_a_module(tmp_path):
    write(
        tmp_path,
        colours_="COLOR = (9, 8, 7)\n",
        a=USES.format("colours_"),
        b=USES.format("colours_"),
    )
    tasks, out = [task(tmp_path, "a"), task(tmp_path, "b")], tmp_path / "out"
    first = run(tasks, out, jobs=1)
    assert (first.drawn, first.failures) == (2, [])
    for name in "ab":
        assert any(path.endswith("colours_.py") for path in inputs_of(out, name)), name
    assert (out / "a.png").read_bytes() == (out / "b.png").read_bytes()
    write(tmp_path, colours_="COLOR = (90, 80, 70)\n")
    again = run(tasks, out, jobs=1, resume=True)
    assert (again.drawn, again.failures) == (2, []) and again.hash != first.hash
    assert (out / "a.png").read_bytes() == (out / "b.png").read_bytes()


def test_a_script_that_comes_later_sees_what_its_module_is_now(tmp_path):
    write(
        tmp_path, shades_="COLOR = (9, 8, 7)\n", a=USES.format("shades_"), b=USES.format("shades_")
    )
    run([task(tmp_path, "a")], tmp_path / "one", jobs=1)
    write(tmp_path, shades_="COLOR = (90, 80, 70)\n")
    run([task(tmp_path, "b")], tmp_path / "two", jobs=1)
    run([task(tmp_path, "a")], tmp_path / "three", jobs=1)
    old, new, same = (
        (tmp_path / path).read_bytes() for path in ("one/a.png", "two/b.png", "three/a.png")
    )
    assert old != new == same


def test_a_module_of_a_module_changes_for_all(tmp_path):
    """One script imports it itself, another through a module that keeps what it took."""
    write(
        tmp_path,
        deep_="COLOR = (9, 8, 7)\n",
        near_="from deep_ import COLOR\n",
        a=USES.format("near_"),
        b=USES.format("deep_"),
    )
    tasks, out = [task(tmp_path, name) for name in "ab"], tmp_path / "out"
    run(tasks, out, jobs=1)
    write(tmp_path, deep_="COLOR = (90, 80, 70)\n")
    for one in (tasks[1], tasks[0]):
        again = run([one], tmp_path / f"new_{one.name}", jobs=1)
        assert again.failures == []
    old, new, same = (
        (tmp_path / path).read_bytes() for path in ("out/a.png", "new_a/a.png", "new_b/b.png")
    )
    assert old != new == same


HIDDEN = USES.replace("import {0}\n", "import importlib\n{0} = importlib.import_module('{0}')\n")


@pytest.mark.parametrize(
    "uses, place",
    [
        (HIDDEN.format("told_"), "told_.py"),
        (USES.replace("import {0}", "from space_ import {0}").format("held_"), "space_/held_.py"),
    ],
    ids=["by importlib", "in a folder without __init__"],
)
def test_modules_of_all_kinds_are_imported_anew(tmp_path, uses, place):
    path = tmp_path / place
    path.parent.mkdir(exist_ok=True)
    path.write_text("COLOR = (9, 8, 7)\n")
    write(tmp_path, a=uses, b=uses)
    tasks, out = [task(tmp_path, name) for name in "ab"], tmp_path / "out"
    first = run(tasks, out, jobs=1)
    assert all(any(one.endswith(place) for one in inputs_of(out, name)) for name in "ab")
    for number in range(2):  # the second change is seen, too
        path.write_text(f"COLOR = (90, {100 * number + 80}, 70)\n")
        again = run(tasks, out, jobs=1, resume=True)
        assert (again.drawn, again.failures) == (2, []) and again.hash != first.hash
        first = again


def test_a_script_that_failed_sees_its_module_mended(tmp_path):
    write(
        tmp_path, lacks_="", a=USES.format("lacks_").replace("def build", "lacks_.COLOR\ndef build")
    )
    assert len(run([task(tmp_path, "a")], tmp_path / "out", jobs=1).failures) == 1
    write(tmp_path, lacks_="COLOR = (9, 8, 7)\n")
    assert run([task(tmp_path, "a")], tmp_path / "out", jobs=1).failures == []


def test_threads_run_scripts_as_one_thread_does(tmp_path, manifest):
    """Each round has scripts of its own, which the threads load at once."""
    for turn in range(15):
        name, uses = f"hues_{turn}", f"inner_{turn}"
        write(
            tmp_path,
            **{uses: "COLOR = (1, 2, 3)\n", name: f"from {uses} import COLOR\n"},
            script=USES.format(name),
        )
        tasks = read_manifest(manifest({"script": "script.py", "matrix": {"seed": {"count": 6}}}))
        folder = tmp_path / f"threads_{turn}"
        with ThreadPoolExecutor(3) as executor:
            made = run(tasks.tasks, folder, executor=executor)
        assert (made.drawn, made.failures) == (6, [])
        assert not sys.dont_write_bytecode and str(tmp_path) not in sys.path
        records = [
            json.loads(path.read_text())["inputs"] for path in (folder / ".batch").glob("*.json")
        ]
        assert len(records) == 6 and all(one == records[0] for one in records)
        assert {f"{name}.py", f"{uses}.py"} <= {path.rpartition("/")[2] for path in records[0]}


def test_imports_are_found_in_the_source(tmp_path):
    write(
        tmp_path,
        main="import math, one_\nfrom two_ import three\ndef f():\n    from pack_.inner import g\n",
        one_="import two_\n",
        two_="import main\nthree = 3\n",
        math="never = 1\n",
        unused_="",
    )
    package = tmp_path / "pack_"
    package.mkdir()
    write(
        package,
        __init__="from . import near\nfrom .inner import g\n",
        near="import json\n",
        inner="from .deep import h as g\n",
        deep="def h(",
    )
    found = imports_beside(str(tmp_path / "main.py"))
    names = {"one_", "two_", "pack_", "pack_.near", "pack_.inner", "pack_.deep"}
    assert {name for name in found if name != "main"} == names
    assert found["pack_"] == str(tmp_path / "pack_" / "__init__.py")
    assert found["pack_.deep"] == str(tmp_path / "pack_" / "deep.py")
