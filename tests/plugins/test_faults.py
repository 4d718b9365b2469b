"""Plug-ins that are broken or in each other's way: the error names them, and all else works."""

import json

import numpy as np
import pytest

import engine3d as e3d
from engine3d.apps.cli import main
from engine3d.apps.datasets.kinds import made_writer, writer_class
from engine3d.apps.scenes import load_demo
from engine3d.base.plugins import discovery
from engine3d.base.plugins.groups import GROUPS
from engine3d.base.plugins.registry import find_plugin
from engine3d.datasets import write_dataset
from engine3d.errors import PluginError

READER = """
import engine3d as e3d

def read(file):
    return e3d.box(float(file.read()))
"""
NAMED = r"demo-0 1\.2 \(entry point 'vox' of engine3d\.readers\)"


@pytest.fixture
def vox(tmp_path):
    path = tmp_path / "a.vox"
    path.write_text("2")
    return path


@pytest.mark.parametrize(
    ("code", "said"),
    [
        ("import nowhere_to_be_found", "could not be imported: No module named 'nowhere_to"),
        ("1 / 0", "could not be imported: ZeroDivisionError: division by zero"),
        ("raise SystemExit(3)", "could not be imported: SystemExit: 3"),
        ("", "could not be imported: AttributeError: module 'demo_0_.*has no attribute 'read'"),
        ("read = 3", "must be a function"),
        ("def read(file): return [1]", "returned list, not a Mesh or a Scene"),
        ("def read(file): pass", "returned nothing, not a Mesh or a Scene"),
        ("def read(file): return {}['a']", r"raised KeyError: 'a' \(demo_0_.*\.py:1\)"),
        (
            "class Mute(Exception):\n    def __str__(self): 1 / 0\ndef read(file): raise Mute",
            r"raised Mute \(demo_0_.*\.py:3\)",
        ),
        ("def read(): pass", r"raised TypeError: read\(\) takes 0 positional"),
        ("def read(file): pass\nread.up = 'Z'", "says up = 'Z': it must be one of"),
        ("def read(file): pass\nread.engine3d_api = 2", "needs the contract 2 of plug-ins, but"),
        ("def read(file): pass\nread.engine3d_api = '1'", "says engine3d_api = '1', which is no"),
        (
            "from engine3d import Mesh\ndef read(file): return Mesh([[0, 0, 0]], [[0, 1, 2]])",
            "faces holds the index 2, but there are 1 vertices",
        ),
    ],
)
def test_a_broken_reader_is_an_error_of_the_file(package, vox, tmp_path, code, said):
    package(code, readers={"vox": "{0}:read"})
    with pytest.raises(e3d.FileFormatError, match=rf"a\.vox: {NAMED}:? {said}") as told:
        e3d.load_mesh(vox)
    assert "\n" not in str(told.value)
    e3d.save_mesh(e3d.box(), tmp_path / "a.obj")
    assert len(e3d.load_mesh(tmp_path / "a.obj").faces) == 12


def test_what_a_reader_raises_on_purpose_passes(package, vox, tmp_path):
    code = "import engine3d as e3d\ndef read(file): raise e3d.FileFormatError('bad', line=3)"
    package(code, readers={"vox": "{0}:read"})
    with pytest.raises(e3d.FileFormatError) as told:
        e3d.load_mesh(vox)
    assert str(told.value) == f"{vox}:3: bad"
    package("def read(file): open('/nowhere/at/all')", readers={"vex": "{0}:read"})
    said = r"^/nowhere/at/all: demo-1 1\.2 \(.*\): cannot read: No such file"
    with pytest.raises(e3d.FileAccessError, match=said):
        e3d.load_mesh(vox.rename(tmp_path / "a.vex"))
    package("def read(file): file.open('none.png')", readers={"vix": "{0}:read"})
    with pytest.raises(e3d.FileAccessError, match=r"^none\.png: demo-2 1\.2 \(.*\): not found"):
        e3d.load_mesh((tmp_path / "a.vex").rename(tmp_path / "a.vix"))


