"""``--root``: files that models name may come from a folder that the user names, too."""

import json

import pytest
from PIL import Image

from engine3d.apps.cli import main
from engine3d.batch import read_manifest, run

SIZE = ("--size", "32x24")


@pytest.fixture
def model(tmp_path):
    """A model whose image is in a sibling folder."""
    (tmp_path / "images").mkdir()
    (tmp_path / "models").mkdir()
    Image.new("RGB", (2, 2), (255, 0, 0)).save(tmp_path / "images" / "a.png")
    (tmp_path / "models" / "a.mtl").write_text("newmtl m\nmap_Kd ../images/a.png\n")
    path = tmp_path / "models" / "a.obj"
    path.write_text("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n")
    return path


COMMANDS = {
    "render": lambda path, out: ["render", path, "-o", f"{out}/a.png", *SIZE],
    "run": lambda path, out: [
        "run",
        path,
        "--headless",
        "--frames",
        "1",
        "-o",
        f"{out}/a.png",
        *SIZE,
    ],
    "sheet": lambda path, out: ["sheet", path, "-o", f"{out}/a.png", "--size", "400x300"],
    "convert": lambda path, out: ["convert", path, f"{out}/a.glb"],
    "info": lambda path, out: ["info", path],
}


@pytest.mark.parametrize("command", COMMANDS)
def test_commands(model, tmp_path, capsys, command):
    arguments = COMMANDS[command](str(model), str(tmp_path))
    assert main(arguments) == 0
    said = capsys.readouterr()
    if command != "sheet":  # whose report has it
        assert "refused; root=FOLDER allows another" in said.err + said.out
    assert main([*arguments, "--root", str(tmp_path)]) == 0
    said = capsys.readouterr()
    assert "refused" not in said.err + said.out


def test_pictures_are_textured(model, tmp_path):
    shown = []
    for options in ([], ["--root", str(tmp_path)]):
        path = tmp_path / "b.png"
        assert main(["render", str(model), "-o", str(path), "--unlit", *SIZE, *options]) == 0
        with Image.open(path) as picture:
            shown.append(picture.convert("RGB").getpixel((14, 14)))
    assert shown[0] != shown[1] and shown[1][0] > 200 > 60 > shown[1][1]


def test_a_root_that_is_none(model, capsys):
    assert main(["info", str(model), "--root", "none"]) == 1
    assert capsys.readouterr().err == "engine3d: error: none: root: there is no such folder\n"


@pytest.mark.parametrize("look", ["", "plain"])
@pytest.mark.filterwarnings("ignore")
def test_manifests(model, tmp_path, look):
    task = {"model": "models/a.obj", "size": [32, 24], **({"look": look} if look else {})}
    hashes = set()
    for root in (None, "."):
        path = tmp_path / "m.json"
        said = {**task, "name": "a", **({"root": root} if root else {})}
        path.write_text(json.dumps({"version": 1, "tasks": [said]}))
        summary = run(read_manifest(path).tasks, tmp_path / f"out{root is None}", jobs=1)
        assert summary.drawn == 1
        hashes.add(summary.hash)
    assert len(hashes) == 2
