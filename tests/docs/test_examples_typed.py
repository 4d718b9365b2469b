"""Type checkers accept the Python of README.md and docs/, and know what the API takes and returns.

An editable install is found by import hooks, which type checkers don't run: they are shown a folder
in which the package lies under its name.
"""

import json
import re
import shutil
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest
from page_extras import missing_extra

import engine3d

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = [ROOT / "docs", ROOT / "docs" / "tutorials", ROOT / "docs" / "viewer"]
PAGES = [ROOT / "README.md", *(page for each in FOLDERS for page in sorted(each.glob("*.md")))]
EXAMPLES = sorted((ROOT / "docs").rglob("examples/*.py"))

# What editors and checkers are to know.
RIGHT = """
from importlib.resources import files
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

import engine3d as e3d
from engine3d.choices import Mode

if TYPE_CHECKING:
    from typing_extensions import assert_type

mesh = e3d.load_mesh(files("engine3d.data") / "models" / "teapot.obj")
mesh.faces = [(0, 1, 2)]
mesh.normals = None
mesh.materials[0].color = np.array([255, 0, 0], np.uint8)
assert_type(mesh.positions, NDArray[np.float32])
assert_type(mesh.faces, NDArray[np.int32])
assert_type(mesh.normals, NDArray[np.float32])
assert_type(mesh.uvs, NDArray[np.float32] | None)
assert_type(mesh.edge_visible, NDArray[np.bool_] | None)
assert_type(mesh.bounds, NDArray[np.float64])
texture = e3d.Texture(np.zeros((4, 4, 3), np.uint8), filter="bilinear")
texture.wrap = "mirror"
assert_type(texture.filter, Literal["trilinear", "bilinear", "nearest"])
assert_type(texture.pixels, NDArray[np.uint8])
material = e3d.Material(color=(1, 0, 0), roughness=0.5, texture=texture, alpha_mode="mask")
material.texture = e3d.PlacedTexture(texture, uv_set=1)
assert_type(material.roughness, float | None)
assert_type(material.iridescence_ior, float)
light = e3d.DirectionalLight(direction=(0, -1, 0))
light.direction = [0, 0, -1]
assert_type(light.direction, NDArray[np.float64])
assert_type(light.intensity, float)
scene = e3d.Scene(background=None)
node = scene.add(mesh, translation=(0, 1, 0), scale=2.0)
node.translation = np.zeros(3)
assert_type(node.world_pose, NDArray[np.float64])
camera = e3d.PerspectiveCamera()
assert_type(camera.zfar, float)
assert_type(camera.aspect, float | None)
scene.add(camera, pose=e3d.look_at((0, 0, 5), (0, 0, 0)))
mode: Mode = "depth"
scene.add().object = mesh
frame = e3d.render(scene, size=(64, 48), mode=mode, cull="none", outputs=("color", "depth"))
assert_type(frame.color, NDArray[np.uint8])
assert_type(frame.depth, NDArray[np.float32])
assert_type(frame.object_id, NDArray[np.int32])
assert_type(frame.stats, dict[str, Any])
hit = scene.raycast((0, 0, 5), (0, 0, -1))
if hit is not None:
    assert_type(hit.position, NDArray[np.float64])
assert_type(e3d.linalg.sin(0.5), float)
for backend in e3d.backends():
    e3d.Renderer((64, 48), backend=backend)
"""
# Each line is wrong.
WRONG = """
e3d.render(scene, mode="lti")
e3d.render(scene, wirefame="only")
e3d.Renderer((64, 48), backend="cuda")
e3d.Renderer((64, 48), samples=3)
e3d.Renderer((64, 48)).render(scene, outputs=("colour",))
e3d.Texture(mesh.positions, filter="linear")
e3d.Material(alpha_mode="glass")
e3d.Material(roughness="rough")
e3d.Material(colour=(1, 0, 0))
e3d.Material((1, 0, 0))
e3d.PointLight(falloff="linear")
e3d.load_texture("a.png", wrap="tile")
texture.filter = "linear"
node.object = "box"
mesh.nonsense = 1
e3d.load_mesh(3)
"""