def test_the_original_is_the_cause(package, vox):
    package("def read(file): return {}['a']", readers={"vox": "{0}:read"})
    with pytest.raises(e3d.FileFormatError) as told:
        e3d.load_mesh(vox)
    assert isinstance(told.value.__cause__, KeyError)


@pytest.mark.parametrize("status", [-1, 256, "'no'"])
def test_what_is_no_exit_status_is_an_error(package, capsys, status):
    package(f"def add(parser): return lambda args: {status}", commands={"go": "{0}:add"})
    assert main(["go"]) == 1
    assert "demo-0 1.2 (entry point 'go' of engine3d.commands) returned" in capsys.readouterr().err


def test_an_interrupt_passes(package, vox):
    package("def read(file): raise KeyboardInterrupt", readers={"vox": "{0}:read"})
    with pytest.raises(KeyboardInterrupt):
        e3d.load_mesh(vox)


def test_two_packages_for_one_name(package, vox, tmp_path, capsys):
    package(READER, readers={"vox": "{0}:read", "vix": "{0}:read"})
    package(READER, readers={"vox": "{0}:read"})
    message = r"demo-0 1\.2 .* and demo-1 1\.2 .* both add 'vox': uninstall one of them"
    with pytest.raises(PluginError, match=message):
        e3d.load_mesh(vox)
    assert e3d.load_mesh(vox.rename(tmp_path / "a.vix")).bounds[1, 0] == 1
    assert main(["plugins"]) == 1
    assert capsys.readouterr().out.count("another package adds 'vox', too") == 2


def test_of_two_versions_the_first_on_the_path_counts(package, vox):
    package(READER, name="same", version="1.0", readers={"vox": "{0}:read"})
    package(READER, name="Same", version="2.0", readers={"vox": "{0}:read"})
    assert find_plugin("readers", "vox").version == "2.0"


def test_what_ships_wins(package, tmp_path, capsys):
    package("def read(file): 1 / 0", readers={"obj": "{0}:read"}, looks={"studio": "{0}:read"})
    e3d.save_mesh(e3d.box(), tmp_path / "a.obj")
    assert len(e3d.load_mesh(tmp_path / "a.obj").faces) == 12
    e3d.render(e3d.box(), size=(8, 6), look="studio")
    assert main(["plugins"]) == 1
    assert "is never used: engine3d itself has 'obj'" in capsys.readouterr().out


BROKEN = {group: {"demo": "nowhere_to_be_found:value"} for group in GROUPS}


def test_a_package_broken_in_all_ways_breaks_nothing_else(package, tmp_path, capsys):
    package(**BROKEN)
    for arguments in (
        ["--help"],
        ["render", "--help-all"],
        ["--list-readers"],
        ["completion", "zsh"],
    ):
        assert main(arguments) == 0
    e3d.save_mesh(e3d.box(), tmp_path / "a.obj")
    out = ["-o", str(tmp_path / "a.png"), "--size", "16x12"]
    assert main(["render", str(tmp_path / "a.obj"), *out]) == 0
    capsys.readouterr()
    for arguments in (["demo"], ["render", "--scene", "demo", *out]):
        assert main(arguments) == 1
        said = capsys.readouterr().err
        assert said.startswith("engine3d: error: demo-0 1.2 (entry point 'demo' of engine3d.")
        assert "could not be imported: No module named 'nowhere_to_be_found'" in said
    assert main(["plugins", "--json"]) == 1
    report = json.loads(capsys.readouterr().out)["plugins"]
    assert len(report) == len(GROUPS) and all(one["milliseconds"] is None for one in report)


