"""The GitHub Action: its shell runs here, its description names what the scripts take."""

import html
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from golden.samples import write_png
from golden.test_plugin import DRAWN, HEAD

ACTION = Path(__file__).resolve().parents[2] / ".github" / "actions" / "golden"


@pytest.fixture
def start(tmp_path):
    """Runs the action's first step in a folder; returns (process, outputs, summary)."""
    bash = shutil.which("bash") or pytest.skip("needs bash")

    def start(arguments=""):
        environment = {
            **os.environ,
            "GITHUB_ACTION_PATH": str(ACTION),
            "GITHUB_OUTPUT": str(tmp_path / "outputs"),
            "GITHUB_STEP_SUMMARY": str(tmp_path / "summary"),
            "GOLDEN_ARGUMENTS": arguments,
            "GOLDEN_FOLDER": "report folder",
            "GOLDEN_PYTHON": sys.executable,
        }
        environment.pop("CI", None)
        done = subprocess.run(
            [bash, ACTION / "test.sh"],
            cwd=tmp_path,
            env=environment,
            capture_output=True,
            text=True,
        )
        outputs = (tmp_path / "outputs").read_text() if (tmp_path / "outputs").exists() else ""
        return done, dict(line.split("=") for line in outputs.splitlines())

    return start


def test_a_difference_is_reported(start, tmp_path):
    code = (
        "def test_a(golden): golden(picture(3))\ndef test_b(golden): golden(picture(), 'x|<b>`')\n"
    )
    (tmp_path / "test_one.py").write_text(HEAD + code)
    write_png(tmp_path / "golden" / "test_one" / "test_a.png", DRAWN)
    done, outputs = start("-q -p no:cacheprovider\n-k 'test_a or test_b'")
    assert done.returncode == 0, done.stderr
    assert outputs == {"status": "1", "changed": "2"}
    files = {path.name for path in (tmp_path / "report folder").iterdir()}
    assert files == {"report.html", "golden.json", "junit.xml"}
    lines = (tmp_path / "summary").read_text().splitlines()
    assert lines[0] == "### Golden pictures: 1 changed, 1 new"
    rows = [line for line in lines if html.unescape(line).startswith("| test_one/")]
    message = "1 of 48 pixels differ by up to 3, within (3, 2) to (3, 2)"
    shown = [html.unescape(row) for row in rows]
    assert f"| test_one/test_a | changed | {message} | test_one.py::test_a |" in shown
    assert len(rows) == 2 and all(len(re.findall(r"\|", row)) == 5 for row in rows)
    assert "<b>" not in "".join(rows) and "`" not in "".join(rows)


HOSTILE = [
    "![x](https://example.org/x.png)",
    "<img src=https://example.org/x.png>",
    "https://example.org www.example.org a@example.org",
    "[a]: https://example.org",
    "` `` ``` ~~~ | || \\\\| &lt;img&gt; &#60;",
    "**a** _b_ ~c~ # d\n\n# e\r- f",
    "\u202egnp.exe\x1b[31m\0",
    "x" * 100_000,
]


@pytest.mark.parametrize("name", HOSTILE, ids=lambda name: ascii(name[:12]))
def test_names_are_text_in_the_summary(name, tmp_path):
    picture = {"name": name, "status": "changed", "message": name, "test": name}
    (tmp_path / "golden.json").write_text(json.dumps({"pictures": [picture]}))
    files = [str(tmp_path / "golden.json"), str(tmp_path / "summary.md")]
    subprocess.run([sys.executable, ACTION / "summary.py", *files], check=True)
    row = next(r for r in Path(files[1]).read_text("utf-8").splitlines() if "changed |" in r)
    cells = row.removeprefix("| ").removesuffix(" |").split(" | ")
    assert len(cells) == 4 and len(row) < 10_000
    for cell in (cells[0], *cells[2:]):
        assert re.fullmatch(r"(?:[\w /,()-]|&#[0-9]+;)*", cell) and "_" not in cell
        assert html.unescape(cell)[:20].split() == " ".join(printed(name).split())[:20].split()