def blocks(page):
    """The Python of a page, on the lines where it stands there."""
    lines, inside = [], False
    for line in page.read_text(encoding="utf-8").splitlines():
        if line.startswith("```"):
            inside = line == "```python"
            line = "```"
        lines.append(line if inside and line != "```" else "")
    return "\n".join(lines) + "\n"


@pytest.fixture(scope="module")
def sources(tmp_path_factory):
    """A folder of what is to be checked, with the package beside it."""
    folder = tmp_path_factory.mktemp("typed")
    (folder / "packages").mkdir()
    (folder / "packages" / "engine3d").symlink_to(Path(engine3d.__file__).parent)
    for page in PAGES:
        text = blocks(page)
        if missing_extra(text):
            continue
        if text.strip():
            name = "_".join(page.relative_to(ROOT).with_suffix("").parts)
            (folder / f"{name}_md.py").write_text(text, encoding="utf-8")
    for example in EXAMPLES:
        shutil.copy(example, folder)
    (folder / "right.py").write_text(RIGHT, encoding="utf-8")
    (folder / "wrong.py").write_text(RIGHT + WRONG, encoding="utf-8")
    options = {"extraPaths": ["packages"], "typeCheckingMode": "standard"}
    (folder / "pyrightconfig.json").write_text(json.dumps(options), encoding="utf-8")
    assert len(list(folder.glob("*_md.py"))) >= 4
    return folder


@pytest.fixture
def cache(request, sources):
    """A folder for what a checker knows of files that do not change, such as those of NumPy."""
    kept = getattr(request.config, "cache", None)
    return sources / "cache" if kept is None else kept.mkdir("mypy")


def run_mypy(folder, monkeypatch, cache):
    if find_spec("mypy") is None:
        pytest.skip("mypy is not installed (pip install mypy)")
    monkeypatch.setenv("MYPYPATH", str(folder / "packages"))
    options = [
        "--follow-imports=silent",
        "--strict",
        "--allow-untyped-defs",  # an example says what it does, not what its functions take
        "--allow-untyped-calls",
        "--allow-any-generics",
        "--allow-redefinition-new",
        "--local-partial-types",
        "--hide-error-context",
        "--disable-error-code=import-untyped",
        "--config-file=",
    ]
    return [sys.executable, "-m", "mypy", *options, "--cache-dir", str(cache)]


def run_pyright(folder, monkeypatch, cache):
    """basedpyright is pyright as a wheel, where pyright fetches its program from elsewhere."""
    if find_spec("basedpyright") is None:
        pytest.skip("basedpyright is not installed (pip install basedpyright)")
    return [
        sys.executable,
        "-m",
        "basedpyright",
        "--pythonpath",
        sys.executable,
        "--level",
        "error",
    ]


@pytest.mark.parametrize(
    "run",
    [
        pytest.param(run_mypy, id="mypy"),
        pytest.param(run_pyright, id="pyright", marks=pytest.mark.slow),
    ],
)
def test_a_type_checker_reads_the_examples(run, sources, monkeypatch, cache):
    command = run(sources, monkeypatch, cache)
    files = sorted(path.name for path in sources.glob("*.py"))
    done = subprocess.run([*command, *files], cwd=sources, capture_output=True, text=True)
    # They say no types.
    told = re.sub(r'.* attribute of module "mujoco".*', "", done.stdout)
    told = re.sub(r'.* (stub|stub file) .*"pybullet.*', "", told)
    found = re.findall(r"^.*?(\w+)\.py:(\d+).*\berror\b.*$", told, re.MULTILINE)
    others = [(name, line) for name, line in found if name != "wrong"]
    assert not others, done.stdout
    first = RIGHT.count("\n") + 2
    expected = set(range(first, first + WRONG.count("\n") - 1))
    assert {int(line) for name, line in found if name == "wrong"} == expected, done.stdout
