"""README.md tells the truth: its Python runs, its commands parse, its tables hold."""

import re
import shlex
from pathlib import Path

import pytest

from engine3d.apps.cli.parser import make_parser
from engine3d.apps.scenes import DEMO_NAMES, SCENES
from engine3d.apps.viewer.keymap import BINDINGS
from engine3d.base.image_size import MAX_SIZE
from engine3d.io.formats.images import MAX_PIXELS
from engine3d.loaders import formats
from engine3d.model.materials.textures import MAX_SIDE

ROOT = Path(__file__).resolve().parents[2]


def blocks(language):
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    return re.findall(rf"^```{language}\n(.*?)^```", text, re.MULTILINE | re.DOTALL)


def commands():
    """The engine3d commands of the shell blocks, without comments and pipes."""
    lines = [line for block in blocks("sh") for line in block.splitlines()]
    words = [shlex.split(line, comments=True) for line in lines if line.startswith("engine3d")]
    return [line[1 : line.index("|")] if "|" in line else line[1:] for line in words]


def test_python_examples_run(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    names = {}
    for number, block in enumerate(blocks("python")):
        exec(compile(block, f"README.md, example {number + 1}", "exec"), names)
    assert (tmp_path / "island.png").stat().st_size > 10_000
    assert 0.1 < names["pixels_of_island"].mean() < 0.9


@pytest.mark.parametrize("arguments", commands(), ids=" ".join)
def test_commands_parse(arguments):
    make_parser().parse_args(arguments)


def test_readme_is_short():
    assert (ROOT / "README.md").read_text(encoding="utf-8").count("\n") <= 130


def test_the_first_commands_install_and_run():
    assert [block.strip() for block in blocks("sh")[:2]] == [
        "pip install . && engine3d run",
        'pip install -e ".[test]" && pytest -n 3 --dist loadfile',
    ]


def test_the_page_of_the_viewer_has_all_keys():
    text = (ROOT / "docs" / "viewer" / "keys.md").read_text(encoding="utf-8")
    tables = re.findall(r"^\| Key \| What it does \|\n.*\n((?:\|.*\n)+)", text, re.MULTILINE)
    rows = [row for table in tables for row in table.splitlines()]
    listed = {key for row in rows for key in row.split(" | ")[0].removeprefix("| ").split()}
    assert {key for binding in BINDINGS for key in binding.keys} <= listed


def test_scenes_are_those_of_the_command_line():
    lines = (ROOT / "docs" / "viewer" / "index.md").read_text(encoding="utf-8").splitlines()
    start = lines.index("| `--scene` | What it shows |") + 2
    expected = [f"| `{name}` | {SCENES[name].about} |" for name in DEMO_NAMES]
    assert lines[start : start + len(expected) + 1] == [*expected, ""]


def test_limits_are_those_of_the_code():
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    assert f"Frames of 1 to {MAX_SIZE} pixels a side, textures of up to {MAX_SIDE};" in text
    text = (ROOT / "docs" / "formats.md").read_text(encoding="utf-8")
    assert f"at most {MAX_PIXELS:,} pixels" in text
    assert f"sides\n  of at most {MAX_SIDE:,};" in text


def test_formats_are_those_of_the_loaders():
    text = (ROOT / "README.md").read_text(encoding="utf-8").lower()
    table = text[text.index("## what it reads") : text.index("## limits")]
    for reader in formats():
        assert reader.name in table, f"README.md does not mention {reader.description}"