@pytest.mark.parametrize(
    "use",
    [
        lambda path: e3d.save_mesh(e3d.box(), path / "a.demo"),
        lambda path: e3d.save_scene(e3d.Scene(), path / "a.demo"),
        lambda path: e3d.render(e3d.box(), look="demo"),
        lambda path: writer_class("demo"),
    ],
)
def test_a_broken_plugin_is_named_where_it_is_used(package, tmp_path, use):
    package(**BROKEN)
    with pytest.raises(PluginError, match=r"^demo-0 1\.2 \(entry point 'demo' of engine3d\."):
        use(tmp_path)


@pytest.mark.parametrize(
    ("group", "code", "use", "said"),
    [
        (
            "looks",
            "value = 3",
            lambda: e3d.render(e3d.box(), look="demo"),
            "must be a Look",
        ),
        (
            "datasets",
            "class value: kind = 'demo'",
            lambda: writer_class("demo"),
            "must be a Data",
        ),
        (
            "datasets",
            "from engine3d.datasets import FolderWriter as value",
            lambda: writer_class("demo"),
            "has kind = 'folders'",
        ),
        (
            "writers",
            "value = 3",
            lambda: e3d.save_mesh(e3d.box(), "a.demo"),
            "must be a function",
        ),
        (
            "writers",
            "def value(scene, file): return 'lost'",
            lambda: e3d.save_mesh(e3d.box(), "a.demo"),
            "returned 'lost', not None or a list",
        ),
        *(
            ("writers", code, lambda: e3d.save_mesh(e3d.box(), "a.demo"), "returned .* not None or")
            for code in (
                "def value(scene, file): return 5",
                "def value(scene, file): return {'lost': 1}",
                "def value(scene, file): return ['lost', 1]",
                "def value(scene, file): yield 1 / 0",
            )
        ),
        ("writers", "value = max", lambda: e3d.save_mesh(e3d.box(), "a.demo"), "raised TypeError"),
    ],
)
def test_what_breaks_the_contract_is_named(package, tmp_path, monkeypatch, group, code, use, said):
    monkeypatch.chdir(tmp_path)
    package(code, **{group: {"demo": "{0}:value"}})
    with pytest.raises(PluginError, match=rf"^demo-0 1\.2 .*{said}"):
        use()
    assert not (tmp_path / "a.demo").exists()


@pytest.mark.parametrize(
    ("group", "code", "arguments", "said"),
    [
        ("scenes", "def value(): return 3", ["render", "--scene", "demo"], "returned 3, not a Sc"),
        ("scenes", "value = 3", ["render", "--scene", "demo"], "must be a function"),
        ("commands", "def value(parser): pass", ["demo"], "returned NoneType, not the func"),
        *(
            (
                "commands",
                f"def value(parser): parser.add_argument('{option}'); return print",
                ["demo"],
                f"adds {option}, which every command has",
            )
            for option in ("--quiet", "--no-plugins")
        ),
        ("commands", "def value(parser): return lambda args: {}['a']", ["demo"], "raised KeyError"),
        (
            "commands",
            "def value(parser): return lambda args: 'x'",
            ["demo"],
            "returned str, not an",
        ),
    ],
)
def test_a_command_says_what_is_wrong(package, tmp_path, capsys, group, code, arguments, said):
    package(code, **{group: {"demo": "{0}:value"}})
    out = ["-o", str(tmp_path / "a.png"), "--size", "16x12"] if len(arguments) > 1 else []
    assert main([*arguments, *out]) == 1
    assert f"of engine3d.{group}) {said}" in capsys.readouterr().err


@pytest.mark.parametrize("name", ["thing", "writer", "plugin", "scene", "files"])
def test_options_of_writers_may_have_any_name(tmp_path, name):
    """Those of the functions on the way do not get in between."""
    code = f"def value(model, file, *, {name}=1): file.write(b'%d' % {name})"
    space = {}
    exec(code, space)
    e3d.plugins.register("writers", "any", space["value"])
    try:
        e3d.save_mesh(e3d.box(), tmp_path / "a.any", **{name: 7})
    finally:
        e3d.plugins.unregister("writers", "any")
    assert (tmp_path / "a.any").read_bytes() == b"7"


