"""The GitHub Action that shows what a change does to models: its step runs on a repository."""

import html
import importlib
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import engine3d as e3d
from engine3d.base.files.portable_names import fault_of

ACTION = Path(__file__).resolve().parents[2] / ".github" / "actions" / "models"
SIZE = (96, 64)

pytestmark = [
    pytest.mark.skipif(shutil.which("git") is None, reason="needs git"),
    pytest.mark.skipif(shutil.which("bash") is None, reason="needs bash"),
]


class Repository:
    """A repository in a folder, and what the action says of its last commit."""

    def __init__(self, folder):
        self.folder = folder / "repository"
        self.folder.mkdir()
        self.outside = folder
        self.git("init", "--quiet")

    def git(self, *words):
        who = ["-c", "user.name=a", "-c", "user.email=a@example.org"]
        command = ["git", *who, *words]
        done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, check=True)
        return done.stdout.strip()

    def commit(self):
        self.git("add", "--all")
        self.git("commit", "--quiet", "--allow-empty", "--message", "a")
        return self.git("rev-parse", "HEAD")

    def write(self, name, mesh):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        if isinstance(mesh, (str, bytes)):
            path.write_bytes(mesh.encode() if isinstance(mesh, str) else mesh)
        else:
            mesh.save(path)

    def run(self, base, patterns="", folder="../a folder"):
        environment = {
            **os.environ,
            "GITHUB_ACTION_PATH": str(ACTION),
            "GITHUB_OUTPUT": str(self.outside / "outputs"),
            "GITHUB_STEP_SUMMARY": str(self.outside / "summary"),
            "MODELS_BASE": base,
            "MODELS_PATTERNS": patterns,
            "MODELS_SIZE": "{}x{}".format(*SIZE),
            "MODELS_FOLDER": folder,
            "MODELS_PYTHON": sys.executable,
        }
        command = ["bash", ACTION / "draw.sh"]
        return subprocess.run(
            command, cwd=self.folder, env=environment, capture_output=True, text=True
        )

    def told(self, base, patterns=""):
        """Return the outputs, the models by name, and the rows of the summary."""
        done = self.run(base, patterns)
        assert done.returncode == 0, done.stderr
        outputs = dict(line.split("=") for line in (self.outside / "outputs").open())
        content = json.loads((self.outside / "a folder" / "models.json").read_text("utf-8"))
        models = {model["name"]: model for model in content["models"]}
        lines = (self.outside / "summary").read_text("utf-8").splitlines()
        rows = [html.unescape(line) for line in lines if line.startswith("| ")][1:]
        return {name: int(value) for name, value in outputs.items()}, models, rows

    def picture(self, side, name):
        with Image.open(self.outside / "a folder" / side / f"{name}.png") as picture:
            return np.asarray(picture.convert("RGB")).astype(int)


@pytest.fixture
def repository(tmp_path):
    return Repository(tmp_path)


TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nmtllib a.mtl\nusemtl a\nf 1 2 3\n"

TEXTURED = (
    "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3\n"
)


