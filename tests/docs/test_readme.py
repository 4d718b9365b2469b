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


def key_table():
    """The keys of the viewer, in two columns."""
    half = -(-len(BINDINGS) // 2)
    cells = [f"| {' '.join(binding.keys)} | {binding.help} |" for binding in BINDINGS]
    cells += ["| | |"] * (2 * half - len(cells))
    return [left + right[1:] for left, right in zip(cells[:half], cells[half:], strict=True)]


def test_python_examples_run(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    names = {}
    for number, block in enumerate(blocks("python")):
        exec(compile(block, f"README.md, example {number + 1}", "exec"), names)
    assert (tmp_path / "island.png").stat().st_size > 10_000
    assert 0.1 < names["pixels_of_island"].mean() < 0.9
    assert (names["seen"].face_id == 0).any()


@pytest.mark.parametrize("arguments", commands(), ids=" ".join)
def test_commands_parse(arguments):
    make_parser().parse_args(arguments)


def test_the_first_commands_install_and_run():
    assert [block.strip() for block in blocks("sh")[:2]] == [
        "pip install . && engine3d run",
        'pip install -e ".[test]" && pytest -n 3 --dist loadfile',
    ]


def test_keys_are_those_of_the_viewer():
    lines = (ROOT / "README.md").read_text(encoding="utf-8").splitlines()
    expected = key_table()
    missing = [row for row in expected if row not in lines]
    assert not missing, "README.md should have these rows:\n" + "\n".join(expected)


def test_scenes_are_those_of_the_command_line():
    lines = (ROOT / "docs" / "viewer.md").read_text(encoding="utf-8").splitlines()
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
    table = text[text.index("## what it reads") : text.index("## exactness")]
    for reader in formats():
        assert reader.name in table, f"README.md does not mention {reader.description}"