def test_a_name_that_no_file_has_is_told(package, capsys):
    package("def value(file): pass", readers={"VOX": "{0}:value"})
    assert main(["plugins"]) == 1
    assert "is never used: 'VOX' is not the extension of a file in lower case" in (
        capsys.readouterr().out
    )


def test_a_programs_own_writer_has_nothing_to_do_with_a_broken_one(package):
    from engine3d.apps.datasets.kinds import plugin_of
    from engine3d.datasets import FolderWriter

    class Own(FolderWriter):
        kind = "demo"

    package(datasets={"demo": "nowhere_to_be_found:value"})
    package(datasets={"demo": "nowhere_to_be_found:value"})
    assert plugin_of(Own()) is None


@pytest.mark.parametrize("where", ["-D", "--config"])
def test_files_of_options_cannot_leave_plugins_out(tmp_path, capsys, where):
    """It would be too late: the option decides what is known when they are read."""
    path = tmp_path / "config.json"
    path.write_text('[{"options": {"no-plugins": true}}]')
    given = "no-plugins=true" if where == "-D" else str(path)
    assert main(["render", "a.obj", where, given]) != 0
    assert "there is no" in capsys.readouterr().err


def test_extensions_that_are_never_used_are_not_known(package, tmp_path):
    package(READER, readers={"VOX": "{0}:read"})
    (tmp_path / "a.vox").write_text("2")
    with pytest.raises(e3d.FileFormatError) as told:
        e3d.load_mesh(tmp_path / "a.vox")
    assert "VOX" not in str(told.value).partition("known:")[2]


@pytest.mark.filterwarnings("error::DeprecationWarning")
def test_packages_need_no_summary(package, vox):
    """Python is to raise errors of fields that metadata lack; now it warns of them."""
    folder = package(READER, readers={"vox": "{0}:read"})
    (path,) = folder.glob("*.dist-info/METADATA")
    path.write_text("Metadata-Version: 2.1\nName: demo-0\n")
    assert len(e3d.load_mesh(vox).faces) == 12
    (plugin,) = [one for one in discovery.installed_plugins() if one.name == "vox"]
    assert (plugin.package, plugin.version, plugin.about) == ("demo-0", "?", "")


def test_a_warning_that_is_an_error_of_metadata_is_told(package, vox, monkeypatch):
    def deprecated(_):
        raise DeprecationWarning("no more")

    package(READER, readers={"vox": "{0}:read"})
    monkeypatch.setattr(discovery, "_of", deprecated)
    with (
        pytest.warns(e3d.Engine3DWarning, match="left out: DeprecationWarning: no more"),
        pytest.raises(e3d.FileFormatError, match="unknown mesh format"),
    ):
        e3d.load_mesh(vox)


def test_damaged_metadata_of_a_package_is_told_and_passed_over(package, vox):
    package(READER, readers={"vox": "{0}:read"})
    folder = package(READER, readers={"vex": "{0}:read"})
    points = next(folder.glob("*.dist-info")) / "entry_points.txt"
    points.write_text("[engine3d.readers]\nno value\n")
    with pytest.warns(e3d.Engine3DWarning, match="metadata cannot be read"):
        assert len(e3d.load_mesh(vox).faces) == 12
    points.write_bytes(b"[engine3d.readers]\n\xff\xfe")
    discovery._found.cache_clear()
    with pytest.warns(e3d.Engine3DWarning, match="metadata cannot be read"):
        assert len(e3d.load_mesh(vox).faces) == 12