def test_each_change_of_a_model_is_told(repository):
    repository.write("parts/grown.ply", e3d.box((1, 1, 1)))
    repository.write("parts/gone.ply", e3d.box())
    repository.write("parts/kept.ply", e3d.box())
    repository.write("broken.ply", e3d.box())
    repository.write("painted/a.obj", TRIANGLE)
    repository.write("painted/a.mtl", "newmtl a\nKd 1 0 0\n")
    base = repository.commit()
    repository.write("parts/grown.ply", e3d.box((1, 1, 3)))
    (repository.folder / "parts" / "gone.ply").unlink()
    repository.write("new.ply", e3d.torus())
    repository.write("broken.ply", b"ply\nnonsense\n")
    repository.write("painted/a.mtl", "newmtl a\nKd 0 0 1\n")
    repository.commit()
    outputs, models, rows = repository.told(base)
    assert outputs == {"changed": 5, "broken": 1}
    assert {name: model["status"] for name, model in models.items()} == {
        "broken.ply": "broken",
        "new.ply": "new",
        "painted/a.obj": "changed",
        "parts/gone.ply": "gone",
        "parts/grown.ply": "changed",
    }
    grown = models["parts/grown.ply"]
    assert (grown["before"]["volume"], grown["after"]["volume"]) == (1.0, 3.0)
    assert grown["after"]["size"] == [1.0, 1.0, 3.0] and grown["deviation"] == 1.0
    assert "| parts/grown.ply | changed | 12 | 1 x 1 x 1 → 1 x 1 x 3 | 1 → 3 | 1 |" in rows
    assert models["painted/a.obj"]["deviation"] == 0.0
    assert models["broken.ply"]["after"]["error"] == "the header has no end_header"
    # One camera: the box before the change is not as large as it could be alone.
    before, after = (repository.picture(side, "parts/grown.ply") for side in ("before", "after"))
    alone = e3d.render(e3d.box((1, 1, 1)), size=SIZE).color[..., :3].astype(int)
    assert before.shape == after.shape == (SIZE[1], SIZE[0], 3)
    assert area(before) < 0.6 * min(area(after), area(alone))
    red, blue = (repository.picture(side, "painted/a.obj") for side in ("before", "after"))
    assert (red[..., 0] - red[..., 2]).max() > 100 < (blue[..., 2] - blue[..., 0]).max()
    assert repository.picture("different", "painted/a.obj").shape == before.shape
    assert (repository.outside / "a folder" / "report.html").stat().st_size > 1000
    with Image.open(repository.outside / "a folder" / "models.png") as page:
        assert page.width > 3 * SIZE[0] and page.height > 5 * SIZE[1]
    # The working tree of the base is gone again.
    assert len(repository.git("worktree", "list").splitlines()) == 1


def test_files_that_moved_are_gone_from_where_they_were(repository):
    repository.write("old.obj", e3d.uv_sphere(0.7))
    repository.write("a/x.obj", TEXTURED)
    repository.write("a/a.mtl", "newmtl a\nmap_Kd t.png\n")
    (repository.folder / "b").mkdir()
    Image.new("RGB", (8, 8), (255, 0, 0)).save(repository.folder / "a" / "t.png")
    base = repository.commit()
    repository.git("mv", "old.obj", "b/new.obj")
    repository.git("mv", "a/t.png", "b/t.png")
    repository.commit()
    _, models, rows = repository.told(base)
    assert rows[0] == "| a/x.obj | changed: the picture alone | 1 | 1 x 1 x 0 |  | 0 |"
    summary = html.unescape((repository.outside / "summary").read_text("utf-8"))
    assert "\n\na/x.obj: a/a.mtl:2: texture 't.png': not found\n" in summary
    assert {name: model["status"] for name, model in models.items()} == {
        "a/x.obj": "changed",
        "b/new.obj": "new",
        "old.obj": "gone",
    }


def area(pixels):
    """How many pixels stand out from the corner's."""
    return int((np.abs(pixels - pixels[0, 0]).max(axis=-1) > 40).sum())


def triangle_to(x):
    """Return a PLY file of a triangle with a corner at `x`."""
    lists = "property list uchar int vertex_indices"
    axes = "".join(f"property float {axis}\n" for axis in "xyz")
    head = f"ply\nformat ascii 1.0\nelement vertex 3\n{axes}element face 1\n{lists}\nend_header\n"
    return f"{head}0 0 0\n{x} 0 0\n0 1 0\n3 0 1 2\n"


