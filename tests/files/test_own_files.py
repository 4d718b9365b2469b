"""What engine3d writes and reads again: damaged in whatever way, it ends in no traceback."""

import ast
import json
from pathlib import Path

import pytest

pytest.importorskip("resource", reason="FIFOs and alarms are POSIX's")
from files.json_damage import DEPTH
from files.own_files import KINDS, Batch, try_kind

import engine3d as e3d
from engine3d.apps.desktop.recent_files import RecentFiles
from engine3d.apps.golden.result_files import read_json
from engine3d.base.files import json_records
from engine3d.datasets import CocoWriter
from engine3d.errors import FileAccessError, FileFormatError

ENGINE = Path(e3d.__file__).parent
#: Modules that write JSON: which of `KINDS` reads it again, or why nothing does.
WRITERS = {
    "apps/agents/server.py": "answers of a protocol",
    "apps/batch/bytes_of.py": "what scripts want beside their pictures",
    "apps/batch/task.py": "for a hash",
    "apps/cli/commands/bench.py": "for people and programs",
    "apps/cli/commands/info.py": "for people and programs",
    "apps/cli/commands/plugins.py": "for people and programs",
    "apps/datasets/bop_models.py": "bop-shapes",
    "apps/datasets/folders.py": "the data set itself",
    "apps/datasets/writer.py": "the data set itself",
    "apps/editor/autosave.py": "copies",
    "apps/desktop/recent_files.py": "recent",
    "base/files/json_records.py": "batch-plain",
    "compat/open3d/view_control.py": "what Open3D's programs keep of a view",
    "apps/golden/golden_files.py": "golden",
    "apps/golden/result_files.py": "results",
    "apps/learn/page_html.py": "for the script of a page",
    "apps/sheet/report.py": "for people and programs",
    "io/formats/gltf/gltf_writer.py": "gltf",
    "io/writing/scene_saving.py": "scene",
}
#: Modules that read JSON without `json_records`, and why.
READERS = {
    "apps/batch/task.py": "what it just wrote, in memory",
    "base/files/json_records.py": "the one place",
    "compat/open3d/render_option.py": "files of Open3D, whose errors it raises",
    "compat/open3d/view_control.py": "a text, in memory, as Open3D writes it",
    "io/formats/gltf/gltf_file.py": "files of others, with errors of its own",
}
COUNTS = {"golden": 60, "results": 100, "copies": 100, "recent": 60, "config": 10}
COUNTS |= {"scene": 60, "gltf": 60, "manifest": 100}


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.filterwarnings("ignore::engine3d.Engine3DWarning")
def test_damaged_files_are_told_or_done_without(kind, tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    counts, findings = try_kind(kind, tmp_path / "files", 7, COUNTS.get(kind, 4))
    assert not findings
    assert not {"finding", "slow"} & set(counts)


def test_every_writer_and_reader_of_json_is_known():
    found = {"dumps": set(), "loads": set()}
    for path in ENGINE.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.Attribute) and getattr(node.value, "id", "") == "json":
                name = {"dump": "dumps", "load": "loads"}.get(node.attr, node.attr)
                found.get(name, set()).add(path.relative_to(ENGINE).as_posix())
    assert found == {"dumps": set(WRITERS), "loads": set(READERS)}
    assert {said for said in WRITERS.values() if " " not in said} <= set(KINDS)


@pytest.mark.parametrize("text", ["[]", "{}", "1", "[" * DEPTH, "", '{"seal":"","key":1}'])
def test_a_damaged_record_is_named_and_its_picture_drawn_again(text, tmp_path):
    case = Batch(tmp_path, CocoWriter(), ".batch/p0.json")
    (path,) = case._files
    path.write_text(text)
    told = r"\.batch[/\\]p0\.json.*: the picture is drawn again"
    with pytest.warns(e3d.Engine3DWarning, match=told):
        assert case._run(True) == case._hash
    assert path.read_bytes() == case._files[path]


def test_a_letter_that_was_changed_does_not_fit_the_seal(tmp_path):
    path = tmp_path / "a.json"
    path.write_bytes(json_records.sealed({"number": 1}))
    assert json_records.read_sealed(path, json_records.anything) == {"number": 1}
    path.write_bytes(path.read_bytes().replace(b":1", b":2"))
    with pytest.raises(FileFormatError, match=r"a\.json: damaged: its content"):
        json_records.read_sealed(path, json_records.anything)


def test_errors_name_file_and_place(tmp_path):
    path = tmp_path / "results.json"
    whole = {"name": "a", "status": "passed"}
    path.write_text(json.dumps({"pictures": [whole, {**whole, "name": 1}]}))
    with pytest.raises(FileFormatError, match=r"results\.json: pictures\[1\]\.name: not what"):
        read_json(str(path))


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ('{"a": 1, "a": 2}', "an object has 'a' twice"),
        ("[NaN]", "NaN is no number of JSON"),
        ("[" * DEPTH, "nested too deeply"),
        ("[\n1,]", ":2: not JSON"),
        ("1" * 5000, "not JSON"),
        (b'"\xe9"', "not in UTF-8"),
        ("[1e999]", r"\[0\]: not what"),
    ],
)
def test_texts_that_are_no_json(text, told):
    with pytest.raises(FileFormatError, match=told):
        json_records.parsed(text, "a.json", json_records.listed(json_records.number))


def test_what_is_no_file_is_not_waited_for(tmp_path):
    import os

    os.mkfifo(tmp_path / "fifo")
    for path in (tmp_path, tmp_path / "fifo", tmp_path / "none", "a\0b"):
        with pytest.raises(FileAccessError):
            json_records.read_json(path)


def test_a_damaged_list_of_recent_files_is_told(tmp_path):
    path = tmp_path / "recent.json"
    path.write_text('{"a": 1}')
    with pytest.warns(e3d.Engine3DWarning, match=r"recent\.json: .* begins anew"):
        assert RecentFiles(path).paths() == ()