WRITER = """
from engine3d.datasets import DatasetWriter as Base

class value(Base):
    kind = "demo"

    def describe(self, sample): return {{}}, None

    def {method}(self, *args): {code}
"""
#: How each kind of plug-in is used, with code that runs then.
USES = {
    "readers": ("def value(file): {code}", lambda path: e3d.load(path / "a.demo")),
    "writers": ("def value(scene, file): {code}", lambda path: e3d.save_mesh(BOX, path / "b.demo")),
    "scenes": ("def value(): {code}", lambda path: load_demo("demo")),
    **{
        f"datasets-{method}": (WRITER.replace("{method}", method), use)
        for method, use in {
            "__init__": lambda path: made_writer("demo"),
            "describe": lambda path: write_dataset(path / "set", made_writer("demo"), [sample()]),
            "finish": lambda path: write_dataset(path / "set", made_writer("demo"), []),
        }.items()
    },
}
BOX = e3d.box()


def sample():
    scene = e3d.Scene()
    scene.add(BOX)
    with e3d.Renderer((8, 6)) as renderer:
        frame = renderer.render(scene)
    return e3d.datasets.Sample("a", 0, frame, scene, e3d.PerspectiveCamera(), np.eye(4), renderer)


@pytest.mark.parametrize("kind", USES)
@pytest.mark.parametrize(
    ("code", "said"),
    [
        ("import sys; sys.exit(1)", "raised SystemExit: 1"),
        ("raise SystemExit('damaged')", "raised SystemExit: damaged"),
        ("raise OSError(28, 'No space left on device')", r"raised OSError: .*No space left"),
        ("open('/nowhere/at/all')", "raised FileNotFoundError: .*No such file"),
        ("raise MemoryError", "needs more memory than there is"),
        ("1 / 0", "raised ZeroDivisionError"),
    ],
)
def test_no_plugin_ends_the_program_or_hides_behind_the_system(package, tmp_path, kind, code, said):
    """Whatever a plug-in raises, its user gets an error of engine3d that names it."""
    text, use = USES[kind]
    package(text.format(code=code), **{kind.partition("-")[0]: {"demo": "{0}:value"}})
    (tmp_path / "a.demo").write_text("x")
    wanted = PluginError
    if kind == "readers":
        is_of_system = code.startswith(("open", "raise OSError"))
        wanted = e3d.FileAccessError if is_of_system else e3d.FileFormatError
        said = said.rpartition(".*")[2] if is_of_system else said
    with pytest.raises(wanted, match=rf"demo-0 1\.2 \(entry point 'demo' of .*{said}"):
        use(tmp_path)


@pytest.mark.parametrize(
    ("code", "status", "said"),
    [
        ("raise SystemExit", 0, ""),
        ("raise SystemExit(7)", 7, ""),
        ("raise SystemExit(-1)", 255, ""),
        ("raise SystemExit('it is broken')", 1, "it is broken\n"),
    ],
)
def test_a_command_may_exit_with_a_status(package, capsys, code, status, said):
    package(f"def run(args): {code}\ndef add(parser): return run", commands={"demo": "{0}:add"})
    assert main(["demo"]) == status
    assert capsys.readouterr().err == said


def test_a_command_that_exits_as_it_adds_options_breaks_nothing_else(package, tmp_path, capsys):
    package("def add(parser): raise SystemExit(9)", commands={"demo": "{0}:add"})
    assert main(["--help"]) == 0
    assert main(["demo"]) == 1
    assert "commands) raised SystemExit: 9" in capsys.readouterr().err


def test_a_command_names_itself_in_errors_of_the_system(package, capsys):
    code = "def run(args): open('/nowhere/at/all')\ndef add(parser): return run"
    package(code, commands={"demo": "{0}:add"})
    assert main(["demo"]) == 1
    said = capsys.readouterr().err
    assert said.startswith("engine3d: error: demo-0 1.2 (entry point 'demo' of engine3d.commands)")
    assert "FileNotFoundError" in said


def test_nobody_reads_what_a_command_prints(package, capfd):
    """A closed pipe is no fault of the command."""
    code = "def run(args): raise BrokenPipeError\ndef add(parser): return run"
    package(code, commands={"demo": "{0}:add"})
    assert main(["demo"]) == 1
    assert capfd.readouterr().err == ""