def test_no_model_ends_the_comparison_of_the_others(repository):
    for name, x in (("nan.ply", 1), ("was_huge.ply", "1e38"), ("z.ply", 1), ("pointer.ply", 1)):
        repository.write(name, triangle_to(x))
    repository.write("was_empty.ply", "")
    base = repository.commit()
    for name, x in (("nan.ply", "nan"), ("was_huge.ply", 1), ("z.ply", 2), ("was_empty.ply", 1)):
        repository.write(name, triangle_to(x))
    repository.write("pointer.ply", "version https://git-lfs.github.com/spec/v1\noid sha256:0\n")
    repository.commit()
    outputs, models, rows = repository.told(base)
    assert outputs == {"changed": 5, "broken": 1}
    assert models["nan.ply"]["deviation"] is None and models["z.ply"]["deviation"] > 0.5
    assert "not finite" in models["nan.ply"]["after"]["warnings"][0]
    told = {row.split(" | ")[0].removeprefix("| "): row.split(" | ")[1] for row in rows}
    assert told == {
        "nan.ply": "changed",
        "pointer.ply": "broken: a pointer of Git LFS: check out with lfs: true",
        "was_empty.ply": "changed: could not be shown before: "
        "line 1: not a PLY file: the first line is not 'ply'",
        "was_huge.ply": "changed",
        "z.ply": "changed",
    }


def test_nothing_is_told_where_no_model_differs(repository):
    repository.write("a.ply", e3d.box())
    base = repository.commit()
    repository.write("readme.txt", "text")
    repository.commit()
    outputs, models, rows = repository.told(base)
    assert (outputs, models, rows) == ({"changed": 0, "broken": 0}, {}, [])
    assert "none differs" in (repository.outside / "summary").read_text("utf-8")


def test_pictures_of_an_earlier_run_do_not_stay(repository):
    base = repository.commit()
    repository.write("a.ply", e3d.box())
    first = repository.commit()
    repository.told(base)
    folder = repository.outside / "a folder"
    (folder / "mine.txt").touch()
    repository.told(first)
    left = {path.relative_to(folder).as_posix() for path in folder.rglob("*")}
    assert left == {"models.json", "mine.txt", "before", "after"}


def test_a_file_written_anew_that_shows_the_same_is_no_change(repository):
    repository.write("painted/a.obj", TRIANGLE)
    repository.write("painted/a.mtl", "newmtl a\nKd 1 0 0\n")
    base = repository.commit()
    repository.write("painted/a.obj", f"# a comment\n{TRIANGLE}")
    repository.write("painted/a.mtl", "# another\nnewmtl a\nKd 1 0 0\n")
    repository.commit()
    outputs, models, _ = repository.told(base)
    assert outputs == {"changed": 0, "broken": 0} and models == {}


def module_of_action(name, monkeypatch):
    monkeypatch.syspath_prepend(ACTION)
    return importlib.import_module(name)


def test_rounding_sets_no_surfaces_apart(tmp_path, monkeypatch):
    module = module_of_action("drawn_model", monkeypatch)
    e3d.torus().save(tmp_path / "a.ply")
    side = module.read(tmp_path / "a.ply")
    assert 0 < e3d.measuring.hausdorff(side.scene, side.scene).distance < 1e-15
    assert module.deviation(side, side) == 0


def test_patterns_choose_the_models(repository, monkeypatch):
    for name in ("one/a.ply", "two/a.ply", "two/deep/b.ply", "two/deep/c.stl", "two/text.txt"):
        repository.write(name, "")
    base = repository.commit()
    monkeypatch.chdir(repository.folder)
    module = module_of_action("changed_models", monkeypatch)
    two = {"two/a.ply", "two/deep/b.ply"}
    for patterns, expected in (
        (["two/**/*.ply"], two),
        (["two/*.ply"], {"two/a.ply"}),
        (["*/a.ply", "two/deep/b.ply", "!one/*"], two),
        ([":(exclude)*.stl", ":!one"], two),
        ([":/!one", "!**/*.stl"], two),
        (["!**/*.ply"], {"two/deep/c.stl"}),
        ([], {"one/a.ply", "two/deep/c.stl", *two}),
        (["**/*.txt"], {"two/text.txt"}),
    ):
        named = module.named_models(base, patterns)
        assert {name for names in named.values() for name in names} == expected
    for pattern in ("/two/*.ply", "../x.ply", ":(nonsense)x"):
        with pytest.raises(SystemExit, match="models: git refuses"):
            module.named_models(base, [pattern])