def printed(text):
    return "".join(c if c.isprintable() or c.isspace() else ascii(c)[1:-1] for c in text)


@pytest.mark.parametrize("text", ["[]", "{}", "1", '{"pictures": [1]}', "[" * 100_000, ""])
def test_results_that_are_none_are_told(text, tmp_path):
    (tmp_path / "golden.json").write_text(text)
    files = [str(tmp_path / "golden.json"), str(tmp_path / "summary.md")]
    done = subprocess.run(
        [sys.executable, ACTION / "summary.py", *files], capture_output=True, text=True
    )
    assert done.returncode == 1 and done.stderr.startswith("golden: no results of pytest")
    assert not (tmp_path / "summary.md").exists()


def test_actions_are_named_by_their_commits():
    """Whoever owns a tag can move it to other code."""
    root = ACTION.parents[2]
    pages = [*root.rglob(".github/**/*.yml"), *root.glob("docs/*.md"), root / "README.md"]
    found = [
        (path.name, name)
        for path in pages
        for name in re.findall(r"uses: +(\S+)", path.read_text("utf-8"))
        if not name.startswith("./")
    ]
    assert len(found) >= 6
    assert not [one for one in found if not re.fullmatch(r"[\w/-]+@[0-9a-f]{40}", one[1])]


def test_results_of_an_earlier_run_do_not_count(start, tmp_path):
    (tmp_path / "test_one.py").write_text(HEAD + "def test_a(golden): golden(picture(3))\n")
    write_png(tmp_path / "golden" / "test_one" / "test_a.png", DRAWN)
    _, outputs = start("-q -p no:cacheprovider")
    assert outputs["changed"] == "1"
    (tmp_path / "summary").unlink()
    _, outputs = start("-q --no-such-option")
    assert outputs == {"status": "4", "changed": "0"}
    assert not (tmp_path / "summary").exists()
    assert not list((tmp_path / "report folder").iterdir())


def test_arguments_run_no_commands(start, tmp_path):
    done, outputs = start("--version $(touch a) `touch b` ; touch c")
    assert outputs["changed"] == "0" and outputs["status"] != ""
    assert not {"a", "b", "c"} & {path.name for path in tmp_path.iterdir()}
    done, outputs = start("'not closed")
    assert done.returncode == 2 and "cannot read the arguments" in done.stderr


@pytest.mark.parametrize(
    "typed, words",
    [
        ("", []),
        (" \n", []),
        ("-k '' -m ''", ["-k", "", "-m", ""]),
        (
            "-q\n'a\nb' \"$(c) ~\" x=* {1,2} \\; '\n'",
            ["-q", "a\nb", "$(c) ~", "x=*", "{1,2}", ";", "\n"],
        ),
    ],
)
def test_arguments_are_words_as_typed(start, tmp_path, monkeypatch, typed, words):
    (tmp_path / "pytest.py").write_text("import sys\nprint(ascii(sys.argv[4:]))\n")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    done, _ = start(typed)
    assert done.stdout == f"{words!a}\n"


def test_the_description_names_what_the_scripts_take():
    text = (ACTION / "action.yml").read_text("utf-8")
    inputs = set(re.findall(r"inputs\.(\w+)", text))
    declared = text[text.index("inputs:") : text.index("outputs:")]
    assert set(re.findall(r"^  (\w+):$", declared, re.M)) == inputs
    variables = set(re.findall(r"(GOLDEN_\w+):", text)) - {"GOLDEN_STATUS"}
    assert variables == set(re.findall(r"GOLDEN_\w+", (ACTION / "test.sh").read_text("utf-8")))
    assert set(re.findall(r"outputs\.(\w+)", text)) == {"status", "changed"}


def test_the_page_names_every_input():
    page = (ACTION.parents[2] / "docs" / "golden.md").read_text("utf-8")
    text = (ACTION / "action.yml").read_text("utf-8")
    for name in {*re.findall(r"inputs\.(\w+)", text), "status", "changed"}:
        assert f"`{name}`" in page