def test_nothing_is_written_where_files_of_the_repository_are(repository):
    repository.write("model-diff/models.json", "{}")
    repository.write("model-diff/before/kept.txt", "")
    os.symlink(repository.outside, repository.folder / "linked")
    base = repository.commit()
    for folder in ("model-diff", ".", "linked", "linked/out"):
        done = repository.run(base, folder=folder)
        assert done.returncode == 1 and "models: name another folder" in done.stderr
    assert (repository.folder / "model-diff/before/kept.txt").exists()


def test_a_pattern_without_files_is_told(repository):
    base = repository.commit()
    for name in ("one/a.ply", "two/a.ply"):
        repository.write(name, e3d.box())
    repository.commit()
    _, models, _ = repository.told(base, "two/**/*.ply\r\n\nthree/*.ply\n")
    assert set(models) == {"two/a.ply"}
    summary = html.unescape((repository.outside / "summary").read_text("utf-8"))
    assert "No file is named by the pattern three/*.ply." in summary and "two/**" not in summary


def test_names_and_links_do_no_harm(repository):
    name = "![x](https:$(touch b)`touch c`|<b> \u202e.ply"
    base = repository.commit()
    repository.write(name, e3d.box())
    repository.write("-o.ply", e3d.box())
    repository.write(f" /{'a' * 251}.ply", e3d.box())
    secret = repository.outside / "secret.ply"
    e3d.box().save(secret)
    (repository.folder / "link.ply").symlink_to(secret)
    repository.commit()
    outputs, models, _ = repository.told(base)
    assert outputs["changed"] == 3
    assert {name.encode("ascii", "backslashreplace").decode(), "-o.ply"} < set(models)
    pictures = [path.name for path in (repository.outside / "a folder").rglob("*.png")]
    assert len(pictures) == 3 + 1  # and all in one
    assert not [one for one in pictures if fault_of(one) or len(one) > 200]
    summary = (repository.outside / "summary").read_text("utf-8")
    assert "<b>" not in summary and "![" not in summary and "`" not in summary
    assert not {"b", "c"} & {path.name for path in repository.folder.iterdir()}


@pytest.mark.parametrize(
    "base", ["", "0" * 40, "no-such", "a:b", "--upload-pack=x", "origin/--upload-pack=x"]
)
def test_without_a_commit_the_action_says_so(repository, base):
    repository.commit()
    done = repository.run(base)
    assert done.returncode == 2 and "models: no commit to compare with" in done.stderr


@pytest.mark.parametrize("named", ["hash", "origin/trunk", ""])
def test_the_base_is_fetched_where_a_checkout_holds_one_commit(repository, tmp_path, named):
    """Without a name it is the default branch, which is the trunk here."""
    repository.git("checkout", "--quiet", "-b", "trunk")
    repository.write("a.ply", e3d.box())
    base = repository.commit()
    repository.git("checkout", "--quiet", "-b", "topic")
    repository.write("a.ply", e3d.torus())
    repository.commit()
    repository.git("checkout", "--quiet", "trunk")
    repository.git("config", "uploadpack.allowAnySHA1InWant", "true")
    origin = repository.folder.rename(tmp_path / "origin")
    command = ["git", "clone", "--quiet", "--depth=1", "--branch=topic", origin.as_uri()]
    subprocess.run([*command, repository.folder], check=True)
    outputs, models, _ = repository.told(base if named == "hash" else named)
    assert outputs["changed"] == 1 and set(models) == {"a.ply"}


def test_the_description_names_what_the_script_takes():
    text = (ACTION / "action.yml").read_text("utf-8")
    declared = text[text.index("inputs:") : text.index("outputs:")]
    assert {*re.findall(r"^  (\w+):$", declared, re.M)} == {*re.findall(r"inputs\.(\w+)", text)}
    taken = set(re.findall(r"MODELS_\w+", (ACTION / "draw.sh").read_text("utf-8")))
    assert set(re.findall(r"(MODELS_\w+):", text)) == taken
    page = (ACTION.parents[2] / "docs" / "golden.md").read_text("utf-8")
    for name in {*re.findall(r"(?:inputs|outputs)\.(\w+)", text)}:
        assert f"`{name}`" in page
